"""The schemas of what `vicode.model.lowering` turns into states: latches, interrupts, competences and layers."""

from vicode.model.design import INTERRUPT_ENDS, Competence, CompetenceStep, DerivedPosition, Interrupt, Latch, Layer
from vicode.store.format_values import CALLS, COUNT, DOC_KEY, EXPRESSION, FLOW_WIDTH, NAME, NAMES, POSITION
from vicode.store.schema_types import KeySchema, MapSchema, RecordSchema

POSITIONS = MapSchema(
    description="a mapping of states to positions",
    value_schema=POSITION,
    flow_width=FLOW_WIDTH,
    name_field="name",
    entry_model=DerivedPosition,
    value_field="at",
)
LATCH = RecordSchema(
    name="latch",
    description="a latch",
    model=Latch,
    flow_width=FLOW_WIDTH,
    keys=(
        KeySchema("on", EXPRESSION, "condition that makes it true", required=True),
        KeySchema("off", EXPRESSION, "condition that makes it false; default: the end of `on`"),
        KeySchema(
            "hold", EXPRESSION, "minimum time between two changes, a number or constant in seconds or in `time_unit`"
        ),
        DOC_KEY,
    ),
)
INTERRUPT = RecordSchema(
    name="interrupt",
    description="an interrupt",
    model=Interrupt,
    flow_width=FLOW_WIDTH,
    synonyms={"if": "when", "during": "while", "ending": "then"},
    keys=(
        KeySchema("do", NAME, "state that becomes active", required=True),
        KeySchema(
            "while",
            NAMES,
            "names of interrupted states, with `*` for any text; default: all but ends and states of interrupts above",
            field="during",
        ),
        KeySchema("when", EXPRESSION, "condition", required=True),
        KeySchema("until", EXPRESSION, "condition for its end; default: `when` no longer holds"),
        KeySchema(
            "then",
            NAME,
            "what follows: a state, or " + ", ".join(f"`{each}`" for each in INTERRUPT_ENDS) + "; default: `resume`",
        ),
        KeySchema(
            "every",
            EXPRESSION,
            "minimum time from its end to the next one, a number or constant in seconds or in `time_unit`",
        ),
        DOC_KEY,
    ),
)
_STEP_KEYS = (
    KeySchema("requires", NAMES, "used components stepped before"),
    KeySchema("modulates", CALLS, "components that it calls, with their parameters"),
)
STEP = RecordSchema(
    name="step",
    description="a step of a competence",
    model=CompetenceStep,
    flow_width=FLOW_WIDTH,
    keys=(
        DOC_KEY,
        KeySchema("when", EXPRESSION, "condition under which the step is possible; default: always"),
        KeySchema("retries", COUNT, "how often it is begun at most; default: no limit", keeps_empty=True),
        *_STEP_KEYS,
    ),
)
COMPETENCE = RecordSchema(
    name="competence",
    description="a competence",
    model=Competence,
    keys=(
        KeySchema("goal", EXPRESSION, "condition that ends it with success", required=True),
        DOC_KEY,
        KeySchema("requires", NAMES, "used components stepped before each step"),
        KeySchema(
            "steps",
            MapSchema(description="a mapping of names to steps", value_schema=STEP, name_field="name"),
            "steps by name; the first one that is possible is done",
        ),
    ),
)
LAYER = RecordSchema(
    name="layer",
    description="a layer",
    model=Layer,
    flow_width=FLOW_WIDTH,
    keys=(
        DOC_KEY,
        KeySchema("when", EXPRESSION, "condition under which the layer commands; the lowest layer has none"),
        KeySchema(
            "for",
            EXPRESSION,
            "how long it commands after that, a number or constant in seconds or in `time_unit`",
            field="hold",
        ),
        *_STEP_KEYS,
    ),
)
