"""The language server: converts between the Language Server Protocol and `OpenBehavior`."""

from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path

from lsprotocol import types as lsp
from pygls import uris
from pygls.lsp.server import LanguageServer

from vicode.findings import Finding, Severity
from vicode.xabsl import tree
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.printer import print_file
from vicode.xabsl.server.completion import CompletionProposal, complete_at
from vicode.xabsl.server.hover import hover_text
from vicode.xabsl.server.open_behavior import OpenBehavior, RenameError, SymbolOccurrence, find_main_file
from vicode.xabsl.symbol_table import Definition

_SEVERITIES = {
    Severity.ERROR: lsp.DiagnosticSeverity.Error,
    Severity.WARNING: lsp.DiagnosticSeverity.Warning,
    Severity.NOTE: lsp.DiagnosticSeverity.Information,
}
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
_SYMBOL_KINDS = {
    tree.ConstantNode: lsp.SymbolKind.Constant,
    tree.EnumerationNode: lsp.SymbolKind.Enum,
    tree.SymbolNode: lsp.SymbolKind.Variable,
    tree.BehaviorNode: lsp.SymbolKind.Function,
}


class XabslLanguageServer(LanguageServer):
    """Serves the behaviors of the open files."""

    def __init__(self) -> None:
        super().__init__("vicode-xabsl", version("vicode"), lsp.TextDocumentSyncKind.Full)
        self.behaviors: dict[Path, OpenBehavior] = {}
        self._main_files: dict[Path, Path] = {}
        self._published: dict[Path, set[Path]] = {}

    def find_behavior(self, path: Path) -> OpenBehavior:
        """The behavior that includes a file, as last compiled."""
        main = self._main_files.get(path)
        if main is None:
            main = self._main_files[path] = find_main_file(path)
        if main not in self.behaviors:
            self.behaviors[main] = OpenBehavior(main, self._texts())
        return self.behaviors[main]

    def on_change(self, path: Path) -> None:
        """Compile the behavior of a file again and publish the findings of all its files."""
        behavior = self.find_behavior(path)
        if path not in behavior.source.files and self._main_files[path] != path:
            # The file is no longer included, or another behavior includes it.
            del self._main_files[path]
            behavior = self.find_behavior(path)
        behavior.open_texts = self._texts()
        self.publish_findings(behavior)

    def publish_findings(self, behavior: OpenBehavior) -> None:
        """Publish the findings of a behavior, and clear those of files that have none any more."""
        findings = behavior.refresh().findings
        folder = behavior.source.main.parent
        by_path: dict[Path, list[lsp.Diagnostic]] = {path: [] for path in self._published.get(behavior.main, ())}
        is_alone = not _has_agents(behavior)
        for finding in findings:
            if finding.location is None or (is_alone and finding.rule.code in ("X609", "X621", "X644")):
                # These findings are expected in a file that no behavior includes.
                continue
            path = (folder / finding.location.file).resolve()
            by_path.setdefault(path, []).append(_diagnostic(finding, folder, self._text(behavior, path)))
        for path, diagnostics in by_path.items():
            self.text_document_publish_diagnostics(
                lsp.PublishDiagnosticsParams(uri=_uri(path), diagnostics=diagnostics)
            )
        self._published[behavior.main] = {path for path, diagnostics in by_path.items() if diagnostics}

    def resolve_position(self, uri: str, position: lsp.Position) -> tuple[OpenBehavior, Path, int]:
        """Resolve a position to the behavior, the file and the offset of the character."""
        path = _path(uri)
        behavior = self.find_behavior(path)
        text = self._text(behavior, path)
        return behavior, path, _offset(text, position)

    def location(self, behavior: OpenBehavior, occurrence: SymbolOccurrence) -> lsp.Location:
        text = self._text(behavior, occurrence.path)
        return lsp.Location(uri=_uri(occurrence.path), range=_range(text, occurrence.start, occurrence.end))

    def workspace_edit(self, behavior: OpenBehavior, occurrences: Sequence[SymbolOccurrence]) -> lsp.WorkspaceEdit:
        changes: dict[str, list[lsp.TextEdit]] = {}
        for occurrence in occurrences:
            text = self._text(behavior, occurrence.path)
            edit = lsp.TextEdit(range=_range(text, occurrence.start, occurrence.end), new_text=occurrence.text)
            changes.setdefault(_uri(occurrence.path), []).append(edit)
        return lsp.WorkspaceEdit(changes=changes)

    def _text(self, behavior: OpenBehavior, path: Path) -> str:
        parsed = behavior.source.files.get(path)
        return parsed.tokens.text if parsed else self._texts().get(path, "")

    def _texts(self) -> dict[Path, str]:
        return {_path(uri): document.source for uri, document in self.workspace.text_documents.items()}


def create_server() -> XabslLanguageServer:
    server = XabslLanguageServer()
    _register_document_sync(server)
    _register_queries(server)
    _register_edits(server)
    return server


def _register_document_sync(server: XabslLanguageServer) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_DID_OPEN)
    def opened(params: lsp.DidOpenTextDocumentParams) -> None:
        server.on_change(_path(params.text_document.uri))

    @server.feature(lsp.TEXT_DOCUMENT_DID_CHANGE)
    def changed(params: lsp.DidChangeTextDocumentParams) -> None:
        server.on_change(_path(params.text_document.uri))

    @server.feature(lsp.TEXT_DOCUMENT_DID_SAVE)
    def saved(params: lsp.DidSaveTextDocumentParams) -> None:
        server.on_change(_path(params.text_document.uri))

    @server.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def closed(params: lsp.DidCloseTextDocumentParams) -> None:
        server.on_change(_path(params.text_document.uri))


