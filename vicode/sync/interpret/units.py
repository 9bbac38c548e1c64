"""Splits a module into units, which are compared by name: methods, entries of the list of states, class attributes.

The order of methods has no effect, so it does not count.
"""

import ast
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from vicode.regions import find_regions
from vicode.sync.code_items import (
    CODE,
    COMMENT,
    DOCSTRING,
    HEADER,
    IMPORT,
    REGION,
    CodeItem,
    ModulePart,
    imported_names,
    split_items,
    split_parts,
)

Items = tuple[CodeItem, ...]
Imports = frozenset[tuple[str, str, str]]
_CLASS_HEADER = "{}:"
_COMMON = {"_decide_common": (["return False"],), "_act_common": ([], ["pass"])}
"""Methods that every state calls, and what they contain without an effect."""
METHOD_DEPTH = 2
"""The depth of statements in methods."""
_STATES = "__init__:"
_CLASS_REGION = "\n    # <vicode "


@dataclass(frozen=True, slots=True, kw_only=True)
class Units:
    """The items of a module by unit, in the order of the file; its imports, and the bodies of its regions."""

    items: Mapping[str, Items]
    imports: Imports
    bodies: Mapping[str, str]

    def states(self) -> Items:
        """Return the entries of the list of states."""
        return tuple(item for name, items in self.items.items() if f".{_STATES}'" in name for item in items)


@dataclass(frozen=True, slots=True)
class UnitReader:
    """Splits versions of one generated module; `bodies` are those of the regions that the person started with.

    A part of a module that is equal in two versions is read once, so that both have identical items of it.
    """

    bodies: Mapping[str, str] = field(default_factory=dict)
    _known: dict[tuple[str, str], tuple[Mapping[str, Items], Imports]] = field(default_factory=dict)

    def split_generated(self, text: str) -> Units:
        """Split a generated module; code that was added to the module or the class is not a part of its region.

        Raises:
            SyntaxError: The text is not Python.
        """
        bodies = list_bodies(text)
        items: dict[str, Items] = {}
        imports: Imports = frozenset()
        for part in split_parts(text):
            key = (part.owner, part.text)
            if key not in self._known:
                self._known[key] = self._read(part, bodies)
            found, found_imports = self._known[key]
            for name, own in found.items():
                items[name] = (*items[name], *own) if name in items else own
            imports |= found_imports
        return Units(items=items, imports=imports, bodies=bodies)

    def _read(self, part: ModulePart, bodies: Mapping[str, str]) -> tuple[Mapping[str, Items], Imports]:
        items = [
            each
            for item in part.split()
            for each in (expand_region(item, bodies, self.bodies) if item.depth < METHOD_DEPTH else (item,))
        ]
        return _by_unit(items, part.owner), _imports(items)

    def split_edited(self, text: str) -> Units:
        """Split the file of a person.

        Raises:
            SyntaxError: The text outside regions is not Python.
        """
        try:
            units, imports = self._read_edited(split_parts(text))
        except SyntaxError:
            # A part may end inside a string.
            whole = split_items(text)
            units, imports = {name: list(items) for name, items in _by_unit(whole).items()}, _imports(whole)
        items = {name: tuple(own) for name, own in units.items()}
        return Units(items=_without_common(items), imports=imports, bodies=list_bodies(text))

    def _read_edited(self, parts: Iterable[ModulePart]) -> tuple[dict[str, list[CodeItem]], Imports]:
        units: dict[str, list[CodeItem]] = {}
        imports: Imports = frozenset()
        for part in parts:
            known = self._known.get((part.owner, part.text)) if part.owner and _CLASS_REGION not in part.text else None
            if known is None:
                items = part.split_in_place()
                known = _by_unit(items, part.owner), _imports(items)
            for name, own in known[0].items():
                units.setdefault(name, []).extend(own)
            imports |= known[1]
        return units, imports


def _imports(items: Iterable[CodeItem]) -> Imports:
    return frozenset(imported_names(item for item in items if item.depth == 0))


def list_bodies(text: str) -> dict[str, str]:
    """Return the bodies of the regions of a text by id."""
    return {region.id: region.body for region in find_regions(text).regions}


def _by_unit(items: Sequence[CodeItem], owner: str = "") -> dict[str, Items]:
    units: dict[str, list[CodeItem]] = {}
    for item, unit in name_units(items, owner):
        if item.kind == HEADER or (item.kind == IMPORT and item.depth == 0):
            continue
        for name, part in _split_states(item, unit):
            units.setdefault(name, []).append(part)
    return {name: tuple(own) for name, own in units.items()}


