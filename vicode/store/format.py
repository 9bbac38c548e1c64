"""The format, version 1: every key of a design file and of project.yaml in one table.

Reader, writer, JSON Schema and the tables of docs/design-format.md all come from here.
"""

from vicode.model.project import LANGUAGES
from vicode.store.shapes import Key, Kind, Leaf, Listing, Pair, Record, Table

VERSION = "1"
LINE = 110
"""Lists and mappings are written in brackets when they fit into a line of this length."""

TEXT = Leaf(kind=Kind.TEXT)
NAME = Leaf(kind=Kind.NAME)
EXPRESSION = Leaf(kind=Kind.EXPRESSION)
FREQUENCY = Leaf(kind=Kind.NUMBER)
COUNT = Leaf(kind=Kind.COUNT)
FLAG = Leaf(kind=Kind.FLAG)
POSITION = Pair(what="a position [x, y]")
LABEL_POSITION = Pair(what="a position [part, beside]")
NAMES = Listing(what="a list of names", item=lambda: NAME, width=LINE)
ASSIGNMENTS = Table(what="a mapping of names to expressions", value=EXPRESSION, width=LINE)
ARGUMENTS = Table(what="a mapping of parameters to expressions", value=EXPRESSION, width=LINE)
CODE = Table(what="code, or a mapping of languages to code", value=TEXT, short="python", keys=LANGUAGES)

_VERSION = Key(
    name="vicode", shape=Leaf(kind=Kind.VERSION), required=True, meaning="version of the format; this one is 1"
)
_DOC = Key(name="doc", shape=TEXT, meaning="a sentence for people; it becomes the docstring of what is generated")
_XABSL_NAME = Key(name="xabsl_name", shape=TEXT, meaning="its name in XABSL")
_TITLE = Key(name="title", shape=TEXT, meaning="a short heading")
_ID = Key(name="id", shape=NAME, meaning="a name that stays through edits; written by the editor")


def _declaration(name: str, value_key: str, meaning: str, *more: Key) -> Record:
    wrong = {word: value_key for word in ("default", "initial", "value") if word != value_key}
    return Record(
        name=name,
        what=f"a declaration, or just its {value_key} value",
        short=value_key,
        width=LINE,
        meant=wrong,
        keys=(
            Key(name="type", shape=NAME, meaning="bool, int, float or an enumeration; left out: as the value"),
            Key(name=value_key, shape=EXPRESSION, meaning=meaning),
            Key(name="unit", shape=TEXT, meaning="unit of the value, such as mm"),
            Key(
                name="range", shape=Pair(what="a range [low, high]"), meaning="lowest and highest value, both included"
            ),
            _DOC,
            _XABSL_NAME,
            *more,
        ),
    )


PARAMETER = _declaration("parameter", "default", "value when a caller leaves it out")
VARIABLE = _declaration("variable", "initial", "first value")
CONSTANT = _declaration("constant", "value", "its value")
ARGUMENT = _declaration("argument", "default", "value when a caller leaves it out")
OUTPUT = _declaration(
    "output",
    "initial",
    "first value",
    Key(
        name="arguments",
        shape=Table(what="a mapping of names to declarations", value=ARGUMENT, width=LINE),
        keeps_empty=True,
        meaning="given (even empty), the output is a function of these",
    ),
)

