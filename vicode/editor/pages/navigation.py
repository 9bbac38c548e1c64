"""Navigation between designs: search, open a used component, go back. The URL follows the selection."""

import json
from collections.abc import Callable, Sequence

from nicegui import ui

from vicode.editor.pages.canvas_controller import CanvasController
from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.designs.open_design import open_design
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.search.search_index import SearchTarget
from vicode.editor.view import ItemRef
from vicode.editor.view.page_urls import design_url, extend_trail

HOME = "/"


class Navigator:
    """Navigation from one design.

    Args:
        context: the open design.
        open_palette: opens the command palette of the window.
        trail: the components on the path to this design.
    """

    def __init__(self, context: WindowContext, open_palette: Callable[[], None], trail: Sequence[str]) -> None:
        self._context, self._open_palette, self._trail = context, open_palette, tuple(trail)
        self._shown = context.selected
        context.changes.subscribe(self._update_address)

    def commands(self) -> tuple[Command, ...]:
        return (
            Command(
                "find",
                "Find anything",
                self._open_palette,
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

    def select_initial(self, selected: ItemRef | None, canvas_controller: CanvasController) -> None:
        """Select and show the item that the URL names, if it exists."""
        if selected is not None and canvas_controller.exists(selected):
            self._context.selected = self._shown = (selected,)
            canvas_controller.scroll_to_initial(selected)

    def go_to(self, target: SearchTarget) -> None:
        context = self._context
        if (target.project, target.component) != (context.workspace.key, context.design.component):
            open_design(design_url(target.project, target.component, target.selected))
        elif target.selected is None:
            context.select()
        else:
            context.show(target.selected)

    def open_component(self, component: str) -> None:
        workspace, here = self._context.workspace, self._context.design.component
        if workspace.project.design(component) is None:
            self._context.show_toast(f"{component} is hand-written and has no design", "info")
        else:
            with self._context.client:
                open_design(design_url(workspace.key, component, trail=extend_trail(self._trail, here)))

    def _update_address(self) -> None:
        """Update the URL, so that it can be shared, and Back restores the selection."""
        context = self._context
        if context.selected == self._shown:
            return
        self._shown = context.selected
        address = design_url(context.workspace.key, context.design.component, context.single_selection, self._trail)
        context.client.run_javascript(f"replaceDesignUrl({json.dumps(address)})")
