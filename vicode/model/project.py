"""A project: the designs of a folder and the declarations of project.yaml."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from vicode.model.design import Declaration, Design

WORLD, INTERNAL, MISSING, REMOTE, TOPIC = "world", "internal", "", "remote", "topic"
"""Generated implementations: WORLD delegates to the world, INTERNAL stores shared variables.

The class of a component that is not implemented yet (MISSING) stores outputs and parameters. That of a component which
a profile assigns to another robot (REMOTE) exchanges them with it, and one of a topic (TOPIC) reads or publishes them.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Enumeration:
    """An enumeration type with literals such as `Side.left`. `elements` are pairs of name and doc.

    If `internal`, the XABSL engine numbers the elements instead of the robot program. `xabsl_elements` are pairs of an
    element and its name in XABSL, where they differ.
    """

    name: str
    elements: tuple[tuple[str, str], ...]
    doc: str = ""
    internal: bool = False
    xabsl_name: str = ""
    xabsl_elements: tuple[tuple[str, str], ...] = ()

    @property
    def element_names(self) -> tuple[str, ...]:
        return tuple(name for name, _doc in self.elements)


@dataclass(frozen=True, slots=True, kw_only=True)
class ProfileClass:
    """Another class of a component, as "module:Class"."""

    component: str
    implementation: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RemoteReference:
    """A component of another process or robot, "ROBOT/COMPONENT", in the place of a component.

    Attributes:
        reliable: Whether each message counts, and not only the newest.
        max_age: Seconds after which its outputs are too old; None for the default.
    """

    component: str
    remote: str
    reliable: bool = False
    max_age: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class TopicReference:
    """A topic of ROS 2 in the place of a component: `outputs` are read from it, or `parameters` are published.

    Attributes:
        type: The message type, such as "sensor_msgs/msg/LaserScan".
        outputs: Pairs of output and field, such as ("nearest", "min(ranges)").
        parameters: Pairs of parameter and field.
        frame: The frame_id of published messages.
        max_age: Seconds after which outputs are too old; None for the default.
    """

    component: str
    topic: str
    type: str = ""
    outputs: tuple[tuple[str, str], ...] = ()
    parameters: tuple[tuple[str, str], ...] = ()
    frame: str = ""
    max_age: float | None = None


