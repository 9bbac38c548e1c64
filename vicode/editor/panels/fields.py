"""Form fields that show one value of the design and change it, without disturbing who types in them."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, cast

from nicegui import ui
from nicegui.elements.mixins.disableable_element import DisableableElement
from nicegui.elements.mixins.value_element import ValueElement

from vicode.editor.panels.text_input import TextInput
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.descriptions import describe_path
from vicode.editor.session.field_merge import SentValues
from vicode.editor.session.form_key import has_same_structure
from vicode.findings import DesignPath, Finding
from vicode.model.design import Design

ReadValue = Callable[[Design], Any]
WriteValue = Callable[[Design, Any], Design]
Validate = Callable[[Any], str]
ListOptions = Callable[[Design], Sequence[str]]


@dataclass(frozen=True, slots=True, kw_only=True)
class FieldBinding:
    """What a field shows and changes. `path` leads to the value in the design, for findings and undo labels.

    Where the names in a path may change while the field stays, `get_path` tells it of a design. `validate` says in
    words why a value cannot be taken over, nothing if it can.
    """

    label: str
    read: ReadValue
    write: WriteValue
    path: DesignPath = ()
    hint: str = ""
    validate: Validate = field(default=lambda _value: "")
    get_path: Callable[[Design], DesignPath] | None = None

    def locate(self, design: Design) -> DesignPath:
        """Where the value stands in a design."""
        return self.get_path(design) if self.get_path else self.path


@dataclass(eq=False)
class Field:
    """A field on the screen; `refresh` shows the design's value unless somebody is typing in it."""

    context: WindowContext
    binding: FieldBinding
    element: ValueElement[Any]
    message: ui.label | None = None
    has_focus: bool = False
    error: str = ""
    """Why what stands in the field is not in the design."""
    _value_at_error: Any = None
    _browser_state: SentValues = field(default_factory=SentValues)
    _shown_design: Design | None = None

    def __post_init__(self) -> None:
        """Watch for typing."""
        self.element.on("focus", lambda: self.focus(has_focus=True))
        self.element.on("blur", lambda: self.focus(has_focus=False))
        self.element.on_value_change(lambda event: self._on_typed(event.value))
        if isinstance(self.element, TextInput):
            self.element.on_browser_text = self._on_browser_text
        self.refresh()

    def refresh(self) -> None:
        """Show what the design holds, and what is wrong with it."""
        value = self.binding.read(self.context.design)
        # What was refused stays to be mended, until the design itself has another value.
        if self.error and value != self._value_at_error:
            self.error = ""
        if not self.has_focus and not self.error:
            self._shown_design = self.context.design
            if self.element.value != value:
                self.element.set_value(value)
            self._record_shown(value)
        if self.message is not None:
            self._show_findings(self.message)

    def focus(self, *, has_focus: bool) -> None:
        """Note whether somebody is typing here, and let the others know."""
        self.has_focus = has_focus
        self.context.presence.update(self.context.window, editing_path=self.path if has_focus else ())
        if not has_focus:
            self.refresh()

    @property
    def path(self) -> DesignPath:
        """Where the value stands in the design as it is now."""
        return self.binding.locate(self.context.design)

    def transfer_input_from(self, old: "Field", sent_text: str = "") -> None:
        """Hear what is typed as a change of what the field before showed, to which others may have added since.

        What the field before has `sent_text` is noted there: it may tell more, or the same once more.
        """
        self._browser_state.transfer_input_from(old._browser_state)
        if sent_text and not self.binding.validate(sent_text):
            old._browser_state.field_merge.record_sent(sent_text, self._normalize(sent_text))

    def apply_delayed_input(self, text: str) -> None:
        """Take over what was typed into the field that stood here before."""
        self.element.set_value(text)

    def commit_delayed_input(self, text: str) -> None:
        """Take over what was typed here, though the form shows another thing by now."""
        now = self.binding.read(self.context.design)
        if self.is_path_valid() and not self.binding.validate(text) and text != now:
            wanted = self._browser_state.field_merge.merge_typed(text, now)
            self._browser_state.field_merge.record_sent(text, self._normalize(text))
            self.context.edit(f"edit {describe_path(self.path)}", lambda design: self.binding.write(design, wanted))

    def _record_shown(self, value: Any) -> None:
        number = self.element.server_seq if isinstance(self.element, TextInput) else 0
        self._browser_state.record_shown(value, number)

    def _on_browser_text(self, number: int, text: str) -> None:
        """Note what the browser showed when a text was typed, of all that it was sent."""
        self._browser_state.select_base(number)
        if text == self.element.value and self.is_path_valid() and not self.binding.validate(text):
            # Nothing else will: another one has made the same of it.
            self._browser_state.field_merge.record_sent(text, self._normalize(text))

    def _normalize(self, value: Any) -> Any:
        """What the design would hold if the value alone was written."""
        return self.binding.read(self.binding.write(self.context.design, value))

    def is_path_valid(self) -> bool:
        """Whether the path still leads to what the field was made for: nothing was put before it, or taken away."""
        before, now = self._shown_design, self.context.design
        return before is now or (before is not None and has_same_structure(before, now, self.binding.locate(before)))

    def other_findings(self) -> list[Finding]:
        """What is wrong with the value though it does not stand in the design."""
        return []

    def _on_typed(self, value: Any) -> None:
        now = self.binding.read(self.context.design)
        self.error, self._value_at_error = self.binding.validate(value), now
        if self.error or value == now:
            if value == now:
                self._record_shown(now)
            self.refresh()
            return
        if not self.is_path_valid():
            # It would go into what stands there now.
            self.context.show_toast("Somebody else changed the order here just now: look again", "warning")
            return
        wanted = self._browser_state.field_merge.merge_typed(value, now)
        write, key = self.binding.write, "/".join(map(str, self.path)) + self.binding.label
        # Noted before the edit is told to all fields, this one among them.
        self._browser_state.field_merge.record_sent(value, self._normalize(value))
        self.context.edit(f"edit {describe_path(self.path)}", lambda design: write(design, wanted), coalesce_key=key)
        self._shown_design = self.context.design

    def _show_findings(self, message: ui.label) -> None:
        found = findings_at(self.path, self.context.document.findings)
        words = [f"{each.message}{f' ({each.fix})' if each.fix else ''}" for each in (*found, *self.other_findings())]
        names = self.context.presence.names_editing(self.path, self.context.window)
        others = [f"{' and '.join(names)} {'types' if len(names) == 1 else 'type'} here too"] if names else []
        text = " · ".join(([self.error] if self.error else words) + others)
        if message.text != text:
            message.set_text(text)
            message.set_visibility(bool(text))
        is_wrong = bool(self.error or words)
        self.element.classes(add="has-finding" if is_wrong else None, remove=None if is_wrong else "has-finding")
        message.classes(add=None if is_wrong else "is-info", remove="is-info" if is_wrong else None)


