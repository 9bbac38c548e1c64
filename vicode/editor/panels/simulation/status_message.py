"""The status line of a simulation: errors, the position in the past, the reason why it stopped."""

from vicode.editor.panels import texts
from vicode.editor.panels.robots.robot_view import RobotView
from vicode.editor.panels.simulation.controller import SimulationController
from vicode.editor.view.activation import code_error_view
from vicode.runs import RunStatus, Simulation
from vicode.services.running_robots.robot_link import LinkStatus

_HINT = "F10 steps, F6 plays and pauses, Shift+F6 runs to the next state, F9 sets a breakpoint on the selection."


def status_message(controller: SimulationController) -> tuple[str, str]:
    """The status text and its kind: error, warning, past or info."""
    simulation = controller.simulation
    if controller.robot.is_shown:
        return robot_message(controller.robot, simulation)
    if controller.is_starting:
        return ("info", "Starting: generating and loading the code…")
    if controller.start_error:
        return ("error", controller.start_error)
    if controller.is_stale and simulation is not None and simulation.status is RunStatus.ENDED:
        return ("warning", "The design has changed. The recorded run of the previous version is shown.")
    if controller.is_stale:
        return ("warning", "Restart to apply the new options.")
    if simulation is None:
        return ("info", _hint(controller))
    kind, text = _running_message(simulation, is_moving=controller.is_playing or controller.is_running)
    return (kind, text or _hint(controller))


def robot_message(view: RobotView, simulation: Simulation | None) -> tuple[str, str]:
    """The status text of a live view and its kind."""
    link, robot = view.link, view.robot
    if link.status is LinkStatus.CLOSED:
        return ("info", "Not attached. Enter the address that the robot prints.")
    if link.status is LinkStatus.REFUSED:
        return ("error", f"Not attached: {link.problem}")
    if link.status is LinkStatus.LOST:
        return ("warning", f"No connection to {link.address}, trying again: {link.problem}")
    if link.status is LinkStatus.CONNECTING or robot is None:
        return ("info", f"Connecting to {link.address}…")
    if simulation is not None and simulation.is_past:
        behind = len(simulation.recording) - simulation.cursor
        return ("past", f"Viewing the past: {behind} recorded iteration{'s' * (behind != 1)} before the latest.")
    if view.other_versions:
        others = ", ".join(view.other_versions[:3]) + ("…" if len(view.other_versions) > 3 else "")
        subject = "this design" if view.design.component in view.other_versions else others
        words = f"The robot runs another version of {subject}."
        return ("warning", f"{words} Generate and restart the robot, or open its version with: vicode show")
    iteration = simulation.shown_iteration if simulation is not None else None
    if simulation is not None and iteration is not None and iteration.errors:
        return ("error", code_error_view(simulation.prepared.design, iteration.errors[0]).text)
    return ("info", _describe_robot(view))


def _describe_robot(view: RobotView) -> str:
    robot, link = view.robot, view.link
    assert robot is not None
    component, description = view.design.component, robot.description
    if component not in description.components:
        return f"{robot.name} does not use {component}. Choose another robot, or open {description.root}."
    words = f"{'Paused' if robot.is_paused else 'Live'}: {robot.name} at {link.address}"
    if robot.missed:
        words += f", {robot.missed} iteration{'s' * (robot.missed != 1)} not shown"
    if robot.error_count:
        words += f", {robot.error_count} error{'s' * (robot.error_count != 1)}"
    if view.other_versions is None:
        words += ". Its version was not compared: the design has errors"
    return f"{words}."


def _hint(controller: SimulationController) -> str:
    """The keys, and whether the code runs without a sandbox."""
    problem = controller.sandbox_problem
    return f"{_HINT} {texts.not_sandboxed(problem)}" if problem else _HINT


def _running_message(simulation: Simulation, *, is_moving: bool) -> tuple[str, str]:
    if simulation.failure is not None and not simulation.is_past:
        record = simulation.failure.error
        words = code_error_view(simulation.prepared.design, record).text if record else simulation.failure.message
        return ("error", words)
    if simulation.is_past and not is_moving:
        behind = len(simulation.recording) - simulation.cursor
        return ("past", f"Viewing the past: {behind} iteration{'s' * (behind != 1)} before the latest.")
    iteration = simulation.shown_iteration
    if iteration is not None and iteration.errors:
        return ("error", code_error_view(simulation.prepared.design, iteration.errors[0]).text)
    if simulation.warning:
        return ("warning", simulation.warning)
    return ("info", "" if is_moving else _describe_stop(simulation))


def _describe_stop(simulation: Simulation) -> str:
    """Why it stopped; "" for a run that made all its steps."""
    state = simulation.shown_iteration.state if simulation.shown_iteration else ""
    words = {
        "transition": f"Stopped at a breakpoint: the transition to {state}",
        "state": f"Stopped on entering {state}",
        "error": "Stopped at an error",
        "done": f"Done: {state} is a final state",
        "finished": "The world has finished",
        "change": f"Entered {state}",
        "pause": "Paused",
        "end": "End of the recording",
    }
    return words.get(simulation.stop_reason, "")
