"""Asks once for each folder before a simulation or a comparison of languages runs its code."""

from dataclasses import dataclass

from nicegui import run, ui

from vicode.editor.panels import texts
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.trust import contains_code, is_trusted, trust_folder
from vicode.platform import state_folder
from vicode.simulation.isolation import isolation_problem


@dataclass(frozen=True, slots=True, kw_only=True)
class TrustPurpose:
    """What code is run for: the languages it runs, the question, and the label of the button that accepts."""

    languages: tuple[str, ...]
    question: str
    accept: str


SIMULATE = TrustPurpose(
    languages=("python",),
    question=(
        "Simulate runs the Python code of this folder. Trust it only if you know where it comes from; "
        "the answer is remembered for this user."
    ),
    accept="Trust and simulate",
)
REPLAY = TrustPurpose(
    languages=("python",),
    question=(
        "To show what the value changes, the design runs with recorded inputs, and so does the Python code in it. "
        "Trust the folder only if you know where it comes from; the answer is remembered for this user."
    ),
    accept="Trust and replay",
)
COMPARE = TrustPurpose(
    languages=("python", "cpp"),
    question=(
        "Comparing languages runs the Python and C++ code of this folder. Trust it only if you know where it comes "
        "from; the answer is remembered for this user."
    ),
    accept="Trust and compare",
)


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
            context.show_toast(
                "The folder is trusted until the editor ends: the state folder cannot be written", "info"
            )
    return workspace.is_trusted


async def _ask(context: WindowContext, purpose: TrustPurpose) -> bool:
    problem = await run.io_bound(isolation_problem)
    with context.client, titled_dialog("Trust this folder?") as dialog:
        ui.label(str(context.workspace.folder.resolve())).classes("mono")
        ui.label(purpose.question)
        ui.label(
            texts.not_sandboxed(problem)
            if problem
            else (
                "It runs in a sandbox: it can read this folder and installed software, write nothing but temporary "
                "files, and has no network. It may still use up memory, disk space and processor time."
            )
        )
        with ui.row().classes("dialog-buttons"):
            ui.button("Cancel", on_click=lambda: dialog.submit(False)).props("flat no-caps")
            primary_button(purpose.accept, lambda: dialog.submit(True))
    return bool(await dialog)
