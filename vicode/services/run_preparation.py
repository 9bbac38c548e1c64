"""Prepares the run of a component in a new process: its code in a folder, and the origin that its trace names."""

from dataclasses import dataclass
from pathlib import Path

from vicode.generators import collect_components, generate, python_class_path
from vicode.git import GitError, find_repository
from vicode.model.design_hash import hash_design
from vicode.model.project import WORLD, Project
from vicode.output import apply_diffs, compare_files
from vicode.runs.setup import used_components
from vicode.store import OpenProject


@dataclass(frozen=True, slots=True, kw_only=True)
class RunOrigin:
    """The hash of the design that runs, and the git revision of its project, "" if it is in no repository."""

    design: str
    revision: str = ""


def find_origin(opened: OpenProject, component: str) -> RunOrigin:
    """What runs; the revision ends in -dirty if the project was modified since."""
    design = hash_design(opened.project, component)
    try:
        repository = find_repository(opened.folder)
        if repository.head is None:
            return RunOrigin(design=design)
        is_modified = repository.is_modified([repository.relative(opened.folder)])
    except GitError:
        return RunOrigin(design=design)
    return RunOrigin(design=design, revision=repository.head + ("-dirty" if is_modified else ""))


def needs_bridge(project: Project, component: str) -> bool:
    """Whether a component uses the world, and the project has one only for robots that connect."""
    if project.world or not project.bridge.world:
        return False
    designs = (project.design(name) for name in collect_components(project, {component}))
    used = (project.interface(use.component) for design in designs if design for use in design.uses)
    return any(interface and interface.implementation == WORLD for interface in used)


def find_topics(project: Project, component: str) -> tuple[str, ...]:
    """The components that a component uses, directly or not, and that a profile connects to topics of ROS 2."""
    design = project.design(component)
    used = used_components(project, design) if design is not None else ()
    return tuple(each.component for each in project.components if each.component in used and each.is_topic)


def generate_for_run(opened: OpenProject, component: str, folder: Path) -> str:
    """Generate the component and all it uses into a folder; return the path of its class."""
    project = opened.project
    files = generate(project, components=[component], languages=["python"], sources=opened.design_paths)
    apply_diffs(compare_files(files, folder), folder)
    return python_class_path(project, component)