def _without_common(units: dict[str, Items]) -> dict[str, Items]:
    """Remove methods for common transitions and actions that a person made empty, and their calls."""
    for call, ends in _COMMON.items():
        empty = [
            name
            for name, items in units.items()
            if name.endswith(f".{call}") and [item.code for item in items if item.kind == CODE][1:] in ends
        ]
        for name in empty:
            del units[name]
            units = {other: tuple(_without_call(items, call)) for other, items in units.items()}
    return units


def _without_call(items: Items, name: str) -> Iterator[CodeItem]:
    codes = [item.code for item in items]
    for index, item in enumerate(items):
        is_test = item.code == f"if decide and self.{name}():" and codes[index + 1 : index + 2] == ["return"]
        is_behind = index > 0 and item.code == "return" and codes[index - 1] == f"if decide and self.{name}():"
        if not (is_test or is_behind or item.code == f"self.{name}()") or item.comments:
            yield item


def name_units(items: Sequence[CodeItem], owner: str = "") -> Iterator[tuple[CodeItem, str]]:
    """Yield the items of a module, or of a part of the class `owner`, with their units.

    Entries of the list of states belong to their method.
    """
    classes = {item.scope for item in items if isinstance(item.node, ast.ClassDef) and "." not in item.scope} | {owner}
    unit = ""
    for index, item in enumerate(items):
        is_heading = item.kind == COMMENT and index + 1 < len(items) and _is_heading(item, items[index + 1])
        unit = _unit_of(items[index + 1] if is_heading else item, unit, classes)
        yield item, unit


def _is_heading(comment: CodeItem, following: CodeItem) -> bool:
    """Whether a comment belongs to the definition below it."""
    is_definition = isinstance(following.node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef)
    return is_definition and comment.last == following.first - 1 and comment.depth == following.depth


def _unit_of(item: CodeItem, before: str, classes: Collection[str]) -> str:
    """Return the unit of an item: "Player.run" for a method, "Player:period" in the class, ":LIMIT" in the module."""
    top, _dot, rest = item.scope.partition(".")
    if isinstance(item.node, ast.ClassDef) and not rest:
        return _CLASS_HEADER.format(top)
    if top and (rest or top not in classes):
        return f"{top}.{rest.partition('.')[0]}" if top in classes else top
    if item.depth > (1 if top else 0):
        return before
    match item.node:
        case ast.Assign(targets=[ast.Name(id=name)]) | ast.AnnAssign(target=ast.Name(id=name)):
            return f"{top}:{name}"
    return f"{top}:{'doc' if item.kind == DOCSTRING else item.code}"


def _split_states(item: CodeItem, unit: str) -> Iterator[tuple[str, CodeItem]]:
    """Yield the call that lists the states as one unit per state, and as one with the names in their order."""
    match item.node:
        case ast.Expr(value=ast.Call(func=ast.Attribute(attr="_set_states"), args=states, keywords=[])) if (
            states and unit.endswith(".__init__")
        ):
            calls = [state.args if isinstance(state, ast.Call) else [] for state in states]
            names = [ast.unparse(arguments[0]) if arguments else "" for arguments in calls]
            yield f"{unit}:states", replace(item, code="self._set_states:", node=None)
            for name in names:
                yield f"{unit}:states", replace(item, code=name, depth=item.depth + 1, comments=(), node=None)
            for name, state in zip(names, states, strict=True):
                node = ast.Expr(value=state)
                code = ast.unparse(state)
                yield f"{unit}:{name}", replace(item, code=code, depth=item.depth + 1, comments=(), node=node)
        case _:
            yield unit, item


def expand_region(item: CodeItem, bodies: Mapping[str, str], old_bodies: Mapping[str, str]) -> Iterator[CodeItem]:
    """Replace a region that was added by its statements, and put those around a region that were added to it."""
    if item.kind != REGION or old_bodies.get(item.code) == bodies[item.code]:
        yield item
        return
    try:
        inside = [_moved_into(part, item) for part in split_items(bodies[item.code])]
    except SyntaxError:
        yield item
        return
    if item.code not in old_bodies:
        yield from inside
        return
    old = [_moved_into(part, item).key for part in split_items(old_bodies[item.code])]
    for start in range(len(inside) - len(old) + 1):
        if [part.key for part in inside[start : start + len(old)]] == old:
            yield from (*inside[:start], item, *inside[start + len(old) :])
            return
    yield from inside


def _moved_into(item: CodeItem, region: CodeItem) -> CodeItem:
    scope = ".".join(part for part in (region.scope, item.scope) if part)
    return replace(item, scope=scope, depth=item.depth + region.depth, first=region.first, last=region.last)
