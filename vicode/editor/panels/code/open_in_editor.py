"""Opens code of a design in the user's own editor, from its field."""

import json

from nicegui import run, ui

from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import DiskConflictError
from vicode.editor.session.external_editor import CodePlace, find_place
from vicode.findings import DesignPath

_KEY = "vicode-open-with-link"
_ANSWER_TIMEOUT_S = 60.0


def open_in_editor(context: WindowContext, path: DesignPath, language: str) -> None:
    """Open the generated code of a part of the design; the file is generated first if it does not exist."""
    context.run_in_background(_open(context, path, language), "open in editor")


def editor_command(context: WindowContext) -> tuple[Command, ...]:
    """The command that switches between the configured editor and the link, remembered in the browser."""
    if not context.external_editor.name:
        return ()

    async def switch() -> None:
        uses_link = not await _uses_link()
        await ui.run_javascript(f'localStorage.setItem("{_KEY}", "{"yes" if uses_link else "no"}")')
        name = "VS Code, by a link" if uses_link else context.external_editor.name
        context.show_toast(f"Code opens with {name}", "info")

    def handle() -> None:
        context.run_in_background(switch(), "switch editor")

    return (Command("code-editor", "Switch the editor for code", handle, MenuGroup.DESIGN, icon="open_in_new"),)


async def _open(context: WindowContext, path: DesignPath, language: str) -> None:
    place = find_place(context.workspace, context.document, path, language)
    place = place or await _generate(context, path, language)
    if place is None:
        return
    editor = context.external_editor
    with context.client:
        if not editor.is_local:
            # The file is on another machine.
            ui.run_javascript(f"navigator.clipboard?.writeText({json.dumps(place.text)})")
            context.show_toast(f"Copied {place.text}", "info")
        elif not editor.name or await _uses_link():
            ui.run_javascript(f"location.href = {json.dumps(place.vscode_url)}")
        else:
            _start(context, place)


def _start(context: WindowContext, place: CodePlace) -> None:
    try:
        context.external_editor.open(place)
    except OSError as error:
        context.show_toast(
            f"{context.external_editor.name} could not be started: {error.strerror or error}", "negative"
        )


async def _generate(context: WindowContext, path: DesignPath, language: str) -> CodePlace | None:
    try:
        context.workspace.save(context.document)
        result = await run.io_bound(context.workspace.generate, context.document)
    except (OSError, ValueError, DiskConflictError) as error:
        context.show_toast(f"The code is not generated yet: {error}", "negative")
        return None
    place = find_place(context.workspace, context.document, path, language)
    if place is None and result is not None:
        context.show_toast(result.message, "negative")
    return place


async def _uses_link() -> bool:
    try:
        return bool(await ui.run_javascript(f'localStorage.getItem("{_KEY}") === "yes"', timeout=_ANSWER_TIMEOUT_S))
    except TimeoutError:
        return False
