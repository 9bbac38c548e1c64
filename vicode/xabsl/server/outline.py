"""The outline of a file, and search for the definitions of all open behaviors."""

from collections.abc import Iterable, Iterator

from lsprotocol import types as lsp

from vicode.xabsl import tree
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.server.open_behavior import OpenBehavior
from vicode.xabsl.server.positions import token_range, uri_of

_SYMBOL_KINDS = {
    tree.ConstantNode: lsp.SymbolKind.Constant,
    tree.EnumerationNode: lsp.SymbolKind.Enum,
    tree.SymbolNode: lsp.SymbolKind.Variable,
    tree.BehaviorNode: lsp.SymbolKind.Function,
}
_ROLE_KINDS = {
    "option": lsp.SymbolKind.Module,
    "behavior": lsp.SymbolKind.Function,
    "agent": lsp.SymbolKind.Object,
    "enum": lsp.SymbolKind.Enum,
    "element": lsp.SymbolKind.EnumMember,
    "const": lsp.SymbolKind.Constant,
    "state": lsp.SymbolKind.Class,
    "input": lsp.SymbolKind.Variable,
    "output": lsp.SymbolKind.Field,
    "internal": lsp.SymbolKind.Field,
}
_MAX_SYMBOLS = 500


def workspace_symbols(behaviors: Iterable[OpenBehavior], query: str) -> list[lsp.WorkspaceSymbol]:
    """Definitions whose names contain the characters of a query in order, best matches first."""
    found = [
        (rank, symbol)
        for behavior in behaviors
        for symbol in _symbols(behavior)
        if (rank := _rank(symbol.name, query)) is not None
    ]
    found.sort(key=lambda entry: (entry[0], entry[1].name))
    return [symbol for _rank, symbol in found[:_MAX_SYMBOLS]]


def _symbols(behavior: OpenBehavior) -> Iterator[lsp.WorkspaceSymbol]:
    for definition, owner in behavior.definitions():
        if definition.role in _ROLE_KINDS:
            tokens = definition.tokens
            location = lsp.Location(
                uri_of(behavior.path_of(tokens)), token_range(tokens, definition.name_node.first_token)
            )
            kind = _ROLE_KINDS[definition.role]
            container = owner.name if owner else None
            yield lsp.WorkspaceSymbol(location=location, name=definition.name, kind=kind, container_name=container)


def _rank(name: str, query: str) -> int | None:
    """0 for the same beginning, 1 for a part, 2 for the characters in order, None for no match."""
    name, query = name.casefold(), query.casefold()
    if query in name:
        return 0 if name.startswith(query) else 1
    characters = iter(name)
    return 2 if all(character in characters for character in query) else None


def document_symbols(tokens: Tokens, file: tree.FileNode) -> list[lsp.DocumentSymbol]:
    return [_outline(tokens, item) for item in file.body]


def _outline(tokens: Tokens, item: tree.OptionNode | tree.NamespaceNode | tree.AgentNode) -> lsp.DocumentSymbol:
    match item:
        case tree.OptionNode():
            inner = [_document_symbol(tokens, state, state.name, lsp.SymbolKind.Class) for state in item.states]
            kind = lsp.SymbolKind.Module
        case tree.NamespaceNode():
            inner = [
                _document_symbol(tokens, declaration, declaration.name, _SYMBOL_KINDS[type(declaration)])
                for declaration in item.declarations
            ]
            kind = lsp.SymbolKind.Namespace
        case tree.AgentNode():
            inner, kind = [], lsp.SymbolKind.Object
    outer = _document_symbol(tokens, item, item.name, kind)
    outer.children = inner
    return outer


def _document_symbol(
    tokens: Tokens, node: tree.SyntaxNode, name: tree.NameNode, kind: lsp.SymbolKind
) -> lsp.DocumentSymbol:
    return lsp.DocumentSymbol(
        name=name.text,
        kind=kind,
        range=token_range(tokens, node.first_token, max(node.last_token, name.first_token)),
        selection_range=token_range(tokens, name.first_token),
    )
