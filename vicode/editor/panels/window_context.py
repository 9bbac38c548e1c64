"""The state shared by the panels of one window: the open design, the selection, and the services of the page."""

from collections.abc import Callable, Coroutine
from dataclasses import dataclass, field
from typing import Any, Protocol

from nicegui import Client, background_tasks

from vicode.editor.panels.code.code_editor import CodeEditorFactory
from vicode.editor.panels.code.code_linter import CodeLinter
from vicode.editor.panels.toasts import show_toast
from vicode.editor.session import DocumentSession, PresenceRoom, Workspace
from vicode.editor.session.external_editor import ExternalEditor
from vicode.editor.session.gestures.delivery import Inbox
from vicode.editor.view import ItemRef
from vicode.model.design import Design
from vicode.subscribers import Subscribers


class PageServices(Protocol):
    """What panels ask of their page."""

    def reveal(self, item: ItemRef) -> None:
        """Scroll the canvas to an item."""

    def run_canvas_command(self, command: str) -> None: ...

    def open_component(self, component: str) -> None: ...

    def offer_undo(self, text: str, undo: Callable[[], object]) -> None:
        """Show a message about a change of files, with an undo button."""

    async def view_run(self, trace: str) -> None:
        """View a recorded run of the design in Simulate."""

    def recover_work(self, is_continued: bool) -> None:
        """Offer unsaved work that a killed server has left; recover that of the design if its user was typing then."""


@dataclass(eq=False, kw_only=True)
class WindowContext:
    """The state shared by the panels of one window."""

    workspace: Workspace
    document: DocumentSession
    client: Client
    """The client of this window. Handlers use it after an edit, as their own button may be deleted by then."""
    page: PageServices
    inbox: Inbox
    external_editor: ExternalEditor = field(default_factory=ExternalEditor)
    selected: tuple[ItemRef, ...] = ()
    selection_seq: int = 0
    """The number of the browser's latest selection, from 1."""
    is_opening: bool = False
    """Whether the form of the selected item takes the focus when it is shown."""
    open_sections: set[str] = field(default_factory=set)
    """Keys of the open sections of forms."""
    code_language: str = ""
    """The language whose tab was chosen last."""
    code_editors: CodeEditorFactory = field(default_factory=CodeEditorFactory)
    linter: CodeLinter = field(init=False)
    changes: Subscribers[[]] = field(default_factory=Subscribers)
    """Called after each change of design or selection."""
    disconnects: Subscribers[[]] = field(default_factory=Subscribers)
    """Called when the browser loses the connection."""
    closings: Subscribers[[]] = field(default_factory=Subscribers)
    """Called once, when the window shows another design or is closed."""
    is_closed: bool = field(init=False, default=False)

    def __post_init__(self) -> None:
        self.linter = CodeLinter(self.workspace, self.document)

    @property
    def window(self) -> str:
        """The id of this window in the presence room."""
        return self.client.id

    @property
    def design(self) -> Design:
        return self.document.design

    @property
    def presence(self) -> PresenceRoom:
        return self.document.shared.presence

    @property
    def single_selection(self) -> ItemRef | None:
        """The selected item if exactly one is selected."""
        return self.selected[0] if len(self.selected) == 1 else None

    def edit(self, label: str, change: Callable[[Design], Design]) -> None:
        """Apply an edit to the design, for all windows."""
        self.document.edit(label, change)

    def select(self, *items: ItemRef) -> None:
        if self.selected != items:
            self.selected = items
            self.notify_subscribers()

    def show(self, item: ItemRef) -> None:
        """Select an item, and make it visible; the design is shown without a selection."""
        self.select(*(() if item.kind == "design" else (item,)))
        self.page.reveal(item)

    def notify_subscribers(self) -> None:
        """Call all subscribers in the client of this window."""
        if not self.is_closed:
            with self.client:
                self.changes.notify()

    def close(self) -> None:
        """Release what the panels subscribed to; work in the background may still edit the design."""
        if not self.is_closed:
            self.is_closed = True
            self.closings.notify()

    def run_in_background(self, work: Coroutine[Any, Any, object], name: str) -> None:
        """Run a coroutine as a task of this window; the page reports its exceptions."""
        background_tasks.create(work, name=name, context=self.client)

    def show_toast(self, text: str, kind: str) -> None:
        """Show a short message; `kind` is positive, negative, info or warning."""
        with self.client:
            show_toast(text, kind)
