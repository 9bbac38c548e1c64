"""Fields of the declarations in project.yaml. Each change is saved immediately and can be undone."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.fields import (
    Attribute,
    Field,
    FieldBinding,
    FieldKind,
    add_field,
    findings_at,
)
from vicode.editor.panels.form import Form
from vicode.editor.panels.name_field import NameField, rename_declaration
from vicode.editor.panels.text_input import TextInput
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.item_paths import TrackedItem
from vicode.editor.session.project_edits import ProjectEdit, edit_design_and_project, edit_project_file
from vicode.editor.session.project_paths import ProjectNodePath
from vicode.editor.session.rename_symbol import validate_identifier
from vicode.findings import DesignPath, Finding
from vicode.model.design import Design
from vicode.model.project import Project


def project_node(form: Form, *path: str | int) -> TrackedItem:
    """A node of project.yaml."""
    return TrackedItem(lambda: form.context.workspace.project, path)


def node_path(node: TrackedItem) -> ProjectNodePath:
    """The path of a node; that of the project if the node no longer exists."""
    path = node.path or ()
    pairs = zip(path[::2], path[1::2], strict=True)
    return ProjectNodePath(steps=tuple((str(section), int(index)) for section, index in pairs))


@dataclass(eq=False)
class _ProjectTextField(NameField):
    """A text field that writes project.yaml on commit."""

    get_file_path: Callable[[], DesignPath] = field(default=tuple)
    """Returns the path of the value in project.yaml."""

    def other_findings(self) -> list[Finding]:
        return findings_at(self.get_file_path(), self.context.workspace.project_findings)


def project_name_field(form: Form, label: str, node: TrackedItem) -> Field:
    """Build a field that renames a node and its references."""
    context = form.context

    def commit(_old: str, new: str) -> str:
        return rename_declaration(context, node_path(node).symbol_ref(context.workspace.project), new)

    binding = FieldBinding(
        label=label,
        read=lambda _design: node_name(node),
        write=_same,
        validate=lambda text: validate_identifier(str(text)),
        item=node,
    )
    element, message = _input(binding, is_code=True)
    element.props("maxlength=80")
    return add_field(form, NameField(context, binding, element, message, rename=commit))


def node_name(node: TrackedItem) -> str:
    """The name of a node; "" if it no longer exists."""
    return node_path(node).name(node.get_root()) if node.path else ""


def project_text_field(form: Form, node: TrackedItem, attribute: Attribute) -> Field:
    """Build a field for a text or number attribute of a node."""

    def read(_design: Design) -> str:
        value = node.get()
        return "" if value is None else str(attribute.format(getattr(value, attribute.name)))

    def change(text: str) -> Callable[[Any], Any]:
        changes: dict[str, Any] = {attribute.name: attribute.parse(text)}
        return lambda value: replace(value, **changes)

    return project_custom_field(form, node, attribute, (read, change))


def project_custom_field(
    form: Form,
    node: TrackedItem,
    attribute: Attribute,
    accessors: tuple[Callable[[Design], str], Callable[[str], Callable[[Any], Any]]],
) -> Field:
    """Build a text field; `accessors` read the text, and turn a text into a change of the node."""
    read, change = accessors
    context = form.context

    def commit(_old: str, new: str) -> str:
        return attribute.validate(new) or write_node(context, node, change(new))

    binding = FieldBinding(
        label=attribute.label,
        hint=attribute.hint,
        read=read,
        write=_same,
        validate=lambda text: attribute.validate(str(text)),
        item=node,
    )
    is_long = attribute.kind is FieldKind.LONG_TEXT
    element, message = _input(binding, is_code=attribute.kind is FieldKind.CODE, is_long=is_long)
    element.props("maxlength=2000")

    def get_file_path() -> DesignPath:
        return (*node_path(node).path(context.workspace.project), *_file_key(node, attribute))

    project_field = _ProjectTextField(
        context, binding, element, message, rename=commit, get_file_path=get_file_path, is_multiline=is_long
    )
    project_field.is_optional = True
    return add_field(form, project_field)


def _file_key(node: TrackedItem, attribute: Attribute) -> DesignPath:
    """The key below which an attribute stands in the file: of an element none, it is its value."""
    match (node_path(node).section, attribute.name):
        case ("elements", _):
            return ()
        case ("constants", "initial"):
            return ("value",)
        case ("parameters" | "arguments", "initial"):
            return ("default",)
        case (_, name):
            return (attribute.key or name,)


def _input(binding: FieldBinding, *, is_code: bool, is_long: bool = False) -> tuple[TextInput, ui.label]:
    with ui.column().classes("field"):
        element = TextInput(binding.label, placeholder=binding.hint, multiline=is_long, monospace=is_code)
        message = ui.label().classes("field-finding").props('role="status"')
        message.set_visibility(False)
    return element, message


def project_binding(form: Form, node: TrackedItem, label: str, name: str) -> FieldBinding:
    """Bind an attribute of a node that is written at once."""

    def commit(value: Any) -> str:
        changes = {name: value}
        return "" if value is None else write_node(form.context, node, lambda old: replace(old, **changes))

    return FieldBinding(
        label=label, read=lambda _design: getattr(node.get(), name), write=_same, item=node, commit=commit
    )


def _same(design: Design, _value: Any) -> Design:
    return design


def write_node(context: WindowContext, node: TrackedItem, change: Callable[[Any], Any]) -> str:
    """Change a node in project.yaml; return an error message, or "" on success."""
    project = context.workspace.project
    path = node_path(node)
    if node.path is None:
        return texts.changed_by_another_user("the item")
    name = "edit " + " of ".join(reversed(path.names(project) or (project.name,)))
    return write_project(context, lambda project: path.update(project, change), name, path)


def write_project(
    context: WindowContext,
    change: Callable[[Project], Project],
    what: str,
    path: ProjectNodePath | None = None,
    *,
    is_confirmed: bool = False,
) -> str:
    """Change project.yaml and offer to undo it; return an error message, or "" on success. See `edit_project_file`."""
    try:
        result = edit_project_file(context.workspace, change, path, summary=what, allow_errors=is_confirmed)
    except OSError as error:
        return texts.not_written(error_reason(error))
    edit = result.edit
    if edit is not None:
        message = texts.project_saved(what, result.broken_designs)
        context.document.record_compound(edit)
        context.page.offer_undo(message, lambda: _undo(context, edit))
        context.notify_subscribers()
    return result.error


def write_design_and_project(
    context: WindowContext,
    label: str,
    change_design: Callable[[Design], Design],
    change_project: Callable[[Project], Project],
) -> str:
    """Change project.yaml and the open design as one edit; return an error message, or "" on success."""
    try:
        return edit_design_and_project(context.document, context.workspace, label, change_design, change_project)
    except OSError as error:
        return texts.not_written(error_reason(error))


def _undo(context: WindowContext, edit: ProjectEdit) -> None:
    error = context.document.undo_compound(edit)
    if error:
        context.show_toast(error, "warning")
    context.notify_subscribers()
