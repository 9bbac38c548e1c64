"""The data of the C++ templates: formatted lines and blocks of them."""

from dataclasses import dataclass

Lines = tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class FunctionView:
    """A member function: its declaration in the class, and its definition with an indented body."""

    declaration: str
    signature: str
    body: Lines
    doc: Lines = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentView:
    """A generated component; `members` are the sections of data members, each with a title."""

    namespace: str
    name: str
    base: str
    doc: Lines
    header: str
    includes: Lines
    module_code: Lines
    state_type: str
    states: Lines
    parameters: Lines
    declaration: Lines
    constructor: Lines
    initializers: Lines
    members: tuple[tuple[str, Lines], ...]
    initial_state: str
    cooperative_states: Lines
    calls: str
    member_code: Lines
    public_functions: tuple[FunctionView, ...]
    private_functions: tuple[FunctionView, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class CppInterfaceView:
    """A component without a design; `functions` are complete declarations."""

    name: str
    title: str
    doc: Lines
    is_abstract: bool
    uses_world: bool
    frequency: str
    parameters: Lines
    members: Lines
    functions: Lines
    visits: Lines
    parameter_visits: Lines
    input_visits: Lines


@dataclass(frozen=True, slots=True, kw_only=True)
class CppEnumerationView:
    """An enumeration; `cases` convert its elements to their names."""

    name: str
    type: str
    doc: Lines
    elements: Lines
    cases: Lines


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectView:
    """What the project's shared files contain; `components` are pairs of member and class in the order of creation."""

    package: str
    namespace: str
    title: str
    doc: Lines
    has_declarations: bool = False
    enumerations: tuple[CppEnumerationView, ...] = ()
    constants: Lines = ()
    world: Lines = ()
    interfaces: tuple[CppInterfaceView, ...] = ()
    includes: Lines = ()
    components: Lines = ()
    constructor: Lines = ()
    initializers: Lines = ()
    sources: Lines = ()
    library: str = ""
    inputs: Lines = ()
    is_live: bool = False
