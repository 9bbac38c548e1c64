"""The files of the designs of an import: their texts with comments and computed positions."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from vicode.diagram.layered_layout import complete_layout
from vicode.diagram.layout import LayoutService
from vicode.importers import ImportResult
from vicode.model.edits import move_nodes
from vicode.model.project import Project
from vicode.output import resolve_below, write_atomically
from vicode.store import add_comments, save_design, save_project_file


def format_files(imported: ImportResult) -> dict[str, str]:
    """The texts of project.yaml and the designs, by path relative to the project."""
    project = imported.project
    comments = [(comment.path, comment.text) for comment in imported.comments]
    texts = {"project.yaml": add_comments(save_project_file(project), comments, is_project_file=True)}
    for design, about in zip(project.designs, imported.designs, strict=True):
        comments = [(comment.path, comment.text) for comment in about.comments]
        texts[about.path] = add_comments(save_design(design), comments)
    return texts


def design_paths(imported: ImportResult) -> dict[str, str]:
    return {about.component: about.path for about in imported.designs}


def with_layout(project: Project) -> Project:
    """A project whose designs have positions: all are computed, or those that are missing."""
    designs = []
    with LayoutService() as service:
        for design in project.designs:
            is_placed = any(state.at for state in design.states)
            places = complete_layout(design) if is_placed else service.compute(design).layout
            common = places.common if design.common.transitions or design.common.actions else None
            designs.append(
                move_nodes(design, _rounded(places.states), _rounded(places.uses), common and _round(common))
            )
    return replace(project, designs=tuple(designs))


def _rounded(places: dict[str, tuple[float, float]]) -> dict[str, tuple[float, float]]:
    return {name: _round(at) for name, at in places.items()}


def _round(at: tuple[float, float]) -> tuple[float, float]:
    return (round(at[0]), round(at[1]))


def write_files(folder: Path, texts: Mapping[str, str]) -> None:
    targets = {resolve_below(folder, path): text for path, text in texts.items()}
    for target, text in targets.items():
        target.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(target, text)
