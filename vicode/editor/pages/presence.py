"""Presence of one window: announces it while it is connected, and shows the other users."""

from nicegui import core

from vicode.editor.canvas import Canvas
from vicode.editor.canvas.protocol import RemoteUser, item_json
from vicode.editor.pages.user_identity import store_name
from vicode.editor.panels.presence_bar import PresenceBar
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import Presence, User

_UPDATE_DELAY_S = 0.04


class PresenceSync:
    """Synchronizes one window with the presence room of the design."""

    def __init__(self, context: WindowContext, user: User, canvas: Canvas, presence_bar: PresenceBar) -> None:
        """Join when the browser connects; leave when it disconnects, or the window shows another design or closes."""
        self.context, self.person, self.canvas, self.presence_bar = context, user, canvas, presence_bar
        presence_bar.rename = self.rename
        self.shown_typing: object = None
        self.is_update_scheduled = False
        context.closings.subscribe(context.presence.changes.subscribe(self._on_presence_change))
        for leaving in (context.disconnects, context.closings):
            leaving.subscribe(lambda: context.presence.leave(context.window))
        context.changes.subscribe(lambda: context.presence.update(context.window, selected=context.selected))

    def rename(self, name: str) -> None:
        """Rename the user in all windows, and store the name in the browser."""
        store_name(name)
        self.person = self.context.document.shared.users.get_or_create_user(self.person.id, name)
        for presence in self.context.presence.presences:
            if presence.user.id == self.person.id:
                self.context.presence.update(presence.window, user=self.person)

    def join(self) -> None:
        self.context.presence.join(self.context.window, self.person)
        self.context.presence.update(self.context.window, selected=self.context.selected)

    def _on_presence_change(self) -> None:
        if not self.is_update_scheduled and core.loop is not None:
            self.is_update_scheduled = True
            # With many users, presence updates may wait; edits do not.
            core.loop.call_later(_UPDATE_DELAY_S * max(1, len(self.context.presence.presences) / 4), self._show)

    def _show(self) -> None:
        self.is_update_scheduled = False
        if self.canvas.is_deleted:
            return
        others = self.context.presence.others(self.context.window)
        typing = [(each.user.name, each.editing_path) for each in others if each.editing_path]
        with self.canvas.client:
            self.canvas.show_presence([_other_user(each) for each in others if each.user.id != self.person.id])
            self.presence_bar.refresh()
            if typing != self.shown_typing:
                self.shown_typing = typing
                self.context.notify_subscribers()


def _other_user(presence: Presence) -> RemoteUser:
    point = presence.pointer
    return {
        "name": presence.user.name,
        "color": presence.user.color,
        "items": [item_json(item) for item in presence.selected if item.kind != "design"],
        "pointer": {"x": point[0], "y": point[1]} if point else None,
    }
