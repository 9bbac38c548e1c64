"""One open design: its history, what is wrong with it, who watches it."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from vicode.editor.session.history import History, Step
from vicode.editor.view import path_of_key
from vicode.findings import Finding
from vicode.model.design import Design
from vicode.model.walks import decision_at

Watcher = Callable[["Document"], None]
Checker = Callable[[Design], tuple[Finding, ...]]


@dataclass(eq=False, kw_only=True)
class Document:
    """An open design. Every change goes through `edit`, `undo` or `redo`; watchers are told after each.

    `rev` counts the changes. `disk_text` is the text last read from or written to `file`, `reading` what is wrong
    with it: keys that mean nothing are not in the design, but they are in the file.
    """

    file: Path
    disk_text: str
    saved: Design
    check: Checker
    reading: tuple[Finding, ...] = ()
    history: History = field(init=False)
    findings: tuple[Finding, ...] = field(init=False, default=())
    rev: int = field(init=False, default=0)
    _watchers: list[Watcher] = field(init=False, default_factory=list)
    _typing_in: str = field(init=False, default="")

    def __post_init__(self) -> None:
        """Begin with what is on disk."""
        self.history = History(present=Step(label="open", design=self.saved))
        self.findings = self._find(self.saved)

    @property
    def design(self) -> Design:
        """The design as it is now."""
        return self.history.present.design

    @property
    def is_saved(self) -> bool:
        """Whether the file holds the design as it is now."""
        return self.design == self.saved

    def edit(self, label: str, change: Callable[[Design], Design], *, typing_in: str = "") -> None:
        """Change the design; `label` names the edit in the history.

        Edits that follow each other with the same `typing_in` (a field being typed in) are one step of it.
        """
        design = change(self.design)
        goes_on = bool(typing_in) and typing_in == self._typing_in and design != self.design
        self._become(self.history.replaced(design) if goes_on else self.history.then(label, design))
        self._typing_in = typing_in

    def undo(self) -> None:
        """Take the last edit back."""
        self._typing_in = ""
        self._become(self.history.undone())

    def redo(self) -> None:
        """Do again what undo took back."""
        self._typing_in = ""
        self._become(self.history.redone())

    def mark_saved(self, text: str, reading: tuple[Finding, ...] = ()) -> None:
        """Note that the design as it is now stands in the file as `text`."""
        self.saved, self.disk_text, self.reading = self.design, text, reading
        self.findings = self._find(self.design)
        self._tell()

    def reload(self, design: Design, text: str, reading: tuple[Finding, ...] = ()) -> None:
        """Take what the file holds now; the edits made here stay in the history."""
        self.saved, self.disk_text, self.reading = design, text, reading
        self._become(self.history.then("reload from disk", design))
        self._tell()

    def has_decision(self, key: str) -> bool:
        """Whether there is a decision with this canvas id."""
        return decision_at(self.design, path_of_key(key)) is not None

    def check_again(self) -> None:
        """Check once more, because another design of the project has changed."""
        findings = self._find(self.design)
        if findings != self.findings:
            self.findings = findings
            self._tell()

    def watch(self, watcher: Watcher) -> Callable[[], None]:
        """Tell `watcher` after every change; what is returned ends it."""
        self._watchers.append(watcher)

        def unwatch() -> None:
            if watcher in self._watchers:
                self._watchers.remove(watcher)

        return unwatch

    def _become(self, history: History) -> None:
        if history is self.history:
            return
        self.history = history
        self.rev += 1
        self.findings = self._find(self.design)
        self._tell()

    def _find(self, design: Design) -> tuple[Finding, ...]:
        return tuple(dict.fromkeys((*self.reading, *self.check(design))))

    def _tell(self) -> None:
        for watcher in tuple(self._watchers):
            watcher(self)
