"""The experiments: which behavior drives how many robots through which worlds, and when a run has succeeded."""

from collections.abc import Sequence
from dataclasses import dataclass

from vicode.simulated_robot.arena import Arena
from vicode.simulated_robot.map_file import load_world_map
from vicode.simulated_robot.session import RobotTrack
from vicode.simulated_robot.world_map import WorldMap

FULL_CIRCLE_DEG = 360.0
LARGEST_OVERSHOOT_DEG = 5.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Experiment:
    """An experiment.

    Attributes:
        name: Its name on the command line.
        title: Its heading.
        doc: What happens, and when a run has succeeded.
        sample: The sample project with the behavior.
        behavior: The design, which is also the option in XABSL.
        maps: Names of the worlds.
        robots: Robots in each world.
        seconds: A run that takes longer has failed.
        turns: Whether the robot turns around once; otherwise it drives to a goal, if the map has one.
        last_state: The state of the root in which a run ends, "" if it ends at a goal.
        thesis_design: File of the design that the thesis shows.
        thesis_option: File of the option as printed in the thesis, which runs next to ours; "" if there is none.
        thesis_doc: What the thesis reports.
    """

    name: str
    title: str
    doc: str
    sample: str
    behavior: str
    maps: tuple[str, ...]
    robots: int = 1
    seconds: float = 60.0
    turns: bool = False
    last_state: str = ""
    thesis_design: str = ""
    thesis_option: str = ""
    thesis_doc: tuple[str, ...] = ()

    def load_maps(self) -> tuple[WorldMap, ...]:
        return tuple(load_world_map(name) for name in self.maps)

    def is_over(self, arena: Arena, tracks: Sequence[RobotTrack]) -> bool:
        """Whether the robots have finished."""
        if self.last_state:
            return all(track.state == self.last_state for track in tracks)
        return all(arena.has_reached_goal(track.robot) for track in tracks)

    def find_problem(self, arena: Arena, tracks: Sequence[RobotTrack]) -> str:
        """Why a run has failed, "" if it has not."""
        errors = [error for track in tracks for error in track.errors]
        if errors:
            return f"the bridge reported: {errors[0]}"
        if any(track.robot.contacts for track in tracks):
            return "touched a wall or another robot"
        if not self.is_over(arena, tracks):
            return f"not finished after {self.seconds:g} s"
        if self.turns and abs(tracks[0].robot.turned - FULL_CIRCLE_DEG) > LARGEST_OVERSHOOT_DEG:
            return f"not within {LARGEST_OVERSHOOT_DEG:g}° of a circle"
        return ""


_DELAY = (
    "Later, with the corridor: “after running the program for a minute, the sensor data of 30 seconds in was only "
    "just coming in”. The thesis found the cause in the robot's program and could not fix it in time."
)
_CIRCLE = (
    "“This resulted in the robot turning slightly more than 360 degrees, which is Okay, because the XABSL engine "
    "waits until it's over 360 degrees, and then sends back a message for the robot to stop spinning.” "
    "(section 7.1.1; the option is figure 7)"
)
_CORRIDOR = (
    "“The principle is simple: the robot always turns to the place where the longest laser ray comes from.” "
    "(figure 10; the code is figure 11)"
)
_CORRIDOR_RESULT = (
    "The thesis does not say whether the robot touched walls: “The corridor traversing had a bit of problems.” "
    "Here, the robot also turns away from walls that are near at its sides, and is slower while it turns. The "
    "option as printed, which waits for 2 s before each movement, runs with the same worlds, seeds and new data."
)
_ONE_ROBOT = (
    "“Currently the program only supports using one XABSL engine with one robot and one connection to a robot "
    "commander system.” (section 9, future work)"
)
_EXPERIMENTS = (
    Experiment(
        name="circle",
        title="Driving a circle",
        doc="The robot turns around once and stops. "
        "A run has succeeded if it has turned 360° ± 5° and touched nothing.",
        sample="rescue",
        behavior="drive_circle",
        maps=("arena",),
        seconds=60.0,
        turns=True,
        last_state="stop",
        thesis_design="drive_circle",
        thesis_doc=(_CIRCLE, _DELAY),
    ),
    Experiment(
        name="corridor",
        title="Walking a corridor",
        doc="The robot finds its way by the least distance in each of seven regions of its laser. "
        "A run has succeeded if the robot reaches the end and has touched nothing.",
        sample="rescue",
        behavior="walk_corridor",
        maps=("straight", "bent", "t"),
        seconds=240.0,
        thesis_design="walk_corridor",
        thesis_option="walk_corridor.xabsl",
        thesis_doc=(_CORRIDOR, _CORRIDOR_RESULT, _DELAY),
    ),
    Experiment(
        name="meeting",
        title="Several robots",
        doc="Four robots cross a room, pass a door one after another (a state with capacity 1), and meet behind it "
        "(a state that all four enter together). A run has succeeded if all have met and none has touched anything.",
        sample="meeting",
        behavior="meet",
        maps=("two_rooms",),
        robots=4,
        seconds=180.0,
        last_state="stop",
        thesis_doc=(_ONE_ROBOT,),
    ),
)
EXPERIMENTS = {each.name: each for each in _EXPERIMENTS}
"""The experiments by name."""
