"""The history as lines of a list: the newest first, branches indented."""

from dataclasses import dataclass

from vicode.editor.session.history import History, Step


@dataclass(frozen=True, slots=True, kw_only=True)
class HistoryLine:
    """One step: `depth` is 0 on the way to where the design is, more on branches beside it."""

    step: Step
    depth: int
    is_now: bool
    is_ahead: bool


def lines_of_history(history: History, most: int) -> tuple[HistoryLine, ...]:
    """The newest steps, at most so many, and always where the design is."""
    newest_child = {step.parent: step.id for step in sorted(history.steps.values(), key=lambda each: each.id)}
    before = {step.id for step in history.path}
    ahead: list[int] = []
    at = history.at
    while at in newest_child:
        at = newest_child[at]
        ahead.append(at)
    main = before | set(ahead)
    depths: dict[int, int] = {}
    for id_, step in sorted(history.steps.items()):
        goes_on = step.parent not in main and newest_child.get(step.parent) == id_
        depths[id_] = 0 if id_ in main else depths.get(step.parent, 0) + (0 if goes_on else 1)
    shown = sorted(history.steps, reverse=True)[:most]
    if history.at not in shown:
        shown.append(history.at)
    return tuple(
        HistoryLine(
            step=history.steps[id_],
            depth=depths[id_],
            is_now=id_ == history.at,
            is_ahead=id_ not in before,
        )
        for id_ in shown
    )
