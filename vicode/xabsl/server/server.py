"""The language server: answers the requests of the Language Server Protocol about XABSL files."""

import difflib
import logging
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException
from pygls.protocol import json_rpc

from vicode.findings import Severity
from vicode.xabsl.parser import ParsedFile
from vicode.xabsl.printer import print_file
from vicode.xabsl.server import call_hierarchy
from vicode.xabsl.server.code_actions import code_actions
from vicode.xabsl.server.completion import CompletionProposal, complete_at, find_prefix
from vicode.xabsl.server.folding import folding_ranges
from vicode.xabsl.server.hover import hover_text
from vicode.xabsl.server.language_server import XabslLanguageServer
from vicode.xabsl.server.open_behavior import OpenBehavior, RenameError, SymbolOccurrence
from vicode.xabsl.server.outline import document_symbols, workspace_symbols
from vicode.xabsl.server.positions import path_of, range_at, uri_of
from vicode.xabsl.server.semantic_tokens import LEGEND, semantic_tokens
from vicode.xabsl.server.signature_help import signature_help
from vicode.xabsl.symbol_table import Definition

_Result = TypeVar("_Result")
_COMPLETION_KINDS = {
    "option": lsp.CompletionItemKind.Module,
    "behavior": lsp.CompletionItemKind.Function,
    "input": lsp.CompletionItemKind.Variable,
    "output": lsp.CompletionItemKind.Field,
    "internal": lsp.CompletionItemKind.Field,
    "const": lsp.CompletionItemKind.Constant,
    "parameter": lsp.CompletionItemKind.TypeParameter,
    "element": lsp.CompletionItemKind.EnumMember,
    "enum": lsp.CompletionItemKind.Enum,
    "state": lsp.CompletionItemKind.Class,
    "word": lsp.CompletionItemKind.Keyword,
}


def create_server(encoding_of: Callable[[Path], str] = lambda _path: "") -> XabslLanguageServer:
    """Create the server; `encoding_of` returns the encoding of a file that is not UTF-8, empty for the default."""
    server = XabslLanguageServer(encoding_of)
    # An answer with an error, such as a refusal to rename, is not a failure of the server.
    logging.getLogger(json_rpc.__name__).addFilter(_is_failure)
    for register in (_register_document_sync, _register_completion, _register_queries, _register_outlines):
        register(server)
    for register in (_register_call_hierarchy, _register_rename, _register_edits):
        register(server)
    return server


def _is_failure(record: logging.LogRecord) -> bool:
    error = record.exc_info[1] if record.exc_info else None
    return not (isinstance(error, JsonRpcException) and error.code == lsp.LSPErrorCodes.RequestFailed.value)


def _register_document_sync(server: XabslLanguageServer) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_DID_OPEN)
    def opened(params: lsp.DidOpenTextDocumentParams) -> None:
        server.on_change(path_of(params.text_document.uri))

    @server.feature(lsp.TEXT_DOCUMENT_DID_CHANGE)
    def changed(params: lsp.DidChangeTextDocumentParams) -> None:
        server.on_change(path_of(params.text_document.uri))

    @server.feature(lsp.TEXT_DOCUMENT_DID_SAVE)
    def saved(params: lsp.DidSaveTextDocumentParams) -> None:
        server.on_change(path_of(params.text_document.uri))

    @server.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def closed(params: lsp.DidCloseTextDocumentParams) -> None:
        server.on_change(path_of(params.text_document.uri))


def _register_completion(server: XabslLanguageServer) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_COMPLETION, lsp.CompletionOptions(trigger_characters=[".", "@", "("]))
    def complete(params: lsp.CompletionParams) -> list[lsp.CompletionItem]:
        behavior, path, offset = server.resolve_position(params.text_document.uri, params.position)
        parsed = behavior.source.files.get(path)
        if parsed is None:
            return []
        proposals = complete_at(behavior, parsed.tokens, offset)
        start = offset - len(find_prefix(parsed.tokens.text, offset))
        replaced = range_at(parsed.tokens.text, start, offset)
        takes_snippets = _takes_snippets(server)
        return [
            _completion_item(proposal, number, replaced, takes_snippets=takes_snippets)
            for number, proposal in enumerate(proposals)
        ]

    @server.feature(lsp.TEXT_DOCUMENT_SIGNATURE_HELP, lsp.SignatureHelpOptions(trigger_characters=["(", ",", "="]))
    def help_with_signature(params: lsp.SignatureHelpParams) -> lsp.SignatureHelp | None:
        behavior, path, offset = server.resolve_position(params.text_document.uri, params.position)
        parsed = behavior.source.files.get(path)
        return signature_help(behavior, parsed.tokens, offset) if parsed else None


