"""The undo history as rows of a list, newest first, with branches indented."""

from dataclasses import dataclass

from vicode.editor.session.history import HistoryEntry, UndoHistory


@dataclass(frozen=True, slots=True, kw_only=True)
class HistoryRow:
    """One entry; `depth` is 0 on the current path and its continuation, more on other branches."""

    entry: HistoryEntry
    depth: int
    is_current: bool
    is_ahead: bool


def list_history_rows(history: UndoHistory, limit: int) -> tuple[HistoryRow, ...]:
    """The newest entries up to `limit`, and always the current one."""
    newest_child = {entry.parent: entry.id for _id, entry in sorted(history.entries.items())}
    before = {entry.id for entry in history.path}
    ahead: list[int] = []
    entry_id = history.current_id
    while entry_id in newest_child:
        entry_id = newest_child[entry_id]
        ahead.append(entry_id)
    main = before | set(ahead)
    depths: dict[int, int] = {}
    for id_, entry in sorted(history.entries.items()):
        continues_branch = entry.parent not in main and newest_child.get(entry.parent) == id_
        depths[id_] = 0 if id_ in main else depths.get(entry.parent, 0) + (0 if continues_branch else 1)
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
