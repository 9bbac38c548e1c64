"""Writes project.yaml. Each change is saved immediately and can be undone."""

from collections.abc import Callable
from typing import Any

from vicode.editor.panels import texts
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.descriptions import error_reason
from vicode.editor.session.project.project_edits import ProjectEdit, edit_design_and_project, edit_project_file
from vicode.editor.session.project.project_paths import ProjectNodePath
from vicode.model.design import Design
from vicode.model.project import Project


def write_node(context: WindowContext, path: ProjectNodePath, change: Callable[[Any], Any]) -> str:
    """Change a node in project.yaml; return an error message, or "" on success."""
    project = context.workspace.project
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
