"""Shows in one window what other programs changed in generated code: notices with Undo, and marks until looked at."""

from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import DISK_USER, DocumentSession
from vicode.editor.view import ItemRef

_DESIGN = (ItemRef(kind="design"),)


class OutsideEditNotices:
    """Shows new notices, and removes the marks of items that were selected and left."""

    def __init__(self, context: WindowContext) -> None:
        self.context = context
        self._shown = context.document.shared.outside.notice.number
        self._selected = context.selected or _DESIGN

    def refresh(self) -> None:
        outside = self.context.document.shared.outside
        if outside.notice.number != self._shown:
            self._shown = outside.notice.number
            entry_id = outside.notice.entry_id
            self.context.page.offer_undo(outside.notice.text, lambda: self._undo(entry_id))
        selected = self.context.selected or _DESIGN
        if selected != self._selected:
            left, self._selected = self._selected, selected
            if outside.unmark(left):
                self._notify()

    def _undo(self, entry_id: int) -> None:
        error = self.context.document.undo_entry(entry_id)
        if error:
            self.context.show_toast(error, "warning")

    def _notify(self) -> None:
        shared = self.context.document.shared
        shared.changes.notify(DocumentSession(shared, DISK_USER))
