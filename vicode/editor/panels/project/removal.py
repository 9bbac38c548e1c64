"""Removes nodes of project.yaml, after confirmation if they are used."""

from itertools import groupby

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.project.writing import write_project
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.project.project_paths import ProjectNodePath
from vicode.model.references import ReferenceLocation, find_references

_MAX_LISTED = 40


def confirm_and_remove(context: WindowContext, path: ProjectNodePath) -> None:
    """Remove a node; if it is used, list the references and ask for confirmation."""
    project = context.workspace.project
    name = path.name(project)
    if path.section == "elements" and len(ProjectNodePath(steps=path.steps[:-1]).get(project).elements) == 1:
        context.show_toast("An enumeration needs at least one element. Remove the enumeration instead.", "warning")
        return
    references = find_references(project, path.symbol_ref(project))
    if not references:
        _remove(context, path)
        return
    with titled_dialog(f"Remove {path.kind} {name}?") as dialog:
        ui.label("It is used in these places, which will report errors:").classes("field-label")
        _list(references)
        if context.workspace.broken_file_names:
            ui.label(texts.skipped_files(context.workspace.broken_file_names)).classes("empty")

        def remove() -> None:
            dialog.close()
            if path.name(context.workspace.project) == name:
                _remove(context, path)
            else:
                context.show_toast(f"Another user removed, renamed or moved {name}. Check and try again.", "warning")

        with ui.row().classes("dialog-buttons"):
            ui.button("Cancel", on_click=dialog.close).props("flat no-caps autofocus")
            primary_button("Remove anyway", remove)
    dialog.on("hide", dialog.delete)


def _list(references: tuple[ReferenceLocation, ...]) -> None:
    with ui.column().classes("change-list reference-list").props('role="list"'):
        for component, locations in groupby(references[:_MAX_LISTED], key=lambda each: each.component):
            ui.label(component or "project.yaml").classes("mono").props('role="listitem"')
            ui.label("; ".join(each.description for each in locations)).props('role="listitem"')
        if len(references) > _MAX_LISTED:
            ui.label(texts.more(len(references) - _MAX_LISTED, "places")).props('role="listitem"')


def _remove(context: WindowContext, path: ProjectNodePath) -> None:
    what = f"remove {path.kind} {path.name(context.workspace.project)}"
    error = write_project(context, path.remove, what, path, is_confirmed=True)
    if error:
        context.show_toast(texts.sentence(error), "warning")
