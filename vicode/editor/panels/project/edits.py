"""Edits that the browser makes in the forms of project.yaml. Each is saved immediately and can be undone."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from vicode.editor.panels.inspector.rename_dialog import rename_declaration
from vicode.editor.panels.project.removal import confirm_and_remove
from vicode.editor.panels.project.writing import write_design_and_project, write_node, write_project
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.forms.edits import ButtonEdit, CheckEdit, ChoiceEdit, FormEdit, NameEdit, TextEdit
from vicode.editor.session.forms.form_paths import parse_path
from vicode.editor.session.forms.form_places import FormResult
from vicode.editor.session.forms.list_ids import DECLARATION_LISTS
from vicode.editor.session.forms.project_places import ProjectPlace, find_project_place, node_path, resolve_in_project
from vicode.editor.session.forms.text_merge import merge_texts
from vicode.editor.session.project import project_edits
from vicode.editor.session.project.interface_edits import add_command, add_input
from vicode.editor.session.texts import ITEM_MISSING
from vicode.findings import DesignPath
from vicode.model.project import Project

_MISSING = FormResult(error=ITEM_MISSING)


class ProjectFormEdits:
    """The edits of project.yaml in one window."""

    def __init__(self, context: WindowContext) -> None:
        self.context = context

    def apply(self, edit: FormEdit) -> FormResult:
        match edit:
            case NameEdit():
                return self._rename(edit)
            case TextEdit() | ChoiceEdit() | CheckEdit():
                place = find_project_place(self._project, self._ids, parse_path(edit.path))
                return _MISSING if place is None else self._write(place, edit)
            case ButtonEdit(action="add-input" | "add-command"):
                return self._add_interface(edit)
            case ButtonEdit():
                return self._press(edit)
            case _:
                return _MISSING

    @property
    def _project(self) -> Project:
        return self.context.workspace.project

    @property
    def _ids(self) -> Any:
        return self.context.document.shared.list_ids

    def _resolve(self, path: str) -> DesignPath | None:
        return resolve_in_project(self._project, self._ids, parse_path(path))

    def _rename(self, edit: NameEdit) -> FormResult:
        """Rename a node and its references; a dialog may ask first, and the name stays until then."""
        steps, new = self._resolve(edit.path), edit.text.strip()
        if not steps or steps[-1] != "name":
            return _MISSING
        path = node_path(steps[:-1])
        name = path.name(self._project)
        error = "" if new == name else rename_declaration(self.context, path.symbol_ref(self._project), new)
        return FormResult(own=path.name(self._project), error=error)

    def _write(self, place: ProjectPlace, edit: TextEdit | ChoiceEdit | CheckEdit) -> FormResult:
        field, node = place.field, place.node.get(self._project)
        now, typed = field.read(node), edit.text.strip() if isinstance(edit, TextEdit) else edit.value
        if error := field.validate(typed):
            return FormResult(error=error)
        own = field.read(field.write(node, typed))
        value: Any = typed
        if isinstance(edit, TextEdit) and edit.base != now:
            value = merge_texts(edit.base, str(typed), str(now))
        error = field.validate(value)
        if not error and value != now:
            error = write_node(self.context, place.node, lambda old: field.write(old, value))
        return FormResult(own=str(own), error=error)

    def _add_interface(self, edit: ButtonEdit) -> FormResult:
        """Add an input with a type, or a command with its parameters."""
        add = add_input if edit.action == "add-input" else add_command
        added = add(self._project, self.context.design, edit.text.strip(), edit.to)
        return FormResult(
            error=added.error
            or write_design_and_project(self.context, added.label, added.change_design, added.change_project)
        )

    def _press(self, edit: ButtonEdit) -> FormResult:
        steps = self._resolve(edit.path)
        match edit.action, steps:
            case "add-card", (*_, str(section)):
                change = self._addition((*steps[:-1], section))
                if change is None:
                    return _MISSING
                self._ids.of_project(self._project).want(steps, edit.card)
                noun = section.removesuffix("s")
                return FormResult(error=write_project(self.context, change, f"add {noun}"))
            case "remove-arguments", ("components", int(), "outputs", int(), "arguments"):
                path = node_path(steps[:-1])
                return FormResult(error=write_node(self.context, path, lambda output: replace(output, arguments=None)))
            case "remove-card", (*_, str(), int()):
                confirm_and_remove(self.context, node_path(steps))
                return FormResult()
            case "move-card", (*_, "elements" | "arguments", int()):
                path = node_path(steps)
                what = f"move {path.name(self._project)} up"
                return FormResult(error=write_project(self.context, path.move_up, what, path, is_confirmed=True))
            case _:
                return _MISSING

    def _addition(self, steps: DesignPath) -> Callable[[Project], Project] | None:
        """The change that adds an item to a list of the project."""
        root = self.context.design.component
        match steps:
            case ("enumerations",):
                return project_edits.add_enumeration
            case ("constants",):
                return project_edits.add_constant
            case ("components",):
                return project_edits.add_component
            case ("agents",):
                return lambda project: project_edits.add_agent(project, root)
            case ("enumerations", int(), "elements"):
                return lambda project: node_path(steps[:-1]).update(project, project_edits.add_element)
            case ("components", int(), "outputs", int(), "arguments"):
                return lambda project: node_path(steps[:-1]).update(project, project_edits.add_argument)
            case ("components", int(), str(section)) if section in DECLARATION_LISTS[:3]:
                return lambda project: node_path(steps[:-1]).update(
                    project, lambda component: project_edits.add_declaration(component, section)
                )
            case _:
                return None
