"""The way through the designs: find a thing and go there, open a used component, come back; the address follows."""

import json
from collections.abc import Sequence
from dataclasses import dataclass

from nicegui import ui

from vicode.editor.panels.command import Command, MenuGroup
from vicode.editor.panels.command_palette import CommandPalette
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.search_index import SearchIndex, SearchTarget
from vicode.editor.view import ItemRef
from vicode.editor.view.page_urls import design_url, extend_trail, parse_selection

HOME = "/"


@dataclass(frozen=True, slots=True, kw_only=True)
class PageRequest:
    """How one came to a page: the components on the way, what to select there; and the index of what there is."""

    index: SearchIndex
    trail: tuple[str, ...] = ()
    select: str = ""
    tour: bool = False
    """Whether the tour may begin by itself."""


class Navigator:
    """Where one window can go from here.

    Args:
        context: the open design.
        index: what can be found.
        trail: the components one came through.
    """

    def __init__(self, context: WindowContext, index: SearchIndex, trail: Sequence[str]) -> None:
        """Let the desk lead on to used components."""
        self._context, self._trail = context, tuple(trail)
        self._shown = context.selected
        here = SearchTarget(project=context.workspace.key, component=context.design.component)
        self.palette = CommandPalette(index, self.go_to, here)
        context.open_component = self.open_component
        context.subscribe(self._update_address)

    def commands(self) -> tuple[Command, ...]:
        """Find, back and home."""
        return (
            Command(
                "find",
                "Find anything",
                self.palette.open,
                MenuGroup.VIEW,
                icon="search",
                keys=("Ctrl+K",),
                while_typing=True,
            ),
            # Alt+Left is the browser's own, and works before the page is awake.
            Command("back", "Back to where you came from", ui.navigate.back, MenuGroup.VIEW, icon="arrow_back"),
            Command(
                "home", "All designs", lambda: ui.navigate.to(HOME), MenuGroup.VIEW, icon="home", keys=("Alt+Home",)
            ),
        )

    def select_initial(self, wanted: str) -> ItemRef | None:
        """Select what the address names; None if that is nothing here."""
        selected = parse_selection(wanted)
        if selected is None or not self._context.is_shown(selected):
            return None
        self._context.selected = self._shown = (selected,)
        return selected

    def go_to(self, goal: SearchTarget) -> None:
        """Show a thing, here or in another design."""
        desk = self._context
        if (goal.project, goal.component) != (desk.workspace.key, desk.design.component):
            ui.navigate.to(design_url(goal.project, goal.component, goal.selected))
        elif goal.selected is None:
            desk.select()
        else:
            desk.select(goal.selected)
            desk.reveal(goal.selected)

    def open_component(self, component: str) -> None:
        """Open the design of a component that this one uses."""
        workspace, here = self._context.workspace, self._context.design.component
        if workspace.project.design(component) is None:
            self._context.show_toast(f"{component} is hand-written: it has no design to open", "info")
        else:
            with self._context.client:
                ui.navigate.to(design_url(workspace.key, component, trail=extend_trail(self._trail, here)))

    def _update_address(self) -> None:
        """Keep the address true, so that it can be given to others, and Back finds what was selected."""
        desk = self._context
        if desk.selected == self._shown:
            return
        self._shown = desk.selected
        address = design_url(desk.workspace.key, desk.design.component, desk.single_selection, self._trail)
        desk.client.run_javascript(f'history.replaceState(history.state, "", {json.dumps(address)})')
