"""Compares two versions of a design by state and transition."""

from collections.abc import Iterator, Sequence

from vicode.findings import DesignPath
from vicode.model.design import (
    Action,
    Call,
    CommonSection,
    Competence,
    CompetenceStep,
    Design,
    DiagramFrame,
    Latch,
    Layer,
    RunCode,
    State,
)
from vicode.model.diff.changes import Change, ChangeKind
from vicode.model.diff.decision_diff import diff_decisions
from vicode.model.diff.item_diff import (
    diff_declarations,
    diff_fields,
    diff_keyed,
    diff_ordered,
    diff_positions,
    diff_values,
)
from vicode.model.edits import rename_state, rename_use
from vicode.model.lowering import lift_design, lower_design
from vicode.model.merge.matching import find_renamed_states, find_renamed_uses
from vicode.model.words import describe_action, describe_parts, describe_property, describe_value

_Construct = Latch | CompetenceStep | Layer
_SECTIONS = ("parameters", "outputs", "variables")
_PHASES = {"enter": "enter action", "actions": "action", "leave": "leave action"}
_APART = {
    Design: (
        "component",
        "uses",
        *_SECTIONS,
        "common",
        "states",
        "latches",
        "interrupts",
        "competence",
        "layers",
        "positions",
        "properties",
        "frames",
        "notes",
    ),
    State: ("name", "requires", "modulates", *_PHASES, "transitions"),
    CommonSection: ("actions", "transitions"),
}
"""The fields that are not compared as one value."""


def diff_designs(old: Design, new: Design) -> tuple[Change, ...]:
    """Compare two versions of a design.

    A removed and an added state are one renamed state if they have the same id or mostly the same content. References
    to renamed states and uses are no changes of their own.
    """
    if old == new:
        return ()
    old, new = lift_design(old), lift_design(new)
    changes: list[Change] = []
    if old.component != new.component:
        subject = f"component {new.component}"
        changes.append(
            Change(kind=ChangeKind.RENAMED, subject=subject, path=("component",), old=old.component, new=new.component)
        )
    old, renames = _apply_renames(old, new)
    return (*changes, *renames, *_diff_content(old, new))


def rename_like(old: Design, new: Design) -> Design:
    """The old version with the states and uses that were renamed under their new names."""
    return _apply_renames(old, new)[0]


def _apply_renames(old: Design, new: Design) -> tuple[Design, list[Change]]:
    renames: list[Change] = []
    for section, kind, find, rename in (
        ("states", "state", find_renamed_states, rename_state),
        ("uses", "use", find_renamed_uses, rename_use),
    ):
        for before, after in find(old, new).items():
            old = lift_design(rename(lower_design(old), before, after))
            subject = f"{kind} {after}"
            renames.append(
                Change(kind=ChangeKind.RENAMED, subject=subject, path=(section, after), old=before, new=after)
            )
    return old, renames


def _diff_content(old: Design, new: Design) -> Iterator[Change]:
    yield from diff_fields((), "", old, new, _APART[Design])
    yield from diff_keyed(
        ("uses",),
        old.uses,
        new.uses,
        subject=lambda use: f"use {use.alias}",
        content=lambda use: str(use.component),
        compare=lambda here, before, after: diff_fields(here, f"use {after.alias}", before, after, ("alias",)),
    )
    for section in _SECTIONS:
        before, after = getattr(old, section), getattr(new, section)
        yield from diff_declarations((section,), before, after, section.removesuffix("s"))
    yield from _diff_common(old.common, new.common)
    yield from diff_keyed(
        ("states",),
        old.states,
        new.states,
        subject=lambda state: f"state {state.name}",
        content=_describe_state,
        compare=_diff_state,
    )
    yield from _diff_constructs(old, new)
    yield from diff_ordered(
        ("properties",),
        old.properties,
        new.properties,
        subject=lambda _promised: "property",
        content=describe_property,
        compare=lambda _there, here, before, after: diff_values(here, "property", before, after, describe_property),
    )
    yield from diff_keyed(
        ("frames",),
        old.frames,
        new.frames,
        subject=lambda frame: f"frame {frame.name}",
        content=lambda frame: ", ".join(frame.states),
        compare=_diff_frame,
    )
    yield from diff_keyed(
        ("notes",),
        old.notes,
        new.notes,
        subject=lambda note: f"note {note.name}",
        content=lambda note: str(note.text),
        compare=lambda here, before, after: diff_fields(here, f"note {after.name}", before, after),
    )


