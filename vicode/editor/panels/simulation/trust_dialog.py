"""Asks once for each folder before a simulation or a comparison of languages runs its code."""

from dataclasses import dataclass

from nicegui import run, ui

from vicode.editor.panels import texts
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.recovery.recovery_store import state_folder
from vicode.editor.session.trust import contains_code, is_trusted, trust_folder
from vicode.simulation.isolation import isolation_problem


@dataclass(frozen=True, slots=True, kw_only=True)
class TrustPurpose:
    """What code is run for: the languages it runs, the question, and the label of the button that accepts."""

    languages: tuple[str, ...]
    question: str
    accept: str


SIMULATE = TrustPurpose(languages=("python",), question=texts.TRUST_QUESTION, accept="Trust and simulate")
REPLAY = TrustPurpose(languages=("python",), question=texts.TRUST_TO_REPLAY, accept="Trust and replay")
COMPARE = TrustPurpose(languages=("python", "cpp"), question=texts.TRUST_TO_COMPARE, accept="Trust and compare")


async def ask_for_trust(context: WindowContext, purpose: TrustPurpose = SIMULATE) -> bool:
    """Return whether the code of the project may run, after asking the user if that is not known."""
    workspace = context.workspace
    if workspace.is_trusted or not contains_code(workspace.folder, workspace.project, purpose.languages):
        return True
    workspace.is_trusted = is_trusted(state_folder(), workspace.folder)
    if not workspace.is_trusted and await _ask(context, purpose):
        workspace.is_trusted = True
        try:
            trust_folder(state_folder(), workspace.folder)
        except OSError:
            context.show_toast(texts.TRUST_NOT_REMEMBERED, "info")
    return workspace.is_trusted


async def _ask(context: WindowContext, purpose: TrustPurpose) -> bool:
    problem = await run.io_bound(isolation_problem)
    with context.client, titled_dialog(texts.TRUST_TITLE) as dialog:
        ui.label(str(context.workspace.folder.resolve())).classes("mono")
        ui.label(purpose.question)
        ui.label(texts.not_sandboxed(problem) if problem else texts.SANDBOXED)
        with ui.row().classes("dialog-buttons"):
            ui.button("Cancel", on_click=lambda: dialog.submit(False)).props("flat no-caps")
            primary_button(purpose.accept, lambda: dialog.submit(True))
    return bool(await dialog)
