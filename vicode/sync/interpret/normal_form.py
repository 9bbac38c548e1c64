"""The normal form of a generated module: texts that a person may write in place of the generated one become equal.

Hand-written actions stand where they run, guards are nested below `if decide:`, numbers are compared by value, and
what the generator derives (imports, comments with times) is left out.
"""

import ast
import copy
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace

from vicode.model.python_parser import parse_module
from vicode.regions import find_regions
from vicode.sync.code_items import (
    CODE,
    COMMENT,
    DOCSTRING,
    HEADER,
    IMPORT,
    REGION,
    CodeItem,
    imported_names,
    split_items,
)

_TIME_COMMENT = re.compile(r"#\s*after \S+ m?s\Z")
_NS_PER_UNIT = {"s": 1e9, "ms": 1e6}
_ACTION_CALL = re.compile(r"self\.(_do_\w+)\(\)\Z")


@dataclass(frozen=True, slots=True, kw_only=True)
class GeneratedParts:
    """What the text generated from the design contains: bodies of regions by id, scopes, and comments with times."""

    bodies: Mapping[str, str] = field(default_factory=dict)
    scopes: frozenset[str] = frozenset()
    time_comments: frozenset[tuple[str, str]] = frozenset()


@dataclass(frozen=True, slots=True, kw_only=True)
class NormalForm:
    """A module: its raw items, its normal items, the names it imports, and the bodies of its regions."""

    raw: tuple[CodeItem, ...]
    items: tuple[CodeItem, ...]
    keys: tuple[object, ...]
    imports: frozenset[tuple[str, str, str]]
    bodies: Mapping[str, str]


def collect_parts(text: str) -> GeneratedParts:
    """Collect the parts of a generated text."""
    items = split_items(text)
    comments = {(item.scope, comment) for item in items for comment in item.comments}
    return GeneratedParts(
        bodies={region.id: region.body for region in find_regions(text).regions},
        scopes=frozenset(item.scope for item in items),
        time_comments=frozenset(pair for pair in comments if _TIME_COMMENT.match(pair[1])),
    )


def build_normal_form(text: str, parts: GeneratedParts, *, is_generated: bool) -> NormalForm:
    """Build the normal form.

    Args:
        text: The module.
        parts: The parts of the text that the person started with.
        is_generated: The text is generated, so that bodies of regions differ only by code that was added to the design.

    Raises:
        SyntaxError: The text is not Python.
    """
    raw = split_items(text)
    bodies = {region.id: region.body for region in find_regions(text).regions}
    items = _inline_actions(list(raw))
    items = [
        part
        for item in items
        for part in (_expand_region(item, bodies, parts) if is_generated or item.code not in parts.bodies else (item,))
    ]
    imports = frozenset(imported_names(item for item in items if item.depth == 0))
    items = [item for item in items if item.kind != HEADER and not (item.kind == IMPORT and item.depth == 0)]
    items = _move_new_methods(items, parts)
    items = _nest_decisions(items)
    items = [_without_time_comments(part, parts) for item in items for part in _split_states(item)]
    items = [_with_plain_text(item) for item in items]
    keys = tuple(item.key for item in items)
    return NormalForm(raw=raw, items=tuple(items), keys=keys, imports=imports, bodies=bodies)


def _inline_actions(items: list[CodeItem]) -> list[CodeItem]:
    """Put the regions of the methods `_do_…` in place of their only call."""
    by_scope: dict[str, list[CodeItem]] = {}
    for item in items:
        by_scope.setdefault(item.scope, []).append(item)
    calls = Counter(match[1] for item in items if item.kind == CODE and (match := _ACTION_CALL.match(item.code)))
    inlined = {
        scope.rpartition(".")[2]: content[1]
        for scope, content in by_scope.items()
        if len(content) == 2 and content[1].kind == REGION and calls[scope.rpartition(".")[2]] == 1
    }
    result = []
    for item in items:
        name = item.scope.rpartition(".")[2]
        if name in inlined and (item.kind == REGION or isinstance(item.node, ast.FunctionDef)):
            continue
        match = _ACTION_CALL.match(item.code) if item.kind == CODE else None
        region = inlined.get(match[1]) if match else None
        result.append(item if region is None else replace(region, scope=item.scope, depth=item.depth))
    return result


def _expand_region(item: CodeItem, bodies: Mapping[str, str], parts: GeneratedParts) -> Iterator[CodeItem]:
    """Replace a region that was added by its statements, and put those around a region that were added to it."""
    if item.kind != REGION or parts.bodies.get(item.code) == bodies[item.code]:
        yield item
        return
    try:
        inside = [_moved_into(part, item) for part in split_items(bodies[item.code])]
    except SyntaxError:
        yield item
        return
    if item.code not in parts.bodies:
        yield from inside
        return
    old = [_moved_into(part, item).key for part in split_items(parts.bodies[item.code])]
    for start in range(len(inside) - len(old) + 1):
        if [part.key for part in inside[start : start + len(old)]] == old:
            yield from (*inside[:start], item, *inside[start + len(old) :])
            return
    yield from inside


def _moved_into(item: CodeItem, region: CodeItem) -> CodeItem:
    scope = ".".join(part for part in (region.scope, item.scope) if part)
    return replace(item, scope=scope, depth=item.depth + region.depth, first=region.first, last=region.last)


