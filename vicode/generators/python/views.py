"""The data of the Python templates: formatted strings and lists of them."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class MethodView:
    """A method; both texts are indented, and the signature ends with a colon."""

    signature: str
    body: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentModuleView:
    """A module with one component; `imports` are import sections, `settings` are class attributes.

    `renaming` is a statement after a class that is not named as its component: traces have the name of the design.
    """

    docstring: str
    imports: tuple[tuple[str, ...], ...]
    imports_for_types: tuple[str, ...]
    module_code: str
    class_name: str
    base: str
    class_docstring: str
    settings: tuple[str, ...]
    methods: tuple[MethodView, ...]
    members: str
    renaming: str


@dataclass(frozen=True, slots=True, kw_only=True)
class MainModuleView:
    """The module that runs a package; `components` are names and class paths, and all texts are quoted."""

    docstring: str
    components: tuple[tuple[str, str], ...]
    world: str
    clock: str


@dataclass(frozen=True, slots=True, kw_only=True)
class EnumerationClassView:
    """An enumeration; `members` are lines, `renaming` gives the class the name of the enumeration."""

    name: str
    docstring: str
    members: tuple[str, ...]
    renaming: str


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclarationsModuleView:
    """A module with the project's enumerations and constants."""

    docstring: str
    imports: tuple[str, ...]
    enumerations: tuple[EnumerationClassView, ...]
    constants: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfaceClassView:
    """A component without a design."""

    name: str
    base: str
    docstring: str
    methods: tuple[MethodView, ...]
    renaming: str


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfacesModuleView:
    """The module of the components without a design; `imports` are import sections."""

    docstring: str
    imports: tuple[tuple[str, ...], ...]
    imports_for_types: tuple[str, ...]
    classes: tuple[InterfaceClassView, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class GuardProbeView:
    """One guard; `id` and the names in `reads` are quoted, `conditions` and the values of `reads` are expressions."""

    id: str
    conditions: tuple[str, ...]
    reads: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ProbesModuleView:
    """A module that evaluates the guards of a component; `sources` are quoted state names with their guards."""

    docstring: str
    imports: tuple[str, ...]
    sources: tuple[tuple[str, tuple[GuardProbeView, ...]], ...]
    enumerations: tuple[tuple[str, str], ...]