def _diff_constructs(old: Design, new: Design) -> Iterator[Change]:
    yield from _diff_named(("latches",), "latch", old.latches, new.latches)
    yield from diff_ordered(
        ("interrupts",),
        old.interrupts,
        new.interrupts,
        subject=lambda interrupt: f"interrupt by {interrupt.do}",
        content=describe_parts,
        compare=lambda _there, here, before, after: diff_fields(here, f"interrupt by {after.do}", before, after, ()),
    )
    yield from _diff_competence(old.competence, new.competence)
    yield from _diff_named(("layers",), "layer", old.layers, new.layers)
    before, after = ({each.name: each.at for each in design.positions} for design in (old, new))
    for name in {**before, **after}:
        yield from diff_positions(("positions", name), f"state {name}", before.get(name), after.get(name))


def _diff_named(path: DesignPath, kind: str, old: Sequence[_Construct], new: Sequence[_Construct]) -> Iterator[Change]:
    return diff_keyed(
        path,
        old,
        new,
        subject=lambda each: f"{kind} {each.name}",
        content=describe_parts,
        compare=lambda here, before, after: diff_fields(here, f"{kind} {after.name}", before, after),
    )


def _diff_competence(old: Competence | None, new: Competence | None) -> Iterator[Change]:
    path = ("competence",)
    if old is None or new is None:
        yield from diff_values(path, "", old, new, describe_value, attribute="competence")
    else:
        yield from diff_fields(path, "competence", old, new, ("steps",))
        yield from _diff_named((*path, "steps"), "step", old.steps, new.steps)


def _diff_frame(path: DesignPath, old: DiagramFrame, new: DiagramFrame) -> Iterator[Change]:
    subject = f"frame {new.name}"
    yield from diff_fields(path, subject, old, new, ("name", "states"))
    yield from diff_values((*path, "states"), subject, old.states, new.states, ", ".join)


def _diff_common(old: CommonSection, new: CommonSection) -> Iterator[Change]:
    yield from diff_fields(("common",), "common section", old, new, _APART[CommonSection])
    yield from _diff_actions(("common", "actions"), "action", "common section", old.actions, new.actions)
    yield from diff_decisions(("common", "transitions"), "common", old.transitions, new.transitions)


def _describe_state(state: State) -> str:
    """The content of an added or removed state, as counts."""
    count = len(state.transitions)
    return f"{count} transition{'s' * (count != 1)}" if count else ""


def _diff_state(path: DesignPath, old: State, new: State) -> Iterator[Change]:
    owner = f"state {new.name}"
    yield from diff_fields(path, owner, old, new, _APART[State])
    yield from diff_keyed(
        (*path, "requires"),
        old.requires,
        new.requires,
        subject=lambda alias: f"requirement {alias} of {owner}",
        content=lambda _alias: "",
        compare=lambda _path, _old, _new: iter(()),
    )
    yield from diff_keyed(
        (*path, "modulates"),
        old.modulates,
        new.modulates,
        subject=lambda call: f"modulation of {call.alias} in {owner}",
        content=_arguments,
        compare=lambda here, before, after: diff_values(
            here, f"modulation of {after.alias} in {owner}", before, after, _arguments
        ),
    )
    for phase, kind in _PHASES.items():
        yield from _diff_actions((*path, phase), kind, owner, getattr(old, phase), getattr(new, phase))
    yield from diff_decisions((*path, "transitions"), new.name, old.transitions, new.transitions)


def _diff_actions(
    path: DesignPath, kind: str, owner: str, old: tuple[Action, ...], new: tuple[Action, ...]
) -> Iterator[Change]:
    subject = f"{kind} of {owner}"
    return diff_ordered(
        path,
        old,
        new,
        subject=lambda _action: subject,
        content=describe_action,
        compare=lambda _there, here, before, after: _diff_action(here, subject, before, after),
    )


def _diff_action(path: DesignPath, subject: str, old: Action, new: Action) -> Iterator[Change]:
    if isinstance(old, RunCode) and isinstance(new, RunCode):
        yield from diff_fields(path, subject, old, new, ("code",))
        yield from diff_values(path, subject, old.code, new.code, describe_value)
    else:
        yield from diff_values(path, subject, old, new, describe_action)


def _arguments(call: Call) -> str:
    return ", ".join(f"{name}: {text}" for name, text in call.arguments)
