"""Random projects without errors: typed expressions over a few names, hostile texts, formatted code."""

from hypothesis import strategies as st

from vicode.model.design import (
    Assign,
    Call,
    Code,
    CommonSection,
    DecisionGroup,
    Declaration,
    Design,
    Guard,
    RunCode,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.model.project import Enumeration, Interface, Project

_NUMBERS = ["0", "1", "2.5", "1e-9", "40000", "a", "b", "n", "k", "limit", "scale", "state_time", "eyes.distance"]
_WHOLES = ["0", "3", "n", "k", "limit", "eyes.count"]
_TRUTHS = ["True", "false", "seen", "eyes.seen", "done(legs)"]
_WORDS = [
    "",
    "plain",
    'say "no"',
    '"',
    '"""',
    "\\",
    "ends\\",
    "<vicode x 12345678>",
    "# </vicode>",
    "a\u2028b",
    "\x00\x07",
]
_LINES = [
    "self.a += 1",
    "if self.seen:\n    self.n = 2",
    "# nothing",
    'text = """x\n  y"""',
    "pass",
    "def f() -> int:\n    return 1",
]
_STATES = ["A", "a", "B_1", "b1", "on", "1e3", "None", "Look", "look", "LookForIt"]


def _code(text: str) -> Code:
    return Code(texts=(("python", text),))


words = st.lists(st.sampled_from(_WORDS) | st.text(max_size=8), max_size=4).map(" ".join)
docs = st.just("") | words | st.lists(words, max_size=3).map("\n\n".join)
codes = st.lists(st.sampled_from(_LINES), min_size=1, max_size=2).map(lambda lines: _code("\n\n".join(lines)))
predicates = st.sampled_from(["return self.seen", "near = self.a < 3\nreturn near"]).map(_code)


def _extend_numbers(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    return (
        st.builds("({} {} {})".format, inner, st.sampled_from(["+", "-", "*", "/", "//", "%"]), inner)
        | st.builds("-{}".format, inner)
        | st.builds("({} if {} else {})".format, inner, st.sampled_from(_TRUTHS), inner)
        | st.builds("{}({}, {})".format, st.sampled_from(["min", "max", "hypot", "atan2"]), inner, inner)
        | st.builds("{}({})".format, st.sampled_from(["abs", "sqrt", "float", "floor", "sign"]), inner)
        | st.builds("eyes.bearing_to(y={1}, x={0})".format, inner, inner)
    )


def _extend_wholes(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    return st.builds("({} {} {})".format, inner, st.sampled_from(["+", "-", "*"]), inner) | st.builds(
        "-{}".format, inner
    )


numbers = st.recursive(st.sampled_from(_NUMBERS), _extend_numbers, max_leaves=6)
wholes = st.recursive(st.sampled_from(_WHOLES), _extend_wholes, max_leaves=3)
_comparisons = st.builds("({} {} {})".format, numbers, st.sampled_from(["<", "<=", ">", "==", "!="]), numbers)
truths = st.recursive(
    st.sampled_from(_TRUTHS) | _comparisons | st.sampled_from(["side == Side.left", "n < k <= limit"]),
    lambda inner: (
        st.builds("({} {} {})".format, inner, st.sampled_from(["and", "or"]), inner)
        | st.builds("not ({})".format, inner)
    ),
    max_leaves=5,
)
_sides = st.sampled_from(["Side.left", "Side.right", "side"])

assigns = st.one_of(
    numbers.map(lambda text: Assign(values=(("a", text),))),
    numbers.map(lambda text: Assign(values=(("b", f"b + {text}"),))),
    wholes.map(lambda text: Assign(values=(("n", text),))),
    truths.map(lambda text: Assign(values=(("seen", text),))),
)
calls = st.builds(
    lambda speed, side, given: Call(alias="legs", arguments=(("speed", speed), ("side", side))[:given]),
    numbers,
    _sides,
    st.integers(0, 2),
)
passages = st.lists(assigns | st.builds(RunCode, code=codes), max_size=2).map(tuple)
actions = st.lists(assigns | calls | st.builds(RunCode, code=codes), max_size=3).map(tuple)
guards = st.builds(
    Guard,
    when=st.just("") | truths,
    after=st.sampled_from(["", "", "2", "0.25", "pause"]),
    code=st.none() | st.none() | predicates,
)


rarely = st.sampled_from([False, False, False, True])


def _decisions(names: list[str]) -> st.SearchStrategy[tuple[Transition | Stay | DecisionGroup, ...]]:
    leaf = st.builds(Transition, to=st.sampled_from(names), guard=guards, doc=docs, disabled=rarely) | st.builds(
        Stay, guard=guards, disabled=rarely
    )
    tree = st.recursive(
        leaf,
        lambda inner: st.builds(
            DecisionGroup,
            guard=guards,
            then=st.lists(inner, min_size=1, max_size=2).map(tuple),
            otherwise=st.lists(inner, max_size=2).map(tuple),
            doc=docs,
            disabled=rarely,
        ),
        max_leaves=4,
    )
    return st.lists(tree, max_size=3).map(tuple)


@st.composite
def sound_designs(draw: st.DrawFn) -> Design:
    """Draw a design that uses only declarations of `sound_projects`."""
    names = draw(st.lists(st.sampled_from(_STATES), min_size=1, max_size=4, unique=True))
    decisions, initial = _decisions(names), draw(st.sampled_from(names))
    states = tuple(
        State(
            name=name,
            doc=draw(docs),
            final=draw(st.booleans()),
            disabled=name != initial and draw(rarely),
            requires=draw(st.sampled_from([(), ("eyes",), ("eyes", "legs")])),
            enter=draw(passages),
            actions=draw(actions),
            leave=draw(passages),
            transitions=draw(decisions),
        )
        for name in names
    )
    return Design(
        component=draw(st.sampled_from(["Player", "State", "Class", "TryIt", "Root"])),
        doc=draw(docs),
        frequency_hz=draw(st.sampled_from([None, 10.0, 12.5])),
        resume=draw(st.booleans()),
        time_unit=draw(st.sampled_from(["", "ms"])),
        uses=(Use(alias="eyes", component="Eyes"), Use(alias="legs", component="Legs")),
        parameters=(
            Declaration(name="side", type="Side", doc=draw(docs)),
            Declaration(name="k", type="int", initial="limit"),
        ),
        outputs=(Declaration(name="seen", type="bool"), Declaration(name="n", initial="0", unit="m\n")),
        variables=(Declaration(name="a", type="float", initial="limit / 2"), Declaration(name="b", doc=draw(docs))),
        initial=initial,
        common=CommonSection(actions=draw(actions), transitions=draw(decisions)),
        states=states,
    )


def project_of(design: Design, words: str = "") -> Project:
    """Draw a project with all declarations that sound designs use."""
    eyes = Interface(
        component="Eyes",
        implementation="field.eyes:Eyes",
        outputs=(
            Declaration(name="seen", type="bool"),
            Declaration(name="distance"),
            Declaration(name="count", type="int"),
            Declaration(
                name="bearing_to", arguments=(Declaration(name="x"), Declaration(name="y", type="float", initial="0"))
            ),
        ),
    )
    legs = Interface(
        component="Legs",
        implementation="field.legs:LegDriver",
        parameters=(Declaration(name="speed"), Declaration(name="side", type="Side")),
    )
    return Project(
        name=words or "sampled",
        doc=words,
        enumerations=(Enumeration(name="Side", elements=(("left", words), ("right", ""))),),
        constants=(
            Declaration(name="limit", type="int", initial="3", doc=words),
            Declaration(name="scale", type="float", initial="limit * 2"),
            Declaration(name="pause", type="float", initial="1"),
        ),
        components=(eyes, legs),
        designs=(design,),
    )
