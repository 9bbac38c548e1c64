"""One window among the others: it is announced while it is connected, and shows what the others are at."""

from typing import cast

from nicegui import core, ui

from vicode.editor.canvas import Canvas
from vicode.editor.canvas.gesture import Item, Other
from vicode.editor.pages.visitor import keep_name
from vicode.editor.panels.desk import Desk
from vicode.editor.panels.people_chips import PeopleChips
from vicode.editor.session import Person, Presence

_BREATH_S = 0.04


class Meeting:
    """Keeps the company informed of this window, and this window of the company."""

    def __init__(self, desk: Desk, person: Person, canvas: Canvas, chips: PeopleChips) -> None:
        """Come in when the browser connects; go when it is closed, or loses the server."""
        self.desk, self.person, self.canvas, self.chips = desk, person, canvas, chips
        chips.rename = self.rename
        self.typing: object = None
        self.is_behind = False
        client = ui.context.client
        client.on_connect(self._come)
        client.on_disconnect(lambda: desk.company.leave(desk.window))
        client.on_delete(lambda: desk.company.leave(desk.window))
        client.on_delete(desk.company.watch(self._hear))
        desk.listen(lambda: desk.company.turn(desk.window, selected=desk.selected))

    def rename(self, name: str) -> None:
        """Give this person another name, here and in the browser's memory."""
        keep_name(name)
        self.person = self.desk.document.sheet.people.greet(self.person.id, name)
        for presence in self.desk.company.all:
            if presence.person.id == self.person.id:
                self.desk.company.turn(presence.window, person=self.person)

    def _come(self) -> None:
        self.desk.company.enter(self.desk.window, self.person)
        self.desk.company.turn(self.desk.window, selected=self.desk.selected)

    def _hear(self) -> None:
        if not self.is_behind and core.loop is not None:
            self.is_behind = True
            # Where many are, news of people may wait; edits do not.
            core.loop.call_later(_BREATH_S * max(1, len(self.desk.company.all) / 4), self._show)

    def _show(self) -> None:
        self.is_behind = False
        if self.canvas.is_deleted:
            return
        others = self.desk.company.others(self.desk.window)
        typing = [(each.person.name, each.typing_in) for each in others if each.typing_in]
        with self.canvas.client:
            self.canvas.show_people([_other(each) for each in others if each.person.id != self.person.id])
            self.chips.refresh()
            if typing != self.typing:
                self.typing = typing
                self.desk.tell()


def _other(presence: Presence) -> Other:
    items = [{"of": thing.of, "id": thing.id} for thing in presence.selected if thing.of != "design"]
    point = presence.pointer
    return {
        "name": presence.person.name,
        "colour": presence.person.colour,
        "items": cast("list[Item]", items),
        "pointer": {"x": point[0], "y": point[1]} if point else None,
    }
