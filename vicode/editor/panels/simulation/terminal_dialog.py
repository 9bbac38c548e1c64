"""Shows the command line that repeats the simulation."""

from pathlib import Path

from nicegui import ui

from vicode.editor.panels.copy_text import copy_text
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.simulation.controller import SimulationController
from vicode.editor.panels.widgets import primary_button
from vicode.runs.terminal_command import NotRepeatableError, TerminalCommand, terminal_command


def show_terminal_command(controller: SimulationController) -> None:
    """Open the dialog; without a simulation, or if no command repeats it, show why."""
    context, simulation = controller.context, controller.simulation
    if simulation is None or controller.robot.is_shown:
        context.show_toast("Start a simulation first (F10): the command repeats it", "info")
        return
    try:
        found = terminal_command(_design_path(controller), simulation, controller.config)
    except NotRepeatableError as error:
        context.show_toast(f"No command repeats this: {error}", "info")
        return
    with titled_dialog("Run this in the terminal", "terminal-dialog") as dialog:
        ui.label(_explain(found, len(simulation.recording)))
        ui.label(found.command).classes("mono terminal-command").props('tabindex=0 role="group" aria-label="Command"')
        if found.inputs_file:
            with ui.row().classes("items-center"):
                ui.label(found.inputs_file).classes("mono")
                ui.button("Download", icon="download", on_click=lambda: _download(found)).props("flat dense no-caps")
            ui.label(found.inputs_text).classes("mono terminal-command").props(
                'tabindex=0 role="group" aria-label="Inputs"'
            )
        with ui.row().classes("dialog-buttons"):
            ui.button("Close", on_click=dialog.close).props("flat no-caps")
            primary_button(
                "Copy command", lambda: copy_text(context, found.command, "Command copied."), icon="content_copy"
            )
    dialog.on("hide", dialog.delete)


def _design_path(controller: SimulationController) -> str:
    """The path of the design from the folder that the editor was started in."""
    context, here = controller.context, Path.cwd()
    path = context.workspace.files[context.design.component].resolve()
    return str(path.relative_to(here) if path.is_relative_to(here) else path)


def _explain(found: TerminalCommand, iterations: int) -> str:
    inputs = "the inputs of this file" if found.inputs_file else "the inputs that you set"
    if not iterations:
        return "Runs this design without a world, for 60 s of simulated time."
    steps = "1 iteration" if iterations == 1 else f"{iterations} iterations"
    return f"Repeats this simulation: {steps} with {inputs}."


def _download(found: TerminalCommand) -> None:
    ui.download(found.inputs_text.encode(), found.inputs_file, "text/plain")
