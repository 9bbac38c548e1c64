"""The call hierarchy of options and basic behaviors: who calls one, and what it calls."""

from collections.abc import Iterator

from lsprotocol import types as lsp

from vicode.xabsl import tree
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.server.open_behavior import OpenBehavior
from vicode.xabsl.server.positions import token_range, uri_of
from vicode.xabsl.symbol_table import Definition

_KINDS = {"option": lsp.SymbolKind.Module, "behavior": lsp.SymbolKind.Function, "agent": lsp.SymbolKind.Object}


def call_item(behavior: OpenBehavior, definition: Definition) -> lsp.CallHierarchyItem | None:
    """The item of an option, a basic behavior or an agent."""
    if definition.role not in _KINDS:
        return None
    tokens, node, name = definition.tokens, definition.node, definition.name_node
    return lsp.CallHierarchyItem(
        name=definition.name,
        kind=_KINDS[definition.role],
        detail=definition.role,
        uri=uri_of(behavior.path_of(tokens)),
        range=token_range(tokens, node.first_token, node.last_token),
        selection_range=token_range(tokens, name.first_token),
    )


def incoming_calls(behavior: OpenBehavior, definition: Definition) -> list[lsp.CallHierarchyIncomingCall]:
    calls: dict[int, lsp.CallHierarchyIncomingCall] = {}
    for caller, callee, tokens, token in _calls(behavior):
        if callee is definition and (item := call_item(behavior, caller)) is not None:
            call = calls.setdefault(id(caller), lsp.CallHierarchyIncomingCall(from_=item, from_ranges=[]))
            call.from_ranges = [*call.from_ranges, token_range(tokens, token)]
    return list(calls.values())


def outgoing_calls(behavior: OpenBehavior, definition: Definition) -> list[lsp.CallHierarchyOutgoingCall]:
    calls: dict[int, lsp.CallHierarchyOutgoingCall] = {}
    for caller, callee, tokens, token in _calls(behavior):
        if caller is definition and (item := call_item(behavior, callee)) is not None:
            call = calls.setdefault(id(callee), lsp.CallHierarchyOutgoingCall(to=item, from_ranges=[]))
            call.from_ranges = [*call.from_ranges, token_range(tokens, token)]
    return list(calls.values())


def _calls(behavior: OpenBehavior) -> Iterator[tuple[Definition, Definition, Tokens, int]]:
    """Caller, callee, and the file and token of each call; an agent calls its root option."""
    table = behavior.compiled.table
    callers = sorted(
        (definition for group in (table.options, table.agents) for definition in group.values()),
        key=lambda definition: definition.node.first_token,
    )
    for tokens, token, callee in behavior.compiled.references:
        if callee.role not in _KINDS:
            continue
        for caller in callers:
            node = caller.node
            assert isinstance(node, tree.OptionNode | tree.AgentNode)
            if caller.tokens is tokens and node.first_token <= token <= node.last_token:
                yield caller, callee, tokens, token