USE = Record(
    name="use",
    what="the name of a component",
    short="component",
    width=LINE,
    keys=(
        Key(name="component", shape=NAME, required=True, meaning="name of the component"),
        Key(name="at", shape=POSITION, meaning="centre on the canvas"),
    ),
)
ACTION = Record(
    name="action",
    what="an action ('set', 'call' or 'code')",
    is_item=True,
    one_of=("set", "call", "code"),
    missing=("an action that does nothing", "give it 'set', 'call' or 'code'"),
    needs=(("with", "call"), ("id", "code")),
    keys=(
        Key(
            name="set",
            shape=ASSIGNMENTS,
            keeps_empty=True,
            meaning="own variables and outputs, or `used.variable`, each with its new value",
        ),
        Key(name="call", shape=NAME, meaning="the used component to step here"),
        Key(name="with", shape=ARGUMENTS, meaning="its parameters; those left out take their defaults"),
        Key(name="code", shape=CODE, keeps_empty=True, meaning="code to run"),
        _ID,
    ),
)
ACTIONS = Listing(what="code, or a list of actions", item=lambda: ACTION, lone="code")
DECISIONS = Listing(what="a list of transitions", item=lambda: DECISION)
DECISION: Record = Record(
    name="transition",
    what="a transition ('to', 'stay' or 'then')",
    width=LINE,
    is_item=True,
    one_of=("to", "stay", "then"),
    missing=("transition has no target", "add 'to: <state>'"),
    needs=(("else", "then"), ("label_at", "to")),
    meant={
        "target": "to", "goto": "to", "next": "to", "if": "when", "guard": "when", "condition": "when",
        "timeout": "after", "description": "doc",
    },
    keys=(
        Key(name="to", shape=NAME, meaning="the state to change to; the state itself: stay"),
        Key(name="stay", shape=Leaf(kind=Kind.TRUE), meaning="`true`: ends the decision, changes nothing"),
        Key(name="when", shape=EXPRESSION, meaning="condition that must hold"),
        Key(name="after", shape=EXPRESSION, meaning="seconds that must have passed in the state"),
        _DOC,
        _ID,
        Key(
            name="label_at",
            shape=LABEL_POSITION,
            meaning="where its label is: part of the way (0 to 1), pixels beside it; left out: where there is room",
        ),
        Key(name="code", shape=CODE, keeps_empty=True, meaning="body of a function whose bool result must hold"),
        Key(name="then", shape=DECISIONS, keeps_empty=True, meaning="a group: tested in order when the guard holds"),
        Key(name="else", shape=DECISIONS, meaning="of a group: tested in order when the guard does not hold"),
        Key(name="disabled", shape=FLAG, implied=False, meaning="kept, but as if it were not there"),
    ),
)  # fmt: skip
_ACTIONS_KEYS = (
    Key(name="actions", shape=ACTIONS, meaning="done at each iteration in the state, in order"),
    Key(name="code", shape=CODE, stands_for="actions", meaning="short for `actions` with only this code"),
)
_TRANSITIONS = Key(name="transitions", shape=DECISIONS, meaning="tested in order; the first that holds is taken")
STATE = Record(
    name="state",
    what="a state",
    width=40,
    meant={
        "on_enter": "enter", "on_entry": "enter", "entry": "enter", "on_exit": "leave", "exit": "leave",
        "on_leave": "leave", "do": "actions", "action": "actions", "transition": "transitions",
        "require": "requires", "modulate": "modulates", "position": "at", "description": "doc",
    },
    keys=(
        _DOC,
        Key(name="at", shape=POSITION, meaning="centre on the canvas"),
        Key(name="final", shape=FLAG, implied=False, meaning="a target state: the component reports that it is done"),
        Key(name="capacity", shape=COUNT, keeps_empty=True, meaning="so many robots of a team may be in it at once"),
        Key(name="synchronized", shape=COUNT, keeps_empty=True, meaning="so many robots of a team enter it at once"),
        Key(name="disabled", shape=FLAG, implied=False, meaning="kept, but neither it nor a way to it is there"),
        _ID,
        _XABSL_NAME,
        Key(name="requires", shape=NAMES, meaning="used components stepped before the state's own work"),
        Key(
            name="modulates",
            shape=Table(what="a mapping of used components to parameters", value=ARGUMENTS, names=True, width=LINE),
            meaning="short for calls at the end of `actions`: used component to parameters",
        ),
        Key(name="enter", shape=ACTIONS, meaning="done when the state is entered"),
        *_ACTIONS_KEYS,
        Key(name="leave", shape=ACTIONS, meaning="done when the state is left"),
        _TRANSITIONS,
    ),
)  # fmt: skip
COMMON = Record(
    name="common",
    what="what all states share",
    keys=(_DOC, Key(name="at", shape=POSITION, meaning="centre on the canvas"), *_ACTIONS_KEYS, _TRANSITIONS),
)


def _declarations(record: Record) -> Table:
    return Table(what="a mapping of names to declarations", value=record)


