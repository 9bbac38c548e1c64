"""The normal form of a unit of a module: texts that a person may write in place of the generated one become equal.

Hand-written actions stand where they run, guards are nested below `if decide:`, branches behind a `return` are not
nested, numbers are compared by value, and comments with times, which the generator derives, are left out.
"""

import ast
import copy
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace

from vicode.model.python_parser import parse_module
from vicode.sync.code_items import CODE, COMMENT, DOCSTRING, GENERATED_DOCSTRINGS, IMPORT, REGION, CodeItem
from vicode.sync.interpret.equivalent_expressions import plain_code
from vicode.sync.interpret.units import METHOD_DEPTH, Items, Units, expand_region

_TIME_COMMENT = re.compile(r"#\s*after \S+ m?s\Z")
_NS_PER_UNIT = {"s": 1e9, "ms": 1e6}
_ACTION_CALL = re.compile(r"self\.(_do_\w+)\(\)\Z")
_NEEDS_PLAIN_FORM = re.compile(
    r"float|round|\.limit\(|\.saturate\(|\bint\(|\bis\b|\bin\b|\d\.\d|\de|[!=]= 0|(self\.[\w.]+) = \1 "
)


@dataclass(frozen=True, slots=True, kw_only=True)
class GeneratedParts:
    """What the text generated from the design contains: bodies of regions by id, and comments with times by scope."""

    bodies: Mapping[str, str] = field(default_factory=dict)
    time_comments: frozenset[tuple[str, str]] = frozenset()


def collect_parts(units: Units) -> GeneratedParts:
    """Collect the parts of a generated module."""
    comments = {(item.scope, comment) for items in units.items.values() for item in items for comment in item.comments}
    return GeneratedParts(
        bodies=units.bodies, time_comments=frozenset(pair for pair in comments if _TIME_COMMENT.match(pair[1]))
    )


def find_inlined(units: Units, others: Units) -> dict[str, CodeItem]:
    """Return the regions of the methods `_do_…` that only one of two modules has, by unit.

    Such a method is compared at the place of its only call. A method that consists of more than a region, or is used
    in another way, stays a unit of its own.
    """
    found = {
        name: items[1]
        for name, items in units.items.items()
        if "._do_" in name and name not in others.items and _is_action_method(name, items)
    }
    if not found:
        return {}
    uses = [word for items in units.items.values() for item in items for word in _action_names(item.code)]
    uses += [word for body in units.bodies.values() for word in _action_names(body)]
    calls = [name for items in units.items.values() for name in called_actions(items)]
    # Its own definition names the method, too.
    return {
        name: region
        for name, region in found.items()
        if calls.count(_short(name)) == 1 and uses.count(_short(name)) == 2
    }


def _is_action_method(name: str, items: Items) -> bool:
    match items:
        case (head, region):
            return region.kind == REGION and head.code == f"def {_short(name)}(self) -> None:" and not head.comments
        case _:
            return False


def _short(unit: str) -> str:
    return unit.rpartition(".")[2]


def called_actions(items: Items) -> tuple[str, ...]:
    """Return the names of the methods `_do_…` that items call in a statement of its own."""
    return tuple(match[1] for item in items if (match := _call_of(item)))


def _action_names(code: str) -> list[str]:
    return re.findall(r"\b_do_\w+", code)


def _call_of(item: CodeItem) -> re.Match[str] | None:
    return _ACTION_CALL.match(item.code) if item.kind == CODE and not item.comments else None


