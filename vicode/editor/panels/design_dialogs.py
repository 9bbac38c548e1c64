"""Asks what is to become of a design: a new one, another name, a copy, the trash; undo is offered afterwards."""

from collections.abc import Callable
from dataclasses import dataclass

from nicegui import ui

from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.widgets import primary_button
from vicode.editor.session import Workspace, rename_component, templates, trash
from vicode.editor.session.workspace import TrashedDesign
from vicode.editor.view.page_urls import design_url
from vicode.model.names import is_valid_name, name_from_text

ShowToast = Callable[[str, str], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignDialogs:
    """The dialogs of one page; `offer_undo` shows words with a button that takes back what was done."""

    show_toast: ShowToast
    offer_undo: Callable[[str, Callable[[], object]], None]

    def ask_new(self, workspace: Workspace) -> None:
        """A new design, from a template."""
        choices = templates.list_templates()
        titles = {each.name: f"{each.title}: {each.doc}" for each in choices}
        with titled_dialog(f"New design in {workspace.project.name}") as dialog:
            name = _name_field("Component", "", "FollowBall")
            ui.label("Begin with").classes("field-label")
            begin = ui.radio(titles, value=choices[0].name).classes("template-choice")

            def create() -> None:
                wanted = name.value.strip()
                template = next(each for each in choices if each.name == begin.value)
                refused = trash.validate_component_name(workspace, wanted)
                if refused or not self._run_file_operation(
                    lambda: workspace.create(wanted, _text_of(template, wanted, workspace))
                ):
                    self._show_error(refused)
                    _suggest_valid_name(name)
                    return
                dialog.close()
                ui.navigate.to(design_url(workspace.key, wanted))

            _buttons(dialog, "Create", create, name)

    def ask_duplicate(self, workspace: Workspace, component: str) -> None:
        """A copy under another name."""
        with titled_dialog(f"Duplicate {component}") as dialog:
            name = _name_field("Name of the copy", trash.copy_name(workspace, component), "")

            def copy() -> None:
                wanted = name.value.strip()
                refused = trash.validate_component_name(workspace, wanted)
                if refused or not self._run_file_operation(
                    lambda: trash.duplicate_design(workspace, component, wanted)
                ):
                    self._show_error(refused)
                    _suggest_valid_name(name)
                    return
                dialog.close()
                self.show_toast(f"{wanted} is a copy of {component}", "positive")

            _buttons(dialog, "Duplicate", copy, name)

    def ask_rename(self, workspace: Workspace, component: str) -> None:
        """Another name, with all that changes listed while it is typed."""
        with titled_dialog(f"Rename {component}") as dialog:
            name = _name_field("New name", component, "")
            ui.label("What changes").classes("field-label")
            listed = ui.column().classes("change-list").props('aria-live="polite"')

            def plan() -> rename_component.ComponentRenamePlan:
                return rename_component.plan_component_rename(workspace, component, name.value.strip())

            def show() -> None:
                planned = plan()
                listed.clear()
                with listed:
                    for change in planned.changes:
                        ui.label(change.file.name).classes("mono")
                        ui.label(change.summary)
                    if planned.changes and workspace.broken_file_names:
                        unread = f"Not looked into, as it cannot be read: {', '.join(workspace.broken_file_names)}"
                        ui.label(unread).classes("empty")
                    if planned.error:
                        ui.label(f"Not possible: {planned.error}").classes("empty")

            def rename() -> None:
                planned = plan()
                if planned.error or not self._rename(workspace, planned):
                    self._show_error(planned.error)
                    _suggest_valid_name(name)
                    return
                dialog.close()

            name.on_value_change(show)
            show()
            _buttons(dialog, "Rename everywhere", rename, name)

    def ask_move_to_trash(self, workspace: Workspace, component: str) -> None:
        """Move a design to the trash."""
        refused = trash.validate_move_to_trash(workspace, component)
        if refused:
            self.show_toast(_capitalize(refused), "warning")
            return
        users = trash.find_dependents(workspace, component)
        with titled_dialog(f"Move {component} to the trash?") as dialog:
            ui.label(f"{workspace.files[component].name} goes to the trash of this computer; Undo puts it back.")
            if users:
                ui.label(f"Still used by {', '.join(users)}: these get findings until they use something else.")

            def remove() -> None:
                dialog.close()
                self._run_file_operation(lambda: self._move_to_trash(workspace, component))

            _buttons(dialog, "Move to trash", remove, None)

    def _move_to_trash(self, workspace: Workspace, component: str) -> None:
        self.offer_restore(workspace, trash.move_to_trash(workspace, component))

    def offer_restore(self, workspace: Workspace, thrown: TrashedDesign) -> None:
        """Offer to put a design back that was thrown away."""

        def undo() -> None:
            refused = trash.restore_from_trash(workspace, thrown)
            self.show_toast(_capitalize(refused) or f"{thrown.component} is back", "warning" if refused else "positive")

        self.offer_undo(f"{thrown.component} is in the trash", undo)

    def _rename(self, workspace: Workspace, planned: rename_component.ComponentRenamePlan) -> bool:
        def rename() -> None:
            refused = rename_component.apply_component_rename(workspace, planned)
            if refused:
                self._show_error(refused)
                return
            back = rename_component.plan_component_rename(workspace, planned.new, planned.old)
            self.offer_undo(f"{planned.old} is {planned.new} now", lambda: self._rename_back(workspace, back))

        return self._run_file_operation(rename)

    def _rename_back(self, workspace: Workspace, planned: rename_component.ComponentRenamePlan) -> None:
        again = rename_component.plan_component_rename(workspace, planned.old, planned.new)
        refused = again.error
        if refused or not self._run_file_operation(lambda: rename_component.apply_component_rename(workspace, again)):
            self._show_error(refused)
            return
        self.show_toast(f"It is {planned.new} again", "positive")

    def _show_error(self, refused: str) -> None:
        if refused:
            self.show_toast(_capitalize(refused), "warning")

    def _run_file_operation(self, act: Callable[[], object]) -> bool:
        """Do something to files; what the system has against it is told."""
        try:
            act()
        except OSError as error:
            self.show_toast(f"Not done: {error}", "negative")
            return False
        return True


def _text_of(template: templates.Template, component: str, workspace: Workspace) -> str:
    return templates.instantiate_template(template, component, workspace.project)


def _name_field(label: str, value: str, example: str) -> ui.input:
    field = ui.input(label, value=value, placeholder=example).classes("dialog-field")
    field.props("outlined dense stack-label autofocus maxlength=80")
    return field


def _suggest_valid_name(field: ui.input) -> None:
    """Put the nearest name there is into a field whose text is none; one press more takes it."""
    wanted = str(field.value).strip()
    if not is_valid_name(wanted) and name_from_text(wanted):
        field.set_value(name_from_text(wanted))


def _buttons(dialog: ui.dialog, label: str, act: Callable[[], object], field: ui.input | None) -> None:
    if field is not None:
        field.on("keydown.enter", act)
    with ui.row().classes("dialog-buttons"):
        ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
        primary_button(label, act)


def _capitalize(words: str) -> str:
    return words[:1].upper() + words[1:]
