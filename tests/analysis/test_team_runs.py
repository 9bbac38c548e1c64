"""Teams of reference interpreters with random inputs stay in the configurations of the model."""

import random

import pytest

from tests.analysis.random_teams import FullProduct
from vicode.analysis.projects import ProjectAnalysis
from vicode.analysis.teams import TeamAnalysis
from vicode.model.design import Call, Declaration, Design, Guard, State, Transition, Use
from vicode.model.project import Agent, Interface, Project
from vicode.semantics import Interpreter, RobotReport

TICK_NS = 20_000_000
_EYES = Interface(
    component="Eyes",
    implementation="world",
    outputs=(Declaration(name="go", type="bool"), Declaration(name="turn", type="bool")),
)
_USES = (Use(alias="eyes", component="Eyes"), Use(alias="lift", component="Lift"))


def to(name: str, when: str = "") -> Transition:
    return Transition(to=name, guard=Guard(when=when))


# Robots do not turn away from a synchronized state while they wait: then the others would enter it without them.
_ROBOT = Design(
    component="Robot",
    uses=_USES,
    initial="Search",
    states=(
        State(name="Search", transitions=(to("Queue", "eyes.go"), to("Rest", "eyes.turn and not eyes.go"))),
        State(name="Queue", transitions=(to("Door"),)),
        State(name="Door", capacity=1, transitions=(to("Search", "eyes.turn"), to("Work", "eyes.go"))),
        State(name="Work", modulates=(Call(alias="lift"),), transitions=(to("Search", "done(lift) and eyes.go"),)),
        State(name="Rest", final=True),
    ),
)
_LIFT = Design(
    component="Lift",
    uses=_USES[:1],
    initial="Wait",
    states=(
        State(name="Wait", transitions=(to("Up"),)),
        State(name="Up", synchronized=2, transitions=(to("Down", "eyes.turn"),)),
        State(name="Down", final=True, transitions=(to("Wait", "not eyes.go and eyes.turn"),)),
    ),
)
PROJECT = Project(
    name="team", components=(_EYES,), agents=(Agent(name="robot", root="Robot"),), designs=(_ROBOT, _LIFT)
)


@pytest.mark.parametrize("ticks", [1, 4])
def test_the_model_contains_all_runs(ticks: int) -> None:
    team = TeamAnalysis(ProjectAnalysis(PROJECT))
    assert team.searches is not None
    (search,) = team.searches
    full = FullProduct(list(search.product.robots), team.places)
    model = {tuple(frozenset(each.items()) for each in full.active(at)) for at in full.graph}
    visited = set()
    for seed in range(100):
        rng = random.Random(seed)
        robots = [Interpreter(PROJECT, "Robot", priority=n, team_ticks=ticks) for n in range(team.size)]
        reports = [RobotReport(priority=n) for n in range(team.size)]
        for iteration in range(60):
            for robot, own in zip(robots, reports, strict=True):
                for name in ("go", "turn"):
                    robot.set_input("Eyes", name, rng.random() < 0.3)
                robot.step(iteration * TICK_NS, [each for each in reports if each is not own])
            reports = [robot.report() for robot in robots]
            visited.add(tuple(frozenset(_active(robot)) for robot in robots))
    assert visited <= model
    # Some configurations need inputs in an order that is rare.
    assert len(visited) > 0.7 * len(model)


def _active(robot: Interpreter) -> set[tuple[str, str]]:
    memory = robot.memory
    active = (name for name in ("Robot", "Lift") if memory.components[name].stepped_in == memory.iteration)
    return {(name, memory.components[name].state) for name in active}
