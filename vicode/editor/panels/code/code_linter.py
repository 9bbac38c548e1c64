"""Runs the linter on the Python code of the open design, in a thread, while code fields are shown."""

from nicegui import background_tasks, run

from vicode.editor.session.document import DocumentSession
from vicode.editor.session.workspace import Workspace
from vicode.findings import DesignPath
from vicode.model.texts import iter_texts
from vicode.services.lint import LintWarning, LintWarnings, lint_design
from vicode.subscribers import Subscribers


class CodeLinter:
    """The lint warnings of one window, updated when the design has changed.

    Subscribers of `changes` are called after each update.
    """

    def __init__(self, workspace: Workspace, document: DocumentSession) -> None:
        self._workspace, self._document = workspace, document
        self.changes: Subscribers[[]] = Subscribers()
        self._warnings: LintWarnings = {}
        self._texts: dict[DesignPath, str] = {}
        self._linted_rev = -1
        self._is_busy = False

    def lints_for(self, path: DesignPath, text: str) -> tuple[LintWarning, ...]:
        """Return the warnings for the code at a path, if they belong to this text; start the linter if necessary."""
        self._lint_if_needed()
        return self._warnings.get(path, ()) if self._texts.get(path) == text else ()

    def _lint_if_needed(self) -> None:
        if not self._is_busy and self._linted_rev != self._document.rev:
            self._is_busy = True
            background_tasks.create(self._lint(), name="lint")

    async def _lint(self) -> None:
        try:
            while self._linted_rev != self._document.rev:
                self._linted_rev, design = self._document.rev, self._document.design
                warnings = await run.io_bound(lint_design, self._workspace.project, design)
                # The result is None while the server shuts down.
                if warnings is None:
                    return
                self._warnings = warnings
                self._texts = {item.path: item.text for item in iter_texts(design) if item.language == "python"}
        finally:
            self._is_busy = False
        self.changes.notify()
