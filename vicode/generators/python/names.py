"""Names at the top of a generated module, and which of them hand-written code uses."""

import ast
import keyword
import re
import textwrap
from collections.abc import Iterable

from vicode.generators.plan import INTERFACES_MODULE, ProjectPlan
from vicode.model.python_parser import parse_module

RESERVED_MODULES = frozenset(
    {*keyword.kwlist, *keyword.softkwlist, "__init__", "bica", "declarations", INTERFACES_MODULE}
)
"""What no module of a package may be called."""

# What generated code itself says at the top, in a class body or in a function.
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
    """Names of enumerations, constants and classes in modules; one that is ours gets a `_`.

    Classes are found under `class_key`, since a component and a constant may share a name: then the constant yields.
    """
    # Of all designs, so that a part of a project finds the names that the whole has.
    used = [use.component for design in plan.project.designs for use in design.uses]
    written = [*plan.package.modules, *sorted(plan.package.interfaces), *used]
    classes = {class_key(component): component_class_name(component) for component in written}
    names = {"arithmetic": "arithmetic", **classes}
    taken = _RESERVED_NAMES | set(classes.values())
    for declared in (*(each.name for each in plan.enumerations), *(each.name for each in plan.constants)):
        names[declared] = _unique_name(declared, taken)
    return names


def class_key(component: str) -> str:
    """How `assign_global_names` calls the class of a component."""
    return f"class {component}"


def component_class_name(component: str) -> str:
    """The name of a component's class."""
    return _unique_name(component, _RESERVED_NAMES)


def names_in_code(texts: Iterable[str]) -> frozenset[str]:
    """Names that Python code reads; of code that does not parse, every word."""
    return frozenset(word for text in texts for word in _names_in(text))


def has_statement(text: str) -> bool:
    """Whether there is more than blanks and comments in a piece of code."""
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
