"""A desk: one browser window at work on one design. Panels read it, edit through it, and are told of changes."""

from collections.abc import Callable, Coroutine
from dataclasses import dataclass, field
from typing import Any

from nicegui import Client, background_tasks

from vicode.editor.panels.code_editor import CodeEditors
from vicode.editor.panels.lints import CodeLints
from vicode.editor.panels.messages import say
from vicode.editor.session import Company, Document, Workspace
from vicode.editor.view import Selected
from vicode.model.design import Design

Listener = Callable[[], None]


@dataclass(eq=False, kw_only=True)
class Desk:
    """What the panels of one window share: the open design, and what this window has selected."""

    workspace: Workspace
    document: Document
    client: Client
    """The page of this window. What a handler does after an edit is done here: its own button may be gone by then."""
    reveal: Callable[[Selected], None] = field(default=lambda _thing: None)
    """Bring a thing into the middle of the canvas."""
    run: Callable[[str], None] = field(default=lambda _command: None)
    """Do what a command of the canvas does, by its name."""
    open: Callable[[str], None] = field(default=lambda _component: None)
    """Open the design of another component."""
    offer_undo: Callable[[str, Callable[[], object]], None] = field(default=lambda _words, _act: None)
    """Say what was done to files, with a button that takes it back."""
    is_there: Callable[[Selected], bool] = field(default=lambda _thing: True)
    """Whether a thing is in the drawing."""
    selected: tuple[Selected, ...] = ()
    open_folds: set[str] = field(default_factory=set)
    """The folds of forms that this window has opened."""
    code_editors: CodeEditors = field(default_factory=CodeEditors)
    lints: CodeLints = field(init=False)
    _listeners: list[Listener] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Be ready to ask for remarks on code."""
        self.lints = CodeLints(self.workspace, self.document)

    @property
    def window(self) -> str:
        """The id of this window among those on the design."""
        return self.client.id

    @property
    def design(self) -> Design:
        """The design as it is now."""
        return self.document.design

    @property
    def company(self) -> Company:
        """Who else has the design open."""
        return self.document.sheet.company

    @property
    def only(self) -> Selected | None:
        """The one selected thing, None for none or several."""
        return self.selected[0] if len(self.selected) == 1 else None

    def edit(self, label: str, change: Callable[[Design], Design], *, typing_in: str = "") -> None:
        """Change the design (all windows follow)."""
        self.document.edit(label, change, typing_in=typing_in)

    def select(self, *things: Selected) -> None:
        """Select exactly these."""
        if self.selected != things:
            self.selected = things
            self.tell()

    def listen(self, listener: Listener) -> Callable[[], None]:
        """Call `listener` after every change of the design or the selection; what is returned ends it."""
        self._listeners.append(listener)

        def stop() -> None:
            if listener in self._listeners:
                self._listeners.remove(listener)

        return stop

    def tell(self) -> None:
        """Bring every panel up to date."""
        with self.client:
            for listener in tuple(self._listeners):
                listener()

    def begin(self, work: Coroutine[Any, Any, object], name: str) -> None:
        """Do what takes longer beside the event loop's other work; if it fails, the person is told."""
        background_tasks.create(work, name=name, context=self.client)

    def say(self, text: str, kind: str) -> None:
        """Show a short message; `kind` is positive, negative, info or warning."""
        with self.client:
            say(text, kind)
