"""Version 1 of the format: all keys of design files, with the model fields that hold them; see also `project_format`.

The reader, the writer, the conversion from and to the model, the JSON Schema and the tables of docs/design-format.md
are derived from these schemas.
"""

from vicode.model.design import (
    Assign,
    Call,
    CommonSection,
    DecisionGroup,
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
from vicode.store.architecture_format import COMPETENCE, INTERRUPT, LATCH, LAYER, POSITIONS, STEP
from vicode.store.format_values import (
    ARGUMENT,
    ARGUMENTS,
    ASSIGNMENTS,
    CALLS,
    CODE,
    COLOR_KEY,
    COUNT,
    DOC_KEY,
    EXPRESSION,
    FLAG,
    FLOW_WIDTH,
    FREQUENCY_KEY,
    ID_KEY,
    LABEL_POSITION,
    NAME,
    NAMES,
    OUTPUT,
    PARAMETER,
    POSITION_KEY,
    TEXT,
    VARIABLE,
    VERSION_KEY,
    XABSL_NAME_KEY,
    declarations,
)
from vicode.store.schema_types import (
    KeySchema,
    ListSchema,
    MapSchema,
    RecordSchema,
    ScalarSchema,
    ScalarType,
)

USE = RecordSchema(
    name="use",
    description="the name of a component",
    model=Use,
    shorthand_key="component",
    flow_width=FLOW_WIDTH,
    keys=(
        KeySchema("component", NAME, "name of the component", required=True),
        POSITION_KEY,
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
        ID_KEY,
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
        ID_KEY,
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
        POSITION_KEY,
        COLOR_KEY,
        KeySchema("final", FLAG, "final state: the component reports that it is done", default=False),
        KeySchema("failed", FLAG, "of a final state: the component has ended without success", default=False),
        KeySchema(
            "capacity", COUNT, "maximum number of robots of a team in the state at the same time", keeps_empty=True
        ),
        KeySchema(
            "synchronized", COUNT, "minimum number of robots of a team that enter the state together", keeps_empty=True
        ),
        KeySchema("disabled", FLAG, "the state has no effect but stays in the design", default=False),
        ID_KEY,
        XABSL_NAME_KEY,
        KeySchema("requires", NAMES, "used components stepped before the state runs"),
        KeySchema("modulates", CALLS, "parameters by used component; short for calls at the end of `actions`"),
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
    keys=(DOC_KEY, POSITION_KEY, *_ACTIONS_KEYS, _TRANSITIONS),
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
    keys=(KeySchema("text", TEXT, "the text, with line breaks"), POSITION_KEY),
)
FRAME = RecordSchema(
    name="frame",
    description="the states of a frame",
    model=DiagramFrame,
    shorthand_key="states",
    flow_width=FLOW_WIDTH,
    synonyms={"colour": "color"},
    keys=(COLOR_KEY, KeySchema("states", NAMES, "the states around which it is drawn")),
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
        KeySchema(
            "latches",
            MapSchema(description="a mapping of names to latches", value_schema=LATCH, name_field="name"),
            "bools with hysteresis (docs/architectures.md)",
        ),
        KeySchema(
            "interrupts",
            ListSchema(description="a list of interrupts", item_schema=lambda: INTERRUPT),
            "rules that interrupt many states, the most urgent first (docs/architectures.md)",
        ),
        KeySchema("competence", COMPETENCE, "steps towards a goal, instead of states (docs/architectures.md)"),
        KeySchema(
            "layers",
            MapSchema(description="a mapping of names to layers", value_schema=LAYER, name_field="name"),
            "layers of a subsumption architecture, the lowest first, instead of states (docs/architectures.md)",
        ),
        KeySchema("positions", POSITIONS, "centers on the canvas of the states of a competence or of layers"),
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
    LATCH,
    INTERRUPT,
    COMPETENCE,
    STEP,
    LAYER,
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
