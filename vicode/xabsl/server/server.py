"""The server itself: hands what a text editor asks to `Behavior`, and its answers back, in the protocol's own types."""

from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path

from lsprotocol import types as lsp
from pygls import uris
from pygls.lsp.server import LanguageServer

from vicode.findings import Finding, Severity
from vicode.xabsl import tree
from vicode.xabsl.declared import Declared
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.printer import print_file
from vicode.xabsl.server.behavior import Behavior, RenameError, Spot, find_main
from vicode.xabsl.server.completing import Choice, choices_at
from vicode.xabsl.server.describing import describe

_SEVERITIES = {
    Severity.ERROR: lsp.DiagnosticSeverity.Error,
    Severity.WARNING: lsp.DiagnosticSeverity.Warning,
    Severity.NOTE: lsp.DiagnosticSeverity.Information,
}
_KINDS = {
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
_NAMESPACES = {
    tree.Constant: lsp.SymbolKind.Constant,
    tree.Enumeration: lsp.SymbolKind.Enum,
    tree.Symbol: lsp.SymbolKind.Variable,
    tree.Behavior: lsp.SymbolKind.Function,
}


class Server(LanguageServer):
    """Serves the behaviors that open files belong to."""

    def __init__(self) -> None:
        super().__init__("vicode-xabsl", version("vicode"), lsp.TextDocumentSyncKind.Full)
        self.behaviors: dict[Path, Behavior] = {}
        self._mains: dict[Path, Path] = {}
        self._told: dict[Path, set[Path]] = {}

    def behavior_of(self, path: Path) -> Behavior:
        """The behavior that a file belongs to, read as it was last."""
        main = self._mains.get(path)
        if main is None:
            main = self._mains[path] = find_main(path)
        if main not in self.behaviors:
            self.behaviors[main] = Behavior(main, self._texts())
        return self.behaviors[main]

    def changed(self, path: Path) -> None:
        """Read the behavior of a file anew, and tell what is wrong with all of its files."""
        behavior = self.behavior_of(path)
        if path not in behavior.source.files and self._mains[path] != path:
            # It is included no more, or another file has it now.
            del self._mains[path]
            behavior = self.behavior_of(path)
        behavior.open_texts = self._texts()
        self.tell(behavior)

    def tell(self, behavior: Behavior) -> None:
        """Publish the findings of a behavior; files without any are told so once."""
        found = behavior.look().findings
        folder = behavior.source.main.parent
        by_path: dict[Path, list[lsp.Diagnostic]] = {path: [] for path in self._told.get(behavior.main, ())}
        is_alone = not _has_agents(behavior)
        for finding in found:
            if finding.place is None or (is_alone and finding.rule.code in ("X609", "X621", "X644")):
                # A file that no behavior includes is judged by itself.
                continue
            path = (folder / finding.place.file).resolve()
            by_path.setdefault(path, []).append(_diagnostic(finding, folder, self._text(behavior, path)))
        for path, diagnostics in by_path.items():
            self.text_document_publish_diagnostics(
                lsp.PublishDiagnosticsParams(uri=_uri(path), diagnostics=diagnostics)
            )
        self._told[behavior.main] = {path for path, diagnostics in by_path.items() if diagnostics}

    def place(self, uri: str, position: lsp.Position) -> tuple[Behavior, Path, int]:
        """The behavior and the character that a position means."""
        path = _path(uri)
        behavior = self.behavior_of(path)
        text = self._text(behavior, path)
        return behavior, path, _offset(text, position)

    def location(self, behavior: Behavior, spot: Spot) -> lsp.Location:
        """Where a spot is, for a text editor."""
        text = self._text(behavior, spot.path)
        return lsp.Location(uri=_uri(spot.path), range=_range(text, spot.start, spot.end))

    def edit(self, behavior: Behavior, spots: Sequence[Spot]) -> lsp.WorkspaceEdit:
        """An edit of all spots."""
        changes: dict[str, list[lsp.TextEdit]] = {}
        for spot in spots:
            text = self._text(behavior, spot.path)
            edit = lsp.TextEdit(range=_range(text, spot.start, spot.end), new_text=spot.text)
            changes.setdefault(_uri(spot.path), []).append(edit)
        return lsp.WorkspaceEdit(changes=changes)

    def _text(self, behavior: Behavior, path: Path) -> str:
        parsed = behavior.source.files.get(path)
        return parsed.tokens.text if parsed else self._texts().get(path, "")

    def _texts(self) -> dict[Path, str]:
        return {_path(uri): document.source for uri, document in self.workspace.text_documents.items()}


def make_server() -> Server:
    """A server with all that it can do."""
    server = Server()
    _add_changes(server)
    _add_answers(server)
    _add_edits(server)
    return server


def _add_changes(server: Server) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_DID_OPEN)
    def opened(params: lsp.DidOpenTextDocumentParams) -> None:
        server.changed(_path(params.text_document.uri))

    @server.feature(lsp.TEXT_DOCUMENT_DID_CHANGE)
    def changed(params: lsp.DidChangeTextDocumentParams) -> None:
        server.changed(_path(params.text_document.uri))

    @server.feature(lsp.TEXT_DOCUMENT_DID_SAVE)
    def saved(params: lsp.DidSaveTextDocumentParams) -> None:
        server.changed(_path(params.text_document.uri))

    @server.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def closed(params: lsp.DidCloseTextDocumentParams) -> None:
        server.changed(_path(params.text_document.uri))


