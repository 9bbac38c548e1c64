"""What one window shows of the robot that the editor is attached to, and what it asks of it."""

from collections.abc import Awaitable, Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from nicegui import run

from vicode.editor.session.simulation import Breakpoints
from vicode.editor.view import ItemRef
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.robots import RobotDescription
from vicode.runs import Recording, RunStatus, Simulation, prepare_view
from vicode.runs.design_trace import focus_iteration
from vicode.runs.guard_values import evaluate_guards
from vicode.runs.why_not import PastConditions, WhyNot, explain
from vicode.services.robot_version import find_other_versions
from vicode.services.running_robots.console import RobotConsole
from vicode.services.running_robots.robot_link import NO_CONTROL, LinkStatus, Place, RobotRequestError
from vicode.services.running_robots.watched_robot import WatchedRobot
from vicode.simulation import IterationResult

if TYPE_CHECKING:
    from vicode.editor.panels.simulation.controller import SimulationController

NOT_ATTACHED = "Attach to a robot first: Simulate, source Robot"


class RobotView:
    """The live view of a window; while `is_shown`, it provides the simulation of its controller."""

    def __init__(self, controller: "SimulationController") -> None:
        self._controller = controller
        self.context = controller.context
        self.link = controller.context.workspace.robots
        self.is_shown = False
        self.other_versions: tuple[str, ...] | None = ()
        """Components of which the robot runs another version; None if that is not known."""
        self.console = RobotConsole(
            self.link,
            lambda: self.project,
            component=self._find_commanded,
            set_breakpoints=self._set_breakpoints,
        )
        self._compared: tuple[Project, RobotDescription] | None = None
        self._is_comparing = False
        self._seen: object = None
        unsubscribe = self.link.changes.subscribe(self._on_change)
        self.context.closings.subscribe(unsubscribe)
        self.context.closings.subscribe(self.link.leave)
        if self.link.is_open:
            self.show()

    @property
    def robot(self) -> WatchedRobot | None:
        return self.link.robot

    @property
    def design(self) -> Design:
        return self.context.design

    @property
    def project(self) -> Project:
        return self.context.workspace.project

    @property
    def problem_of_control(self) -> str:
        """Why the robot cannot be controlled, "" if it can."""
        if not self.is_shown or self.link.status is not LinkStatus.CONNECTED:
            return NOT_ATTACHED
        return "" if self.link.control else NO_CONTROL

    def show(self) -> None:
        """Show the robot instead of a simulation."""
        self.is_shown = True
        self.link.start()
        self._on_change()

    def hide(self) -> None:
        """Show simulations again; the editor stays attached."""
        self.is_shown = False
        self._controller.show_simulation(None)

    def attach(self, address: str, token: str) -> None:
        """Connect to an address.

        Raises:
            AttachError: It is no address.
        """
        self.link.open(address, token)
        self.link.start()

    def design_changed(self) -> None:
        """Show the newest design: names that it no longer has are shown as text only."""
        if self.is_shown:
            self._seen = None
            self._controller.show_simulation(None)
            self._on_change()

    def toggle_pause(self) -> None:
        is_paused = self.robot is not None and self.robot.is_paused
        self.ask("resume" if is_paused else "pause")

    def enter(self, item: ItemRef | None) -> None:
        """Go to a state of the robot."""
        if item is None or item.kind != "states":
            self.context.show_toast("Select a state to go to", "info")
            return
        self.ask("enter", component=self._component, state=item.id)

    def tell_breakpoints(self) -> None:
        if self.is_shown and not self.problem_of_control:
            places = self._controller.breakpoints.places(self.design)
            self._run(partial(self.link.set_breakpoints, self._component, places))

    def ask(self, do: str, **fields: Any) -> None:
        """Ask the robot for something, and show a message if it was not done."""
        if problem := self.problem_of_control:
            self.context.show_toast(problem, "info")
        else:
            self._run(partial(self.link.request, do, **fields))

    def _find_commanded(self) -> str:
        """The shown component, "" if the robot does not have it."""
        return self._component if self.robot and self._component in self.robot.description.components else ""

    async def _set_breakpoints(self, component: str, places: tuple[Place, ...]) -> None:
        """Set breakpoints as the console asks; those of the shown component are also those of the window."""
        await self.link.set_breakpoints(component, places)
        if component == self._component:
            self._controller.set_breakpoints(Breakpoints.at_places(places, self.design))

    @property
    def _component(self) -> str:
        return self.context.design.component

    def _run(self, act: Callable[[], Awaitable[object]]) -> None:
        async def guarded() -> None:
            try:
                await act()
            except RobotRequestError as error:
                self.context.show_toast(f"{error}", "warning")

        self.context.run_in_background(guarded(), "ask robot")

    def _on_change(self) -> None:
        """Show what arrived; called for each message."""
        if self.context.is_closed:
            return
        self._controller.canvas.set_controls_robot(not self.problem_of_control)
        if not self.is_shown:
            return
        robot = self.robot
        if robot is None:
            self._controller.show_simulation(None)
            return
        simulation = self._controller.simulation
        recording = robot.recording(self._component, self._focus)
        if simulation is None or simulation.live is not recording or self._seen is not robot:
            self._seen = robot
            self._controller.show_simulation(self._view(recording, robot))
            self.tell_breakpoints()
        else:
            simulation.follow()
        self._compare_versions(robot)

    def _view(self, recording: Recording, robot: WatchedRobot) -> Simulation:
        design = self.context.design
        simulation = Simulation(
            prepared=prepare_view(design),
            cwd=self.context.workspace.folder,
            live=recording,
            find_guards=lambda recording, number: self._guards(robot, recording, number),
            on_change=self._controller.simulation_changed,
        )
        simulation.status = RunStatus.RUNNING
        return simulation

    def _focus(self, iteration: IterationResult) -> IterationResult:
        return focus_iteration(iteration, self.context.design)

    def _guards(self, robot: WatchedRobot, recording: Recording, number: int) -> Mapping[str, Any]:
        iteration = recording.iteration(number)
        if iteration is None:
            return {}
        project, design = self.context.workspace.project, self.context.design
        return evaluate_guards(project, design, iteration, _latest_steps(robot, iteration), robot.tuned)

    def why_not(self, recording: Recording, number: int, target: str, past: PastConditions) -> WhyNot:
        """Why a state of the robot is not active in an iteration."""
        robot, iteration = self.robot, recording.iteration(number)
        if robot is None or iteration is None:
            return WhyNot(target=target)
        project, design = self.context.workspace.project, self.context.design
        steps = _latest_steps(robot, iteration)
        return explain(
            project,
            design,
            recording,
            number,
            target=target,
            latest=steps,
            tuned=robot.tuned,
            past=past,
        )

    def _compare_versions(self, robot: WatchedRobot) -> None:
        """Compare the code of the robot with the designs, when either changes."""
        workspace = self.context.workspace
        project, description = workspace.project, robot.description
        known = self._compared
        if self._is_comparing or (known and known[0] is project and known[1] is description):
            return
        self._compared, self._is_comparing = (project, description), True

        async def compare() -> None:
            try:
                self.other_versions = await run.io_bound(
                    find_other_versions, project, workspace.source_paths, description, dict(robot.written)
                )
            finally:
                self._is_comparing = False
            self._controller.simulation_changed()

        self.context.run_in_background(compare(), "compare versions")


def _latest_steps(robot: WatchedRobot, iteration: IterationResult) -> dict[str, Mapping[str, Any]]:
    """What was not stepped keeps its values; earlier iterations are shown with the latest of those."""
    return {**{name: seen.step for name, seen in robot.steps.items()}, **_steps(iteration)}


def _steps(iteration: IterationResult) -> dict[str, Mapping[str, Any]]:
    return {str(step["component"]): step for step in iteration.tree}
