"""Fields of the declarations in project.yaml. Each change is saved immediately and can be undone."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from nicegui import ui

from vicode.editor.panels import texts
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
    """An attribute edited as text: `format` and `parse` convert it, `validate` returns an error message or ""."""

    label: str
    attribute: str
    hint: str = ""
    format: Callable[[Any], str] = str
    parse: Callable[[str], Any] = str.strip
    validate: Callable[[str], str] = lambda _text: ""
    is_multiline: bool = False


DOC = TextAttribute(label="Description", attribute="doc", is_multiline=True)
XABSL_NAME = TextAttribute(label="Name in XABSL", attribute="xabsl_name")
RANGE = TextAttribute(
    label="Range",
    attribute="range",
    hint="minimum, maximum: 0, 9000",
    format=number_text.format_range,
    parse=number_text.parse_range,
    validate=number_text.validate_range,
)
FREQUENCY = TextAttribute(
    label="Frequency, Hz",
    attribute="frequency_hz",
    hint="every step",
    format=number_text.format_number,
    parse=number_text.parse_frequency,
    validate=number_text.validate_frequency,
)


@dataclass(eq=False)
class ProjectTextField(NameField):
    """A text field that writes project.yaml on commit; `on_refresh` is called after each refresh."""

    on_refresh: Callable[[], None] = field(default=lambda: None)
    get_file_path: Callable[[], DesignPath] = field(default=tuple)
    """Returns the path of the value in project.yaml."""

    def other_findings(self) -> list[Finding]:
        return findings_at(self.get_file_path(), self.context.workspace.project_findings)

    def refresh(self) -> None:
        super().refresh()
        self.on_refresh()


def project_name_field(
    context: WindowContext,
    label: str,
    node_path: ProjectNodePath,
    on_renamed: Callable[[str], None] = lambda _name: None,
) -> Field:
    """Build a field that renames a node and its references; `on_renamed` gets each new name."""

    def commit(_old: str, new: str) -> str:
        return rename_declaration(context, node_path.symbol_ref(context.workspace.project), new)

    binding = FieldBinding(
        label=label,
        read=lambda _design: node_path.name(context.workspace.project),
        write=_same,
        validate=lambda text: validate_identifier(str(text)),
    )
    element, message = _input(binding, is_code=True)
    element.props("maxlength=80")
    return NameField(context, binding, element, message, rename=commit, on_name_changed=on_renamed)


def project_text_field(
    context: WindowContext,
    node_path: ProjectNodePath,
    attribute: TextAttribute,
    on_refresh: Callable[[], None] = lambda: None,
) -> Field:
    """Build a field for a text or number attribute of a node."""

    def read(_design: Design) -> str:
        node = node_path.get(context.workspace.project)
        return "" if node is None else attribute.format(getattr(node, attribute.attribute))

    def change(text: str) -> Callable[[Any], Any]:
        changes: dict[str, Any] = {attribute.attribute: attribute.parse(text)}
        return lambda node: replace(node, **changes)

    return project_custom_field(context, node_path, attribute, (read, change), on_refresh)


def project_custom_field(
    context: WindowContext,
    node_path: ProjectNodePath,
    attribute: TextAttribute,
    accessors: tuple[Callable[[Design], str], Callable[[str], Callable[[Any], Any]]],
    on_refresh: Callable[[], None] = lambda: None,
) -> Field:
    """Build a text field; `accessors` read the text, and turn a text into a change of the node."""
    read, change = accessors

    def commit(_old: str, new: str) -> str:
        return attribute.validate(new) or write_node(context, node_path, change(new))

    binding = FieldBinding(
        label=attribute.label,
        hint=attribute.hint,
        read=read,
        write=_same,
        validate=lambda text: attribute.validate(str(text)),
    )
    is_text = attribute.attribute in ("doc", "title")
    element, message = _input(binding, is_code=not is_text, is_long=attribute.is_multiline)
    element.props("maxlength=2000")

    def get_file_path() -> DesignPath:
        return (*node_path.path(context.workspace.project), *_file_key(node_path, attribute))

    project_field = ProjectTextField(
        context,
        binding,
        element,
        message,
        rename=commit,
        on_refresh=on_refresh,
        get_file_path=get_file_path,
        is_multiline=attribute.is_multiline,
    )
    project_field.is_optional = True
    return project_field


def _file_key(node_path: ProjectNodePath, attribute: TextAttribute) -> DesignPath:
    """The path of an attribute below its node in the file; empty for the description of an element."""
    match (node_path.section, attribute.attribute):
        case ("elements", _):
            return ()
        case ("constants", "initial"):
            return ("value",)
        case ("parameters" | "arguments", "initial"):
            return ("default",)
        case (_, "frequency_hz"):
            return ("frequency",)
        case (_, name):
            return (name,)


def _input(binding: FieldBinding, *, is_code: bool, is_long: bool = False) -> tuple[TextInput, ui.label]:
    with ui.column().classes("field"):
        element = TextInput(binding.label, placeholder=binding.hint, multiline=is_long, monospace=is_code)
        message = ui.label().classes("field-finding").props('role="status"')
        message.set_visibility(False)
    return element, message


def project_checkbox(context: WindowContext, node_path: ProjectNodePath, label: str, attribute: str) -> Field:
    def read(_design: Design) -> bool:
        return bool(getattr(node_path.get(context.workspace.project), attribute, False))

    box = ui.checkbox(label).props("dense").classes("wide")
    return _ProjectCheckbox(
        context, FieldBinding(label=label, read=read, write=_same), box, node_path=node_path, attribute=attribute
    )


def project_choice_field(
    context: WindowContext, node_path: ProjectNodePath, label: str, attribute: str, options: Callable[[], Sequence[str]]
) -> Field:
    def read(_design: Design) -> str | None:
        return getattr(node_path.get(context.workspace.project), attribute, None) or None

    with ui.column().classes("field"):
        element = ui.select(list(options()), label=label, value=None).props("outlined dense options-dense stack-label")
        message = ui.label().classes("field-finding").props('role="status"')
        message.set_visibility(False)
    binding = FieldBinding(label=label, read=read, write=_same)
    return _ProjectChoice(
        context, binding, element, message, options=lambda _design: options(), node_path=node_path, attribute=attribute
    )


@dataclass(eq=False)
class _ProjectCheckbox(Field):
    node_path: ProjectNodePath = field(kw_only=True)
    attribute: str = field(kw_only=True)

    def _on_typed(self, value: Any) -> None:
        _write_value(self, self.node_path, self.attribute, value)


@dataclass(eq=False)
class _ProjectChoice(ChoiceField):
    node_path: ProjectNodePath = field(kw_only=True)
    attribute: str = field(kw_only=True)

    def _on_typed(self, value: Any) -> None:
        if value is not None:
            _write_value(self, self.node_path, self.attribute, value)


def _write_value(project_field: Field, node_path: ProjectNodePath, attribute: str, value: Any) -> None:
    """Write a value; on failure show an error and the old value."""
    if value == project_field.binding.read(project_field.context.design):
        return
    changes = {attribute: value}
    error = write_node(project_field.context, node_path, lambda node: replace(node, **changes))
    if error:
        project_field.context.show_toast(texts.sentence(error), "warning")
        project_field.has_focus = False
        project_field.refresh()


def _same(design: Design, _value: Any) -> Design:
    return design


def write_node(context: WindowContext, node_path: ProjectNodePath, change: Callable[[Any], Any]) -> str:
    """Change a node in project.yaml; return an error message, or "" on success."""
    project = context.workspace.project
    name = "edit " + " of ".join(reversed(node_path.names(project) or (project.name,)))
    return write_project(context, lambda project: node_path.update(project, change), name, node_path)


def write_project(
    context: WindowContext,
    change: Callable[[Project], Project],
    what: str,
    node_path: ProjectNodePath | None = None,
    *,
    is_confirmed: bool = False,
) -> str:
    """Change project.yaml and offer to undo it; return an error message, or "" on success. See `edit_project_file`."""
    try:
        result = edit_project_file(context.workspace, change, node_path, summary=what, allow_errors=is_confirmed)
    except OSError as error:
        return texts.not_written(error_reason(error))
    edit = result.edit
    if edit is not None:
        message = texts.project_saved(what, result.broken_designs)
        context.document.record_compound(edit)
        context.page.offer_undo(message, lambda: _undo(context, edit))
        context.notify_subscribers()
    return result.error


def _undo(context: WindowContext, edit: ProjectEdit) -> None:
    error = context.document.undo_compound(edit)
    if error:
        context.show_toast(error, "warning")
    context.notify_subscribers()