def _add_answers(server: Server) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_COMPLETION, lsp.CompletionOptions(trigger_characters=[".", "@", "("]))
    def complete(params: lsp.CompletionParams) -> list[lsp.CompletionItem]:
        behavior, path, offset = server.place(params.text_document.uri, params.position)
        parsed = behavior.source.files.get(path)
        choices = choices_at(behavior, parsed.tokens, offset) if parsed else []
        return [_item(each, number) for number, each in enumerate(choices)]

    @server.feature(lsp.TEXT_DOCUMENT_HOVER)
    def hover(params: lsp.HoverParams) -> lsp.Hover | None:
        declared = _declared(server, params.text_document.uri, params.position)[1]
        if declared is None:
            return None
        return lsp.Hover(contents=lsp.MarkupContent(kind=lsp.MarkupKind.Markdown, value=describe(declared)))

    @server.feature(lsp.TEXT_DOCUMENT_DEFINITION)
    def define(params: lsp.DefinitionParams) -> lsp.Location | None:
        behavior, declared = _declared(server, params.text_document.uri, params.position)
        return server.location(behavior, behavior.spot_of(declared)) if declared else None

    @server.feature(lsp.TEXT_DOCUMENT_REFERENCES)
    def refer(params: lsp.ReferenceParams) -> list[lsp.Location]:
        behavior, declared = _declared(server, params.text_document.uri, params.position)
        if declared is None:
            return []
        own = behavior.spot_of(declared)
        wants_own = params.context.include_declaration
        spots = (each for each in behavior.spots_of(declared) if wants_own or each != own)
        return [server.location(behavior, spot) for spot in spots]


