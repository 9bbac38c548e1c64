"""Import statements, sorted and wrapped as the usual tools leave them."""

import re
from collections.abc import Iterable
from dataclasses import dataclass

from vicode.generators.python.pretty_printer import LINE_WIDTH


@dataclass(frozen=True, slots=True, kw_only=True)
class Import:
    """`from module import name`, under another name if `alias` is given."""

    module: str
    name: str
    alias: str = ""


def format_imports(imports: Iterable[Import]) -> list[str]:
    """One statement a module, sorted; names under another name have a statement each."""
    wanted = set(imports)
    lines: list[str] = []
    for module in sorted({each.module for each in wanted}, key=_natural):
        plain = sorted({each.name for each in wanted if each.module == module and not each.alias}, key=_member_order)
        renamed = {(each.name, each.alias) for each in wanted if each.module == module and each.alias}
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
    """Constants first, then classes, then the rest, told apart by their letters."""
    is_constant = len(name) > 1 and name.isupper()
    kind = 0 if is_constant else 1 if name[0].isupper() else 2
    return (kind, _natural(name), name)


def _natural(text: str) -> list[tuple[int, int, str]]:
    """Numbers count as numbers, case does not."""
    parts = re.findall(r"\d+|\D", text.lower())
    return [(0, int(part), "") if part.isdigit() else (1, 0, part) for part in parts]
