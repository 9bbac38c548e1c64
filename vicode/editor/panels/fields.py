"""Form fields that show one value of the design and change it, without disturbing who types in them."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, cast

from nicegui import ui
from nicegui.elements.mixins.disableable_element import DisableableElement
from nicegui.elements.mixins.value_element import ValueElement

from vicode.editor.panels.desk import Desk
from vicode.editor.panels.text_input import TextInput
from vicode.editor.session.keystrokes import Shown
from vicode.editor.session.outline import is_same_place
from vicode.editor.session.wording import words_of_path
from vicode.findings import Finding, Path
from vicode.model.design import Design

Read = Callable[[Design], Any]
Write = Callable[[Design, Any], Design]
Refuse = Callable[[Any], str]
Options = Callable[[Design], Sequence[str]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Bound:
    """What a field shows and changes. `path` leads to the value in the design, for findings and undo labels.

    Where the names in a path may change while the field stays, `path_in` tells it of a design. `refuse` says in
    words why a value cannot be taken over, nothing if it can.
    """

    label: str
    read: Read
    write: Write
    path: Path = ()
    hint: str = ""
    refuse: Refuse = field(default=lambda _value: "")
    path_in: Callable[[Design], Path] | None = None

    def place_in(self, design: Design) -> Path:
        """Where the value stands in a design."""
        return self.path_in(design) if self.path_in else self.path


@dataclass(eq=False)
class Field:
    """A field on the screen; `refresh` shows the design's value unless somebody is typing in it."""

    desk: Desk
    bound: Bound
    element: ValueElement[Any]
    message: ui.label | None = None
    has_focus: bool = False
    refused: str = ""
    """Why what stands in the field is not in the design."""
    _refused_beside: Any = None
    _browser: Shown = field(default_factory=Shown)
    _shown_in: Design | None = None

    def __post_init__(self) -> None:
        """Watch for typing."""
        self.element.on("focus", lambda: self.focus(has_focus=True))
        self.element.on("blur", lambda: self.focus(has_focus=False))
        self.element.on_value_change(lambda event: self._typed(event.value))
        if isinstance(self.element, TextInput):
            self.element.on_heard = self._hear
        self.refresh()

    def refresh(self) -> None:
        """Show what the design holds, and what is wrong with it."""
        value = self.bound.read(self.desk.design)
        # What was refused stays to be mended, until the design itself has another value.
        if self.refused and value != self._refused_beside:
            self.refused = ""
        if not self.has_focus and not self.refused:
            self._shown_in = self.desk.design
            if self.element.value != value:
                self.element.set_value(value)
            self._note_shown(value)
        if self.message is not None:
            self._show_findings(self.message)

    def focus(self, *, has_focus: bool) -> None:
        """Note whether somebody is typing here, and let the others know."""
        self.has_focus = has_focus
        self.desk.company.turn(self.desk.window, typing_in=self.path if has_focus else ())
        if not has_focus:
            self.refresh()

    @property
    def path(self) -> Path:
        """Where the value stands in the design as it is now."""
        return self.bound.place_in(self.desk.design)

    def go_on_from(self, old: "Field", told: str = "") -> None:
        """Hear what is typed as a change of what the field before showed, to which others may have added since.

        What the field before has `told` is noted there: it may tell more, or the same once more.
        """
        self._browser.go_on_from(old._browser)
        if told and not self.bound.refuse(told):
            old._browser.keystrokes.sent(told, self._spelled(told))

    def hear_late(self, text: str) -> None:
        """Take over what was typed into the field that stood here before."""
        self.element.set_value(text)

    def write_late(self, text: str) -> None:
        """Take over what was typed here, though the form shows another thing by now."""
        now = self.bound.read(self.desk.design)
        if self.leads_there() and not self.bound.refuse(text) and text != now:
            wanted = self._browser.keystrokes.bring_in(text, now)
            self._browser.keystrokes.sent(text, self._spelled(text))
            self.desk.edit(f"edit {words_of_path(self.path)}", lambda design: self.bound.write(design, wanted))

    def _note_shown(self, value: Any) -> None:
        number = self.element.number if isinstance(self.element, TextInput) else 0
        self._browser.show(value, number)

    def _hear(self, number: int, text: str) -> None:
        """Note what the browser showed when a text was typed, of all that it was sent."""
        self._browser.typed_on(number)
        if text == self.element.value and self.leads_there() and not self.bound.refuse(text):
            # Nothing else will: another one has made the same of it.
            self._browser.keystrokes.sent(text, self._spelled(text))

    def _spelled(self, value: Any) -> Any:
        """What the design would hold if the value alone was written."""
        return self.bound.read(self.bound.write(self.desk.design, value))

    def leads_there(self) -> bool:
        """Whether the path still leads to what the field was made for: nothing was put before it, or taken away."""
        before, now = self._shown_in, self.desk.design
        return before is now or (before is not None and is_same_place(before, now, self.bound.place_in(before)))

    def other_findings(self) -> list[Finding]:
        """What is wrong with the value though it does not stand in the design."""
        return []

    def _typed(self, value: Any) -> None:
        now = self.bound.read(self.desk.design)
        self.refused, self._refused_beside = self.bound.refuse(value), now
        if self.refused or value == now:
            if value == now:
                self._note_shown(now)
            self.refresh()
            return
        if not self.leads_there():
            # It would go into what stands there now.
            self.desk.say("Somebody else changed the order here just now: look again", "warning")
            return
        wanted = self._browser.keystrokes.bring_in(value, now)
        write, key = self.bound.write, "/".join(map(str, self.path)) + self.bound.label
        # Noted before the edit is told to all fields, this one among them.
        self._browser.keystrokes.sent(value, self._spelled(value))
        self.desk.edit(f"edit {words_of_path(self.path)}", lambda design: write(design, wanted), typing_in=key)
        self._shown_in = self.desk.design

    def _show_findings(self, message: ui.label) -> None:
        found = findings_at(self.path, self.desk.document.findings)
        words = [f"{each.message}{f' ({each.mend})' if each.mend else ''}" for each in (*found, *self.other_findings())]
        names = self.desk.company.typing_at(self.path, self.desk.window)
        others = [f"{' and '.join(names)} {'types' if len(names) == 1 else 'type'} here too"] if names else []
        text = " · ".join(([self.refused] if self.refused else words) + others)
        if message.text != text:
            message.set_text(text)
            message.set_visibility(bool(text))
        is_wrong = bool(self.refused or words)
        self.element.classes(add="has-finding" if is_wrong else None, remove=None if is_wrong else "has-finding")
        message.classes(add=None if is_wrong else "is-news", remove="is-news" if is_wrong else None)


