"""The format, version 1: every key of a design file and of project.yaml in one table.

Reader, writer, JSON Schema and the tables of docs/design-format.md all come from here.
"""

from vicode.model.project import CODE_LANGUAGES
from vicode.store.schema_types import (
    KeySchema,
    ListSchema,
    MapSchema,
    PairSchema,
    RecordSchema,
    ScalarSchema,
    ScalarType,
)

VERSION = "1"
FLOW_WIDTH = 110
"""Lists and mappings are written in brackets when they fit into a line of this length."""

TEXT = ScalarSchema(scalar_type=ScalarType.TEXT)
NAME = ScalarSchema(scalar_type=ScalarType.NAME)
EXPRESSION = ScalarSchema(scalar_type=ScalarType.EXPRESSION)
FREQUENCY = ScalarSchema(scalar_type=ScalarType.NUMBER)
COUNT = ScalarSchema(scalar_type=ScalarType.COUNT)
FLAG = ScalarSchema(scalar_type=ScalarType.BOOLEAN)
POSITION = PairSchema(description="a position [x, y]")
LABEL_POSITION = PairSchema(description="a position [part, beside]")
NAMES = ListSchema(description="a list of names", item_schema=lambda: NAME, flow_width=FLOW_WIDTH)
ASSIGNMENTS = MapSchema(description="a mapping of names to expressions", value_schema=EXPRESSION, flow_width=FLOW_WIDTH)
ARGUMENTS = MapSchema(
    description="a mapping of parameters to expressions", value_schema=EXPRESSION, flow_width=FLOW_WIDTH
)
CODE = MapSchema(
    description="code, or a mapping of languages to code",
    value_schema=TEXT,
    shorthand_key="python",
    allowed_keys=CODE_LANGUAGES,
)

_VERSION = KeySchema(
    name="vicode",
    schema=ScalarSchema(scalar_type=ScalarType.VERSION),
    required=True,
    description="version of the format; this one is 1",
)
_DOC = KeySchema(
    name="doc", schema=TEXT, description="a sentence for people; it becomes the docstring of what is generated"
)
_XABSL_NAME = KeySchema(name="xabsl_name", schema=TEXT, description="its name in XABSL")
_TITLE = KeySchema(name="title", schema=TEXT, description="a short heading")
_ID = KeySchema(name="id", schema=NAME, description="a name that stays through edits; written by the editor")


