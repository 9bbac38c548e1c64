"""A readable diff: the text on disk to the left, the new one to the right."""

from html import escape

from nicegui import ui

from vicode.editor.session.diffing import Change, Row, side_by_side

_SIGNS = {Change.ADDED: "+", Change.REMOVED: "−", Change.CHANGED: "±"}
_WORDS = {Change.ADDED: "added", Change.REMOVED: "removed", Change.CHANGED: "changed"}
_MOST_ROWS = 2000


def diff_view(old: str | None, new: str | None) -> ui.html:
    """Build it; None: there is no file on that side."""
    rows = side_by_side(old or "", new or "")
    body = "".join(_row(row) for row in rows[:_MOST_ROWS])
    if len(rows) > _MOST_ROWS:
        body += f'<tr class="gap"><td colspan="5">and {len(rows) - _MOST_ROWS} more lines</td></tr>'
    heads = ("on disk" if old is not None else "no file yet", "generated" if new is not None else "will be deleted")
    head = f'<tr><th colspan="2">{heads[0]}</th><th></th><th colspan="2">{heads[1]}</th></tr>'
    columns = '<colgroup><col class="number"><col><col class="sign"><col class="number"><col></colgroup>'
    table = f'<table class="diff mono">{columns}<thead>{head}</thead><tbody>{body}</tbody></table>'
    # Everything that comes from a text is escaped here; nothing else is in it.
    return (
        ui.html(table, sanitize=False).classes("diff-box").props('tabindex="0" role="region" aria-label="Differences"')
    )


def _row(row: Row) -> str:
    if row.change is Change.GAP:
        return f'<tr class="gap"><td colspan="5">{escape(row.old)}</td></tr>'
    sign = _SIGNS.get(row.change, "")
    word = _WORDS.get(row.change, "")
    return (
        f'<tr class="{row.change}"><td class="number">{row.old_number or ""}</td><td class="old">{escape(row.old)}</td>'
        f'<td class="sign" title="{word}">{sign}</td>'
        f'<td class="number">{row.new_number or ""}</td><td class="new">{escape(row.new)}</td></tr>'
    )
