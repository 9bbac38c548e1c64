"""Navigation between designs: search, open a used component, go back. The URL follows the selection."""

import json
from collections.abc import Sequence
from dataclasses import dataclass

from nicegui import ui

from vicode.editor.pages import texts
from vicode.editor.pages.canvas_controller import CanvasController
from vicode.editor.panels.command import Command, MenuGroup
from vicode.editor.panels.command_palette import CommandPalette
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.search_index import SearchIndex, SearchTarget
from vicode.editor.view.page_urls import design_url, extend_trail, parse_selection

HOME = "/"


@dataclass(frozen=True, slots=True, kw_only=True)
class PageRequest:
    """Parameters of a page: the breadcrumb trail, the item to select, and the search index."""

    index: SearchIndex
    trail: tuple[str, ...] = ()
    select: str = ""
    tour: bool = False
    """Whether the tour may start automatically."""


class Navigator:
    """Navigation of one window.

    Args:
        context: the open design.
        index: the search index.
        trail: the components on the path to this design.
    """

    def __init__(self, context: WindowContext, index: SearchIndex, trail: Sequence[str]) -> None:
        self._context, self._trail = context, tuple(trail)
        self._shown = context.selected
        here = SearchTarget(project=context.workspace.key, component=context.design.component)
        self.palette = CommandPalette(index, self.go_to, here)
        context.changes.subscribe(self._update_address)

    def commands(self) -> tuple[Command, ...]:
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
            # The browser handles Alt+Left itself, also before the page is connected.
            Command("back", "Go back", ui.navigate.back, MenuGroup.VIEW, icon="arrow_back"),
            Command(
                "home", "All designs", lambda: ui.navigate.to(HOME), MenuGroup.VIEW, icon="home", keys=("Alt+Home",)
            ),
        )

    def select_initial(self, selection: str, canvas_controller: CanvasController) -> None:
        """Select and show the item that the URL names, if it exists."""
        selected = parse_selection(selection)
        if selected is not None and canvas_controller.exists(selected):
            self._context.selected = self._shown = (selected,)
            canvas_controller.scroll_to_initial(selected)

    def go_to(self, target: SearchTarget) -> None:
        context = self._context
        if (target.project, target.component) != (context.workspace.key, context.design.component):
            ui.navigate.to(design_url(target.project, target.component, target.selected))
        elif target.selected is None:
            context.select()
        else:
            context.select(target.selected)
            context.page.reveal(target.selected)

    def open_component(self, component: str) -> None:
        workspace, here = self._context.workspace, self._context.design.component
        if workspace.project.design(component) is None:
            self._context.show_toast(texts.hand_written_component(component), "info")
        else:
            with self._context.client:
                ui.navigate.to(design_url(workspace.key, component, trail=extend_trail(self._trail, here)))

    def _update_address(self) -> None:
        """Update the URL, so that it can be shared, and Back restores the selection."""
        context = self._context
        if context.selected == self._shown:
            return
        self._shown = context.selected
        address = design_url(context.workspace.key, context.design.component, context.single_selection, self._trail)
        context.client.run_javascript(f'history.replaceState(history.state, "", {json.dumps(address)})')
