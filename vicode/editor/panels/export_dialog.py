"""Exports the diagram as a file or as text on the clipboard, with a preview."""

import base64
from collections.abc import Callable

from nicegui import run, ui

from vicode.diagram.export_formats import EXPORT_FORMATS, ExportFormat, ExportOptions, NotExportableError
from vicode.editor.panels import texts
from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.copy_text import copy_text
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.model.names import snake_case

_TITLES = {each.name: each.title for each in EXPORT_FORMATS.values()}
_SVG = EXPORT_FORMATS["svg"]
_ALL, _SELECTED = "Whole diagram", "Selection"
# The preview of a larger diagram would be slower than the download.
_MAX_PREVIEW_STATES = 400


class ExportDialog:
    """Asks for format and options of an export.

    Args:
        context: the open design and the selection.
        links_shown: whether the canvas shows the links to used components.
    """

    def __init__(self, context: WindowContext, links_shown: Callable[[], bool]) -> None:
        self._context, self._links_shown = context, links_shown

    def commands(self) -> tuple[Command, ...]:
        """Return the command of the dialog, and a copy command for each text format."""
        copies = tuple(
            Command(
                f"copy-{form.name}",
                f"Copy as {form.label}",
                _copier(self._context, form),
                MenuGroup.DESIGN,
                icon="content_copy",
            )
            for form in EXPORT_FORMATS.values()
            if form.is_text
        )
        keys = ("Ctrl+Shift+E",)
        ask = Command(
            "export", "Export diagram…", self.ask, MenuGroup.DESIGN, icon="download", keys=keys, while_typing=True
        )
        return (ask, *copies)

    def ask(self) -> None:
        selected = _selected_states(self._context)
        with titled_dialog(f"Export {self._context.design.component}") as dialog:
            with ui.element("div").classes("export-choices"):
                name = ui.select(_TITLES, value=_SVG.name, label="Format").props("outlined dense options-dense")
                scopes = [_ALL, _SELECTED] if selected else [_ALL]
                scope = ui.select(scopes, value=scopes[-1], label="Scope").props("outlined dense options-dense")
                links = ui.switch("Used components", value=self._links_shown())
                dark = ui.switch("Dark theme", value=False)
            preview = ui.element("div").classes("export-preview").props("tabindex=0 role=group aria-label=Preview")

            def form() -> ExportFormat:
                return EXPORT_FORMATS[name.value]

            def options() -> ExportOptions:
                only = selected if scope.value == _SELECTED else None
                project = self._context.workspace.project
                return ExportOptions(project=project, only=only, links=bool(links.value), dark=bool(dark.value))

            def show() -> None:
                preview.clear()
                with preview:
                    _show_preview(self._context, form(), options())

            for choice in (name, scope, links, dark):
                choice.on_value_change(show)
            show()
            with ui.row().classes("dialog-buttons"):
                ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
                ui.button("Copy text", on_click=lambda: _copy(self._context, form(), options())).props(
                    "flat no-caps"
                ).bind_enabled_from(name, "value", lambda _name: form().is_text or form() is _SVG)
                primary_button("Download", lambda: _download(self._context, form(), options()), icon="download")
        dialog.on("hide", dialog.delete)


def _selected_states(context: WindowContext) -> frozenset[str]:
    return frozenset(item.id for item in context.selected if item.kind == "states")


def _show_preview(context: WindowContext, form: ExportFormat, options: ExportOptions) -> None:
    """Show the preview when it is rendered."""
    if len(context.design.states) > _MAX_PREVIEW_STATES:
        ui.label(texts.preview_too_large(len(context.design.states))).classes("empty")
        return

    async def draw() -> None:
        content, problem = None, ""
        try:
            content = await run.io_bound((form if form.is_text else _SVG).write, context.design, options)
        except NotExportableError as error:
            problem = str(error)
        # The user may have chosen other options or closed the dialog.
        if container.is_deleted or not (content or problem):
            return
        container.clear()
        with container:
            if content is None:
                ui.label(problem).classes("empty").props('role="status"')
            elif form.is_text:
                ui.label(content.decode()).classes("mono export-text")
            else:
                image = ui.element("img").props('alt="Preview of the exported diagram"')
                image.props["src"] = f"data:image/svg+xml;base64,{base64.b64encode(content).decode()}"

    with ui.element("div").style("display: contents") as container:
        ui.label("Rendering…").classes("empty").props('role="status"')
    # A large diagram takes seconds.
    context.run_in_background(draw(), "preview")


def _copier(context: WindowContext, form: ExportFormat) -> Callable[[], None]:
    def copy() -> None:
        project, only = context.workspace.project, _selected_states(context) or None
        _copy(context, form, ExportOptions(project=project, only=only))

    return copy


def _copy(context: WindowContext, form: ExportFormat, options: ExportOptions) -> None:
    try:
        text = form.write(context.design, options).decode()
    except NotExportableError as error:
        context.show_toast(str(error), "warning")
        return
    copy_text(context, text, f"Copied {context.design.component} as {form.label}")


def _download(context: WindowContext, form: ExportFormat, options: ExportOptions) -> None:
    async def paint() -> None:
        # Large images take seconds.
        try:
            content = await run.io_bound(form.write, context.design, options)
        except NotExportableError as error:
            context.show_toast(str(error), "warning")
            return
        if content is not None:
            ui.download(content, f"{snake_case(context.design.component)}{form.suffixes[0]}", form.media_type)

    context.run_in_background(paint(), "export")