def findings_at(path: DesignPath, findings: Iterable[Finding]) -> list[Finding]:
    """The findings about what stands at a path, or in it."""
    return [
        finding
        for finding in findings
        if path and finding.subject is not None and finding.subject.path[: len(path)] == path
    ]


def text_field(
    context: WindowContext, binding: FieldBinding, *, monospace: bool = False, multiline: bool = False
) -> Field:
    """A text in a line, or in as many as it needs; its findings stand below."""
    with ui.column().classes("field"):
        element = TextInput(binding.label, placeholder=binding.hint, multiline=multiline, monospace=monospace)
        element.props("debounce=250")
        message = ui.label().classes("field-finding")
        message.set_visibility(False)
    return Field(context, binding, element, message)


def choice_field(
    context: WindowContext, binding: FieldBinding, options: ListOptions, *, multiple: bool = False
) -> Field:
    """One, or several, of the design's options; what the design holds can always be chosen, known or not."""
    if not multiple:
        binding = _none_for_empty(binding)
    with ui.column().classes("field"):
        element = ui.select(
            list(options(context.design)), label=binding.label, multiple=multiple, value=[] if multiple else None
        )
        element.props("outlined dense options-dense stack-label" + (" use-chips" if multiple else ""))
        message = ui.label().classes("field-finding")
        message.set_visibility(False)
    return ChoiceField(context, binding, element, message, options=options)


def _none_for_empty(binding: FieldBinding) -> FieldBinding:
    """The same value, None where it is empty: a choice of one shows nothing as None."""
    return replace(
        binding,
        read=lambda design: binding.read(design) or None,
        write=lambda design, value: binding.write(design, value or ""),
    )


@dataclass(eq=False)
class ChoiceField(Field):
    """A choice; without the design's value among its options it would choose something else by itself."""

    options: ListOptions = field(default=lambda _design: ())

    def refresh(self) -> None:
        """Show what the design holds, and what it offers."""
        if self.has_focus:
            super().refresh()
            return
        design, element = self.context.design, cast("ui.select", self.element)
        wanted = list(dict.fromkeys([*self.options(design), *_as_list(self.binding.read(design))]))
        self._set_options([*wanted, *(each for each in _as_list(element.value) if each not in wanted)])
        super().refresh()
        self._set_options(wanted)

    def _set_options(self, options: list[str]) -> None:
        element = cast("ui.select", self.element)
        if element.options != options:
            element.set_options(options)


def _as_list(value: Any) -> list[str]:
    return value if isinstance(value, list) else [value] if value else []


def state_names(design: Design) -> list[str]:
    """What a choice among states offers."""
    return [state.name for state in design.states]


def checkbox_field(context: WindowContext, binding: FieldBinding) -> Field:
    """Yes or no."""
    return Field(context, binding, ui.checkbox(binding.label).props("dense"))


def set_enabled(element: DisableableElement, *, flag: bool) -> None:
    """Enable or disable a button, only sending what changed."""
    if element.enabled != flag:
        element.set_enabled(flag)
