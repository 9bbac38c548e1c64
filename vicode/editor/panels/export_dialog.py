"""Takes the drawing out: as a file to download, or as text on the clipboard, with a look at it first."""

import base64
import json
from collections.abc import Callable

from nicegui import run, ui

from vicode.diagram.formats import Format, Wish
from vicode.editor.panels.command import Command, Place
from vicode.editor.panels.desk import Desk
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.rows import primary_button
from vicode.model.names import snake_case

_TITLES = {
    Format.SVG: "SVG, sharp at every size",
    Format.PDF: "PDF, one page",
    Format.PNG: "PNG, for slides",
    Format.MERMAID: "Mermaid, for READMEs",
    Format.PLANTUML: "PlantUML",
    Format.DOT: "DOT, for Graphviz",
}
_TEXTS = (Format.MERMAID, Format.PLANTUML, Format.DOT)
_ALL, _SELECTED = "Everything", "What is selected"
# Also where a page is not served securely, and has only the old way.
_WRITE = "return Quasar.copyToClipboard(%s).then(() => true, () => false)"
# A browser may ask first whether it is allowed.
_PATIENCE_S = 60
# A look at more would be slower than the download.
_MOST_LOOKED_AT = 400


class ExportDialog:
    """Asks what to take out, and how.

    Args:
        desk: the open design, and what is selected.
        links_shown: whether the drawing shows used components just now.
    """

    def __init__(self, desk: Desk, links_shown: Callable[[], bool]) -> None:
        """Open it by its commands."""
        self._desk, self._links_shown = desk, links_shown

    def commands(self) -> tuple[Command, ...]:
        """The dialog, and a way past it for each text."""
        copies = tuple(
            Command(
                f"copy-{form}", f"Copy as {form.label}", _copier(self._desk, form), Place.DESIGN, icon="content_copy"
            )
            for form in _TEXTS
        )
        keys = ("Ctrl+Shift+E",)
        ask = Command(
            "export", "Export the drawing…", self.ask, Place.DESIGN, icon="download", keys=keys, while_typing=True
        )
        return (ask, *copies)

    def ask(self) -> None:
        """Ask, showing what would come out."""
        selected = _selected_states(self._desk)
        with titled_dialog(f"Export {self._desk.design.component}") as dialog:
            with ui.element("div").classes("export-choices"):
                form = ui.select(_TITLES, value=Format.SVG, label="Format").props("outlined dense options-dense")
                scopes = [_ALL, _SELECTED] if selected else [_ALL]
                scope = ui.select(scopes, value=scopes[-1], label="What").props("outlined dense options-dense")
                links = ui.switch("Used components", value=self._links_shown())
                dark = ui.switch("Dark colours", value=False)
            look = ui.element("div").classes("export-look").props("tabindex=0 role=group aria-label=Preview")

            def wish() -> Wish:
                only = selected if scope.value == _SELECTED else None
                return Wish(only=only, links=bool(links.value), dark=bool(dark.value))

            def show() -> None:
                look.clear()
                with look:
                    _look(self._desk, form.value, wish())

            for choice in (form, scope, links, dark):
                choice.on_value_change(show)
            show()
            with ui.row().classes("dialog-buttons"):
                ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
                ui.button("Copy text", on_click=lambda: _copy(self._desk, form.value, wish())).props(
                    "flat no-caps"
                ).bind_enabled_from(form, "value", lambda chosen: chosen in (*_TEXTS, Format.SVG))
                primary_button("Download", lambda: _download(self._desk, form.value, wish()), icon="download")
        dialog.on("hide", dialog.delete)


def _selected_states(desk: Desk) -> frozenset[str]:
    return frozenset(thing.id for thing in desk.selected if thing.of == "states")


def _look(desk: Desk, form: Format, wish: Wish) -> None:
    """A picture as a picture, a text as a text; it comes when it is drawn."""
    if len(desk.design.states) > _MOST_LOOKED_AT:
        ui.label(f"{len(desk.design.states)} states: too many to look at here").classes("empty")
        return

    async def draw() -> None:
        content = await run.io_bound(_exported, desk, form if form in _TEXTS else Format.SVG, wish)
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
    desk.begin(draw(), "look")


def _copier(desk: Desk, form: Format) -> Callable[[], None]:
    return lambda: _copy(desk, form, Wish(only=_selected_states(desk) or None))


def _copy(desk: Desk, form: Format, wish: Wish) -> None:
    text = json.dumps(_exported(desk, form, wish).decode())

    async def write() -> None:
        try:
            is_done = await desk.client.run_javascript(_WRITE % text, timeout=_PATIENCE_S)
        except TimeoutError:
            is_done = False
        if is_done:
            desk.say(f"{form.label} of {desk.design.component} is on the clipboard", "positive")
        else:
            desk.say("The browser let nothing be put on the clipboard: export it as a file", "warning")

    desk.begin(write(), "copy")


def _download(desk: Desk, form: Format, wish: Wish) -> None:
    async def paint() -> None:
        # Large pictures take seconds; the others must not wait for them.
        content = await run.io_bound(_exported, desk, form, wish)
        if content is not None:
            ui.download(content, f"{snake_case(desk.design.component)}{form.suffix}", form.media_type)

    desk.begin(paint(), "export")


def _exported(desk: Desk, form: Format, wish: Wish) -> bytes:
    from vicode.diagram.export import export  # noqa: PLC0415 - many ways of drawing, none of them the first page's

    return export(desk.design, form, wish)
