"""Signature help: the parameters of the call around the cursor, with the current one marked."""

from bisect import bisect_left

from lsprotocol import types as lsp

from vicode.xabsl.lexer import Tokens
from vicode.xabsl.server.completion import callee_name, find_callee
from vicode.xabsl.server.hover import doc_comment, signature
from vicode.xabsl.server.open_behavior import OpenBehavior
from vicode.xabsl.symbol_table import Definition


def signature_help(behavior: OpenBehavior, tokens: Tokens, offset: int) -> lsp.SignatureHelp | None:
    """The signature of the innermost call around a character, None outside of calls."""
    before = bisect_left(tokens.starts, offset)
    opening = _opening_parenthesis(tokens, before)
    while opening is not None:
        callee = find_callee(behavior.compiled.table, callee_name(tokens, opening))
        if callee is not None and callee.parameters:
            return _help(callee, _active_parameter(tokens, opening, before, callee))
        opening = _opening_parenthesis(tokens, opening)
    return None


def _opening_parenthesis(tokens: Tokens, before: int) -> int | None:
    """The last parenthesis before a token that is still open there."""
    depth = 0
    for number in range(before - 1, -1, -1):
        kind = tokens.kinds[number]
        if kind in (";", "{", "}"):
            return None
        if kind == ")":
            depth += 1
        elif kind == "(":
            if depth == 0:
                return number
            depth -= 1
    return None


def _active_parameter(tokens: Tokens, opening: int, before: int, callee: Definition) -> int:
    """The parameter whose argument is being written: the one named, else the first that has no argument."""
    depth, current, used = 0, "", set[str]()
    for number in range(opening + 1, before):
        kind = tokens.kinds[number]
        depth += (kind == "(") - (kind == ")")
        if depth == 0 and kind == "=":
            current = tokens.texts[number - 1]
            used.add(current)
        elif depth == 0 and kind == ",":
            current = ""
    names = [*callee.parameters]
    if current in names:
        return names.index(current)
    return next((number for number, name in enumerate(names) if name not in used), len(names) - 1)


def _help(callee: Definition, active: int) -> lsp.SignatureHelp:
    parameters = [
        lsp.ParameterInformation(
            label=signature(parameter).split(" [")[0].split(' "')[0],
            documentation="\n".join(filter(None, (signature(parameter), doc_comment(parameter)))),
        )
        for parameter in callee.parameters.values()
    ]
    information = lsp.SignatureInformation(
        label=signature(callee), documentation=doc_comment(callee) or None, parameters=parameters
    )
    return lsp.SignatureHelp(signatures=[information], active_signature=0, active_parameter=active)
