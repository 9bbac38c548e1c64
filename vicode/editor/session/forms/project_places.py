"""The fields of project.yaml that edits of forms change."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from vicode.editor.session.forms.fields import field_of, xabsl_field
from vicode.editor.session.forms.form_field import FormField
from vicode.editor.session.forms.form_paths import resolve
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.session.forms.nodes import CodeText, Field, Node, iter_fields
from vicode.editor.session.forms.project_form import project_parts
from vicode.editor.session.gestures.item_paths import item_at
from vicode.editor.session.project.project_paths import ProjectNodePath
from vicode.findings import DesignPath
from vicode.model.project import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectPlace:
    """A field: the node of project.yaml that has it, its path in the file, and how it is read and written."""

    node: ProjectNodePath
    file_path: DesignPath
    field: FormField


def resolve_in_project(project: Project, ids: ListIds, steps: DesignPath) -> DesignPath | None:
    """The path with indices of a path in a form; None if it does not lead to project.yaml, or no longer."""
    return resolve(project, ids.of_project(project), (), steps[1:]) if steps[:1] == ("project",) else None


def node_path(steps: DesignPath) -> ProjectNodePath:
    """The path to a node by its sections and indices."""
    pairs = zip(steps[::2], steps[1::2], strict=True)
    return ProjectNodePath(steps=tuple((str(section), int(index)) for section, index in pairs))


def find_project_place(project: Project, ids: ListIds, steps: DesignPath) -> ProjectPlace | None:
    """The field at a path in a form; None if there is none."""
    resolved = resolve_in_project(project, ids, steps)
    if resolved is None or len(resolved) % 2 == 0:
        return None
    path, name = node_path(resolved[:-1]), str(resolved[-1])
    if (path.section, name) == ("elements", "xabsl"):
        owner = ProjectNodePath(steps=path.steps[:-1])
        file_path = (*owner.path(project), "xabsl_elements")
        return ProjectPlace(node=owner, file_path=file_path, field=xabsl_field(path.name(project)))
    field = field_of(item_at(project, resolved[:-1]), (name,))
    if field is None:
        return None
    return ProjectPlace(node=path, file_path=(*path.path(project), *_file_key(path.section, name)), field=field)


def project_fields(project: Project, ids: ListIds) -> Iterator[tuple[Field, DesignPath]]:
    """The fields of all forms of project.yaml with their paths in the file."""
    parts: Iterable[tuple[Node, ...]] = project_parts(project, ids.of_project(project)).values()
    for part in parts:
        for node in iter_fields(part):
            place = None if isinstance(node, CodeText) else find_project_place(project, ids, node.path)
            if place is not None:
                yield node, place.file_path


def _file_key(section: str, name: str) -> DesignPath:
    """The key below which an attribute stands in the file: of an element none, it is its value."""
    match (section, name):
        case ("elements", _):
            return ()
        case ("constants", "initial"):
            return ("value",)
        case ("parameters" | "arguments", "initial"):
            return ("default",)
        case (_, "frequency_hz"):
            return ("frequency",)
        case _:
            return (name,)
