"""Asks once for each folder before a simulation runs its Python code."""

from nicegui import run, ui

from vicode.editor.panels import texts
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.recovery import state_folder
from vicode.editor.session.trust import contains_code, is_trusted, trust_folder
from vicode.simulation.isolation import isolation_problem


async def ask_for_trust(context: WindowContext) -> bool:
    """Return whether the code of the project may run, after asking the user if that is not known."""
    workspace = context.workspace
    if workspace.is_trusted or not contains_code(workspace.folder, workspace.project):
        return True
    workspace.is_trusted = is_trusted(state_folder(), workspace.folder)
    if not workspace.is_trusted and await _ask(context):
        workspace.is_trusted = True
        try:
            trust_folder(state_folder(), workspace.folder)
        except OSError:
            context.show_toast(texts.TRUST_NOT_REMEMBERED, "info")
    return workspace.is_trusted


async def _ask(context: WindowContext) -> bool:
    problem = await run.io_bound(isolation_problem)
    with context.client, titled_dialog(texts.TRUST_TITLE) as dialog:
        ui.label(str(context.workspace.folder.resolve())).classes("mono")
        ui.label(texts.TRUST_QUESTION)
        ui.label(texts.not_sandboxed(problem) if problem else texts.SANDBOXED)
        with ui.row().classes("dialog-buttons"):
            ui.button("Cancel", on_click=lambda: dialog.submit(False)).props("flat no-caps")
            primary_button("Trust and simulate", lambda: dialog.submit(True))
    return bool(await dialog)