DESIGN = Record(
    name="design",
    what="a design",
    meant={
        "name": "component",
        "start": "initial",
        "initial_state": "initial",
        "description": "doc",
        "hz": "frequency",
    },
    keys=(
        _VERSION,
        Key(name="component", shape=NAME, required=True, meaning="name of the component, one in the project"),
        _DOC,
        _XABSL_NAME,
        Key(name="frequency", shape=FREQUENCY, meaning="Hz; left out: works at every step it is given"),
        Key(name="resume", shape=FLAG, implied=False, meaning="`true`: goes on where it was when it is stepped again"),
        Key(
            name="arithmetic",
            shape=Leaf(kind=Kind.NAME, choices=("xabsl",)),
            meaning="`xabsl`: calculates and restarts as XABSL does; left out: as docs/semantics.md says",
        ),
        Key(
            name="time_unit",
            shape=Leaf(kind=Kind.NAME, choices=("s", "ms")),
            meaning="unit of the times in expressions: `s` or `ms`; left out: seconds",
        ),
        Key(
            name="uses",
            shape=Table(what="a mapping of names to components", value=USE),
            meaning="components under the names that code, guards and links use",
        ),
        Key(name="parameters", shape=_declarations(PARAMETER), meaning="what others may modulate in it"),
        Key(name="outputs", shape=_declarations(OUTPUT), meaning="what others may read from it, and it may set"),
        Key(name="variables", shape=_declarations(VARIABLE), meaning="its own memory"),
        Key(name="initial", shape=NAME, meaning="name of the first state"),
        Key(name="module", shape=CODE, meaning="code for the top of the generated file"),
        Key(name="members", shape=CODE, meaning="code for the inside of the generated class"),
        Key(name="common", shape=COMMON, meaning="done and tested before what every state does and tests"),
        Key(
            name="states",
            shape=Table(what="a mapping of names to states", value=STATE),
            meaning="the states by name, in the order they are shown",
        ),
    ),
)

ENUMERATION = Record(
    name="enumeration",
    what="a list of elements, or a mapping of elements to what they mean",
    short="elements",
    width=LINE,
    keys=(
        _DOC,
        Key(
            name="elements",
            shape=Table(what="elements", value=TEXT, names=True, width=LINE),
            required=True,
            meaning="its elements, as a list or with a sentence each",
        ),
        Key(name="internal", shape=FLAG, implied=False, meaning="XABSL: the engine numbers them, not the robot"),
        _XABSL_NAME,
        Key(
            name="xabsl_elements",
            shape=Table(what="a mapping of elements to names", value=TEXT, width=LINE),
            meaning="names of elements in XABSL, where they are others",
        ),
    ),
)
INTERFACE = Record(
    name="component",
    what="the declaration of a hand-written component",
    keys=(
        Key(
            name="implementation",
            shape=TEXT,
            meaning="the class, written module:Class; `world` or `internal`: vicode writes it",
        ),
        _TITLE,
        Key(name="frequency", shape=FREQUENCY, meaning="Hz; left out: works at every step it is given"),
        _DOC,
        _XABSL_NAME,
        Key(name="parameters", shape=_declarations(PARAMETER), meaning="what others may modulate in it"),
        Key(name="outputs", shape=_declarations(OUTPUT), meaning="what others may read from it"),
        Key(name="variables", shape=_declarations(VARIABLE), meaning="what others may read and set"),
    ),
)
AGENT = Record(
    name="agent",
    what="the name of a root component",
    short="root",
    width=LINE,
    keys=(
        Key(name="root", shape=NAME, required=True, meaning="component that is stepped"),
        _TITLE,
        _DOC,
        _XABSL_NAME,
    ),
)
PROJECT = Record(
    name="project",
    what="a project",
    meant={"name": "project", "description": "doc", "output": "generated", "enums": "enumerations"},
    keys=(
        _VERSION,
        Key(name="project", shape=NAME, required=True, meaning="name of the project"),
        _DOC,
        Key(
            name="languages",
            shape=NAMES,
            implied=("python",),
            keeps_empty=True,
            meaning="languages to generate; left out: python",
        ),
        Key(name="world", shape=TEXT, meaning="the simulated world to run in, written module:Class"),
        Key(
            name="generated",
            shape=TEXT,
            implied="generated",
            keeps_empty=True,
            meaning="folder of generated files, relative to this file; left out: `generated`",
        ),
        Key(
            name="enumerations",
            shape=Table(what="a mapping of names to enumerations", value=ENUMERATION),
            meaning="types whose values are named; a value is written `Side.left`",
        ),
        Key(name="constants", shape=_declarations(CONSTANT), meaning="values that all designs may use"),
        Key(
            name="components",
            shape=Table(what="a mapping of names to hand-written components", value=INTERFACE),
            meaning="hand-written components and what they offer",
        ),
        Key(
            name="agents",
            shape=Table(what="a mapping of names to root components", value=AGENT),
            meaning="names for running the project from one root component each",
        ),
    ),
)
RECORDS = (DESIGN, STATE, COMMON, DECISION, ACTION, USE, PARAMETER, OUTPUT, VARIABLE, ARGUMENT)
PROJECT_RECORDS = (PROJECT, ENUMERATION, CONSTANT, INTERFACE, PARAMETER, OUTPUT, VARIABLE, ARGUMENT, AGENT)
