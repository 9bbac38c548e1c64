"""The schemas of single values of the format, and of declarations, which design files and project.yaml share."""

from vicode.languages import LANGUAGES
from vicode.model.design import STATE_COLORS, Call, Code, Declaration
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
CALLS = MapSchema(
    description="a mapping of used components to parameters",
    value_schema=ARGUMENTS,
    allows_name_list=True,
    flow_width=FLOW_WIDTH,
    name_field="alias",
    entry_model=Call,
    value_field="arguments",
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
ID_KEY = KeySchema("id", NAME, "identifier that does not change with edits; written by the editor")
POSITION_KEY = KeySchema("at", POSITION, "center on the canvas")
COLOR_KEY = KeySchema("color", ScalarSchema(scalar_type=ScalarType.NAME, choices=STATE_COLORS), "color in diagrams")
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
