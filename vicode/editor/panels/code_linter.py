"""What the linter says of the open design's Python, asked beside the event loop while somebody looks at code."""

from typing import Protocol
from weakref import WeakSet

from nicegui import background_tasks, run

from vicode.editor.session.document import DocumentSession
from vicode.editor.session.lint import LintWarning, LintWarnings, lint_design
from vicode.editor.session.workspace import Workspace
from vicode.findings import DesignPath
from vicode.model.texts import iter_texts


class LintSubscriber(Protocol):
    """A field that shows remarks."""

    @property
    def is_deleted(self) -> bool:
        """Whether it is on no page any more."""

    def refresh(self) -> None:
        """Show what there is now."""


class CodeLinter:
    """The remarks for one window; asked anew when the design has changed, the newest answer counts."""

    def __init__(self, workspace: Workspace, document: DocumentSession) -> None:
        """Nothing is known yet, and nothing is asked before a field follows."""
        self._workspace, self._document = workspace, document
        self._subscribers: WeakSet[LintSubscriber] = WeakSet()
        self._found: LintWarnings = {}
        self._texts: dict[DesignPath, str] = {}
        self._linted_rev = -1
        self._is_busy = False

    def subscribe(self, follower: LintSubscriber) -> None:
        """Refresh a field whenever there are new remarks, as long as it lives."""
        self._subscribers.add(follower)

    def lints_for(self, path: DesignPath, text: str) -> tuple[LintWarning, ...]:
        """The remarks on the code at a path, if they were made of this very text; asks for newer ones if it is time."""
        self._lint_if_needed()
        return self._found.get(path, ()) if self._texts.get(path) == text else ()

    def _lint_if_needed(self) -> None:
        if not self._is_busy and self._linted_rev != self._document.rev:
            self._is_busy = True
            background_tasks.create(self._lint(), name="lint")

    async def _lint(self) -> None:
        try:
            while self._linted_rev != self._document.rev:
                self._linted_rev, design = self._document.rev, self._document.design
                found = await run.io_bound(lint_design, self._workspace.project, design)
                # Nothing comes back while the server is shutting down.
                if found is None:
                    return
                self._found = found
                self._texts = {each.path: each.text for each in iter_texts(design) if each.language == "python"}
        finally:
            self._is_busy = False
        for follower in tuple(self._subscribers):
            if not follower.is_deleted:
                follower.refresh()
