"""Removes what project.yaml declares; where others say it, they are listed first."""

from itertools import groupby

from nicegui import ui

from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.project.project_fields import write_project
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.project_paths import ProjectNodePath
from vicode.editor.session.references import ReferenceLocation, find_references

_MAX_LISTED = 40


def confirm_and_remove(context: WindowContext, spot: ProjectNodePath) -> None:
    """Remove a thing: at once where nothing says it, else after it was shown what does."""
    project = context.workspace.project
    name, names = spot.name(project), spot.names(project)
    if not name:
        return
    if spot.section == "elements" and len(ProjectNodePath(steps=spot.steps[:-1]).get(project).elements) == 1:
        context.show_toast("An enumeration has at least one element: remove the enumeration", "warning")
        return
    mentions = find_references(project, spot.symbol_ref(project))
    if not mentions:
        _remove(context, spot)
        return
    with titled_dialog(f"Remove {spot.kind} {name}?") as dialog:
        ui.label("It is used here; what says it gets findings until it says something else:").classes("field-label")
        _list(mentions)
        if context.workspace.broken_file_names:
            ui.label(
                f"Not looked into, as it cannot be read: {', '.join(context.workspace.broken_file_names)}"
            ).classes("empty")

        def go_on() -> None:
            dialog.close()
            if spot.names(context.workspace.project) == names:
                _remove(context, spot)
            else:
                context.show_toast(f"Somebody else removed, renamed or moved {name}: look again", "warning")

        with ui.row().classes("dialog-buttons"):
            ui.button("Cancel", on_click=dialog.close).props("flat no-caps autofocus")
            primary_button("Remove anyway", go_on)
    dialog.on("hide", dialog.delete)


def _list(mentions: tuple[ReferenceLocation, ...]) -> None:
    with ui.column().classes("change-list reference-list").props('role="list"'):
        for component, found in groupby(mentions[:_MAX_LISTED], key=lambda each: each.component):
            ui.label(component or "project.yaml").classes("mono").props('role="listitem"')
            ui.label("; ".join(each.description for each in found)).props('role="listitem"')
        if len(mentions) > _MAX_LISTED:
            ui.label(f"and {len(mentions) - _MAX_LISTED} more places").props('role="listitem"')


def _remove(context: WindowContext, spot: ProjectNodePath) -> None:
    name = spot.name(context.workspace.project)
    refused = write_project(context, spot.remove, f"no {spot.kind} {name} any more", spot, is_agreed=True)
    if refused:
        context.show_toast(refused[:1].upper() + refused[1:], "warning")
