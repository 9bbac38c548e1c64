"""The history as lines of a list: the newest first, branches indented."""

from dataclasses import dataclass

from vicode.editor.session.history import HistoryEntry, UndoHistory


@dataclass(frozen=True, slots=True, kw_only=True)
class HistoryRow:
    """One step: `depth` is 0 on the way to where the design is, more on branches beside it."""

    entry: HistoryEntry
    depth: int
    is_current: bool
    is_ahead: bool


def list_history_rows(history: UndoHistory, limit: int) -> tuple[HistoryRow, ...]:
    """The newest steps, at most so many, and always where the design is."""
    newest_child = {step.parent: step.id for step in sorted(history.entries.values(), key=lambda each: each.id)}
    before = {step.id for step in history.path}
    ahead: list[int] = []
    at = history.current_id
    while at in newest_child:
        at = newest_child[at]
        ahead.append(at)
    main = before | set(ahead)
    depths: dict[int, int] = {}
    for id_, step in sorted(history.entries.items()):
        goes_on = step.parent not in main and newest_child.get(step.parent) == id_
        depths[id_] = 0 if id_ in main else depths.get(step.parent, 0) + (0 if goes_on else 1)
    shown = sorted(history.entries, reverse=True)[:limit]
    if history.current_id not in shown:
        shown.append(history.current_id)
    return tuple(
        HistoryRow(
            entry=history.entries[id_],
            depth=depths[id_],
            is_current=id_ == history.current_id,
            is_ahead=id_ not in before,
        )
        for id_ in shown
    )
