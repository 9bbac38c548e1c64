"""Compares the decisions of a state with their groups."""

from collections.abc import Iterable, Iterator
from typing import Any

from vicode.findings import DesignPath
from vicode.model.design import Decision, DecisionGroup, Stay, Transition
from vicode.model.diff.changes import Change, ChangeKind, describe_decision
from vicode.model.diff.item_diff import diff_fields, diff_ordered, diff_positions
from vicode.model.words import describe_guard

_APART = ("guard", "label_at", "then", "otherwise")
_Decisions = tuple[Decision, ...]


def diff_decisions(path: DesignPath, source: str, old: _Decisions, new: _Decisions) -> Iterator[Change]:
    """The changes of the decisions of a state; one that moved into or out of a group is one change."""
    changes = tuple(_diff_list(path, path, source, old, new))
    removed = {change.path: change for change in changes if change.kind is ChangeKind.REMOVED}
    added = [change for change in changes if change.kind is ChangeKind.ADDED]
    moves: dict[DesignPath, tuple[Change, ...]] = {}
    for change in added:
        origin = _find_origin(change, removed.values(), old, new)
        if origin is not None:
            del removed[origin.path]
            moves[change.path] = tuple(_describe_move(origin.path, change, source, old, new))
    for change in changes:
        if change.kind is ChangeKind.ADDED and change.path in moves:
            yield from moves[change.path]
        elif change.kind is not ChangeKind.REMOVED or change.path in removed:
            yield change


def _diff_list(there: DesignPath, here: DesignPath, source: str, old: _Decisions, new: _Decisions) -> Iterator[Change]:
    """Compare lists at the paths `there` in the old and `here` in the new version."""

    def compare(there: DesignPath, here: DesignPath, before: Any, after: Any) -> Iterator[Change]:
        return _diff_decision(there, here, source, before, after)

    return diff_ordered(
        here,
        old,
        new,
        subject=lambda decision: describe_decision(source, decision),
        content=_describe_content,
        compare=compare,
        old_path=there,
    )


def _diff_decision(there: DesignPath, here: DesignPath, source: str, before: Any, after: Any) -> Iterator[Change]:
    name = describe_decision(source, after)
    yield from diff_fields(here, name, before, after, _APART)
    if isinstance(after, Transition):
        yield from diff_positions((*here, "label_at"), f"label of {name}", before.label_at, after.label_at)
    yield from diff_fields(here, name, before.guard, after.guard)
    if isinstance(after, DecisionGroup):
        yield from _diff_list((*there, "then"), (*here, "then"), source, before.then, after.then)
        yield from _diff_list((*there, "else"), (*here, "else"), source, before.otherwise, after.otherwise)


def _find_origin(added: Change, removed: Iterable[Change], old: _Decisions, new: _Decisions) -> Change | None:
    """The removed decision that was added at another place: an equal one, or else one with the same description."""
    decision = _find(new, _steps(added.path))
    alike = [each for each in removed if (each.subject, each.old) == (added.subject, added.new)]
    alike = [each for each in alike if type(_find(old, _steps(each.path))) is type(decision)]
    return next((each for each in alike if _find(old, _steps(each.path)) == decision), alike[0] if alike else None)


def _describe_move(
    origin: DesignPath, added: Change, source: str, old: _Decisions, new: _Decisions
) -> Iterator[Change]:
    before, after = _describe_place(old, _steps(origin)), _describe_place(new, _steps(added.path))
    yield Change(
        kind=ChangeKind.MOVED,
        subject=added.subject,
        path=added.path,
        attribute="place",
        old=before,
        new=after if after != before else f"{after}, another one",
    )
    moved = _find(old, _steps(origin)), _find(new, _steps(added.path))
    yield from _diff_decision(origin, added.path, source, *moved)


def _steps(path: DesignPath) -> DesignPath:
    """The part of a path below the decisions of a state."""
    return path[path.index("transitions") + 1 :] if path[0] == "common" else path[3:]


def _find(decisions: _Decisions, steps: DesignPath) -> Decision:
    decision = decisions[int(steps[0])]
    for branch, index in zip(steps[1::2], steps[2::2], strict=True):
        decision = _branch(decision, branch)[int(index)]
    return decision


def _branch(decision: Decision, branch: str | int) -> _Decisions:
    assert isinstance(decision, DecisionGroup)
    return decision.then if branch == "then" else decision.otherwise


def _describe_place(decisions: _Decisions, steps: DesignPath) -> str:
    """The place in its list and, in a group, the branch with its guard."""
    if len(steps) == 1:
        return f"place {int(steps[0]) + 1} of {len(decisions)}"
    *outer, branch, index = steps
    group = _find(decisions, tuple(outer))
    guard = describe_guard(group.guard)
    numbers = ".".join(str(int(step) + 1) for step in outer[::2])
    place = f"place {int(index) + 1} of {len(_branch(group, branch))}"
    return f"{place} in '{branch}' of decision {numbers}{f' ({guard})' if guard else ''}"


def _describe_content(decision: Decision) -> str:
    guard = describe_guard(decision.guard)
    if not isinstance(decision, DecisionGroup):
        return guard
    inner = (*decision.then, *decision.otherwise)
    targets = [
        f"→ {each.to}" if isinstance(each, Transition) else "stay" if isinstance(each, Stay) else "…" for each in inner
    ]
    return f"{guard}{': ' if guard else ''}{', '.join(targets)}"