def normalize(
    items: Items,
    inlined: Mapping[str, CodeItem],
    bodies: Mapping[str, str],
    parts: GeneratedParts,
    *,
    is_generated: bool,
) -> Items:
    """Return the items of a unit in the normal form.

    Args:
        items: The items.
        inlined: The regions of methods by name that replace their calls.
        bodies: The bodies of the regions of the module.
        parts: The parts of the text that the person started with.
        is_generated: The module is generated: its regions differ only by code that was added to the design.
    """
    normal = [_with_action(item, inlined) for item in items if item.code != "pass" and not _is_generated_doc(item)]
    normal = [
        part
        for item in normal
        for part in (
            expand_region(item, bodies, parts.bodies) if _may_be_expanded(item, parts, is_generated) else (item,)
        )
    ]
    # Imports of the module are compared as a set.
    normal = [item for item in normal if item.kind != IMPORT or item.depth > 0]
    normal = _nest_decisions(_flatten_branches(normal))
    return tuple(_with_plain_text(_without_time_comments(item, parts)) for item in normal)


def _is_generated_doc(item: CodeItem) -> bool:
    return item.kind == DOCSTRING and item.code in GENERATED_DOCSTRINGS


def _may_be_expanded(item: CodeItem, parts: GeneratedParts, is_generated: bool) -> bool:
    """Whether a region of a method may contain code that was added; a person may have copied one, too."""
    return item.depth >= METHOD_DEPTH and (is_generated or item.code not in parts.bodies)


def _with_action(item: CodeItem, inlined: Mapping[str, CodeItem]) -> CodeItem:
    call = _call_of(item)
    region = inlined.get(call[1]) if call else None
    if region is None:
        return item
    return replace(region, scope=item.scope, depth=item.depth, first=item.first, last=item.last)


def _flatten_branches(items: list[CodeItem]) -> list[CodeItem]:
    """Write an `elif` or `else` behind a branch that ends with `return` as statements of their own."""
    result: list[CodeItem] = []
    # The depths of `else` whose statements stand at the depth of the `if`.
    lifted: list[int] = []
    for item in items:
        while lifted and item.depth <= lifted[-1]:
            lifted.pop()
        depth = item.depth - len(lifted)
        is_branch = item.code.startswith(("elif ", "else:")) and item.kind == CODE
        if not is_branch or not _ends_with_return(result, depth):
            result.append(replace(item, depth=depth))
        elif item.code == "else:":
            lifted.append(item.depth)
        else:
            result.append(replace(item, depth=depth, code=item.code.removeprefix("el")))
    return result


def _ends_with_return(items: list[CodeItem], depth: int) -> bool:
    """Whether the branch above is an `if` of its own and leaves the method."""
    statements = [item for item in reversed(items) if item.kind != COMMENT]
    head = next((item for item in statements if item.depth <= depth), None)
    if head is None or head.depth != depth or not head.code.startswith("if "):
        return False
    return statements[0].depth == depth + 1 and statements[0].code.split(" ")[0] == "return"


def _nest_decisions(items: list[CodeItem]) -> list[CodeItem]:
    """Write `if decide and …:` as a test inside `if decide:`, and join adjacent blocks of it."""
    if any(item.code.startswith("decide") for item in items):
        return items
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


def _is_time_in(comment: str, numbers: Collection[object]) -> bool:
    if not _TIME_COMMENT.match(comment):
        return False
    amount, unit = comment.split()[-2:]
    try:
        return round(float(amount) * _NS_PER_UNIT[unit]) in numbers
    except (ValueError, OverflowError):
        return False


def _with_plain_text(item: CodeItem) -> CodeItem:
    """Compare docstrings by words, and code in the form of equivalent expressions."""
    if item.kind == DOCSTRING:
        return replace(item, code=" ".join(item.code.split()))
    if item.kind != CODE or not _NEEDS_PLAIN_FORM.search(item.code):
        return item
    is_elif = item.code.startswith("elif ")
    code = item.code.removeprefix("el") if is_elif else item.code
    try:
        (statement,) = parse_module(f"{code} pass" if code.endswith(":") else code).body
    except (SyntaxError, ValueError):
        return item
    plain = plain_code(statement).removesuffix("\n    pass")
    return replace(item, code=f"el{plain}" if is_elif else plain)
