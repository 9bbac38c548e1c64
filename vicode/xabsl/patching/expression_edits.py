"""Edits expressions: only the parts that differ are replaced.

The original, the old and the new expression are walked as long as their operators agree; parentheses are looked
through. Operands of `&&` and `||` are lists, so that one of them can be added or removed. An old expression that became
a part of the new one stays, and text is written around it. Anything else is replaced, with its comments behind it.
"""

from collections.abc import Sequence
from dataclasses import fields, replace
from typing import Any

from vicode.matching import Match, find_unmoved
from vicode.xabsl import tree
from vicode.xabsl.patching.list_edits import match_items, text_similarity
from vicode.xabsl.patching.source_edits import SourceEdits
from vicode.xabsl.printer import print_node

Expression = tree.ExpressionNode
_COMPARISONS = frozenset(("<", "<=", ">", ">=", "==", "!="))


def edit_expression(file: SourceEdits, old: Expression, before: Expression, after: Expression) -> None:
    """Change an expression.

    Args:
        file: The file of the expression.
        old: The original expression.
        before: The same expression in the form of `after`.
        after: The new expression.
    """
    if before == after:
        return
    if _edit_parts(file, _inner(old), _inner(before), _inner(after)):
        return
    around = _text_around(before, after, keeps_parentheses=not isinstance(old, tree.ParenthesizedNode))
    if around is None:
        file.replace_node(old, with_comments(file, old, print_node(after)))
    else:
        file.insert(file.start(old.first_token), around[0])
        file.insert(file.end(old.last_token), around[1])


_HOLE = "HOLE"


def _text_around(before: Expression, after: Expression, *, keeps_parentheses: bool) -> tuple[str, str] | None:
    """The texts before and after an expression that became a part of another one."""
    inner = _inner(before)

    def with_hole(node: tree.SyntaxNode) -> tree.SyntaxNode:
        if keeps_parentheses and node == inner:
            return tree.ReferenceNode(_HOLE)
        if not keeps_parentheses and isinstance(node, tree.ParenthesizedNode) and _inner(node) == inner:
            return tree.ReferenceNode(_HOLE)
        changes: dict[str, Any] = {}
        for each in fields(node):
            value = getattr(node, each.name)
            if isinstance(value, tree.SyntaxNode):
                changes[each.name] = with_hole(value)
            elif isinstance(value, list):
                changes[each.name] = [with_hole(item) for item in value]
        return replace(node, **changes) if changes else node

    first, hole, last = print_node(with_hole(after)).partition(_HOLE)
    return (first, last) if hole and _HOLE not in last and (first or last) else None


def with_comments(file: SourceEdits, old: tree.SyntaxNode, text: str) -> str:
    """Append the comments of a replaced expression to its new text."""
    found = file.comments_between(file.start(old.first_token), file.end(old.last_token))
    blocks = (f"/* {each[2:].strip()} */" if each.startswith("//") else each for each in found)
    return " ".join([text, *blocks])


def _inner(node: Expression) -> Expression:
    while isinstance(node, tree.ParenthesizedNode):
        node = node.inner
    return node


def _edit_parts(file: SourceEdits, old: Expression, before: Expression, after: Expression) -> bool:
    """Edit the operands of an expression; return whether that was possible."""
    match old, before, after:
        case tree.BinaryNode(), tree.BinaryNode(), tree.BinaryNode():
            if old.operator != before.operator:
                return False
            if old.operator == after.operator and old.operator in ("&&", "||"):
                return _edit_operands(file, old, before, after)
            return _edit_binary(file, old, before, after)
        case tree.UnaryNode(operator=a), tree.UnaryNode(operator=b), tree.UnaryNode(operator=c) if a == b == c:
            return _edit_pairs(file, [old.operand], [before.operand], [after.operand])
        case tree.ConditionalNode(), tree.ConditionalNode(), tree.ConditionalNode():
            return _edit_pairs(
                file,
                [old.condition, old.yes, old.no],
                [before.condition, before.yes, before.no],
                [after.condition, after.yes, after.no],
            )
        case tree.FunctionCallNode(), tree.FunctionCallNode(), tree.FunctionCallNode():
            if before.name.text != after.name.text:
                return False
            return edit_arguments(file, old.arguments, before.arguments, after.arguments)
        case _:
            return False