def findings_at(path: Path, findings: Iterable[Finding]) -> list[Finding]:
    """The findings about what stands at a path, or in it."""
    return [
        finding
        for finding in findings
        if path and finding.thing is not None and finding.thing.path[: len(path)] == path
    ]


def text_field(desk: Desk, bound: Bound, *, monospace: bool = False, lines: bool = False) -> Field:
    """A text in a line, or in as many as it needs; its findings stand below."""
    with ui.column().classes("field"):
        element = TextInput(bound.label, placeholder=bound.hint, lines=lines, monospace=monospace)
        element.props("debounce=250")
        message = ui.label().classes("field-finding")
        message.set_visibility(False)
    return Field(desk, bound, element, message)


def choice_field(desk: Desk, bound: Bound, options: Options, *, several: bool = False) -> Field:
    """One, or several, of the design's options; what the design holds can always be chosen, known or not."""
    if not several:
        bound = _none_for_empty(bound)
    with ui.column().classes("field"):
        element = ui.select(
            list(options(desk.design)), label=bound.label, multiple=several, value=[] if several else None
        )
        element.props("outlined dense options-dense stack-label" + (" use-chips" if several else ""))
        message = ui.label().classes("field-finding")
        message.set_visibility(False)
    return ChoiceField(desk, bound, element, message, options=options)


def _none_for_empty(bound: Bound) -> Bound:
    """The same value, None where it is empty: a choice of one shows nothing as None."""
    return replace(
        bound,
        read=lambda design: bound.read(design) or None,
        write=lambda design, value: bound.write(design, value or ""),
    )


@dataclass(eq=False)
class ChoiceField(Field):
    """A choice; without the design's value among its options it would choose something else by itself."""

    options: Options = field(default=lambda _design: ())

    def refresh(self) -> None:
        """Show what the design holds, and what it offers."""
        if self.has_focus:
            super().refresh()
            return
        design, element = self.desk.design, cast("ui.select", self.element)
        wanted = list(dict.fromkeys([*self.options(design), *_listed(self.bound.read(design))]))
        self._offer([*wanted, *(each for each in _listed(element.value) if each not in wanted)])
        super().refresh()
        self._offer(wanted)

    def _offer(self, options: list[str]) -> None:
        element = cast("ui.select", self.element)
        if element.options != options:
            element.set_options(options)


def _listed(value: Any) -> list[str]:
    return value if isinstance(value, list) else [value] if value else []


def state_names(design: Design) -> list[str]:
    """What a choice among states offers."""
    return [state.name for state in design.states]


def flag_field(desk: Desk, bound: Bound) -> Field:
    """Yes or no."""
    return Field(desk, bound, ui.checkbox(bound.label).props("dense"))


def enable(element: DisableableElement, *, flag: bool) -> None:
    """Enable or disable a button, only sending what changed."""
    if element.enabled != flag:
        element.set_enabled(flag)