def _takes_snippets(server: XabslLanguageServer) -> bool:
    document = server.client_capabilities.text_document
    item = document.completion.completion_item if document and document.completion else None
    return bool(item and item.snippet_support)


def _completion_item(
    proposal: CompletionProposal, number: int, replaced: lsp.Range, *, takes_snippets: bool
) -> lsp.CompletionItem:
    is_snippet = takes_snippets and bool(proposal.snippet)
    return lsp.CompletionItem(
        label=proposal.name,
        kind=_COMPLETION_KINDS.get(proposal.kind),
        detail=proposal.detail or None,
        documentation=proposal.doc or None,
        # Editors have their own idea of a word, which may end at a dot: the range says what is replaced.
        # The text to filter by is the label. Neovim before 0.10 ignores the range of items that repeat it.
        text_edit=lsp.TextEdit(range=replaced, new_text=proposal.snippet if is_snippet else proposal.name),
        insert_text_format=lsp.InsertTextFormat.Snippet if is_snippet else lsp.InsertTextFormat.PlainText,
        # Keeps the order of relevance.
        sort_text=f"{number:05}",
    )


def _register_queries(server: XabslLanguageServer) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_HOVER)
    def hover(params: lsp.HoverParams) -> lsp.Hover | None:
        definition = _definition_at(server, params.text_document.uri, params.position)[1]
        if definition is None:
            return None
        return lsp.Hover(contents=lsp.MarkupContent(kind=lsp.MarkupKind.Markdown, value=hover_text(definition)))

    @server.feature(lsp.TEXT_DOCUMENT_DEFINITION)
    def definition(params: lsp.DefinitionParams) -> lsp.Location | None:
        behavior, path, offset = server.resolve_position(params.text_document.uri, params.position)
        included = behavior.include_at(path, offset)
        if included is not None:
            return lsp.Location(uri=uri_of(included), range=range_at("", 0, 0))
        target = behavior.definition_at(path, offset)
        return server.location(behavior, behavior.declaration_occurrence(target)) if target else None

    @server.feature(lsp.TEXT_DOCUMENT_REFERENCES)
    def references(params: lsp.ReferenceParams) -> list[lsp.Location]:
        behavior, definition = _definition_at(server, params.text_document.uri, params.position)
        if definition is None:
            return []
        declaration = behavior.declaration_occurrence(definition)
        include_declaration = params.context.include_declaration
        occurrences = (
            occurrence
            for occurrence in behavior.occurrences(definition)
            if include_declaration or occurrence != declaration
        )
        return [server.location(behavior, occurrence) for occurrence in occurrences]

    @server.feature(lsp.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT)
    def highlight(params: lsp.DocumentHighlightParams) -> list[lsp.DocumentHighlight]:
        path = path_of(params.text_document.uri)
        behavior, target = _definition_at(server, params.text_document.uri, params.position)
        if target is None:
            return []
        return [
            lsp.DocumentHighlight(
                range=server.location(behavior, occurrence).range,
                kind=lsp.DocumentHighlightKind.Write
                if behavior.is_written(occurrence, target)
                else lsp.DocumentHighlightKind.Read,
            )
            for occurrence in behavior.occurrences(target)
            if occurrence.path == path
        ]


