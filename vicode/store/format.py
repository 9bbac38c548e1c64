"""Version 1 of the format: all keys of design files, with the model fields that hold them; see also `project_format`.

The reader, the writer, the conversion from and to the model, the JSON Schema and the tables of docs/design-format.md
are derived from these schemas.
"""

from vicode.languages import LANGUAGES
from vicode.model.design import (
    STATE_COLORS,
    Assign,
    Call,
    Code,
    CommonSection,
    DecisionGroup,
    Declaration,
    Design,
    DiagramFrame,
    DiagramNote,
    Guard,
    InvariantProperty,
    NeverProperty,
    ReachProperty,
    RecoveryProperty,
    RunCode,
    State,
    Stay,
    Transition,
    Use,
)
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
"""Maximum line length of lists and mappings in flow style."""

TEXT = ScalarSchema(scalar_type=ScalarType.TEXT)
NAME = ScalarSchema(scalar_type=ScalarType.NAME)
EXPRESSION = ScalarSchema(scalar_type=ScalarType.EXPRESSION)
FREQUENCY = ScalarSchema(scalar_type=ScalarType.NUMBER)
COUNT = ScalarSchema(scalar_type=ScalarType.COUNT)
FLAG = ScalarSchema(scalar_type=ScalarType.BOOLEAN)
POSITION = PairSchema(description="a position [x, y]")
LABEL_POSITION = PairSchema(description="a position [fraction, offset]")
NAMES = ListSchema(description="a list of names", item_schema=lambda: NAME, flow_width=FLOW_WIDTH)
ASSIGNMENTS = MapSchema(description="a mapping of names to expressions", value_schema=EXPRESSION, flow_width=FLOW_WIDTH)
ARGUMENTS = MapSchema(
    description="a mapping of parameters to expressions", value_schema=EXPRESSION, flow_width=FLOW_WIDTH
)
CODE = MapSchema(
    description="code, or a mapping of languages to code",
    value_schema=TEXT,
    shorthand_key="python",
    allowed_keys=tuple(LANGUAGES),
    wrapper=Code,
)

VERSION_KEY = KeySchema(
    "vicode", ScalarSchema(scalar_type=ScalarType.VERSION), "version of the format, 1", required=True, constant=VERSION
)
DOC_KEY = KeySchema("doc", TEXT, "description; becomes the docstring of generated code")
XABSL_NAME_KEY = KeySchema("xabsl_name", TEXT, "name in XABSL")
_ID = KeySchema("id", NAME, "identifier that does not change with edits; written by the editor")
_POSITION = KeySchema("at", POSITION, "center on the canvas")
_COLOR = KeySchema("color", ScalarSchema(scalar_type=ScalarType.NAME, choices=STATE_COLORS), "color in diagrams")
FREQUENCY_KEY = KeySchema("frequency", FREQUENCY, "frequency in Hz; default: runs on every step", field="frequency_hz")


def _declaration(name: str, value_key: str, meaning: str, *more: KeySchema) -> RecordSchema:
    return RecordSchema(
        name=name,
        description=f"a declaration, or just its type or {value_key} value",
        model=Declaration,
        shorthand_key=value_key,
        shorthand_words=dict.fromkeys(("bool", "int", "float"), "type"),
        flow_width=FLOW_WIDTH,
        synonyms={word: value_key for word in ("default", "initial", "value") if word != value_key},
        keys=(
            KeySchema("type", NAME, "bool, int, float or an enumeration; default: type of the value"),
            KeySchema(value_key, EXPRESSION, meaning, field="initial"),
            KeySchema("unit", TEXT, "unit of the value, such as mm"),
            KeySchema(
                "range", PairSchema(description="a range [low, high]"), "lowest and highest value, both included"
            ),
            DOC_KEY,
            XABSL_NAME_KEY,
            *more,
        ),
    )


def declarations(record: RecordSchema) -> MapSchema:
    return MapSchema(description="a mapping of names to declarations", value_schema=record, name_field="name")


_TUNABLE = KeySchema(
    "tunable", FLAG, "whether the live view of robots shows a slider for it, from end to end of `range`"
)
PARAMETER = _declaration("parameter", "default", "value if the caller does not set it", _TUNABLE)
VARIABLE = _declaration("variable", "initial", "initial value")
CONSTANT = _declaration("constant", "value", "value", _TUNABLE)
ARGUMENT = _declaration("argument", "default", "value if the caller does not set it")
OUTPUT = _declaration(
    "output",
    "initial",
    "initial value",
    KeySchema(
        "arguments",
        MapSchema(
            description="a mapping of names to declarations",
            value_schema=ARGUMENT,
            name_field="name",
            flow_width=FLOW_WIDTH,
        ),
        "makes the output a function with these arguments, even if empty",
        keeps_empty=True,
    ),
)

