"""The way through the designs: find a thing and go there, open a used component, come back; the address follows."""

import json
from collections.abc import Sequence
from dataclasses import dataclass

from nicegui import ui

from vicode.editor.panels.command import Command, Place
from vicode.editor.panels.desk import Desk
from vicode.editor.panels.palette import Palette
from vicode.editor.session.finding_things import Goal, Index
from vicode.editor.view import Selected
from vicode.editor.view.address import design_address, selected_of_text, trail_onwards

HOME = "/"


@dataclass(frozen=True, slots=True, kw_only=True)
class Way:
    """How one came to a page: the components on the way, what to select there; and the index of what there is."""

    index: Index
    trail: tuple[str, ...] = ()
    select: str = ""
    tour: bool = False
    """Whether the tour may begin by itself."""


class Going:
    """Where one window can go from here.

    Args:
        desk: the open design.
        index: what can be found.
        trail: the components one came through.
    """

    def __init__(self, desk: Desk, index: Index, trail: Sequence[str]) -> None:
        """Let the desk lead on to used components."""
        self._desk, self._trail = desk, tuple(trail)
        self._shown = desk.selected
        here = Goal(project=desk.workspace.key, component=desk.design.component)
        self.palette = Palette(index, self.go, here)
        desk.open = self.open
        desk.listen(self._follow_selection)

    def commands(self) -> tuple[Command, ...]:
        """Find, back and home."""
        return (
            Command(
                "find",
                "Find anything",
                self.palette.open,
                Place.VIEW,
                icon="search",
                keys=("Ctrl+K",),
                while_typing=True,
            ),
            # Alt+Left is the browser's own, and works before the page is awake.
            Command("back", "Back to where you came from", ui.navigate.back, Place.VIEW, icon="arrow_back"),
            Command("home", "All designs", lambda: ui.navigate.to(HOME), Place.VIEW, icon="home", keys=("Alt+Home",)),
        )

    def start(self, wanted: str) -> Selected | None:
        """Select what the address names; None if that is nothing here."""
        selected = selected_of_text(wanted)
        if selected is None or not self._desk.is_there(selected):
            return None
        self._desk.selected = self._shown = (selected,)
        return selected

    def go(self, goal: Goal) -> None:
        """Show a thing, here or in another design."""
        desk = self._desk
        if (goal.project, goal.component) != (desk.workspace.key, desk.design.component):
            ui.navigate.to(design_address(goal.project, goal.component, goal.selected))
        elif goal.selected is None:
            desk.select()
        else:
            desk.select(goal.selected)
            desk.reveal(goal.selected)

    def open(self, component: str) -> None:
        """Open the design of a component that this one uses."""
        workspace, here = self._desk.workspace, self._desk.design.component
        if workspace.project.design(component) is None:
            self._desk.say(f"{component} is hand-written: it has no design to open", "info")
        else:
            with self._desk.client:
                ui.navigate.to(design_address(workspace.key, component, trail=trail_onwards(self._trail, here)))

    def _follow_selection(self) -> None:
        """Keep the address true, so that it can be given to others, and Back finds what was selected."""
        desk = self._desk
        if desk.selected == self._shown:
            return
        self._shown = desk.selected
        address = design_address(desk.workspace.key, desk.design.component, desk.only, self._trail)
        desk.client.run_javascript(f'history.replaceState(history.state, "", {json.dumps(address)})')
