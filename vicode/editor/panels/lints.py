"""What the linter says of the open design's Python, asked beside the event loop while somebody looks at code."""

from typing import Protocol
from weakref import WeakSet

from nicegui import background_tasks, run

from vicode.editor.session.document import Document
from vicode.editor.session.linting import Lint, Lints, lint_design
from vicode.editor.session.workspace import Workspace
from vicode.findings import Path
from vicode.model.texts import walk_texts


class Follower(Protocol):
    """A field that shows remarks."""

    @property
    def is_gone(self) -> bool:
        """Whether it is on no page any more."""

    def refresh(self) -> None:
        """Show what there is now."""


class CodeLints:
    """The remarks for one window; asked anew when the design has changed, the newest answer counts."""

    def __init__(self, workspace: Workspace, document: Document) -> None:
        """Nothing is known yet, and nothing is asked before a field follows."""
        self._workspace, self._document = workspace, document
        self._followers: WeakSet[Follower] = WeakSet()
        self._found: Lints = {}
        self._texts: dict[Path, str] = {}
        self._linted_rev = -1
        self._is_busy = False

    def follow(self, follower: Follower) -> None:
        """Refresh a field whenever there are new remarks, as long as it lives."""
        self._followers.add(follower)

    def of(self, path: Path, text: str) -> tuple[Lint, ...]:
        """The remarks on the code at a path, if they were made of this very text; asks for newer ones if it is time."""
        self._ask()
        return self._found.get(path, ()) if self._texts.get(path) == text else ()

    def _ask(self) -> None:
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
                self._texts = {each.path: each.text for each in walk_texts(design) if each.language == "python"}
        finally:
            self._is_busy = False
        for follower in tuple(self._followers):
            if not follower.is_gone:
                follower.refresh()