def _declaration(name: str, value_key: str, meaning: str, *more: KeySchema) -> RecordSchema:
    wrong = {word: value_key for word in ("default", "initial", "value") if word != value_key}
    return RecordSchema(
        name=name,
        description=f"a declaration, or just its {value_key} value",
        shorthand_key=value_key,
        flow_width=FLOW_WIDTH,
        synonyms=wrong,
        keys=(
            KeySchema(
                name="type", schema=NAME, description="bool, int, float or an enumeration; left out: as the value"
            ),
            KeySchema(name=value_key, schema=EXPRESSION, description=meaning),
            KeySchema(name="unit", schema=TEXT, description="unit of the value, such as mm"),
            KeySchema(
                name="range",
                schema=PairSchema(description="a range [low, high]"),
                description="lowest and highest value, both included",
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
    KeySchema(
        name="arguments",
        schema=MapSchema(
            description="a mapping of names to declarations", value_schema=ARGUMENT, flow_width=FLOW_WIDTH
        ),
        keeps_empty=True,
        description="given (even empty), the output is a function of these",
    ),
)

USE = RecordSchema(
    name="use",
    description="the name of a component",
    shorthand_key="component",
    flow_width=FLOW_WIDTH,
    keys=(
        KeySchema(name="component", schema=NAME, required=True, description="name of the component"),
        KeySchema(name="at", schema=POSITION, description="centre on the canvas"),
    ),
)
ACTION = RecordSchema(
    name="action",
    description="an action ('set', 'call' or 'code')",
    is_item=True,
    one_of=("set", "call", "code"),
    missing_message=("an action that does nothing", "give it 'set', 'call' or 'code'"),
    dependent_keys=(("with", "call"), ("id", "code")),
    keys=(
        KeySchema(
            name="set",
            schema=ASSIGNMENTS,
            keeps_empty=True,
            description="own variables and outputs, or `used.variable`, each with its new value",
        ),
        KeySchema(name="call", schema=NAME, description="the used component to step here"),
        KeySchema(name="with", schema=ARGUMENTS, description="its parameters; those left out take their defaults"),
        KeySchema(name="code", schema=CODE, keeps_empty=True, description="code to run"),
        _ID,
    ),
)
ACTIONS = ListSchema(description="code, or a list of actions", item_schema=lambda: ACTION, single_item_key="code")
DECISIONS = ListSchema(description="a list of transitions", item_schema=lambda: DECISION)
DECISION: RecordSchema = RecordSchema(
    name="transition",
    description="a transition ('to', 'stay' or 'then')",
    flow_width=FLOW_WIDTH,
    is_item=True,
    one_of=("to", "stay", "then"),
    missing_message=("transition has no target", "add 'to: <state>'"),
    dependent_keys=(("else", "then"), ("label_at", "to")),
    synonyms={
        "target": "to", "goto": "to", "next": "to", "if": "when", "guard": "when", "condition": "when",
        "timeout": "after", "description": "doc",
    },
    keys=(
        KeySchema(name="to", schema=NAME, description="the state to change to; the state itself: stay"),
        KeySchema(name="stay", schema=ScalarSchema(scalar_type=ScalarType.TRUE), description="`true`: ends the decision, changes nothing"),
        KeySchema(name="when", schema=EXPRESSION, description="condition that must hold"),
        KeySchema(name="after", schema=EXPRESSION, description="seconds that must have passed in the state"),
        _DOC,
        _ID,
        KeySchema(
            name="label_at",
            schema=LABEL_POSITION,
            description="where its label is: part of the way (0 to 1), pixels beside it; left out: where there is room",
        ),
        KeySchema(name="code", schema=CODE, keeps_empty=True, description="body of a function whose bool result must hold"),
        KeySchema(name="then", schema=DECISIONS, keeps_empty=True, description="a group: tested in order when the guard holds"),
        KeySchema(name="else", schema=DECISIONS, description="of a group: tested in order when the guard does not hold"),
        KeySchema(name="disabled", schema=FLAG, default=False, description="kept, but as if it were not there"),
    ),
)  # fmt: skip
_ACTIONS_KEYS = (
    KeySchema(name="actions", schema=ACTIONS, description="done at each iteration in the state, in order"),
    KeySchema(name="code", schema=CODE, shorthand_for="actions", description="short for `actions` with only this code"),
)
_TRANSITIONS = KeySchema(
    name="transitions", schema=DECISIONS, description="tested in order; the first that holds is taken"
)
STATE = RecordSchema(
    name="state",
    description="a state",
    flow_width=40,
    synonyms={
        "on_enter": "enter", "on_entry": "enter", "entry": "enter", "on_exit": "leave", "exit": "leave",
        "on_leave": "leave", "do": "actions", "action": "actions", "transition": "transitions",
        "require": "requires", "modulate": "modulates", "position": "at", "description": "doc",
    },
    keys=(
        _DOC,
        KeySchema(name="at", schema=POSITION, description="centre on the canvas"),
        KeySchema(name="final", schema=FLAG, default=False, description="a target state: the component reports that it is done"),
        KeySchema(name="capacity", schema=COUNT, keeps_empty=True, description="so many robots of a team may be in it at once"),
        KeySchema(name="synchronized", schema=COUNT, keeps_empty=True, description="so many robots of a team enter it at once"),
        KeySchema(name="disabled", schema=FLAG, default=False, description="kept, but neither it nor a way to it is there"),
        _ID,
        _XABSL_NAME,
        KeySchema(name="requires", schema=NAMES, description="used components stepped before the state's own work"),
        KeySchema(
            name="modulates",
            schema=MapSchema(description="a mapping of used components to parameters", value_schema=ARGUMENTS, allows_name_list=True, flow_width=FLOW_WIDTH),
            description="short for calls at the end of `actions`: used component to parameters",
        ),
        KeySchema(name="enter", schema=ACTIONS, description="done when the state is entered"),
        *_ACTIONS_KEYS,
        KeySchema(name="leave", schema=ACTIONS, description="done when the state is left"),
        _TRANSITIONS,
    ),
)  # fmt: skip
COMMON = RecordSchema(
    name="common",
    description="what all states share",
    keys=(
        _DOC,
        KeySchema(name="at", schema=POSITION, description="centre on the canvas"),
        *_ACTIONS_KEYS,
        _TRANSITIONS,
    ),
)


def _declarations(record: RecordSchema) -> MapSchema:
    return MapSchema(description="a mapping of names to declarations", value_schema=record)


DESIGN = RecordSchema(
    name="design",
    description="a design",
    synonyms={
        "name": "component",
        "start": "initial",
        "initial_state": "initial",
        "description": "doc",
        "hz": "frequency",
    },
    keys=(
        _VERSION,
        KeySchema(
            name="component", schema=NAME, required=True, description="name of the component, one in the project"
        ),
        _DOC,
        _XABSL_NAME,
        KeySchema(name="frequency", schema=FREQUENCY, description="Hz; left out: works at every step it is given"),
        KeySchema(
            name="resume",
            schema=FLAG,
            default=False,
            description="`true`: goes on where it was when it is stepped again",
        ),
        KeySchema(
            name="arithmetic",
            schema=ScalarSchema(scalar_type=ScalarType.NAME, choices=("xabsl",)),
            description="`xabsl`: calculates and restarts as XABSL does; left out: as docs/semantics.md says",
        ),
        KeySchema(
            name="time_unit",
            schema=ScalarSchema(scalar_type=ScalarType.NAME, choices=("s", "ms")),
            description="unit of the times in expressions: `s` or `ms`; left out: seconds",
        ),
        KeySchema(
            name="uses",
            schema=MapSchema(description="a mapping of names to components", value_schema=USE),
            description="components under the names that code, guards and links use",
        ),
        KeySchema(name="parameters", schema=_declarations(PARAMETER), description="what others may modulate in it"),
        KeySchema(
            name="outputs", schema=_declarations(OUTPUT), description="what others may read from it, and it may set"
        ),
        KeySchema(name="variables", schema=_declarations(VARIABLE), description="its own memory"),
        KeySchema(name="initial", schema=NAME, description="name of the first state"),
        KeySchema(name="module", schema=CODE, description="code for the top of the generated file"),
        KeySchema(name="members", schema=CODE, description="code for the inside of the generated class"),
        KeySchema(name="common", schema=COMMON, description="done and tested before what every state does and tests"),
        KeySchema(
            name="states",
            schema=MapSchema(description="a mapping of names to states", value_schema=STATE),
            description="the states by name, in the order they are shown",
        ),
    ),
)

ENUMERATION = RecordSchema(
    name="enumeration",
    description="a list of elements, or a mapping of elements to what they mean",
    shorthand_key="elements",
    flow_width=FLOW_WIDTH,
    keys=(
        _DOC,
        KeySchema(
            name="elements",
            schema=MapSchema(description="elements", value_schema=TEXT, allows_name_list=True, flow_width=FLOW_WIDTH),
            required=True,
            description="its elements, as a list or with a sentence each",
        ),
        KeySchema(
            name="internal", schema=FLAG, default=False, description="XABSL: the engine numbers them, not the robot"
        ),
        _XABSL_NAME,
        KeySchema(
            name="xabsl_elements",
            schema=MapSchema(description="a mapping of elements to names", value_schema=TEXT, flow_width=FLOW_WIDTH),
            description="names of elements in XABSL, where they are others",
        ),
    ),
)
INTERFACE = RecordSchema(
    name="component",
    description="the declaration of a hand-written component",
    keys=(
        KeySchema(
            name="implementation",
            schema=TEXT,
            description="the class, written module:Class; `world` or `internal`: vicode writes it",
        ),
        _TITLE,
        KeySchema(name="frequency", schema=FREQUENCY, description="Hz; left out: works at every step it is given"),
        _DOC,
        _XABSL_NAME,
        KeySchema(name="parameters", schema=_declarations(PARAMETER), description="what others may modulate in it"),
        KeySchema(name="outputs", schema=_declarations(OUTPUT), description="what others may read from it"),
        KeySchema(name="variables", schema=_declarations(VARIABLE), description="what others may read and set"),
    ),
)
AGENT = RecordSchema(
    name="agent",
    description="the name of a root component",
    shorthand_key="root",
    flow_width=FLOW_WIDTH,
    keys=(
        KeySchema(name="root", schema=NAME, required=True, description="component that is stepped"),
        _TITLE,
        _DOC,
        _XABSL_NAME,
    ),
)
PROJECT = RecordSchema(
    name="project",
    description="a project",
    synonyms={"name": "project", "description": "doc", "output": "generated", "enums": "enumerations"},
    keys=(
        _VERSION,
        KeySchema(name="project", schema=NAME, required=True, description="name of the project"),
        _DOC,
        KeySchema(
            name="languages",
            schema=NAMES,
            default=("python",),
            keeps_empty=True,
            description="languages to generate; left out: python",
        ),
        KeySchema(name="world", schema=TEXT, description="the simulated world to run in, written module:Class"),
        KeySchema(
            name="generated",
            schema=TEXT,
            default="generated",
            keeps_empty=True,
            description="folder of generated files, relative to this file; left out: `generated`",
        ),
        KeySchema(
            name="enumerations",
            schema=MapSchema(description="a mapping of names to enumerations", value_schema=ENUMERATION),
            description="types whose values are named; a value is written `Side.left`",
        ),
        KeySchema(name="constants", schema=_declarations(CONSTANT), description="values that all designs may use"),
        KeySchema(
            name="components",
            schema=MapSchema(description="a mapping of names to hand-written components", value_schema=INTERFACE),
            description="hand-written components and what they offer",
        ),
        KeySchema(
            name="agents",
            schema=MapSchema(description="a mapping of names to root components", value_schema=AGENT),
            description="names for running the project from one root component each",
        ),
    ),
)
DESIGN_RECORDS = (DESIGN, STATE, COMMON, DECISION, ACTION, USE, PARAMETER, OUTPUT, VARIABLE, ARGUMENT)
PROJECT_RECORDS = (PROJECT, ENUMERATION, CONSTANT, INTERFACE, PARAMETER, OUTPUT, VARIABLE, ARGUMENT, AGENT)
