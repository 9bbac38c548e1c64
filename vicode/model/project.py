"""A project: the designs of a folder and all that is declared for them in project.yaml."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from vicode.model.design import Declaration, Design

LANGUAGES = ("python", "xabsl")
"""The languages that vicode generates."""
CODE_LANGUAGES = ("python", "cpp", "xabsl")
"""The languages that code in a design may be written in."""
WORLD, INTERNAL = "world", "internal"
"""Implementations that vicode writes: one hands everything on to the world, one keeps variables for all."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Enumeration:
    """A named type; its literals are written `Side.left`. `elements` are pairs of name and doc.

    `internal` says that XABSL's engine numbers them, and not the robot's program. `xabsl_elements` are pairs of an
    element and its name in XABSL, where that is another.
    """

    name: str
    elements: tuple[tuple[str, str], ...]
    doc: str = ""
    internal: bool = False
    xabsl_name: str = ""
    xabsl_elements: tuple[tuple[str, str], ...] = ()

    @property
    def element_names(self) -> tuple[str, ...]:
        """Names of the elements in order."""
        return tuple(name for name, _doc in self.elements)


@dataclass(frozen=True, slots=True, kw_only=True)
class Interface:
    """What others see of a component: hand-written ones are declared so, a design has one by itself.

    `implementation` is "module:Class", or WORLD or INTERNAL for one that vicode writes; empty for one that comes from
    a design. Others may read `outputs` and `variables`, and set the latter.
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

    @property
    def is_generated(self) -> bool:
        """Whether its class is written by vicode, for the world or to keep variables."""
        return self.implementation in (WORLD, INTERNAL)

    @property
    def readable(self) -> tuple[Declaration, ...]:
        """What others may read."""
        return self.outputs + self.variables

    def output(self, name: str) -> Declaration | None:
        """The output or variable of this name, which may be read."""
        return next((output for output in self.readable if output.name == name), None)

    def variable(self, name: str) -> Declaration | None:
        """The variable of this name, which may be set."""
        return next((variable for variable in self.variables if variable.name == name), None)

    def parameter(self, name: str) -> Declaration | None:
        """The parameter of this name."""
        return next((parameter for parameter in self.parameters if parameter.name == name), None)


@dataclass(frozen=True, slots=True, kw_only=True)
class Agent:
    """A name for running the project from one root component."""

    name: str
    root: str
    title: str = ""
    doc: str = ""
    xabsl_name: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Project:
    """All that one folder of designs declares.

    `world` is "module:Class", `generated` the output folder, relative to the project's folder. `unreadable` are components
    whose designs are there and cannot be read, each with its file.
    """

    name: str
    doc: str = ""
    languages: tuple[str, ...] = ("python",)
    world: str = ""
    generated: str = "generated"
    enumerations: tuple[Enumeration, ...] = ()
    constants: tuple[Declaration, ...] = ()
    components: tuple[Interface, ...] = ()
    agents: tuple[Agent, ...] = ()
    designs: tuple[Design, ...] = ()
    unreadable: tuple[tuple[str, str], ...] = ()
    _interfaces: dict[str, "Interface"] = field(default_factory=dict, init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        """Index the interfaces once; the first of two with one name wins, and a check reports the second."""
        for interface in (*self.components, *(derive_interface(design) for design in self.designs)):
            self._interfaces.setdefault(interface.component, interface)

    def design(self, component: str) -> Design | None:
        """The design of a component, None when it is hand-written or unknown."""
        return next((design for design in self.designs if design.component == component), None)

    def interface(self, component: str) -> Interface | None:
        """What a component shows to others, None when nothing declares it."""
        return self._interfaces.get(component)

    def interfaces(self) -> Mapping[str, Interface]:
        """Every known component by name."""
        return self._interfaces

    def enumeration(self, name: str) -> Enumeration | None:
        """The enumeration of this name."""
        return next((enumeration for enumeration in self.enumerations if enumeration.name == name), None)


def derive_interface(design: Design) -> Interface:
    """What a design shows to the components that use it."""
    return Interface(
        component=design.component,
        doc=design.doc,
        frequency_hz=design.frequency_hz,
        parameters=design.parameters,
        outputs=design.outputs,
    )