def _register_queries(server: XabslLanguageServer) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_COMPLETION, lsp.CompletionOptions(trigger_characters=[".", "@", "("]))
    def complete(params: lsp.CompletionParams) -> list[lsp.CompletionItem]:
        behavior, path, offset = server.resolve_position(params.text_document.uri, params.position)
        parsed = behavior.source.files.get(path)
        proposals = complete_at(behavior, parsed.tokens, offset) if parsed else []
        return [_completion_item(proposal, number) for number, proposal in enumerate(proposals)]

    @server.feature(lsp.TEXT_DOCUMENT_HOVER)
    def hover(params: lsp.HoverParams) -> lsp.Hover | None:
        definition = _definition_at(server, params.text_document.uri, params.position)[1]
        if definition is None:
            return None
        return lsp.Hover(contents=lsp.MarkupContent(kind=lsp.MarkupKind.Markdown, value=hover_text(definition)))

    @server.feature(lsp.TEXT_DOCUMENT_DEFINITION)
    def definition(params: lsp.DefinitionParams) -> lsp.Location | None:
        behavior, target = _definition_at(server, params.text_document.uri, params.position)
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


def _register_edits(server: XabslLanguageServer) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_RENAME)
    def rename(params: lsp.RenameParams) -> lsp.WorkspaceEdit | None:
        behavior, definition = _definition_at(server, params.text_document.uri, params.position)
        if definition is None:
            return None
        try:
            return server.workspace_edit(behavior, behavior.rename_edits(definition, params.new_name))
        except RenameError as error:
            server.window_show_message(lsp.ShowMessageParams(type=lsp.MessageType.Error, message=str(error)))
            return None

    @server.feature(lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    def document_symbols(params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:
        path = _path(params.text_document.uri)
        parsed = server.find_behavior(path).source.files.get(path)
        return [_outline(parsed.tokens, item) for item in parsed.file.body] if parsed else []

    @server.feature(lsp.TEXT_DOCUMENT_FORMATTING)
    def format_document(params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit] | None:
        path = _path(params.text_document.uri)
        parsed = server.find_behavior(path).source.files.get(path)
        if parsed is None or any(finding.severity is Severity.ERROR for finding in parsed.findings):
            return None
        text = parsed.tokens.text
        return [lsp.TextEdit(range=_range(text, 0, len(text)), new_text=print_file(parsed.file))]


def _has_agents(behavior: OpenBehavior) -> bool:
    files = behavior.source.files.values()
    return any(isinstance(item, tree.AgentNode) for parsed in files for item in parsed.file.body)


def _definition_at(
    server: XabslLanguageServer, uri: str, position: lsp.Position
) -> tuple[OpenBehavior, Definition | None]:
    behavior, path, offset = server.resolve_position(uri, position)
    return behavior, behavior.definition_at(path, offset)


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
    text, last = tokens.text, min(max(node.last_token, name.first_token), len(tokens.starts) - 1)
    end = tokens.starts[last] + len(tokens.texts[last])
    selection = _range(text, tokens.starts[name.first_token], tokens.starts[name.first_token] + len(name.text))
    return lsp.DocumentSymbol(
        name=name.text, kind=kind, range=_range(text, tokens.starts[node.first_token], end), selection_range=selection
    )


def _completion_item(proposal: CompletionProposal, number: int) -> lsp.CompletionItem:
    snippet = lsp.InsertTextFormat.Snippet if proposal.snippet else lsp.InsertTextFormat.PlainText
    return lsp.CompletionItem(
        label=proposal.name,
        kind=_COMPLETION_KINDS.get(proposal.kind),
        detail=proposal.detail or None,
        documentation=proposal.doc or None,
        insert_text=proposal.snippet or proposal.name,
        insert_text_format=snippet,
        # Keeps the order of relevance.
        sort_text=f"{number:05}",
    )


def _diagnostic(finding: Finding, folder: Path, text: str) -> lsp.Diagnostic:
    location = finding.location
    assert location
    start = _offset(text, lsp.Position(location.line - 1, 0)) + location.column - 1
    related = [
        lsp.DiagnosticRelatedInformation(
            location=lsp.Location(
                uri=_uri((folder / note.location.file).resolve()),
                range=_simple_range(note.location.line, note.location.column, note.location.length),
            ),
            message=note.message,
        )
        for note in finding.notes
        if note.location
    ]
    return lsp.Diagnostic(
        range=_range(text, start, start + location.length),
        message=finding.message + (f"; {finding.fix}" if finding.fix else ""),
        severity=_SEVERITIES[finding.severity],
        code=finding.rule.code,
        source="vicode",
        related_information=related or None,
    )


def _simple_range(line: int, column: int, length: int) -> lsp.Range:
    return lsp.Range(lsp.Position(line - 1, column - 1), lsp.Position(line - 1, column - 1 + length))


def _offset(text: str, position: lsp.Position) -> int:
    """The offset of a position, whose column counts UTF-16 code units."""
    start = 0
    for _ in range(position.line):
        line_end = text.find("\n", start)
        if line_end < 0:
            return len(text)
        start = line_end + 1
    units, offset = 0, start
    while units < position.character and offset < len(text) and text[offset] != "\n":
        units += 1 + (ord(text[offset]) > 0xFFFF)
        offset += 1
    return offset


def _range(text: str, start: int, end: int) -> lsp.Range:
    return lsp.Range(_position(text, start), _position(text, end))


def _position(text: str, offset: int) -> lsp.Position:
    line = text.count("\n", 0, offset)
    line_start = text.rfind("\n", 0, offset) + 1
    return lsp.Position(line, len(text[line_start:offset].encode("utf-16-le")) // 2)


def _path(uri: str) -> Path:
    return Path(uris.to_fs_path(uri) or uri).resolve()


def _uri(path: Path) -> str:
    return uris.from_fs_path(str(path)) or ""
