"""Random projects of two designs: half of them can be expressed in XABSL, the others use everything else."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

from tests.generators.portable_designs import ExpressionDrawer, portable_projects
from vicode.model.design import Action, Assign, Declaration, Design, State
from vicode.model.project import Interface, Project

_NUMBERS = ("0", "-1", "2.5", "a", "n", "limit", "eyes.distance", "legs.load", "state_time", "component_time")
_TRUTHS = ("seen", "eyes.seen", "always", "True", "action_done")


@dataclass(frozen=True)
class AllFunctions(ExpressionDrawer):
    """Draws expressions with all operators and functions."""

    def _computed(self, depth: int) -> str:
        if self.draw(st.booleans()):
            return super()._computed(depth)
        inner, other = self.number(depth - 1), self.number(depth - 1)
        one = ("floor", "ceil", "round", "int", "sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan")
        match self.pick("one", "two", "operator", "legs"):
            case "one":
                return f"{self.pick(*one)}({inner})"
            case "two":
                return f"{self.pick('atan2', 'hypot')}({inner}, {other})"
            case "operator":
                return f"({inner} {self.pick('/', '//', '%')} {other})"
            case _:
                return f"legs.wear(times={inner})"


def draw_projects(count: int, seed: int = 0) -> list[Project]:
    """Draw projects; the same seed gives the same ones."""
    drawn: list[Project] = []
    _collector(count, seed, drawn)()
    return drawn[:count]


def _collector(count: int, number: int, drawn: list[Project]) -> Callable[[], None]:
    @seed(number)
    @settings(
        max_examples=count,
        database=None,
        deadline=None,
        derandomize=False,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @given(portable_projects() | rich_projects())
    def collect(project: Project) -> None:
        drawn.append(project)

    return collect


@st.composite
def rich_projects(draw: st.DrawFn) -> Project:
    """Draw a project with frequencies, resume, enter and leave actions, initial values and all functions."""
    project = draw(portable_projects())
    legs = Interface(
        component="Legs",
        implementation="parts:Legs",
        parameters=next(each.parameters for each in project.components if each.component == "Legs"),
        outputs=(
            Declaration(name="load", type="float", initial="1"),
            Declaration(name="wear", type="int", arguments=(Declaration(name="times", type="float", initial="2"),)),
        ),
        frequency_hz=draw(st.sampled_from([None, 30.0])),
    )
    others = tuple(each for each in project.components if each.component != "Legs")
    designs = tuple(_enriched(draw, design) for design in project.designs)
    return replace(project, languages=("python", "cpp"), components=(*others, legs), designs=designs)


def _enriched(draw: st.DrawFn, design: Design) -> Design:
    is_xabsl = design.arithmetic == "xabsl"
    words = AllFunctions(draw, _NUMBERS, _TRUTHS, is_xabsl)
    states = tuple(_enriched_state(draw, words, design, state) for state in design.states)
    return replace(
        design,
        frequency_hz=draw(st.sampled_from([None, None, 10.0, 33.3, 1000.0])),
        resume=draw(st.booleans()),
        outputs=tuple(replace(each, initial="7" if each.name == "n" else "true") for each in design.outputs),
        variables=tuple(
            replace(each, initial=draw(st.sampled_from(["scale", "-0.0", "limit"]))) if each.name == "a" else each
            for each in design.variables
        ),
        states=states,
    )


def _enriched_state(draw: st.DrawFn, words: AllFunctions, design: Design, state: State) -> State:
    def actions(*, may_call: bool = False) -> tuple[Action, ...]:
        drawn: list[Action] = [
            words.legs() if may_call and draw(st.booleans()) else words.assign() for _ in range(draw(st.integers(0, 2)))
        ]
        return (*drawn, Assign(values=(("a", words.number(3)),))) if draw(st.booleans()) else tuple(drawn)

    has_helper = any(use.alias == "helper" for use in design.uses)
    requires = [(), ("eyes",), ("legs",), ("legs", "eyes"), *([("helper",), ("helper", "legs")] if has_helper else [])]
    return replace(
        state,
        requires=draw(st.sampled_from(requires)),
        enter=actions(),
        actions=(*state.actions, *actions(may_call=True)),
        leave=actions(),
    )