def _move_new_methods(items: list[CodeItem], parts: GeneratedParts) -> list[CodeItem]:
    """Put the methods that are not generated behind the others, sorted by name; their order has no effect."""
    moved: dict[str, list[CodeItem]] = {}
    kept: list[CodeItem] = []
    for item in items:
        owner = ".".join(item.scope.split(".")[:2])
        is_new = "." in owner and owner not in parts.scopes and owner.partition(".")[0] in parts.scopes
        if is_new and owner not in moved and kept and kept[-1].kind == COMMENT and kept[-1].last == item.first - 1:
            moved[owner] = [kept.pop()]
        (moved.setdefault(owner, []) if is_new else kept).append(item)
    return [*kept, *(item for owner in sorted(moved) for item in moved[owner])]


def _nest_decisions(items: list[CodeItem]) -> list[CodeItem]:
    """Write `if decide and …:` as a test inside `if decide:`, and join adjacent blocks of it."""
    result: list[CodeItem] = []
    index = 0
    while index < len(items):
        item = items[index]
        block_end = _block_end(items, index)
        rest = _decide_test(item)
        has_else = block_end < len(items) and items[block_end].code.startswith(("elif ", "else:"))
        if rest is None or has_else:
            result.append(item)
            index += 1
            continue
        comments: list[CodeItem] = []
        while result and result[-1].kind == COMMENT and result[-1].depth == item.depth:
            comments.insert(0, result.pop())
        outer = replace(item, code="if decide:", comments=(), node=None)
        if not _continues_block(result, outer):
            result.append(outer)
        inner = [*comments, *([] if rest is item else [rest]), *items[index + 1 : block_end]]
        shift = 0 if rest is item else 1
        result += [replace(each, depth=each.depth + 1) for each in inner[: len(comments) + shift]]
        result += [replace(each, depth=each.depth + shift) for each in inner[len(comments) + shift :]]
        index = block_end
    return result


def _block_end(items: list[CodeItem], start: int) -> int:
    """Return the index after the last item that is nested in an item."""
    head = items[start]
    end = start + 1
    while end < len(items) and items[end].scope == head.scope and items[end].depth > head.depth:
        end += 1
    return end


def _decide_test(item: CodeItem) -> CodeItem | None:
    """Return the test inside of `if decide:`, the item itself if there is none, and None for any other item."""
    match item.node:
        case ast.If(test=ast.Name(id="decide")) if item.code == "if decide:":
            return item
        case ast.If(test=ast.BoolOp(op=ast.And(), values=[ast.Name(id="decide"), *rest])) as node if (
            item.code.startswith("if ")
        ):
            inner = copy.copy(node)
            inner.test = rest[0] if len(rest) == 1 else ast.BoolOp(op=ast.And(), values=rest)
            return replace(item, code=f"if {ast.unparse(inner.test)}:", node=inner)
        case _:
            return None


def _continues_block(result: list[CodeItem], outer: CodeItem) -> bool:
    """Whether the items end with a block of the same test at the same depth."""
    for item in reversed(result):
        if item.scope != outer.scope or item.depth < outer.depth:
            return False
        if item.depth == outer.depth:
            return item.code == outer.code
    return False


def _split_states(item: CodeItem) -> Iterator[CodeItem]:
    """Write the call that lists the states as one item per state."""
    match item.node:
        case ast.Expr(value=ast.Call(func=ast.Attribute(attr="_set_states"), args=states, keywords=[])) if states:
            yield replace(item, code="self._set_states:", node=None)
            for state in states:
                node = ast.Expr(value=state)
                yield replace(item, code=ast.unparse(state), depth=item.depth + 1, comments=(), node=node)
        case _:
            yield item


def _without_time_comments(item: CodeItem, parts: GeneratedParts) -> CodeItem:
    """Leave out comments such as `# after 0.5 s` that are generated, or agree with the test."""
    if not item.comments or not isinstance(item.node, ast.If):
        return item
    numbers = {node.value for node in ast.walk(item.node.test) if isinstance(node, ast.Constant)}
    kept = (
        comment
        for comment in item.comments
        if (item.scope, comment) not in parts.time_comments and not _is_time_in(comment, numbers)
    )
    return replace(item, comments=tuple(kept))


def _is_time_in(comment: str, numbers: Iterable[object]) -> bool:
    if not _TIME_COMMENT.match(comment):
        return False
    amount, unit = comment.split()[-2:]
    try:
        return round(float(amount) * _NS_PER_UNIT[unit]) in numbers
    except (ValueError, OverflowError):
        return False


def _with_plain_text(item: CodeItem) -> CodeItem:
    """Compare numbers by value and docstrings by words, without conversions to float, which the generator adds."""
    if item.kind == DOCSTRING:
        return replace(item, code=" ".join(item.code.split()))
    if item.kind != CODE or not re.search(r"float|\d\.\d|\de", item.code):
        return item
    is_elif = item.code.startswith("elif ")
    code = item.code.removeprefix("el") if is_elif else item.code
    try:
        (statement,) = parse_module(f"{code} pass" if code.endswith(":") else code).body
    except (SyntaxError, ValueError):
        return item
    plain = ast.unparse(_PlainNumbers().visit(statement)).removesuffix("\n    pass")
    return replace(item, code=f"el{plain}" if is_elif else plain)


class _PlainNumbers(ast.NodeTransformer):
    def visit_Constant(self, node: ast.Constant) -> ast.Constant:
        is_whole = isinstance(node.value, float) and node.value.is_integer()
        return ast.Constant(value=int(node.value)) if is_whole and isinstance(node.value, float) else node

    def visit_Call(self, node: ast.Call) -> ast.AST:
        self.generic_visit(node)
        match node:
            case ast.Call(func=ast.Name(id="float"), args=[only], keywords=[]):
                return only
            case _:
                return node
