"""Form fields that show and change one value of the design, and keep text that the user is typing."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum, auto
from typing import Any, TypeVar, cast

from nicegui import ui
from nicegui.elements.mixins.disableable_element import DisableableElement
from nicegui.elements.mixins.value_element import ValueElement

from vicode.editor.panels import texts
from vicode.editor.panels.form import Form
from vicode.editor.panels.text_input import TextInput
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import number_text
from vicode.editor.session.field_merge import SentValues
from vicode.editor.session.item_paths import TrackedItem
from vicode.findings import DesignPath, Finding, Severity, worst_severity
from vicode.model.design import Design
from vicode.model.paths import describe_path

_SEVERITIES = " ".join(Severity)

ReadValue = Callable[[Design], Any]
WriteValue = Callable[[Design, Any], Design]
Validate = Callable[[Any], str]
ListOptions = Callable[[Design], Sequence[str]]


@dataclass(frozen=True, slots=True, kw_only=True)
class FieldBinding:
    """The value that a field shows and changes.

    `get_path` returns its current path, for findings and undo labels. `item` has the value; None if it is always there.
    `validate` returns an error message, or "" for a valid value.
    """

    label: str
    read: ReadValue
    write: WriteValue
    get_path: Callable[[], DesignPath] = tuple
    hint: str = ""
    validate: Validate = field(default=lambda _value: "")
    item: TrackedItem | None = None
    commit: Callable[[Any], str] | None = None
    """Applies a value that is not in the design; returns an error message, or "" on success."""


FieldT = TypeVar("FieldT", bound="Field")


class FieldKind(Enum):
    """How an attribute is shown."""

    TEXT = auto()
    LONG_TEXT = auto()
    CODE = auto()
    CHECKBOX = auto()


@dataclass(frozen=True, slots=True, kw_only=True)
class Attribute:
    """An attribute that a field shows and changes.

    `format` and `parse` convert the value, `validate` returns an error message or "". `key` is the key in the file if
    it differs from the name; `help` is shown below the field.
    """

    label: str
    name: str
    kind: FieldKind = FieldKind.CODE
    key: str = ""
    hint: str = ""
    help: str = ""
    format: Callable[[Any], Any] = lambda value: value
    parse: Callable[[Any], Any] = lambda value: value
    validate: Validate = lambda _value: ""


DOC = Attribute(label="Description", name="doc", kind=FieldKind.LONG_TEXT)
FREQUENCY = Attribute(
    label="Frequency, Hz",
    name="frequency_hz",
    key="frequency",
    hint="every step",
    format=number_text.format_number,
    parse=number_text.parse_frequency,
    validate=number_text.validate_frequency,
)
XABSL_NAME = Attribute(label="Name in XABSL", name="xabsl_name", parse=str.strip)


def attribute_binding(item: TrackedItem, attribute: Attribute) -> FieldBinding:
    name, format_ = attribute.name, attribute.format

    def read(design: Design) -> Any:
        owner = item.get(design)
        return format_(getattr(owner, name)) if owner is not None else ""

    def write(design: Design, value: Any) -> Design:
        changes = {name: attribute.parse(value)}
        changed: Design = item.update(design, lambda owner: replace(owner, **changes))
        return changed

    return FieldBinding(
        label=attribute.label,
        read=read,
        write=write,
        get_path=lambda: (*(item.path or ()), attribute.key or name),
        hint=attribute.hint,
        validate=attribute.validate,
        item=item,
    )


@dataclass(eq=False)
class Field:
    """A form field; `refresh` shows the value of the design unless the user is typing."""

    context: WindowContext
    binding: FieldBinding
    element: ValueElement[Any]
    message: ui.label | None = None
    has_focus: bool = False
    error: str = ""
    """Why the text of the field is not in the design; "" if it is."""
    _value_at_error: Any = None
    _browser_state: SentValues = field(default_factory=SentValues)

    def __post_init__(self) -> None:
        """Subscribe to focus and input, and show the value."""
        self.element.on("focus", lambda: self.focus(has_focus=True))
        self.element.on("blur", lambda: self.focus(has_focus=False))
        self.element.on_value_change(lambda event: self.on_typed(event.value))
        if isinstance(self.element, TextInput):
            self.element.on_browser_text = self._on_browser_text
        self.refresh()

    def refresh(self) -> None:
        if not self.is_path_valid():
            return
        value = self.binding.read(self.context.design)
        # A rejected text stays until the value in the design changes.
        if self.error and value != self._value_at_error:
            self.error = ""
        if not self.has_focus and not self.error:
            if self.element.value != value:
                self.element.set_value(value)
            self._record_shown(value)
        if self.message is not None and not self.message.is_deleted:
            self._show_findings(self.message)

    def focus(self, *, has_focus: bool) -> None:
        """Record the focus, and show it to other users."""
        self.has_focus = has_focus
        self.context.presence.update(self.context.window, editing_path=self.path if has_focus else ())
        if not has_focus:
            self.refresh()

    @property
    def path(self) -> DesignPath:
        """The path of the value in the current design."""
        return self.binding.get_path()

    def _record_shown(self, value: Any) -> None:
        number = self.element.server_seq if isinstance(self.element, TextInput) else 0
        self._browser_state.record_shown(value, number)

    def _on_browser_text(self, number: int, text: str) -> None:
        """Select the value that the browser showed when the text was typed."""
        self._browser_state.select_base(number)
        if text == self.element.value and self.is_path_valid() and not self.binding.validate(text):
            # No change event follows: another user typed the same text.
            self._browser_state.field_merge.record_sent(text, self._normalize(text))

    def _normalize(self, value: Any) -> Any:
        """Return the value that the design would have after writing `value`."""
        return self.binding.read(self.binding.write(self.context.design, value))

    def is_path_valid(self) -> bool:
        """Whether the item of the value still exists."""
        return self.binding.item is None or self.binding.item.path is not None

    def other_findings(self) -> list[Finding]:
        """Return findings about other files than the design."""
        return []

    def on_typed(self, value: Any) -> None:
        current = self.binding.read(self.context.design)
        self.error, self._value_at_error = self.binding.validate(value), current
        if self.error or value == current:
            if value == current:
                self._record_shown(current)
            self.refresh()
            return
        if not self.is_path_valid():
            self.context.show_toast(texts.changed_by_another_user("the item"), "warning")
            return
        if self.binding.commit is not None:
            error = self.binding.commit(value)
            if error:
                self.context.show_toast(texts.sentence(error), "warning")
                self.has_focus = False
                self.refresh()
            return
        new_value = self._browser_state.field_merge.merge_typed(value, current)
        write, key = self.binding.write, "/".join(map(str, self.path)) + self.binding.label
        # Recorded before the edit notifies all fields, including this one.
        self._browser_state.field_merge.record_sent(value, self._normalize(value))
        self.context.edit(f"edit {describe_path(self.path)}", lambda design: write(design, new_value), coalesce_key=key)

    def _show_findings(self, message: ui.label) -> None:
        findings = findings_at(self.path, self.context.document.findings)
        messages = [
            f"{each.message}{f' ({each.fix})' if each.fix else ''}" for each in (*findings, *self.other_findings())
        ]
        names = self.context.presence.names_editing(self.path, self.context.window)
        others = [texts.others_typing(names)] if names else []
        text = " · ".join(([self.error] if self.error else messages) + others)
        if message.text != text:
            message.set_text(text)
            message.set_visibility(bool(text))
        worst = "error" if self.error else worst_severity((*findings, *self.other_findings())) or "note"
        is_wrong = bool(self.error or messages)
        self.element.classes(add=f"has-finding {worst}" if is_wrong else None, remove=f"has-finding {_SEVERITIES}")
        message.classes(add=str(worst), remove=_SEVERITIES)


def findings_at(path: DesignPath, findings: Iterable[Finding]) -> list[Finding]:
    """Return the findings at a path or below it."""
    return [
        finding
        for finding in findings
        if path and finding.subject is not None and finding.subject.path[: len(path)] == path
    ]


def attribute_field(form: Form, item: TrackedItem, attribute: Attribute) -> Field:
    """Build the field of an attribute, with its help below."""
    binding = attribute_binding(item, attribute)
    if attribute.kind is FieldKind.CHECKBOX:
        built = checkbox_field(form, binding)
    else:
        is_long, is_code = attribute.kind is FieldKind.LONG_TEXT, attribute.kind is FieldKind.CODE
        built = text_field(form, binding, monospace=is_code, multiline=is_long)
    if attribute.help:
        ui.label(attribute.help).classes("empty")
    return built


def text_field(form: Form, binding: FieldBinding, *, monospace: bool = False, multiline: bool = False) -> Field:
    with ui.column().classes("field"):
        element = TextInput(binding.label, placeholder=binding.hint, multiline=multiline, monospace=monospace)
        element.props("debounce=250")
        message = ui.label().classes("field-finding")
        message.set_visibility(False)
    return add_field(form, Field(form.context, binding, element, message))


def add_field(form: Form, built: FieldT) -> FieldT:
    """Refresh a field with its form."""
    form.on_refresh(built.refresh)
    return built


def choice_field(form: Form, binding: FieldBinding, options: ListOptions, *, multiple: bool = False) -> Field:
    """Build a select for one or several options. The current value is always an option."""
    if not multiple:
        binding = _none_for_empty(binding)
    with ui.column().classes("field"):
        element = ui.select(
            list(options(form.context.design)), label=binding.label, multiple=multiple, value=[] if multiple else None
        )
        element.props("outlined dense options-dense stack-label" + (" use-chips" if multiple else ""))
        message = ui.label().classes("field-finding")
        message.set_visibility(False)
    return add_field(form, ChoiceField(form.context, binding, element, message, options=options))


def _none_for_empty(binding: FieldBinding) -> FieldBinding:
    """Map the empty text to None, the empty value of a select."""
    return replace(
        binding,
        read=lambda design: binding.read(design) or None,
        write=lambda design, value: binding.write(design, value or ""),
    )


@dataclass(eq=False)
class ChoiceField(Field):
    """A select. Its options always include the current value; otherwise the element would change it."""

    options: ListOptions = field(default=lambda _design: ())

    def refresh(self) -> None:
        if self.has_focus or not self.is_path_valid():
            super().refresh()
            return
        design, element = self.context.design, cast("ui.select", self.element)
        new_value = list(dict.fromkeys([*self.options(design), *_as_list(self.binding.read(design))]))
        self._set_options([*new_value, *(each for each in _as_list(element.value) if each not in new_value)])
        super().refresh()
        self._set_options(new_value)

    def _set_options(self, options: list[str]) -> None:
        element = cast("ui.select", self.element)
        if element.options != options:
            element.set_options(options)


def _as_list(value: Any) -> list[str]:
    return value if isinstance(value, list) else [value] if value else []


def state_names(design: Design) -> list[str]:
    """Return the options of a choice among states."""
    return [state.name for state in design.states]


def checkbox_field(form: Form, binding: FieldBinding) -> Field:
    element = ui.checkbox(binding.label).props("dense")
    if binding.hint:
        element.tooltip(binding.hint)
    return add_field(form, Field(form.context, binding, element))


def set_enabled(element: DisableableElement, *, flag: bool) -> None:
    """Enable or disable a button, without an update if nothing changed."""
    if element.enabled != flag:
        element.set_enabled(flag)