def _add_edits(server: Server) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_RENAME)
    def rename(params: lsp.RenameParams) -> lsp.WorkspaceEdit | None:
        behavior, declared = _declared(server, params.text_document.uri, params.position)
        if declared is None:
            return None
        try:
            return server.edit(behavior, behavior.renamed(declared, params.new_name))
        except RenameError as error:
            server.window_show_message(lsp.ShowMessageParams(type=lsp.MessageType.Error, message=str(error)))
            return None

    @server.feature(lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    def outline(params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:
        path = _path(params.text_document.uri)
        parsed = server.behavior_of(path).source.files.get(path)
        return [_outline(parsed.tokens, item) for item in parsed.file.body] if parsed else []

    @server.feature(lsp.TEXT_DOCUMENT_FORMATTING)
    def lay_out(params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit] | None:
        path = _path(params.text_document.uri)
        parsed = server.behavior_of(path).source.files.get(path)
        if parsed is None or any(each.severity is Severity.ERROR for each in parsed.findings):
            return None
        text = parsed.tokens.text
        return [lsp.TextEdit(range=_range(text, 0, len(text)), new_text=print_file(parsed.file))]


def _has_agents(behavior: Behavior) -> bool:
    files = behavior.source.files.values()
    return any(isinstance(item, tree.Agent) for parsed in files for item in parsed.file.body)


def _declared(server: Server, uri: str, position: lsp.Position) -> tuple[Behavior, Declared | None]:
    behavior, path, offset = server.place(uri, position)
    return behavior, behavior.declared_at(path, offset)


def _outline(tokens: Tokens, item: tree.Option | tree.Namespace | tree.Agent) -> lsp.DocumentSymbol:
    match item:
        case tree.Option():
            inner = [_symbol(tokens, each, each.name, lsp.SymbolKind.Class) for each in item.states]
            kind = lsp.SymbolKind.Module
        case tree.Namespace():
            inner = [_symbol(tokens, each, each.name, _NAMESPACES[type(each)]) for each in item.declarations]
            kind = lsp.SymbolKind.Namespace
        case tree.Agent():
            inner, kind = [], lsp.SymbolKind.Object
    outer = _symbol(tokens, item, item.name, kind)
    outer.children = inner
    return outer


def _symbol(tokens: Tokens, node: tree.Node, name: tree.Name, kind: lsp.SymbolKind) -> lsp.DocumentSymbol:
    text, last = tokens.text, min(max(node.to, name.at), len(tokens.starts) - 1)
    end = tokens.starts[last] + len(tokens.texts[last])
    own = _range(text, tokens.starts[name.at], tokens.starts[name.at] + len(name.text))
    return lsp.DocumentSymbol(
        name=name.text, kind=kind, range=_range(text, tokens.starts[node.at], end), selection_range=own
    )


def _item(choice: Choice, number: int) -> lsp.CompletionItem:
    snippet = lsp.InsertTextFormat.Snippet if choice.snippet else lsp.InsertTextFormat.PlainText
    return lsp.CompletionItem(
        label=choice.name,
        kind=_KINDS.get(choice.kind),
        detail=choice.detail or None,
        documentation=choice.doc or None,
        insert_text=choice.snippet or choice.name,
        insert_text_format=snippet,
        # What is wanted most stands first, whatever its letters.
        sort_text=f"{number:05}",
    )


def _diagnostic(finding: Finding, folder: Path, text: str) -> lsp.Diagnostic:
    place = finding.place
    assert place
    start = _offset(text, lsp.Position(place.line - 1, 0)) + place.column - 1
    related = [
        lsp.DiagnosticRelatedInformation(
            location=lsp.Location(
                uri=_uri((folder / note.place.file).resolve()),
                range=_simple_range(note.place.line, note.place.column, note.place.length),
            ),
            message=note.message,
        )
        for note in finding.notes
        if note.place
    ]
    return lsp.Diagnostic(
        range=_range(text, start, start + place.length),
        message=finding.message + (f"; {finding.mend}" if finding.mend else ""),
        severity=_SEVERITIES[finding.severity],
        code=finding.rule.code,
        source="vicode",
        related_information=related or None,
    )


def _simple_range(line: int, column: int, length: int) -> lsp.Range:
    return lsp.Range(lsp.Position(line - 1, column - 1), lsp.Position(line - 1, column - 1 + length))


def _offset(text: str, position: lsp.Position) -> int:
    """The character at a position, which counts in units of UTF-16."""
    start = 0
    for _ in range(position.line):
        found = text.find("\n", start)
        if found < 0:
            return len(text)
        start = found + 1
    units, offset = 0, start
    while units < position.character and offset < len(text) and text[offset] != "\n":
        units += 1 + (ord(text[offset]) > 0xFFFF)
        offset += 1
    return offset


def _range(text: str, start: int, end: int) -> lsp.Range:
    return lsp.Range(_position(text, start), _position(text, end))


def _position(text: str, offset: int) -> lsp.Position:
    line = text.count("\n", 0, offset)
    begin = text.rfind("\n", 0, offset) + 1
    return lsp.Position(line, len(text[begin:offset].encode("utf-16-le")) // 2)


def _path(uri: str) -> Path:
    return Path(uris.to_fs_path(uri) or uri).resolve()


def _uri(path: Path) -> str:
    return uris.from_fs_path(str(path)) or ""
