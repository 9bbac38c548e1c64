"""Takes the drawing out: as a file to download, or as text on the clipboard, with a look at it first."""

import base64
import json
from collections.abc import Callable

from nicegui import run, ui

from vicode.diagram.export_formats import ExportFormat, ExportOptions
from vicode.editor.panels.command import Command, MenuGroup
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.model.names import snake_case

_TITLES = {
    ExportFormat.SVG: "SVG, sharp at every size",
    ExportFormat.PDF: "PDF, one page",
    ExportFormat.PNG: "PNG, for slides",
    ExportFormat.MERMAID: "Mermaid, for READMEs",
    ExportFormat.PLANTUML: "PlantUML",
    ExportFormat.DOT: "DOT, for Graphviz",
}
_TEXTS = (ExportFormat.MERMAID, ExportFormat.PLANTUML, ExportFormat.DOT)
_ALL, _SELECTED = "Everything", "What is selected"
# Also where a page is not served securely, and has only the old way.
_WRITE = "return Quasar.copyToClipboard(%s).then(() => true, () => false)"
# A browser may ask first whether it is allowed.
_CLIPBOARD_TIMEOUT_S = 60
# A look at more would be slower than the download.
_MAX_PREVIEW_STATES = 400


class ExportDialog:
    """Asks what to take out, and how.

    Args:
        context: the open design, and what is selected.
        links_shown: whether the drawing shows used components just now.
    """

    def __init__(self, context: WindowContext, links_shown: Callable[[], bool]) -> None:
        """Open it by its commands."""
        self._context, self._links_shown = context, links_shown

    def commands(self) -> tuple[Command, ...]:
        """The dialog, and a way past it for each text."""
        copies = tuple(
            Command(
                f"copy-{form}",
                f"Copy as {form.label}",
                _copier(self._context, form),
                MenuGroup.DESIGN,
                icon="content_copy",
            )
            for form in _TEXTS
        )
        keys = ("Ctrl+Shift+E",)
        ask = Command(
            "export", "Export the drawing…", self.ask, MenuGroup.DESIGN, icon="download", keys=keys, while_typing=True
        )
        return (ask, *copies)

    def ask(self) -> None:
        """Ask, showing what would come out."""
        selected = _selected_states(self._context)
        with titled_dialog(f"Export {self._context.design.component}") as dialog:
            with ui.element("div").classes("export-choices"):
                form = ui.select(_TITLES, value=ExportFormat.SVG, label="Format").props("outlined dense options-dense")
                scopes = [_ALL, _SELECTED] if selected else [_ALL]
                scope = ui.select(scopes, value=scopes[-1], label="What").props("outlined dense options-dense")
                links = ui.switch("Used components", value=self._links_shown())
                dark = ui.switch("Dark colours", value=False)
            look = ui.element("div").classes("export-preview").props("tabindex=0 role=group aria-label=Preview")

            def wish() -> ExportOptions:
                only = selected if scope.value == _SELECTED else None
                return ExportOptions(only=only, links=bool(links.value), dark=bool(dark.value))

            def show() -> None:
                look.clear()
                with look:
                    _show_preview(self._context, form.value, wish())

            for choice in (form, scope, links, dark):
                choice.on_value_change(show)
            show()
            with ui.row().classes("dialog-buttons"):
                ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
                ui.button("Copy text", on_click=lambda: _copy(self._context, form.value, wish())).props(
                    "flat no-caps"
                ).bind_enabled_from(form, "value", lambda chosen: chosen in (*_TEXTS, ExportFormat.SVG))
                primary_button("Download", lambda: _download(self._context, form.value, wish()), icon="download")
        dialog.on("hide", dialog.delete)


def _selected_states(context: WindowContext) -> frozenset[str]:
    return frozenset(thing.id for thing in context.selected if thing.kind == "states")


def _show_preview(context: WindowContext, form: ExportFormat, wish: ExportOptions) -> None:
    """A picture as a picture, a text as a text; it comes when it is drawn."""
    if len(context.design.states) > _MAX_PREVIEW_STATES:
        ui.label(f"{len(context.design.states)} states: too many to look at here").classes("empty")
        return

    async def draw() -> None:
        content = await run.io_bound(_exported, context, form if form in _TEXTS else ExportFormat.SVG, wish)
        # Another choice may have been made meanwhile, or the dialog closed.
        if content is None or place.is_deleted:
            return
        place.clear()
        with place:
            if form in _TEXTS:
                ui.label(content.decode()).classes("mono export-text")
            else:
                image = ui.element("img").props('alt="The drawing as it would come out"')
                image.props["src"] = f"data:image/svg+xml;base64,{base64.b64encode(content).decode()}"

    with ui.element("div").style("display: contents") as place:
        ui.label("Drawing …").classes("empty").props('role="status"')
    # A large drawing takes seconds; nobody waits for it.
    context.run_in_background(draw(), "look")


def _copier(context: WindowContext, form: ExportFormat) -> Callable[[], None]:
    return lambda: _copy(context, form, ExportOptions(only=_selected_states(context) or None))


def _copy(context: WindowContext, form: ExportFormat, wish: ExportOptions) -> None:
    text = json.dumps(_exported(context, form, wish).decode())

    async def write() -> None:
        try:
            is_done = await context.client.run_javascript(_WRITE % text, timeout=_CLIPBOARD_TIMEOUT_S)
        except TimeoutError:
            is_done = False
        if is_done:
            context.show_toast(f"{form.label} of {context.design.component} is on the clipboard", "positive")
        else:
            context.show_toast("The browser let nothing be put on the clipboard: export it as a file", "warning")

    context.run_in_background(write(), "copy")


def _download(context: WindowContext, form: ExportFormat, wish: ExportOptions) -> None:
    async def paint() -> None:
        # Large pictures take seconds; the others must not wait for them.
        content = await run.io_bound(_exported, context, form, wish)
        if content is not None:
            ui.download(content, f"{snake_case(context.design.component)}{form.suffix}", form.media_type)

    context.run_in_background(paint(), "export")


def _exported(context: WindowContext, form: ExportFormat, wish: ExportOptions) -> bytes:
    from vicode.diagram.export import export_design  # noqa: PLC0415 - many ways of drawing, none of them the first page's

    return export_design(context.design, form, wish)
