"""Automatic layout in one window: computed in the background, previewed on the canvas, applied or discarded."""

from collections.abc import Collection, Iterator
from dataclasses import dataclass, field

from nicegui import run, ui
from nicegui.events import ClickEventArguments, Handler

from vicode.diagram.drawn_transitions import shows_common
from vicode.diagram.layered_layout import NodeLayout
from vicode.diagram.layout import LayoutMethod, LayoutService
from vicode.editor.pages.canvas_controller import CanvasController
from vicode.editor.pages.shortcuts import ESCAPE_ATTRIBUTE
from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import apply_layout
from vicode.editor.session.gestures.canvas_gestures import NodePosition
from vicode.model.design import Design

# Graphviz needs longer for more states than this.
_MANY = 500
_LIMIT_S, _LONG_LIMIT_S = 5.0, 15.0
_WORDS = {LayoutMethod.GRAPHVIZ: "with Graphviz", LayoutMethod.LAYERS: "in layers"}


@dataclass(frozen=True, slots=True, kw_only=True)
class LayoutProposal:
    """Positions in preview; `only` names the states that move, None for the whole diagram."""

    layout: NodeLayout
    only: tuple[str, ...] | None


@dataclass(eq=False)
class AutoLayout:
    """The bar over the canvas that shows the progress of a layout, then buttons to apply or discard it."""

    context: WindowContext
    canvas_controller: CanvasController
    proposal: LayoutProposal | None = None
    service: LayoutService | None = None
    bar: ui.element = field(init=False)

    def __post_init__(self) -> None:
        self.bar = ui.element("div").classes("layout-bar").props('role="region" aria-label="Layout"')
        self.bar.set_visibility(False)
        self.canvas_controller.on_preview = self.finish_preview

    def commands(self) -> tuple[Command, ...]:
        return (Command("lay-out", "Auto layout", self.start, MenuGroup.EDIT, icon="auto_awesome_mosaic"),)

    def start(self) -> None:
        """Compute a layout for the selected states, or for the whole diagram, and preview it."""
        if self.service is None:
            self.discard_preview()
            self.context.run_in_background(self._propose(), "lay out")

    async def cancel(self) -> None:
        service, self.service = self.service, None
        self.bar.set_visibility(False)
        if service is not None:
            await run.io_bound(service.close)

    def finish_preview(self, *, accepted: bool) -> None:
        """Apply the previewed positions as one edit, or discard them."""
        if not accepted:
            self.discard_preview()
            return
        proposal, self.proposal = self.proposal, None
        if proposal is None:
            return
        self.bar.set_visibility(False)
        self.context.edit("lay out", lambda design: apply_layout(design, proposal.layout, proposal.only))
        self.canvas_controller.canvas.end_preview()

    def discard_preview(self) -> None:
        """End the preview: the user cancelled it, or the design changed."""
        if self.proposal is not None:
            self.proposal = None
            self.bar.set_visibility(False)
            self.canvas_controller.canvas.show_preview([])

    async def _propose(self) -> None:
        design, rev = self.context.design, self.context.document.rev
        only = tuple(item.id for item in self.context.selected if item.kind == "states") or None
        count = len(only or design.states)
        limit_s = _LIMIT_S if count <= _MANY else _LONG_LIMIT_S
        self._show_progress(_format_count(count), limit_s)
        self.service = service = LayoutService()
        layout = await run.io_bound(service.compute, design, only=only, timeout_s=limit_s)
        is_current, self.service = self.service is service, None
        await run.io_bound(service.close)
        if layout is None or self.canvas_controller.canvas.is_deleted or not is_current:
            return
        self.bar.set_visibility(False)
        if self.context.document.rev != rev:
            self.context.show_toast("The design changed. Run the layout again.", "info")
            return
        self.proposal = LayoutProposal(layout=layout.layout, only=only)
        self.canvas_controller.canvas.show_preview(list(_node_positions(design, layout.layout, only)))
        self._show_preview(f"{_format_count(count)} {_WORDS[LayoutMethod(layout.method)]}", layout.note)

    def _show_progress(self, what: str, limit_s: float) -> None:
        self.bar.clear()
        with self.bar:
            ui.label(f"Laying out {what} ({limit_s:g} s at most)").classes("layout-words").props('role="status"')
            ui.element("div").classes("layout-progress").style(f"--limit: {limit_s:g}s")
            self._cancel_button(self.cancel)
        self.bar.set_visibility(True)

    def _cancel_button(self, leave: Handler[ClickEventArguments]) -> None:
        button = ui.button("Cancel", on_click=leave, color=None).props(f"flat no-caps dense {ESCAPE_ATTRIBUTE}")
        button.tooltip("Escape")

    def _show_preview(self, what: str, note: str) -> None:
        self.bar.clear()
        with self.bar:
            with ui.element("div").classes("layout-words").props('role="status"'):
                ui.label(f"Preview: {what}")
                if note:
                    ui.label(note).classes("small")
            primary_button("Apply", lambda: self.finish_preview(accepted=True)).tooltip("Enter")
            self._cancel_button(self.discard_preview)
        self.bar.set_visibility(True)


def _format_count(states: int) -> str:
    return f"{states} state" + ("" if states == 1 else "s")


def _node_positions(design: Design, layout: NodeLayout, only: Collection[str] | None) -> Iterator[NodePosition]:
    for name, (x, y) in layout.states.items():
        if only is None or name in only:
            yield NodePosition(kind="states", id=name, x=x, y=y)
    for name, (x, y) in layout.notes.items():
        yield NodePosition(kind="notes", id=name, x=x, y=y)
    if only is not None:
        return
    for alias, (x, y) in layout.uses.items():
        yield NodePosition(kind="components", id=alias, x=x, y=y)
    if shows_common(design):
        yield NodePosition(kind="common", id="@common", x=layout.common[0], y=layout.common[1])