def _register_outlines(server: XabslLanguageServer) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    def outline(params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:
        parsed = _parsed_file(server, params.text_document.uri)
        return document_symbols(parsed.tokens, parsed.file) if parsed else []

    @server.feature(lsp.WORKSPACE_SYMBOL)
    def search(params: lsp.WorkspaceSymbolParams) -> list[lsp.WorkspaceSymbol]:
        return workspace_symbols(server.known_behaviors(), params.query)

    @server.feature(lsp.TEXT_DOCUMENT_FOLDING_RANGE)
    def fold(params: lsp.FoldingRangeParams) -> list[lsp.FoldingRange]:
        parsed = _parsed_file(server, params.text_document.uri)
        return folding_ranges(parsed) if parsed else []

    @server.feature(lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, LEGEND)
    def classify(params: lsp.SemanticTokensParams) -> lsp.SemanticTokens:
        parsed = _parsed_file(server, params.text_document.uri)
        behavior = server.find_behavior(path_of(params.text_document.uri))
        return lsp.SemanticTokens(data=semantic_tokens(behavior, parsed.tokens) if parsed else [])


def _register_call_hierarchy(server: XabslLanguageServer) -> None:
    def called_at(item: lsp.CallHierarchyItem) -> tuple[OpenBehavior, Definition | None]:
        return _definition_at(server, item.uri, item.selection_range.start)

    @server.feature(lsp.TEXT_DOCUMENT_PREPARE_CALL_HIERARCHY)
    def prepare(params: lsp.CallHierarchyPrepareParams) -> list[lsp.CallHierarchyItem] | None:
        behavior, target = _definition_at(server, params.text_document.uri, params.position)
        item = call_hierarchy.call_item(behavior, target) if target else None
        return [item] if item else None

    @server.feature(lsp.CALL_HIERARCHY_INCOMING_CALLS)
    def incoming(params: lsp.CallHierarchyIncomingCallsParams) -> list[lsp.CallHierarchyIncomingCall]:
        behavior, target = called_at(params.item)
        return call_hierarchy.incoming_calls(behavior, target) if target else []

    @server.feature(lsp.CALL_HIERARCHY_OUTGOING_CALLS)
    def outgoing(params: lsp.CallHierarchyOutgoingCallsParams) -> list[lsp.CallHierarchyOutgoingCall]:
        behavior, target = called_at(params.item)
        return call_hierarchy.outgoing_calls(behavior, target) if target else []


def _register_rename(server: XabslLanguageServer) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_PREPARE_RENAME)
    def prepare(params: lsp.PrepareRenameParams) -> lsp.PrepareRenamePlaceholder:
        behavior, path, offset = server.resolve_position(params.text_document.uri, params.position)
        occurrence = _answer(lambda: behavior.renamed_occurrence(path, offset))
        return lsp.PrepareRenamePlaceholder(
            range=server.location(behavior, occurrence).range, placeholder=occurrence.text
        )

    @server.feature(lsp.TEXT_DOCUMENT_RENAME, lsp.RenameOptions(prepare_provider=True))
    def rename(params: lsp.RenameParams) -> lsp.WorkspaceEdit:
        behavior, path, offset = server.resolve_position(params.text_document.uri, params.position)

        def edits() -> list[SymbolOccurrence]:
            behavior.renamed_occurrence(path, offset)
            definition = behavior.definition_at(path, offset)
            assert definition
            return behavior.rename_edits(definition, params.new_name)

        return server.workspace_edit(behavior, _answer(edits))


def _answer(compute: Callable[[], _Result]) -> _Result:
    """Compute an answer; the refusal to rename becomes an error that editors show."""
    try:
        return compute()
    except RenameError as error:
        raise JsonRpcException(str(error), code=lsp.LSPErrorCodes.RequestFailed.value) from None


def _register_edits(server: XabslLanguageServer) -> None:
    @server.feature(
        lsp.TEXT_DOCUMENT_CODE_ACTION, lsp.CodeActionOptions(code_action_kinds=[lsp.CodeActionKind.QuickFix])
    )
    def offer_fixes(params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
        path = path_of(params.text_document.uri)
        behavior = server.find_behavior(path)
        only = params.context.only
        if only and not any(lsp.CodeActionKind.QuickFix.startswith(kind) for kind in only):
            return []
        return code_actions(behavior, path, params)

    @server.feature(lsp.TEXT_DOCUMENT_FORMATTING)
    def format_document(params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit] | None:
        parsed = _parsed_file(server, params.text_document.uri)
        if parsed is None or not _is_well_formed(parsed):
            return None
        text = parsed.tokens.text
        return [lsp.TextEdit(range=range_at(text, 0, len(text)), new_text=print_file(parsed.file))]

    @server.feature(lsp.TEXT_DOCUMENT_RANGE_FORMATTING)
    def format_lines(params: lsp.DocumentRangeFormattingParams) -> list[lsp.TextEdit] | None:
        parsed = _parsed_file(server, params.text_document.uri)
        return _format_range(parsed, params.range) if parsed and _is_well_formed(parsed) else None


def _format_range(parsed: ParsedFile, selected: lsp.Range) -> list[lsp.TextEdit]:
    """Format a file and keep only the changes of lines that touch a range."""
    before, after = parsed.tokens.text.splitlines(keepends=True), print_file(parsed.file).splitlines(keepends=True)
    last_line = selected.end.line - (selected.end.character == 0 and selected.end.line > selected.start.line)
    edits = []
    for tag, first, last, new_first, new_last in difflib.SequenceMatcher(
        None, before, after, autojunk=False
    ).get_opcodes():
        if tag != "equal" and first <= last_line and max(last - 1, first) >= selected.start.line:
            changed = lsp.Range(lsp.Position(first, 0), lsp.Position(last, 0))
            edits.append(lsp.TextEdit(range=changed, new_text="".join(after[new_first:new_last])))
    return edits


def _is_well_formed(parsed: ParsedFile) -> bool:
    return not any(finding.severity is Severity.ERROR for finding in parsed.findings)


def _parsed_file(server: XabslLanguageServer, uri: str) -> ParsedFile | None:
    path = path_of(uri)
    return server.find_behavior(path).source.files.get(path)


def _definition_at(
    server: XabslLanguageServer, uri: str, position: lsp.Position
) -> tuple[OpenBehavior, Definition | None]:
    behavior, path, offset = server.resolve_position(uri, position)
    return behavior, behavior.definition_at(path, offset)
