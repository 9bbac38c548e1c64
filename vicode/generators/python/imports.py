"""Import statements, sorted and wrapped as ruff and isort do."""

import re
from collections.abc import Iterable
from dataclasses import dataclass

from vicode.generators.python.pretty_printer import LINE_WIDTH

RUNTIME = "vicode.bica"
"""The package that generated code imports."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Import:
    """`from module import name`, with `as alias` if an alias is given."""

    module: str
    name: str
    alias: str = ""


def format_imports(imports: Iterable[Import]) -> list[str]:
    """Return one sorted statement per module; each renamed import has a separate statement."""
    unique = set(imports)
    lines: list[str] = []
    for module in sorted({item.module for item in unique}, key=_natural):
        plain = sorted({item.name for item in unique if item.module == module and not item.alias}, key=_member_order)
        renamed = {(item.name, item.alias) for item in unique if item.module == module and item.alias}
        statements = [(_member_order(plain[0]), _statement(module, plain))] if plain else []
        statements += [(_member_order(name), [f"from {module} import {name} as {alias}"]) for name, alias in renamed]
        lines += [line for _order, statement in sorted(statements) for line in statement]
    return lines


def _statement(module: str, names: list[str]) -> list[str]:
    line = f"from {module} import {', '.join(names)}"
    if len(line) <= LINE_WIDTH:
        return [line]
    return [f"from {module} import (", *(f"    {name}," for name in names), ")"]


def _member_order(name: str) -> tuple[int, list[tuple[int, int, str]], str]:
    """Sort constants first, then classes, then other names; the case of the letters identifies them."""
    is_constant = len(name) > 1 and name.isupper()
    kind = 0 if is_constant else 1 if name[0].isupper() else 2
    return (kind, _natural(name), name)


def _natural(text: str) -> list[tuple[int, int, str]]:
    """Natural order: digits compare as numbers and case is ignored."""
    parts = re.findall(r"\d+|\D", text.lower())
    return [(0, int(part), "") if part.isdigit() else (1, 0, part) for part in parts]
