"""Global names of generated modules and the names used in code."""

import ast
import keyword
import re
import textwrap
from collections.abc import Iterable

from vicode.generators.plan import INTERFACES_MODULE, ProjectPlan
from vicode.model.python_parser import parse_module

RESERVED_MODULES = frozenset(
    {*keyword.kwlist, *keyword.softkwlist, "__init__", "__main__", "bica", "declarations", INTERFACES_MODULE}
)
"""Module names that no design may use."""

# Names that generated code uses.
_RESERVED_NAMES = frozenset(
    [
        "Component",
        "Enum",
        "Final",
        "Root",
        "State",
        "XabslComponent",
        "TYPE_CHECKING",
        "abs",
        "annotations",
        "arithmetic",
        "bool",
        "decide",
        "design_file",
        "float",
        "frequency_hz",
        "int",
        "max",
        "min",
        "resume",
        "root",
        "round",
        "self",
        "super",
    ]
)
_WORD = re.compile(r"[A-Za-z_]\w*", re.ASCII)


def assign_global_names(plan: ProjectPlan) -> dict[str, str]:
    """Assign names to enumerations, constants and classes; a name that collides gets a trailing `_`.

    The keys of classes are those of `class_key`. If a component and a constant share a name, the constant is renamed.
    """
    # All designs count, so that generating a part of a project gives the same names.
    used = [use.component for design in plan.project.designs for use in design.uses]
    components = [*plan.package.modules, *sorted(plan.package.interfaces), *used]
    classes = {class_key(component): component_class_name(component) for component in components}
    names = {"arithmetic": "arithmetic", **classes}
    taken = _RESERVED_NAMES | set(classes.values())
    for declared in [*(item.name for item in plan.enumerations), *(item.name for item in plan.constants)]:
        names[declared] = _unique_name(declared, taken)
    return names


def class_key(component: str) -> str:
    """Return the key of a component's class in the result of `assign_global_names`."""
    return f"class {component}"


def component_class_name(component: str) -> str:
    return _unique_name(component, _RESERVED_NAMES)


def class_renaming(component: str) -> str:
    """Return the statement that gives a class the name of its component, "" if it has it."""
    name = component_class_name(component)
    return "" if name == component else f'{name}.__name__ = "{component}"'


def names_in_code(texts: Iterable[str]) -> frozenset[str]:
    """Return the names in pieces of Python code; every word of a piece that does not parse."""
    return frozenset(word for text in texts for word in _names_in(text))


def has_statement(text: str) -> bool:
    """Whether code contains more than whitespace and comments."""
    tree = _parse(text)
    return bool(text.strip()) if tree is None else bool(tree.body)


def _unique_name(name: str, taken: frozenset[str]) -> str:
    while name in taken:
        name += "_"
    return name


def _names_in(text: str) -> set[str]:
    tree = _parse(text)
    if tree is None:
        return set(_WORD.findall(text))
    return {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}


def _parse(text: str) -> ast.Module | None:
    try:
        return parse_module(textwrap.dedent(text.replace("\r\n", "\n").strip("\n")))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
