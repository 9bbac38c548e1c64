"""Version 1 of the format: all keys of project.yaml, with the model fields that hold them."""

from vicode.model.project import (
    Agent,
    BridgeSettings,
    Enumeration,
    Interface,
    Profile,
    ProfileClass,
    Project,
    RemoteReference,
    TopicReference,
)
from vicode.store.format_values import (
    ARGUMENT,
    CONSTANT,
    COUNT,
    DOC_KEY,
    EXPRESSION,
    FLAG,
    FLOW_WIDTH,
    FREQUENCY,
    FREQUENCY_KEY,
    NAME,
    NAMES,
    OUTPUT,
    PARAMETER,
    TEXT,
    VARIABLE,
    VERSION_KEY,
    XABSL_NAME_KEY,
    declarations,
)
from vicode.store.schema_types import KeySchema, MapSchema, RecordSchema, ScalarSchema, ScalarType
from vicode.xabsl.source_text import ENCODINGS

_CLOCK = KeySchema(
    "clock",
    ScalarSchema(scalar_type=ScalarType.NAME, choices=("world",)),
    "`world`: the world sets the pace (docs/own-components.md)",
)
TITLE_KEY = KeySchema("title", TEXT, "short heading")

ENUMERATION = RecordSchema(
    name="enumeration",
    description="a list of elements, or a mapping of elements to descriptions",
    model=Enumeration,
    shorthand_key="elements",
    flow_width=FLOW_WIDTH,
    keys=(
        DOC_KEY,
        KeySchema(
            "elements",
            MapSchema(description="elements", value_schema=TEXT, allows_name_list=True, flow_width=FLOW_WIDTH),
            "elements as a list, or as a mapping to descriptions",
            required=True,
        ),
        KeySchema("internal", FLAG, "XABSL: the engine, not the robot program, numbers the elements", default=False),
        XABSL_NAME_KEY,
        KeySchema(
            "xabsl_elements",
            MapSchema(description="a mapping of elements to names", value_schema=TEXT, flow_width=FLOW_WIDTH),
            "XABSL names of the elements, where they differ",
        ),
    ),
)
INTERFACE = RecordSchema(
    name="component",
    description="the declaration of a hand-written component",
    model=Interface,
    keys=(
        KeySchema(
            "implementation",
            TEXT,
            "class as module:Class; vicode generates the class for `world`, `internal`, or if none is given",
        ),
        TITLE_KEY,
        FREQUENCY_KEY,
        DOC_KEY,
        XABSL_NAME_KEY,
        KeySchema("parameters", declarations(PARAMETER), "inputs that other components can set"),
        KeySchema("outputs", declarations(OUTPUT), "values that other components can read"),
        KeySchema("variables", declarations(VARIABLE), "values that other components can read and set"),
        KeySchema("assume", EXPRESSION, "condition that its outputs always fulfill (docs/analysis.md)"),
    ),
)
AGENT = RecordSchema(
    name="agent",
    description="the name of a root component",
    model=Agent,
    shorthand_key="root",
    flow_width=FLOW_WIDTH,
    keys=(
        KeySchema("root", NAME, "root component", required=True),
        TITLE_KEY,
        DOC_KEY,
        XABSL_NAME_KEY,
    ),
)
_FIELDS = MapSchema(description="a mapping of names to fields", value_schema=TEXT, flow_width=FLOW_WIDTH)
CHOICE = RecordSchema(
    name="profile_component",
    description="a class as module:Class, 'remote', or 'topic'",
    variants={"implementation": ProfileClass, "remote": RemoteReference, "topic": TopicReference},
    missing_message=("the component gets no other class", "add 'implementation', 'remote' or 'topic'"),
    dependent_keys=(
        ("reliable", "remote"),
        ("max_age", "remote", "topic"),
        *((key, "topic") for key in ("type", "outputs", "parameters", "frame")),
    ),
    shorthand_key="implementation",
    flow_width=FLOW_WIDTH,
    keys=(
        KeySchema("implementation", TEXT, "class as module:Class", keeps_empty=True),
        KeySchema("remote", TEXT, "the component of another process or robot, as robot/component", keeps_empty=True),
        KeySchema("reliable", FLAG, "`true`: each message counts; default: only the newest", default=False),
        KeySchema("topic", TEXT, "a topic of ROS 2, such as /scan (docs/ros2.md)", keeps_empty=True),
        KeySchema("type", TEXT, "with `topic`: its type, such as sensor_msgs/msg/LaserScan"),
        KeySchema("outputs", _FIELDS, "with `topic`: the field of each output, such as `min(ranges)`"),
        KeySchema("parameters", _FIELDS, "with `topic`: the field of each parameter, such as linear.x"),
        KeySchema("frame", TEXT, "with `topic`: frame_id of published messages"),
        KeySchema("max_age", FREQUENCY, "`remote`, `topic`: seconds after which outputs are too old; default: 1"),
    ),
)
PROFILE = RecordSchema(
    name="profile",
    description="other implementations of components, and another world",
    model=Profile,
    keys=(
        KeySchema("world", TEXT, "class of the world as module:Class, if it is another one"),
        _CLOCK,
        KeySchema("tune", FLAG, "whether programs of ROS 2 may set tunable constants (docs/ros2.md)", default=False),
        KeySchema(
            "components",
            MapSchema(description="a mapping of components to classes", value_schema=CHOICE, name_field="component"),
            "classes as module:Class, or components of other robots, by component",
        ),
    ),
)
BRIDGE = RecordSchema(
    name="bridge",
    description="settings of `vicode bridge`",
    model=BridgeSettings,
    flow_width=FLOW_WIDTH,
    keys=(
        KeySchema("world", TEXT, "class of the world of connected robots as module:Class"),
        KeySchema("tick_ms", FREQUENCY, "time between two ticks in ms; default: 50"),
        KeySchema("port", COUNT, "port that robots connect to; default: 7001", keeps_empty=True),
    ),
)
PROJECT = RecordSchema(
    name="project",
    description="a project",
    model=Project,
    synonyms={"name": "project", "description": "doc", "output": "generated", "enums": "enumerations"},
    keys=(
        VERSION_KEY,
        KeySchema("project", NAME, "name of the project", field="name", required=True),
        DOC_KEY,
        KeySchema("languages", NAMES, "languages of the generated code", default=("python",), keeps_empty=True),
        KeySchema("live", FLAG, "programs in C++ can be watched and recorded (docs/cpp.md)", default=False),
        KeySchema("world", TEXT, "class of the simulated world as module:Class"),
        _CLOCK,
        KeySchema(
            "generated", TEXT, "folder of generated files, relative to this file", default="generated", keeps_empty=True
        ),
        KeySchema(
            "xabsl_encoding",
            ScalarSchema(scalar_type=ScalarType.NAME, choices=ENCODINGS),
            "encoding of XABSL files that are not UTF-8; default: `cp1252`",
        ),
        KeySchema(
            "enumerations",
            MapSchema(description="a mapping of names to enumerations", value_schema=ENUMERATION, name_field="name"),
            "types with named values, written `Side.left`",
        ),
        KeySchema("constants", declarations(CONSTANT), "values for all designs"),
        KeySchema(
            "components",
            MapSchema(
                description="a mapping of names to hand-written components",
                value_schema=INTERFACE,
                name_field="component",
            ),
            "interfaces of the hand-written components",
        ),
        KeySchema(
            "agents",
            MapSchema(description="a mapping of names to root components", value_schema=AGENT, name_field="name"),
            "entry points of the project",
        ),
        KeySchema(
            "profiles",
            MapSchema(description="a mapping of names to profiles", value_schema=PROFILE, name_field="name"),
            "sets of implementations, such as for simulation and for the robot (`--profile`)",
        ),
        KeySchema("bridge", BRIDGE, "how `vicode bridge` runs the designs for connected robots"),
    ),
)
PROJECT_RECORDS = (
    PROJECT,
    ENUMERATION,
    CONSTANT,
    INTERFACE,
    PARAMETER,
    OUTPUT,
    VARIABLE,
    ARGUMENT,
    AGENT,
    PROFILE,
    CHOICE,
    BRIDGE,
)
