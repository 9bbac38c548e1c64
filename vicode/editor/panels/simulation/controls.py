"""The toolbar of a simulation and its position."""

from nicegui import ui

from vicode.editor.panels.simulation.controller import SPEEDS, SimulationController
from vicode.editor.panels.simulation.status_message import status_message
from vicode.editor.panels.simulation.terminal_dialog import show_terminal_command
from vicode.editor.panels.widgets import icon_button, set_enabled
from vicode.editor.view import ItemRef
from vicode.runs import Simulation


class SimulationControls:
    """The toolbar: buttons, position, speed and the status line."""

    def __init__(self, controller: SimulationController) -> None:
        self.controller = controller
        with ui.element("div").classes("simulation-bar").props('role="toolbar" aria-label="Simulation"'):
            self.restart = icon_button("restart_alt", "Start or restart", controller.restart)
            self.back = icon_button("skip_previous", "Step back (Ctrl+Shift+F10)", controller.step_back)
            self.play = icon_button("play_arrow", "Play or pause (F6)", controller.toggle_play)
            self.step = icon_button("skip_next", "Step (F10)", controller.step)
            self.change = icon_button(
                "fast_forward", "Run until the state changes (Shift+F6)", controller.step_to_change
            )
            self.stop = icon_button("stop", "Stop the simulation", controller.stop)
            self.terminal = icon_button(
                "terminal", "Run this in the terminal…", lambda: show_terminal_command(controller)
            )
            self.where = ui.button("", on_click=self._reveal, color=None).props("flat dense no-caps no-wrap")
            self.where.classes("simulation-where mono")
            with self.where:
                ui.tooltip("Show the active state")
            ui.element("div").classes("spacer")
            self.simulated_only: list[ui.element] = [ui.label("Go to").classes("small").props('aria-hidden="true"')]
            self.time = ui.number(min=0, step=0.1, format="%.2f").props('dense outlined suffix="s" debounce=0')
            self.time.props('aria-label="Go to this time"').classes("simulation-time mono")
            self.time.on("keydown.enter", self._go_to_time)
            self.simulated_only.append(ui.label("Speed").classes("small").props('aria-hidden="true"'))
            speeds = {speed: f"{speed:g}×" for speed in SPEEDS}
            self.speed = ui.select(speeds, value=controller.speed, on_change=lambda event: self._set_speed(event.value))
            self.speed.props('dense outlined options-dense aria-label="Speed"').classes("simulation-speed")
            errors = ui.checkbox("Stop at errors", value=controller.pauses_on_errors).props("dense size=xs")
            errors.on_value_change(lambda event: self._set_pauses(flag=bool(event.value)))
            self.simulated_only += [self.time, self.speed, errors]
        with ui.element("div").classes("simulation-message").props('role="status"') as self.message:
            self.icon = ui.icon("info").props('aria-hidden="true"')
            self.words = ui.label()
            self.restart_button = ui.button("Restart", on_click=controller.restart).props("flat dense no-caps size=sm")
            self.continue_button = ui.button("Continue from here", on_click=self._continue_from_here).props(
                "flat dense no-caps size=sm"
            )

    def refresh(self) -> None:
        simulator, simulation = self.controller, self.controller.simulation
        is_robot = simulator.robot.is_shown
        for part in (*self.simulated_only, self.restart, self.stop, self.change, self.terminal):
            part.set_visibility(not is_robot)
        if is_robot:
            self._refresh_for_robot(simulation)
            return
        icon = "pause" if simulator.is_playing or simulator.is_running else "play_arrow"
        if self.play.props["icon"] != icon:
            self.play.props(f"icon={icon}")
        set_enabled(self.back, flag=simulation is not None and simulation.cursor > 0)
        set_enabled(self.stop, flag=simulation is not None)
        set_enabled(self.terminal, flag=simulation is not None)
        for button in (self.play, self.step, self.change):
            set_enabled(button, flag=simulation is None or simulation.can_step or simulator.is_stale)
        self._show_position(_where(simulation))

    def _refresh_for_robot(self, simulation: Simulation | None) -> None:
        robot, can_control = self.controller.robot.robot, not self.controller.robot.problem_of_control
        icon = "play_arrow" if robot is not None and robot.is_paused else "pause"
        if self.play.props["icon"] != icon:
            self.play.props(f"icon={icon}")
        is_past = simulation is not None and simulation.is_past
        set_enabled(self.back, flag=simulation is not None and simulation.cursor > 1)
        set_enabled(self.play, flag=can_control)
        set_enabled(self.step, flag=can_control or is_past)
        self._show_position(_where_robot(simulation) if self.controller.robot.link.is_open else "not attached")

    def _show_position(self, where: str) -> None:
        if self.where.text != where:
            self.where.set_text(where)
        self._show_message()

    def _show_message(self) -> None:
        kind, words = status_message(self.controller)
        simulation = self.controller.simulation
        if self.words.text != words:
            self.words.set_text(words)
        icons = {"error": "error", "warning": "warning", "past": "history"}
        self.icon.set_name(icons.get(kind, "info"))
        self.message.classes(add=kind, remove=" ".join({"error", "warning", "past", "info"} - {kind}))
        is_robot = self.controller.robot.is_shown
        self.restart_button.set_visibility((self.controller.is_stale or kind == "error") and not is_robot)
        is_past = simulation is not None and simulation.is_past and (kind == "past" or is_robot)
        self.continue_button.set_visibility(is_past and simulation is not None and not simulation.replay)
        self.continue_button.set_text("Back to live" if is_robot else "Continue from here")

    def _reveal(self) -> None:
        simulation = self.controller.simulation
        if simulation is not None and simulation.shown_iteration is not None:
            self.controller.context.page.reveal(ItemRef(kind="states", id=simulation.shown_iteration.state))

    def _continue_from_here(self) -> None:
        simulation = self.controller.simulation
        if simulation is not None:
            simulation.truncate()
            simulation.go_to(len(simulation.recording) if simulation.live is not None else simulation.cursor)

    async def _go_to_time(self) -> None:
        if isinstance(self.time.value, int | float):
            await self.controller.run_to_time(float(self.time.value))

    def _set_speed(self, value: object) -> None:
        if value in SPEEDS:
            self.controller.speed = float(str(value))

    def _set_pauses(self, *, flag: bool) -> None:
        self.controller.pauses_on_errors = flag


def _where_robot(simulation: Simulation | None) -> str:
    iteration = simulation.shown_iteration if simulation is not None else None
    if iteration is None:
        return "waiting for the robot"
    return f"{iteration.time_ns / 1e9:.2f} s · iteration {iteration.iteration} · {iteration.state or 'not active'}"


def _where(simulation: Simulation | None) -> str:
    if simulation is None:
        return "not started"
    iteration = simulation.shown_iteration
    if iteration is None:
        return "before the first step"
    return f"{iteration.time_ns / 1e9:.2f} s · iteration {iteration.iteration} · {iteration.state}"