def _edit_pairs(
    file: SourceEdits, old: Sequence[Expression], before: Sequence[Expression], after: Sequence[Expression]
) -> bool:
    for parts in zip(old, before, after, strict=True):
        edit_expression(file, *parts)
    return True


def _edit_binary(file: SourceEdits, old: tree.BinaryNode, before: tree.BinaryNode, after: tree.BinaryNode) -> bool:
    if before.operator == after.operator:
        return _edit_pairs(file, [old.left, old.right], [before.left, before.right], [after.left, after.right])
    are_comparisons = {before.operator, after.operator} <= _COMPARISONS
    if not are_comparisons or before.left != after.left or before.right != after.right:
        return False
    file.replace(file.start(old.operator_token), file.end(old.operator_token), after.operator)
    return True


def _operands(node: Expression, operator: str) -> list[Expression]:
    """The operands of a chain of one operator, which is left-associative."""
    if isinstance(node, tree.BinaryNode) and node.operator == operator:
        return [*_operands(node.left, operator), node.right]
    return [node]


def _edit_operands(file: SourceEdits, old: tree.BinaryNode, before: tree.BinaryNode, after: tree.BinaryNode) -> bool:
    """Edit the operands of a chain of && or ||."""
    sign = old.operator
    olds, befores, afters = _operands(old, sign), _operands(before, sign), _operands(after, sign)
    if len(olds) != len(befores):
        return before.left == after.left and _edit_pairs(file, [old.right], [before.right], [after.right])
    keys = [print_node(each) for each in befores]
    new_keys = [print_node(each) for each in afters]
    matches = match_items(keys, new_keys, lambda one, other: text_similarity(keys[one], new_keys[other]))
    if len(befores) == len(afters) and None in matches:
        matches = list(range(len(afters)))
    kept = find_unmoved(matches)
    if len(kept) < len([match for match in matches if match is not None]) or not kept:
        return False
    for after_operand, match in zip(afters, matches, strict=True):
        if match is not None:
            edit_expression(file, olds[match], befores[match], after_operand)
    _remove_items(file, olds, kept)
    _insert_items(file, olds, matches, new_keys, f" {sign} ")
    return True


def _remove_items(file: SourceEdits, olds: Sequence[tree.SyntaxNode], kept: set[int]) -> None:
    """Remove items with one of the operators or commas beside them."""
    first = min(kept)
    if first:
        file.delete(file.start(olds[0].first_token), file.start(olds[first].first_token))
    for index in range(first + 1, len(olds)):
        if index not in kept:
            file.delete(file.end(olds[index - 1].last_token), file.end(olds[index].last_token))


def _insert_items(
    file: SourceEdits, olds: Sequence[tree.SyntaxNode], matches: Sequence[Match], texts: Sequence[str], separator: str
) -> None:
    previous: Match = None
    for match, text in zip(matches, texts, strict=True):
        if match is not None:
            previous = match
        elif previous is None:
            file.insert(file.start(olds[0].first_token), text + separator)
        else:
            file.insert(file.end(olds[previous].last_token), separator + text)


def edit_arguments(
    file: SourceEdits, old: tree.ArgumentListNode, before: tree.ArgumentListNode, after: tree.ArgumentListNode
) -> bool:
    """Edit the arguments of a call by name; return whether that was possible."""
    olds = {item.name.text: item for item in old.items}
    befores = {item.name.text: item for item in before.items}
    afters = {item.name.text: item for item in after.items}
    kept = [name for name in befores if name in afters]
    is_possible = list(olds) == list(befores) and [name for name in afters if name in befores] == kept
    if not is_possible or len(afters) != len(after.items) or not kept:
        return False
    for name in kept:
        edit_expression(file, olds[name].value, befores[name].value, afters[name].value)
    names = list(olds)
    _remove_items(file, old.items, {names.index(name) for name in kept})
    matches = [names.index(name) if name in olds else None for name in afters]
    _insert_items(file, old.items, matches, [print_node(item) for item in after.items], ", ")
    return True