USE = RecordSchema(
    name="use",
    description="the name of a component",
    model=Use,
    shorthand_key="component",
    flow_width=FLOW_WIDTH,
    keys=(
        KeySchema("component", NAME, "name of the component", required=True),
        _POSITION,
    ),
)
ACTION = RecordSchema(
    name="action",
    description="an action ('set', 'call' or 'code')",
    variants={"set": Assign, "call": Call, "code": RunCode},
    missing_message=("the action has no effect", "add 'set', 'call' or 'code'"),
    dependent_keys=(("with", "call"), ("id", "code")),
    keys=(
        KeySchema(
            "set",
            ASSIGNMENTS,
            "new values of variables and outputs, and of variables of used components: `used.variable`",
            field="values",
            keeps_empty=True,
        ),
        KeySchema("call", NAME, "the used component to step", field="alias"),
        KeySchema("with", ARGUMENTS, "its parameters; others have their defaults", field="arguments"),
        KeySchema("code", CODE, "code to run", keeps_empty=True),
        _ID,
    ),
)
ACTIONS = ListSchema(description="code, or a list of actions", item_schema=lambda: ACTION, single_item_key="code")
DECISIONS = ListSchema(description="a list of transitions", item_schema=lambda: DECISION)
DECISION: RecordSchema = RecordSchema(
    name="transition",
    description="a transition ('to', 'stay' or 'then')",
    variants={"to": Transition, "stay": Stay, "then": DecisionGroup},
    nested={"guard": Guard},
    flow_width=FLOW_WIDTH,
    missing_message=("the transition has no target", "add 'to: <state>'"),
    dependent_keys=(("else", "then"), ("label_at", "to")),
    synonyms={
        "target": "to",
        "goto": "to",
        "next": "to",
        "if": "when",
        "guard": "when",
        "condition": "when",
        "timeout": "after",
        "description": "doc",
    },
    keys=(
        KeySchema("to", NAME, "target state; the state itself means stay"),
        KeySchema(
            "stay",
            ScalarSchema(scalar_type=ScalarType.TRUE),
            "`true`: ends the decision without a transition",
            constant=True,
        ),
        KeySchema("when", EXPRESSION, "condition", field="guard.when"),
        KeySchema("after", EXPRESSION, "minimum time in the state, in seconds or in `time_unit`", field="guard.after"),
        DOC_KEY,
        _ID,
        KeySchema(
            "label_at",
            LABEL_POSITION,
            "label position: fraction of the edge (0 to 1) and offset in pixels; default: automatic",
        ),
        KeySchema(
            "code", CODE, "condition as the body of a function that returns bool", field="guard.code", keeps_empty=True
        ),
        KeySchema("then", DECISIONS, "group: tested in order if the guard holds", keeps_empty=True),
        KeySchema("else", DECISIONS, "of a group: tested in order if the guard does not hold", field="otherwise"),
        KeySchema("disabled", FLAG, "the transition has no effect but stays in the design", default=False),
    ),
)
_ACTIONS_KEYS = (
    KeySchema("actions", ACTIONS, "run in order in each iteration in the state"),
    KeySchema("code", CODE, "short for `actions` with only this code", shorthand_for="actions"),
)
_TRANSITIONS = KeySchema("transitions", DECISIONS, "tested in order; the first one that holds is taken")
STATE = RecordSchema(
    name="state",
    description="a state",
    model=State,
    flow_width=40,
    synonyms={
        "on_enter": "enter",
        "on_entry": "enter",
        "entry": "enter",
        "on_exit": "leave",
        "exit": "leave",
        "on_leave": "leave",
        "do": "actions",
        "action": "actions",
        "transition": "transitions",
        "require": "requires",
        "modulate": "modulates",
        "position": "at",
        "colour": "color",
        "description": "doc",
    },
    keys=(
        DOC_KEY,
        _POSITION,
        _COLOR,
        KeySchema("final", FLAG, "final state: the component reports that it is done", default=False),
        KeySchema(
            "capacity", COUNT, "maximum number of robots of a team in the state at the same time", keeps_empty=True
        ),
        KeySchema(
            "synchronized", COUNT, "minimum number of robots of a team that enter the state together", keeps_empty=True
        ),
        KeySchema("disabled", FLAG, "the state has no effect but stays in the design", default=False),
        _ID,
        XABSL_NAME_KEY,
        KeySchema("requires", NAMES, "used components stepped before the state runs"),
        KeySchema(
            "modulates",
            MapSchema(
                description="a mapping of used components to parameters",
                value_schema=ARGUMENTS,
                allows_name_list=True,
                flow_width=FLOW_WIDTH,
                name_field="alias",
                entry_model=Call,
                value_field="arguments",
            ),
            "parameters by used component; short for calls at the end of `actions`",
        ),
        KeySchema("enter", ACTIONS, "run when the state is entered"),
        *_ACTIONS_KEYS,
        KeySchema("leave", ACTIONS, "run when the state is left"),
        _TRANSITIONS,
    ),
)
COMMON = RecordSchema(
    name="common",
    description="actions and transitions of all states",
    model=CommonSection,
    keys=(DOC_KEY, _POSITION, *_ACTIONS_KEYS, _TRANSITIONS),
)
PROPERTY = RecordSchema(
    name="property",
    description="a property ('reach', 'never', 'can_reach' or 'holds')",
    variants={
        "reach": ReachProperty,
        "never": NeverProperty,
        "can_reach": RecoveryProperty,
        "holds": InvariantProperty,
    },
    missing_message=("the property says nothing", "add 'reach', 'never', 'can_reach' or 'holds'"),
    dependent_keys=(("within", "reach"), ("before", "never")),
    flow_width=FLOW_WIDTH,
    keys=(
        KeySchema("after", NAME, "with `reach` or `never`: the state from which on it applies; default: each start"),
        KeySchema("reach", NAME, "this state becomes active"),
        KeySchema("within", EXPRESSION, "time in which it becomes active, in seconds or in `time_unit`"),
        KeySchema("never", NAME, "this state does not become active"),
        KeySchema("before", NAME, "it may become active once this state was"),
        KeySchema("can_reach", NAME, "there is always a way back to this state"),
        KeySchema("holds", EXPRESSION, "this condition holds after each step"),
    ),
)
PROPERTIES = ListSchema(description="a list of properties", item_schema=lambda: PROPERTY)
NOTE = RecordSchema(
    name="note",
    description="the text of a note",
    model=DiagramNote,
    shorthand_key="text",
    flow_width=FLOW_WIDTH,
    keys=(KeySchema("text", TEXT, "the text, with line breaks"), _POSITION),
)
FRAME = RecordSchema(
    name="frame",
    description="the states of a frame",
    model=DiagramFrame,
    shorthand_key="states",
    flow_width=FLOW_WIDTH,
    synonyms={"colour": "color"},
    keys=(_COLOR, KeySchema("states", NAMES, "the states around which it is drawn")),
)

