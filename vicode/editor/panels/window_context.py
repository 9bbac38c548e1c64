"""The state shared by the panels of one window: the open design, the selection, and the services of the page."""

from collections.abc import Callable, Coroutine
from dataclasses import dataclass, field
from typing import Any

from nicegui import Client, background_tasks

from vicode.editor.panels.code_editor import CodeEditorFactory
from vicode.editor.panels.code_linter import CodeLinter
from vicode.editor.panels.toasts import show_toast
from vicode.editor.session import DocumentSession, PresenceRoom, Workspace
from vicode.editor.view import ItemRef
from vicode.model.design import Design

ChangeListener = Callable[[], None]


@dataclass(eq=False, kw_only=True)
class WindowContext:
    """What the panels of one window share: the open design, and what this window has selected."""

    workspace: Workspace
    document: DocumentSession
    client: Client
    """The page of this window. What a handler does after an edit is done here: its own button may be gone by then."""
    reveal: Callable[[ItemRef], None] = field(default=lambda _thing: None)
    """Bring a thing into the middle of the canvas."""
    run_canvas_command: Callable[[str], None] = field(default=lambda _command: None)
    """Do what a command of the canvas does, by its name."""
    open_component: Callable[[str], None] = field(default=lambda _component: None)
    """Open the design of another component."""
    offer_undo: Callable[[str, Callable[[], object]], None] = field(default=lambda _words, _act: None)
    """Say what was done to files, with a button that takes it back."""
    is_shown: Callable[[ItemRef], bool] = field(default=lambda _thing: True)
    """Whether a thing is in the drawing."""
    selected: tuple[ItemRef, ...] = ()
    open_sections: set[str] = field(default_factory=set)
    """The folds of forms that this window has opened."""
    code_editors: CodeEditorFactory = field(default_factory=CodeEditorFactory)
    linter: CodeLinter = field(init=False)
    _listeners: list[ChangeListener] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Be ready to ask for remarks on code."""
        self.linter = CodeLinter(self.workspace, self.document)

    @property
    def window(self) -> str:
        """The id of this window among those on the design."""
        return self.client.id

    @property
    def design(self) -> Design:
        """The design as it is now."""
        return self.document.design

    @property
    def presence(self) -> PresenceRoom:
        """Who else has the design open."""
        return self.document.shared.presence

    @property
    def single_selection(self) -> ItemRef | None:
        """The one selected thing, None for none or several."""
        return self.selected[0] if len(self.selected) == 1 else None

    def edit(self, label: str, change: Callable[[Design], Design], *, coalesce_key: str = "") -> None:
        """Change the design (all windows follow)."""
        self.document.edit(label, change, coalesce_key=coalesce_key)

    def select(self, *things: ItemRef) -> None:
        """Select exactly these."""
        if self.selected != things:
            self.selected = things
            self.notify_listeners()

    def subscribe(self, listener: ChangeListener) -> Callable[[], None]:
        """Call `listener` after every change of the design or the selection; what is returned ends it."""
        self._listeners.append(listener)

        def stop() -> None:
            if listener in self._listeners:
                self._listeners.remove(listener)

        return stop

    def notify_listeners(self) -> None:
        """Bring every panel up to date."""
        with self.client:
            for listener in tuple(self._listeners):
                listener()

    def run_in_background(self, work: Coroutine[Any, Any, object], name: str) -> None:
        """Do what takes longer beside the event loop's other work; if it fails, the person is told."""
        background_tasks.create(work, name=name, context=self.client)

    def show_toast(self, text: str, kind: str) -> None:
        """Show a short message; `kind` is positive, negative, info or warning."""
        with self.client:
            show_toast(text, kind)
