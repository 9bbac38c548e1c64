"""Random projects that XABSL can express: a player, a helper that it calls, and components of the world."""

from dataclasses import dataclass

from hypothesis import strategies as st

from vicode.model.design import (
    Action,
    Assign,
    Call,
    CommonSection,
    Decision,
    DecisionGroup,
    Declaration,
    Design,
    Guard,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.model.project import INTERNAL, WORLD, Agent, Enumeration, Interface, Project

_SIDES = ("Side.left", "Side.right", "side", "eyes.side", "mine")
_TRUTHS = ("True", "false", "seen", "eyes.seen", "always")
_NUMBERS = (
    *("0", "1", "2.5", "1e-3", "a", "n", "limit", "scale", "eyes.distance", "notes.count"),
    *("state_time", "component_time"),
)
_rarely = st.sampled_from([False, False, False, True])


@dataclass(frozen=True)
class ExpressionDrawer:
    """Draws expressions of one design; `is_xabsl` allows operators whose result depends on the arithmetic."""

    draw: st.DrawFn
    numbers: tuple[str, ...]
    truths: tuple[str, ...]
    is_xabsl: bool

    def pick(self, *choices: str) -> str:
        return self.draw(st.sampled_from(choices))

    def number(self, depth: int = 2) -> str:
        return self._computed(depth) if depth > 0 and self.draw(st.booleans()) else self.pick(*self.numbers)

    def _computed(self, depth: int) -> str:
        inner, leaf = self.number(depth - 1), self.pick(*self.numbers)
        match self.pick("sign", "sign", "part", "minus", "choice", "one", "several", "several"):
            case "sign":
                return f"({inner} {self.pick(*'+-*/%' if self.is_xabsl else '+-*')} {self.number(depth - 1)})"
            case "part":
                return f"({inner} / {self.pick('4', '-limit', 'scale', 'float(3)')})"
            case "minus":
                return f"-{inner}"
            case "choice":
                return f"({inner} if {self.truth(depth - 1)} else {self.number(depth - 1)})"
            case "one":
                return f"{self.pick('abs', 'float', 'sign', 'degrees', 'radians')}({inner})"
            case _:
                other = self.number(depth - 1)
                several = (f"min({inner}, {other})", f"max({inner}, {other})", f"min({leaf}, {inner}, 2)")
                asked = (f"eyes.bearing({leaf})", f"eyes.bearing(y={leaf}, x=1)")
                return self.pick(*several, f"clamp({inner}, {leaf}, 3)", *asked)

    def truth(self, depth: int = 2) -> str:
        if depth <= 0 or self.pick("leaf", "tree") == "leaf":
            return self.pick(*self.truths)
        match self.pick("join", "compare", "chain", "side", "choice", "not", "nan"):
            case "join":
                return f"({self.truth(depth - 1)} {self.pick('and', 'or', '==', '!=')} {self.truth(depth - 1)})"
            case "compare":
                sign = self.pick("<", "<=", ">", ">=", "==", "!=")
                return f"({self.number(depth - 1)} {sign} {self.number(depth - 1)})"
            case "chain":
                return f"({self.number(0)} < {self.number(depth - 1)} <= {self.number(0)} != 7)"
            case "side":
                return f"({self.side(depth - 1)} {self.pick('==', '!=')} {self.side(depth - 1)})"
            case "choice":
                return f"({self.truth(depth - 1)} if {self.truth(depth - 1)} else {self.truth(depth - 1)})"
            case "not":
                return f"(not {self.truth(depth - 1)})"
            case _:
                return f"is_nan({self.number(depth - 1)})"

    def side(self, depth: int = 1) -> str:
        """Draw an expression of an enumeration."""
        leaf = self.pick(*_SIDES)
        return leaf if depth <= 0 else f"({leaf} if {self.truth(depth - 1)} else {self.pick(*_SIDES)})"

    def assign(self) -> Assign:
        """Draw assignments to outputs and variables."""
        wholes = ("n + 1", "n - 2", "3", "-n", "0", "n if seen else limit")
        match self.pick("a", "n", "seen", "side"):
            case "a":
                return Assign(values=(("a", self.number()),))
            case "n":
                return Assign(values=(("n", self.pick(*wholes)), ("notes.count", "notes.count + n")))
            case "seen":
                return Assign(values=(("seen", self.truth()),))
            case _:
                return Assign(values=(("side", self.side()), ("eyes.led", "seen")))

    def legs(self) -> Call:
        """Draw a call of the legs with a subset of the arguments."""
        given = (("side", self.side()), ("speed", self.number(1)))
        return Call(alias="legs", arguments=given[: self.draw(st.integers(0, 2))])

    def decisions(self, names: list[str], asks: tuple[str, ...], depth: int = 2) -> tuple[Decision, ...]:
        """Draw decisions, including groups."""
        return tuple(self._decision(names, asks, depth) for _ in range(self.draw(st.integers(0, 3))))

    def _decision(self, names: list[str], asks: tuple[str, ...], depth: int) -> Decision:
        when = self.pick("", "asked", "drawn", "drawn")
        when = self.pick(*asks, *self.truths) if when == "asked" else self.truth() if when else ""
        guard = Guard(when=when, after=self.pick("", "", "", "0.05", "pause", "90"))
        doc = self.pick("", "", "why", "a */ b", 'say "no"\n// x')
        is_off = self.draw(_rarely)
        match self.pick("to", "to", "stay", "group") if depth else self.pick("to", "stay"):
            case "to":
                return Transition(to=self.pick(*names), guard=guard, doc=doc, disabled=is_off)
            case "stay":
                return Stay(guard=guard, doc=doc, disabled=is_off)
            case _:
                then = self.decisions(names, asks, depth - 1) or (Stay(),)
                otherwise = self.decisions(names, asks, depth - 1) if self.draw(st.booleans()) else ()
                return DecisionGroup(guard=guard, then=then, otherwise=otherwise, doc=doc, disabled=is_off)


@st.composite
def portable_projects(draw: st.DrawFn) -> Project:
    """Draw a project with two designs."""
    is_xabsl, unit = draw(st.booleans()), draw(st.sampled_from(["", "ms"]))
    helper = draw(_designs("Helper", is_xabsl=is_xabsl, unit=unit))
    return project_of(draw(_designs("Player", is_xabsl=is_xabsl, unit=unit)), helper)


@st.composite
def _designs(draw: st.DrawFn, component: str, *, is_xabsl: bool, unit: str) -> Design:
    is_player = component == "Player"
    words = ExpressionDrawer(draw, (*_NUMBERS, *(() if is_player else ("k",))), _TRUTHS, is_xabsl)
    names = draw(st.lists(st.sampled_from(["A", "b", "C_1", "look", "Rest"]), min_size=1, max_size=4, unique=True))
    states = []
    for name in names:
        count = draw(st.integers(0, 3))
        actions: list[Action] = [words.assign() if draw(st.booleans()) else words.legs() for _ in range(count)]
        asks: tuple[str, ...] = ("action_done",)
        if is_player and draw(st.booleans()):
            given = (("k", words.number(1)), ("hard", words.truth(1)))[: draw(st.integers(0, 2))]
            actions.insert(draw(st.integers(0, len(actions))), Call(alias="helper", arguments=given))
            asks = ("action_done", "done(helper)", "not done(helper) and action_done")
        state = State(
            name=name,
            doc=draw(st.sampled_from(["", "what\nit does", "*/"])),
            final=draw(st.booleans()),
            disabled=name != names[0] and draw(_rarely),
            requires=draw(st.sampled_from([(), ("eyes",)])),
            actions=tuple(actions),
            transitions=words.decisions(names, asks),
        )
        states.append(state)
    common = CommonSection(
        actions=(words.assign(),) if draw(st.booleans()) else (),
        transitions=words.decisions(names, ("action_done",)) if draw(st.booleans()) else (),
    )
    uses = ("eyes", "legs", "notes", *(("helper",) if is_player else ()))
    return Design(
        component=component,
        doc="Does */ something",
        arithmetic="xabsl" if is_xabsl else "",
        time_unit=unit,
        uses=tuple(Use(alias=alias, component=alias.capitalize()) for alias in uses),
        parameters=()
        if is_player
        else (
            Declaration(name="k", type="float", initial="limit", unit='"m"', range=(-5, 1e4)),
            Declaration(name="hard", type="bool", initial="true", doc="how"),
        ),
        outputs=(Declaration(name="seen", type="bool"), Declaration(name="n", initial="0", unit="m\n")),
        variables=(Declaration(name="a", type="float"), Declaration(name="side", type="Side")),
        initial=draw(st.sampled_from([state.name for state in states if not state.disabled])),
        common=common,
        states=tuple(states),
    )


def project_of(*designs: Design) -> Project:
    """Draw a project with all declarations that the designs use."""
    bearing = (Declaration(name="x"), Declaration(name="y", type="float", initial="scale"))
    eyes = Interface(
        component="Eyes",
        title="What is seen",
        implementation=WORLD,
        outputs=(
            Declaration(name="seen", type="bool"),
            Declaration(name="distance", unit="mm", range=(-10, 9000)),
            Declaration(name="side", type="Side"),
            Declaration(name="bearing", arguments=bearing),
        ),
        variables=(Declaration(name="led", type="bool"),),
    )
    legs = Interface(
        component="Legs",
        implementation=WORLD,
        parameters=(
            Declaration(name="speed", type="float", initial="scale * 2"),
            Declaration(name="side", type="Side", initial="Side.right"),
        ),
    )
    notes = Interface(
        component="Notes", implementation=INTERNAL, variables=(Declaration(name="count", type="int", initial="0"),)
    )
    return Project(
        name="Law",
        languages=("python", "xabsl"),
        enumerations=(Enumeration(name="Side", elements=(("left", "the */ left"), ("right", ""))),),
        constants=(
            Declaration(name="limit", type="int", initial="3"),
            Declaration(name="scale", type="float", initial="limit / 2 - 4"),
            Declaration(name="pause", type="float", initial="0.07"),
            Declaration(name="mine", initial="Side.right"),
            Declaration(name="always", initial="True"),
        ),
        components=(eyes, legs, notes),
        agents=(Agent(name="main", root="Player"),),
        designs=designs,
    )
