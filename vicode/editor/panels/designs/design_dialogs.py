"""Dialogs to create, rename, duplicate and delete designs, with undo."""

from collections.abc import Callable
from dataclasses import dataclass

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.designs.open_design import open_design
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.widgets import primary_button
from vicode.editor.session import Workspace, templates
from vicode.editor.session.project import renames, trash
from vicode.editor.session.workspace import TrashedDesign
from vicode.editor.view.page_urls import design_url
from vicode.model.names import is_valid_name, name_from_text
from vicode.services.rename import component as rename_component

ShowToast = Callable[[str, str], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignDialogs:
    """The dialogs of one page; `offer_undo` shows a message with an undo button."""

    show_toast: ShowToast
    offer_undo: Callable[[str, Callable[[], object]], None]

    def menu_entries(self) -> dict[str, Callable[[Workspace, str], None]]:
        """The entries of the menu of a design."""
        return {
            "Rename everywhere…": self.ask_rename,
            "Duplicate…": self.ask_duplicate,
            "Move to trash…": self.ask_move_to_trash,
        }

    def ask_new(self, workspace: Workspace) -> None:
        choices = templates.list_templates()
        titles = {each.name: f"{each.title}: {each.doc}" for each in choices}
        with titled_dialog(f"New design in {workspace.project.name}") as dialog:
            name = name_field("Component", "", "FollowBall")
            ui.label("Template").classes("field-label")
            template_choice = ui.radio(titles, value=choices[0].name).classes("template-choice")

            def create() -> None:
                new_name = name.value.strip()
                template = next(each for each in choices if each.name == template_choice.value)
                error = trash.validate_component_name(workspace, new_name)
                if error or not self._run_file_operation(
                    lambda: workspace.create(new_name, _text_of(template, new_name, workspace))
                ):
                    self._show_error(error)
                    _suggest_valid_name(name)
                    return
                dialog.close()
                open_design(design_url(workspace.key, new_name))

            dialog_buttons(dialog, "Create", create, name)

    def ask_duplicate(self, workspace: Workspace, component: str) -> None:
        with titled_dialog(f"Duplicate {component}") as dialog:
            name = name_field("Name of the copy", trash.copy_name(workspace, component), "")

            def copy() -> None:
                new_name = name.value.strip()
                error = trash.validate_component_name(workspace, new_name)
                if error or not self._run_file_operation(
                    lambda: trash.duplicate_design(workspace, component, new_name)
                ):
                    self._show_error(error)
                    _suggest_valid_name(name)
                    return
                dialog.close()
                self.show_toast(f"Duplicated {component} as {new_name}", "positive")

            dialog_buttons(dialog, "Duplicate", copy, name)

    def ask_rename(self, workspace: Workspace, component: str) -> None:
        """Ask for a new name; list the changed files while the user types."""
        with titled_dialog(f"Rename {component}") as dialog:
            name = name_field("New name", component, "")
            ui.label("Changes").classes("field-label")
            change_list = ui.column().classes("change-list").props('aria-live="polite"')

            def plan() -> rename_component.ComponentRenamePlan:
                return rename_component.plan_component_rename(workspace, component, name.value.strip())

            def show() -> None:
                rename_plan = plan()
                change_list.clear()
                with change_list:
                    for change in rename_plan.changes:
                        ui.label(change.file.name).classes("mono")
                        ui.label(change.summary)
                    if rename_plan.changes and workspace.broken_file_names:
                        ui.label(texts.skipped_files(workspace.broken_file_names)).classes("empty")
                    if rename_plan.error:
                        ui.label(f"Cannot rename: {rename_plan.error}").classes("empty")

            def rename() -> None:
                rename_plan = plan()
                if rename_plan.error or not self._rename(workspace, rename_plan):
                    self._show_error(rename_plan.error)
                    _suggest_valid_name(name)
                    return
                dialog.close()

            name.on_value_change(show)
            show()
            dialog_buttons(dialog, "Rename everywhere", rename, name)

    def ask_move_to_trash(self, workspace: Workspace, component: str) -> None:
        error = trash.validate_move_to_trash(workspace, component)
        if error:
            self.show_toast(texts.sentence(error), "warning")
            return
        users = trash.find_dependents(workspace, component)
        with titled_dialog(f"Move {component} to the trash?") as dialog:
            ui.label(f"{workspace.files[component].name} is moved to the system trash. You can undo this.")
            if users:
                ui.label(texts.still_used_by(users))

            def remove() -> None:
                dialog.close()
                self._run_file_operation(lambda: self._move_to_trash(workspace, component))

            dialog_buttons(dialog, "Move to trash", remove, None)

    def _move_to_trash(self, workspace: Workspace, component: str) -> None:
        self.offer_restore(workspace, trash.move_to_trash(workspace, component))

    def offer_restore(self, workspace: Workspace, trashed: TrashedDesign) -> None:
        def undo() -> None:
            error = trash.restore_from_trash(workspace, trashed)
            text = texts.sentence(error) or f"{trashed.component} restored"
            self.show_toast(text, "warning" if error else "positive")

        self.offer_undo(f"{trashed.component} moved to trash", undo)

    def _rename(self, workspace: Workspace, rename_plan: rename_component.ComponentRenamePlan) -> bool:
        def rename() -> None:
            error = renames.apply_component_rename(workspace, rename_plan)
            if error:
                self._show_error(error)
                return
            inverse_plan = rename_component.plan_component_rename(workspace, rename_plan.new, rename_plan.old)
            self.offer_undo(
                texts.renamed(rename_plan.old, rename_plan.new), lambda: self._rename_back(workspace, inverse_plan)
            )

        return self._run_file_operation(rename)

    def _rename_back(self, workspace: Workspace, rename_plan: rename_component.ComponentRenamePlan) -> None:
        plan = rename_component.plan_component_rename(workspace, rename_plan.old, rename_plan.new)
        error = plan.error
        if error or not self._run_file_operation(lambda: renames.apply_component_rename(workspace, plan)):
            self._show_error(error)
            return
        self.show_toast(texts.renamed_back(rename_plan.new), "positive")

    def _show_error(self, error: str) -> None:
        if error:
            self.show_toast(texts.sentence(error), "warning")

    def _run_file_operation(self, action: Callable[[], object]) -> bool:
        """Run a file operation; show an error and return False if it fails."""
        try:
            action()
        except OSError as error:
            self.show_toast(texts.operation_failed(error), "negative")
            return False
        return True


def _text_of(template: templates.Template, component: str, workspace: Workspace) -> str:
    return templates.instantiate_template(template, component, workspace.project)


def name_field(label: str, value: str, example: str) -> ui.input:
    field = ui.input(label, value=value, placeholder=example).classes("dialog-field")
    field.props("outlined dense stack-label autofocus maxlength=80")
    return field


def _suggest_valid_name(field: ui.input) -> None:
    """Replace an invalid name in a field by a similar valid one."""
    new_name = str(field.value).strip()
    if not is_valid_name(new_name) and name_from_text(new_name):
        field.set_value(name_from_text(new_name))


def dialog_buttons(dialog: ui.dialog, label: str, action: Callable[[], object], field: ui.input | None) -> None:
    if field is not None:
        field.on("keydown.enter", action)
    with ui.row().classes("dialog-buttons"):
        ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
        primary_button(label, action)
