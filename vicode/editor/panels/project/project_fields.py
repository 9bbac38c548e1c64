"""Fields of what project.yaml declares: each change is written into the file at once, and can be taken back."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from nicegui import ui

from vicode.editor.panels.fields import ChoiceField, Field, FieldBinding, findings_at
from vicode.editor.panels.name_field import NameField, rename_declaration
from vicode.editor.panels.text_input import TextInput
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import number_text
from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.project_edits import ProjectEdit, edit_project_file
from vicode.editor.session.project_paths import ProjectNodePath
from vicode.editor.session.rename_symbol import validate_identifier
from vicode.findings import DesignPath, Finding
from vicode.model.design import Design
from vicode.model.project import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class TextAttribute:
    """An attribute that is typed as a text. `format` and `parse` lead there and back, `validate` says why not."""

    label: str
    attribute: str
    hint: str = ""
    format: Callable[[Any], str] = str
    parse: Callable[[str], Any] = str.strip
    validate: Callable[[str], str] = lambda _text: ""
    is_multiline: bool = False


DOC = TextAttribute(label="Doc", attribute="doc", is_multiline=True)
XABSL_NAME = TextAttribute(label="Name in XABSL", attribute="xabsl_name")
RANGE = TextAttribute(
    label="Range",
    attribute="range",
    hint="lowest, highest: 0, 9000",
    format=number_text.format_range,
    parse=number_text.parse_range,
    validate=number_text.validate_range,
)
FREQUENCY = TextAttribute(
    label="Frequency, Hz",
    attribute="frequency_hz",
    hint="at every step",
    format=number_text.format_number,
    parse=number_text.parse_frequency,
    validate=number_text.validate_frequency,
)


@dataclass(eq=False)
class ProjectTextField(NameField):
    """A text that is taken over when it is done; `on_refresh` is called when what is shown may be another."""

    on_refresh: Callable[[], None] = field(default=lambda: None)
    get_file_path: Callable[[], DesignPath] = field(default=tuple)
    """Where it stands in project.yaml."""

    def other_findings(self) -> list[Finding]:
        """What is wrong with it in project.yaml."""
        return findings_at(self.get_file_path(), self.context.workspace.project_findings)

    def refresh(self) -> None:
        """Show what the file says."""
        super().refresh()
        self.on_refresh()


def project_name_field(
    context: WindowContext, label: str, spot: ProjectNodePath, on_renamed: Callable[[str], None] = lambda _name: None
) -> Field:
    """The name of a thing: all that say it follow, after it was agreed to; `on_renamed` hears it when it is another."""

    def take(_old: str, new: str) -> str:
        return rename_declaration(context, spot.symbol_ref(context.workspace.project), new)

    bound = FieldBinding(
        label=label,
        read=lambda _design: spot.name(context.workspace.project),
        write=_same,
        validate=lambda text: validate_identifier(str(text)),
    )
    element, message = _input(bound, is_code=True)
    element.props("maxlength=80")
    return NameField(context, bound, element, message, rename=take, on_name_changed=on_renamed)


def project_text_field(
    context: WindowContext, spot: ProjectNodePath, line: TextAttribute, on_refresh: Callable[[], None] = lambda: None
) -> Field:
    """A text of a thing, or a number."""

    def read(_design: Design) -> str:
        thing = spot.get(context.workspace.project)
        return "" if thing is None else line.format(getattr(thing, line.attribute))

    def change(text: str) -> Callable[[Any], Any]:
        changes: dict[str, Any] = {line.attribute: line.parse(text)}
        return lambda thing: replace(thing, **changes)

    return project_custom_field(context, spot, line, (read, change), on_refresh)


def project_custom_field(
    context: WindowContext,
    spot: ProjectNodePath,
    line: TextAttribute,
    accessors: tuple[Callable[[Design], str], Callable[[str], Callable[[Any], Any]]],
    on_refresh: Callable[[], None] = lambda: None,
) -> Field:
    """A text that `accessors` read, and make a change of the thing of."""
    read, change = accessors

    def take(_old: str, new: str) -> str:
        return line.validate(new) or write_node(context, spot, change(new))

    bound = FieldBinding(
        label=line.label, hint=line.hint, read=read, write=_same, validate=lambda text: line.validate(str(text))
    )
    is_text = line.attribute in ("doc", "title")
    element, message = _input(bound, is_code=not is_text, is_long=line.is_multiline)
    element.props("maxlength=2000")

    def place() -> DesignPath:
        return (*spot.path(context.workspace.project), *_file_key(spot, line))

    made = ProjectTextField(
        context,
        bound,
        element,
        message,
        rename=take,
        on_refresh=on_refresh,
        get_file_path=place,
        is_multiline=line.is_multiline,
    )
    made.is_optional = True
    return made


def _file_key(spot: ProjectNodePath, line: TextAttribute) -> DesignPath:
    """The key below which an attribute stands in the file: of an element none, it is its value."""
    match (spot.section, line.attribute):
        case ("elements", _):
            return ()
        case ("constants", "initial"):
            return ("value",)
        case ("parameters" | "arguments", "initial"):
            return ("default",)
        case (_, "frequency_hz"):
            return ("frequency",)
        case (_, attribute):
            return (attribute,)


def _input(binding: FieldBinding, *, is_code: bool, is_long: bool = False) -> tuple[TextInput, ui.label]:
    with ui.column().classes("field"):
        element = TextInput(binding.label, placeholder=binding.hint, multiline=is_long, monospace=is_code)
        message = ui.label().classes("field-finding").props('role="status"')
        message.set_visibility(False)
    return element, message


def project_checkbox(context: WindowContext, spot: ProjectNodePath, label: str, attribute: str) -> Field:
    """Yes or no."""

    def read(_design: Design) -> bool:
        return bool(getattr(spot.get(context.workspace.project), attribute, False))

    box = ui.checkbox(label).props("dense").classes("wide")
    return _ProjectCheckbox(
        context, FieldBinding(label=label, read=read, write=_same), box, spot=spot, attribute=attribute
    )


def project_choice_field(
    context: WindowContext, spot: ProjectNodePath, label: str, attribute: str, options: Callable[[], Sequence[str]]
) -> Field:
    """One of several names."""

    def read(_design: Design) -> str | None:
        return getattr(spot.get(context.workspace.project), attribute, None) or None

    with ui.column().classes("field"):
        element = ui.select(list(options()), label=label, value=None).props("outlined dense options-dense stack-label")
        message = ui.label().classes("field-finding").props('role="status"')
        message.set_visibility(False)
    bound = FieldBinding(label=label, read=read, write=_same)
    return _ProjectChoice(
        context, bound, element, message, options=lambda _design: options(), spot=spot, attribute=attribute
    )


@dataclass(eq=False)
class _ProjectCheckbox(Field):
    spot: ProjectNodePath = field(kw_only=True)
    attribute: str = field(kw_only=True)

    def _on_typed(self, value: Any) -> None:
        _write_value(self, self.spot, self.attribute, value)


@dataclass(eq=False)
class _ProjectChoice(ChoiceField):
    spot: ProjectNodePath = field(kw_only=True)
    attribute: str = field(kw_only=True)

    def _on_typed(self, value: Any) -> None:
        if value is not None:
            _write_value(self, self.spot, self.attribute, value)


def _write_value(made: Field, spot: ProjectNodePath, attribute: str, value: Any) -> None:
    """Write what was chosen; what cannot be is told, and shown no more."""
    if value == made.binding.read(made.context.design):
        return
    changes = {attribute: value}
    refused = write_node(made.context, spot, lambda thing: replace(thing, **changes))
    if refused:
        made.context.show_toast(refused[:1].upper() + refused[1:], "warning")
        made.has_focus = False
        made.refresh()


def _same(design: Design, _value: Any) -> Design:
    return design


def write_node(context: WindowContext, spot: ProjectNodePath, change: Callable[[Any], Any]) -> str:
    """Write another thing into project.yaml; returns why not."""
    project = context.workspace.project
    name = " of ".join(reversed(spot.names(project) or (project.name,)))
    return write_project(context, lambda project: spot.update(project, change), name, spot)


def write_project(
    context: WindowContext,
    change: Callable[[Project], Project],
    what: str,
    spot: ProjectNodePath | None = None,
    *,
    is_agreed: bool = False,
) -> str:
    """Write another project.yaml, say so, and offer to take it back; returns why not. See `change_project_file`."""
    try:
        written = edit_project_file(context.workspace, change, spot, summary=what, allow_errors=is_agreed)
    except OSError as error:
        return f"not written: {error_reason(error)}"
    edit = written.edit
    if edit is not None:
        broken = f"; now with errors: {', '.join(written.broken_designs)}" if written.broken_designs else ""
        context.document.record_compound(edit)
        context.offer_undo(f"project.yaml is written: {what}{broken}", lambda: _undo(context, edit))
        context.notify_listeners()
    return written.error


def _undo(context: WindowContext, edit: ProjectEdit) -> None:
    refused = context.document.undo_compound(edit)
    if refused:
        context.show_toast(refused, "warning")
    context.notify_listeners()
