"""The behaviors of the open files, their findings as diagnostics, and positions in them."""

from collections.abc import Callable, Sequence
from pathlib import Path

from lsprotocol import types as lsp
from pygls.lsp.server import LanguageServer

from vicode import __version__
from vicode.findings import Finding, Severity, SourceLocation
from vicode.xabsl import tree
from vicode.xabsl.server.open_behavior import OpenBehavior, SymbolOccurrence
from vicode.xabsl.server.positions import offset_at, path_of, range_at, uri_of
from vicode.xabsl.source_loader import find_agent_files, find_main_file

_SEVERITIES = {
    Severity.ERROR: lsp.DiagnosticSeverity.Error,
    Severity.WARNING: lsp.DiagnosticSeverity.Warning,
    Severity.NOTE: lsp.DiagnosticSeverity.Information,
}


class XabslLanguageServer(LanguageServer):
    """Serves the behaviors of the open files."""

    def __init__(self, encoding_of: Callable[[Path], str]) -> None:
        super().__init__("vicode-xabsl", __version__, lsp.TextDocumentSyncKind.Full)
        self._encoding_of = encoding_of
        self.behaviors: dict[Path, OpenBehavior] = {}
        self._main_files: dict[Path, Path] = {}
        self._published: dict[Path, set[Path]] = {}

    def find_behavior(self, path: Path) -> OpenBehavior:
        """The behavior that includes a file, as last compiled."""
        main = self._main_files.get(path)
        if main is None:
            main = self._main_files[path] = find_main_file(path)
        if main not in self.behaviors:
            self.behaviors[main] = OpenBehavior(main, self._texts(), self._encoding_of(main))
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
            by_path.setdefault(path, []).append(diagnostic(finding, folder, self.text(behavior, path)))
        for path, diagnostics in by_path.items():
            self.text_document_publish_diagnostics(
                lsp.PublishDiagnosticsParams(uri=uri_of(path), diagnostics=diagnostics)
            )
        self._published[behavior.main] = {path for path, diagnostics in by_path.items() if diagnostics}

    def resolve_position(self, uri: str, position: lsp.Position) -> tuple[OpenBehavior, Path, int]:
        """Resolve a position to the behavior, the file and the offset of the character."""
        path = path_of(uri)
        behavior = self.find_behavior(path)
        text = self.text(behavior, path)
        return behavior, path, offset_at(text, position)

    def known_behaviors(self) -> list[OpenBehavior]:
        """The behaviors of open files, or those of the workspace if no file is open."""
        mains = {self.find_behavior(path).main for path in self._texts()}
        if not mains:
            folders = [path_of(folder.uri) for folder in self.workspace.folders.values()]
            mains = {self.find_behavior(main.resolve()).main for folder in folders for main in find_agent_files(folder)}
        return [self.behaviors[main] for main in sorted(mains)]

    def location(self, behavior: OpenBehavior, occurrence: SymbolOccurrence) -> lsp.Location:
        text = self.text(behavior, occurrence.path)
        return lsp.Location(uri=uri_of(occurrence.path), range=range_at(text, occurrence.start, occurrence.end))

    def workspace_edit(self, behavior: OpenBehavior, occurrences: Sequence[SymbolOccurrence]) -> lsp.WorkspaceEdit:
        changes: dict[str, list[lsp.TextEdit]] = {}
        for occurrence in occurrences:
            text = self.text(behavior, occurrence.path)
            edit = lsp.TextEdit(range=range_at(text, occurrence.start, occurrence.end), new_text=occurrence.text)
            changes.setdefault(uri_of(occurrence.path), []).append(edit)
        return lsp.WorkspaceEdit(changes=changes)

    def text(self, behavior: OpenBehavior, path: Path) -> str:
        parsed = behavior.source.files.get(path)
        return parsed.tokens.text if parsed else self._texts().get(path, "")

    def _texts(self) -> dict[Path, str]:
        return {path_of(uri): document.source for uri, document in self.workspace.text_documents.items()}


def _has_agents(behavior: OpenBehavior) -> bool:
    files = behavior.source.files.values()
    return any(isinstance(item, tree.AgentNode) for parsed in files for item in parsed.file.body)


def diagnostic(finding: Finding, folder: Path, text: str) -> lsp.Diagnostic:
    location = finding.location
    assert location
    start = finding_offset(text, location)
    related = [
        lsp.DiagnosticRelatedInformation(
            location=lsp.Location(
                uri=uri_of((folder / note.location.file).resolve()),
                range=_simple_range(note.location.line, note.location.column, note.location.length),
            ),
            message=note.message,
        )
        for note in finding.notes
        if note.location
    ]
    return lsp.Diagnostic(
        range=range_at(text, start, start + location.length),
        message=finding.message + (f"; {finding.fix}" if finding.fix else ""),
        severity=_SEVERITIES[finding.severity],
        code=finding.rule.code,
        source="vicode",
        related_information=related or None,
    )


def _simple_range(line: int, column: int, length: int) -> lsp.Range:
    return lsp.Range(lsp.Position(line - 1, column - 1), lsp.Position(line - 1, column - 1 + length))


def finding_offset(text: str, location: SourceLocation) -> int:
    """The offset of a finding, whose lines end with line feeds only."""
    start = 0
    for _ in range(location.line - 1):
        start = text.find("\n", start) + 1
    return start + location.column - 1
