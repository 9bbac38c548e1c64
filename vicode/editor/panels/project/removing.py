"""Removes what project.yaml declares; where others say it, they are listed first."""

from itertools import groupby

from nicegui import ui

from vicode.editor.panels.desk import Desk
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.project.fields import write_project
from vicode.editor.panels.rows import primary_button
from vicode.editor.session.mentions import Mention, mentions_of
from vicode.editor.session.project_spots import Spot

_MOST = 40


def remove(desk: Desk, spot: Spot) -> None:
    """Remove a thing: at once where nothing says it, else after it was shown what does."""
    project = desk.workspace.project
    name, names = spot.name(project), spot.names(project)
    if not name:
        return
    if spot.section == "elements" and len(Spot(steps=spot.steps[:-1]).read(project).elements) == 1:
        desk.say("An enumeration has at least one element: remove the enumeration", "warning")
        return
    mentions = mentions_of(project, spot.declared(project))
    if not mentions:
        _remove(desk, spot)
        return
    with titled_dialog(f"Remove {spot.kind} {name}?") as dialog:
        ui.label("It is used here; what says it gets findings until it says something else:").classes("field-label")
        _list(mentions)
        if desk.workspace.broken:
            ui.label(f"Not looked into, as it cannot be read: {', '.join(desk.workspace.broken)}").classes("empty")

        def go_on() -> None:
            dialog.close()
            if spot.names(desk.workspace.project) == names:
                _remove(desk, spot)
            else:
                desk.say(f"Somebody else removed, renamed or moved {name}: look again", "warning")

        with ui.row().classes("dialog-buttons"):
            ui.button("Cancel", on_click=dialog.close).props("flat no-caps autofocus")
            primary_button("Remove anyway", go_on)
    dialog.on("hide", dialog.delete)


def _list(mentions: tuple[Mention, ...]) -> None:
    with ui.column().classes("change-list mention-list").props('role="list"'):
        for component, found in groupby(mentions[:_MOST], key=lambda each: each.component):
            ui.label(component or "project.yaml").classes("mono").props('role="listitem"')
            ui.label("; ".join(each.words for each in found)).props('role="listitem"')
        if len(mentions) > _MOST:
            ui.label(f"and {len(mentions) - _MOST} more places").props('role="listitem"')


def _remove(desk: Desk, spot: Spot) -> None:
    name = spot.name(desk.workspace.project)
    refused = write_project(desk, spot.without, f"no {spot.kind} {name} any more", spot, is_agreed=True)
    if refused:
        desk.say(refused[:1].upper() + refused[1:], "warning")