Elsewhere = RemoteReference | TopicReference
"""What does the work of a component outside the program."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Interface:
    """The interface of a component, declared in project.yaml or derived from a design.

    `implementation` is "module:Class" or, for generated classes, WORLD, INTERNAL, MISSING, or with `remote` REMOTE or
    TOPIC; empty for a design. Other components can read `outputs` and `variables`, and set `variables`. `assume` is a
    condition on them that the analysis takes for granted. A profile that allows it gives `tunable` constants to topics.
    """

    component: str
    title: str = ""
    doc: str = ""
    xabsl_name: str = ""
    implementation: str = ""
    frequency_hz: float | None = None
    parameters: tuple[Declaration, ...] = ()
    outputs: tuple[Declaration, ...] = ()
    variables: tuple[Declaration, ...] = ()
    assume: str = ""
    remote: Elsewhere | None = None
    tunable: tuple[Declaration, ...] = ()

    @property
    def is_generated(self) -> bool:
        return self.implementation in (WORLD, INTERNAL, MISSING) or self.remote is not None

    @property
    def is_topic(self) -> bool:
        return isinstance(self.remote, TopicReference)

    @property
    def readable(self) -> tuple[Declaration, ...]:
        """Outputs and variables."""
        return self.outputs + self.variables

    def output(self, name: str) -> Declaration | None:
        """Return the output or variable with this name, None if there is none."""
        return next((output for output in self.readable if output.name == name), None)

    def variable(self, name: str) -> Declaration | None:
        return next((variable for variable in self.variables if variable.name == name), None)

    def parameter(self, name: str) -> Declaration | None:
        return next((parameter for parameter in self.parameters if parameter.name == name), None)


@dataclass(frozen=True, slots=True, kw_only=True)
class Agent:
    """A named entry point with a root component."""

    name: str
    root: str
    title: str = ""
    doc: str = ""
    xabsl_name: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Profile:
    """Other implementations behind the same interfaces, and another world; `clock` is "world" if it sets the pace.

    With `tune`, programs of ROS 2 may set tunable constants.
    """

    name: str
    world: str = ""
    clock: str = ""
    tune: bool = False
    components: tuple[ProfileClass | Elsewhere, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class BridgeSettings:
    """How `vicode bridge` runs the designs: the world as "module:Class", tick and port; None for the defaults."""

    world: str = ""
    tick_ms: float | None = None
    port: int | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Project:
    """The designs and declarations of a folder.

    With `live`, programs in C++ can be watched. `world` is "module:Class", `clock` is "world" if the world sets the
    pace, `generated` the output folder, relative to the project folder, `xabsl_encoding` that of imported XABSL files
    that are not UTF-8. `unreadable` are pairs of component and file for designs that cannot be read.
    """

    name: str
    doc: str = ""
    languages: tuple[str, ...] = ("python",)
    live: bool = False
    world: str = ""
    clock: str = ""
    generated: str = "generated"
    xabsl_encoding: str = ""
    enumerations: tuple[Enumeration, ...] = ()
    constants: tuple[Declaration, ...] = ()
    components: tuple[Interface, ...] = ()
    agents: tuple[Agent, ...] = ()
    profiles: tuple[Profile, ...] = ()
    bridge: BridgeSettings = field(default_factory=BridgeSettings)
    designs: tuple[Design, ...] = ()
    unreadable: tuple[tuple[str, str], ...] = ()
    _interfaces: dict[str, Interface] = field(default_factory=dict, init=False, repr=False, compare=False)
    _designs: dict[str, Design] = field(default_factory=dict, init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        """Index interfaces and designs. The first of several with the same name is used; P201 reports the others."""
        for interface in (*self.components, *(derive_interface(design) for design in self.designs)):
            self._interfaces.setdefault(interface.component, interface)
        for design in self.designs:
            self._designs.setdefault(design.component, design)

    def design(self, component: str) -> Design | None:
        """Return the design of a component, None if it is hand-written or unknown."""
        return self._designs.get(component)

    def interface(self, component: str) -> Interface | None:
        return self._interfaces.get(component)

    def interfaces(self) -> Mapping[str, Interface]:
        return self._interfaces

    def enumeration(self, name: str) -> Enumeration | None:
        return next((enumeration for enumeration in self.enumerations if enumeration.name == name), None)


def select_profile(project: Project, name: str) -> Project:
    """The project with the implementations and the world of a profile.

    Raises:
        KeyError: There is no such profile.
    """
    profile = next((profile for profile in project.profiles if profile.name == name), None)
    if profile is None:
        raise KeyError(name)
    choices = {choice.component: choice for choice in profile.components}
    remote = {name for name, choice in choices.items() if isinstance(choice, Elsewhere)}
    designs = (derive_interface(design) for design in project.designs if design.component in remote)
    tunable = tuple(each for each in project.constants if each.tunable) if profile.tune else ()
    return replace(
        project,
        world=profile.world or project.world,
        # The clock belongs to its world.
        clock=profile.clock or ("" if profile.world else project.clock),
        components=tuple(
            _choose(each, choices.get(each.component), tunable) for each in (*project.components, *designs)
        ),
        designs=tuple(design for design in project.designs if design.component not in remote),
    )


def _choose(
    interface: Interface, choice: ProfileClass | Elsewhere | None, tunable: tuple[Declaration, ...]
) -> Interface:
    match choice:
        case ProfileClass(implementation=implementation):
            return replace(interface, implementation=implementation)
        case RemoteReference():
            return replace(interface, implementation=REMOTE, remote=choice)
        case TopicReference():
            return replace(interface, implementation=TOPIC, remote=choice, tunable=tunable)
        case None:
            return interface


def derive_interface(design: Design) -> Interface:
    return Interface(
        component=design.component,
        doc=design.doc,
        frequency_hz=design.frequency_hz,
        parameters=design.parameters,
        outputs=design.outputs,
    )
