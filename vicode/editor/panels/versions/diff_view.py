"""A side-by-side diff: the text on disk on the left, the new text on the right."""

from html import escape

from nicegui import ui

from vicode.editor.panels.texts import more
from vicode.editor.session.text_diff import DiffRow, LineStatus, side_by_side

_SIGNS = {LineStatus.ADDED: "+", LineStatus.REMOVED: "−", LineStatus.CHANGED: "±"}
_WORDS = {LineStatus.ADDED: "added", LineStatus.REMOVED: "removed", LineStatus.CHANGED: "changed"}
_MAX_ROWS = 2000


def diff_view(old: str | None, new: str | None) -> ui.html:
    """Build the diff; None means that there is no file on that side."""
    rows = side_by_side(old or "", new or "")
    # For a new file, only the right side is shown.
    is_new = old is None
    body = "".join(_row(row, is_new=is_new) for row in rows[:_MAX_ROWS])
    if len(rows) > _MAX_ROWS:
        body += f'<tr class="gap"><td colspan="5">{more(len(rows) - _MAX_ROWS, "lines")}</td></tr>'
    left = "" if is_new else '<th scope="col" colspan="2">on disk</th>'
    right = "generated" if new is not None else "will be deleted"
    head = f'<tr>{left}<td></td><th scope="col" colspan="2">{right}</th></tr>'
    left = "" if is_new else '<col class="number"><col>'
    columns = f'<colgroup>{left}<col class="sign"><col class="number"><col></colgroup>'
    table = f'<table class="diff mono">{columns}<thead>{head}</thead><tbody>{body}</tbody></table>'
    # All texts are escaped above.
    return (
        ui.html(table, sanitize=False).classes("diff-box").props('tabindex="0" role="region" aria-label="Differences"')
    )


def _row(row: DiffRow, *, is_new: bool) -> str:
    if row.status is LineStatus.GAP:
        return f'<tr class="gap"><td colspan="5">{escape(row.old)}</td></tr>'
    sign = _SIGNS.get(row.status, "")
    word = _WORDS.get(row.status, "")
    left = f'<td class="number">{row.old_number or ""}</td><td class="old">{escape(row.old)}</td>'
    return (
        f'<tr class="{row.status}">{"" if is_new else left}'
        f'<td class="sign" title="{word}">{sign}</td>'
        f'<td class="number">{row.new_number or ""}</td><td class="new">{escape(row.new)}</td></tr>'
    )