DESIGN = RecordSchema(
    name="design",
    description="a design",
    model=Design,
    synonyms={
        "name": "component",
        "start": "initial",
        "initial_state": "initial",
        "description": "doc",
        "hz": "frequency",
    },
    keys=(
        VERSION_KEY,
        KeySchema("component", NAME, "name of the component, unique in the project", required=True),
        DOC_KEY,
        XABSL_NAME_KEY,
        FREQUENCY_KEY,
        KeySchema("resume", FLAG, "`true`: a new activation continues in the last state", default=False),
        KeySchema(
            "arithmetic",
            ScalarSchema(scalar_type=ScalarType.NAME, choices=("xabsl",)),
            "`xabsl`: arithmetic and restart as in XABSL; default: as in docs/semantics.md",
        ),
        KeySchema(
            "time_unit",
            ScalarSchema(scalar_type=ScalarType.NAME, choices=("s", "ms")),
            "unit of times in expressions: `s` or `ms`; default: seconds",
        ),
        KeySchema(
            "uses",
            MapSchema(description="a mapping of names to components", value_schema=USE, name_field="alias"),
            "used components by their name in this design",
        ),
        KeySchema("parameters", declarations(PARAMETER), "inputs that other components can set"),
        KeySchema("outputs", declarations(OUTPUT), "values that other components can read"),
        KeySchema("variables", declarations(VARIABLE), "private values"),
        KeySchema("initial", NAME, "name of the initial state"),
        KeySchema("module", CODE, "code at the top of the generated file"),
        KeySchema("members", CODE, "code in the generated class"),
        KeySchema("common", COMMON, "actions and transitions that come before those of each state"),
        KeySchema(
            "states",
            MapSchema(description="a mapping of names to states", value_schema=STATE, name_field="name"),
            "states by name, in display order",
        ),
        KeySchema("properties", PROPERTIES, "what the behavior promises (docs/analysis.md)"),
        KeySchema(
            "frames",
            MapSchema(description="a mapping of titles to frames", value_schema=FRAME, name_field="name"),
            "frames around states in the diagram, by title",
        ),
        KeySchema(
            "notes",
            MapSchema(description="a mapping of names to notes", value_schema=NOTE, name_field="name"),
            "texts in the diagram; the names only identify them",
        ),
    ),
)

DESIGN_RECORDS = (
    DESIGN,
    STATE,
    PROPERTY,
    FRAME,
    NOTE,
    COMMON,
    DECISION,
    ACTION,
    USE,
    PARAMETER,
    OUTPUT,
    VARIABLE,
    ARGUMENT,
)
