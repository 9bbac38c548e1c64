"""Loads the projects at paths of the command line: designs, project folders, folders of projects."""

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.findings import Finding, Severity

if TYPE_CHECKING:
    from vicode.model.project import Project
    from vicode.store import OpenProject

    _Check = Callable[[Project, Collection[str] | None], tuple[Finding, ...]]

DESIGN_SUFFIXES = (".yaml", ".yml")
XABSL_SUFFIXES = (".xabsl", ".yabsl")


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedProject:
    """A project with its selected components (None for all) and their findings.

    `requested` are the components whose files were given; the other selected components are used by them.
    """

    open_project: "OpenProject"
    selected_components: frozenset[str] | None
    requested: tuple[str, ...] = ()
    findings: tuple[Finding, ...]

    @property
    def selected_designs(self) -> tuple[str, ...]:
        """The selected components that have a design, in order."""
        designs = (design.component for design in self.open_project.project.designs)
        return tuple(name for name in designs if self.selected_components is None or name in self.selected_components)

    def components_with_errors(self, language: str) -> frozenset[str]:
        """The components for which no code can be generated; errors in project.yaml affect all components."""
        from vicode.store import find_faulty_components

        return find_faulty_components(self.errors_for(language), self.open_project)

    def errors_for(self, language: str) -> tuple[Finding, ...]:
        """The errors that prevent generating code in a language."""
        return tuple(each for each in self.findings if each.severity is Severity.ERROR and each.applies_to(language))


def load_projects(
    paths: Sequence[str], profile: str = "", *, with_warnings: bool = False, deep: bool = False
) -> tuple[LoadedProject, ...]:
    """Load every project once, with the implementations of a profile.

    Args:
        paths: Folders and files.
        profile: The name of a profile.
        with_warnings: Whether the findings include warnings and notes about designs, besides those about project.yaml.
        deep: Whether they include what takes longer (`vicode.check.behavior`).

    Raises:
        OSError: A path does not exist or cannot be read, there is no design at all, or no such profile.
    """
    # Deferred: --help does not need the store, which is slow to import.
    from vicode.store import find_projects

    wanted: dict[Path, set[Path] | None] = {}
    for path in (Path(each) for each in paths):
        path.stat()
        require_design_file(path)
        if path.is_dir():
            wanted.update(dict.fromkeys(find_projects(path)))
        elif path.name in ("project.yaml", "project.yml"):
            wanted[path.parent] = None
        else:
            (folder,) = find_projects(path)
            files = wanted.setdefault(folder, set())
            if files is not None:
                files.add(path)
    if not wanted:
        raise OSError(f"no designs in {', '.join(paths)}{_hint(paths)}")
    check = _load_check(with_warnings=with_warnings, deep=deep)
    return tuple(_load_project(folder, files, profile, check) for folder, files in wanted.items())


def _load_check(*, with_warnings: bool, deep: bool) -> "_Check":
    from vicode.check import check_file, check_project, find_errors

    if not with_warnings:
        # Those of project.yaml are few, and found fast.
        return lambda project, components: tuple(
            dict.fromkeys((*check_file(project), *find_errors(project, components)))
        )
    if not deep:
        return check_project

    from vicode.check.behavior import check_behavior

    return check_behavior


def _hint(paths: Sequence[str]) -> str:
    """How to get designs from what the paths contain."""
    from vicode.xabsl.source_loader import find_agent_files

    found = next((file for path in paths for file in find_agent_files(Path(path))), None)
    if found:
        return f"; 'vicode import {found}' converts an XABSL behavior to designs"
    return f"; create one with 'vicode edit {paths[0]}', or copy a sample with 'vicode sample'"


def require_design_file(path: Path) -> None:
    """Raise OSError if a file is not a design."""
    if path.is_file() and path.suffix not in DESIGN_SUFFIXES:
        way = "; 'vicode import' converts an XABSL behavior to designs" if path.suffix in XABSL_SUFFIXES else ""
        raise OSError(f"{path} is not a design; specify a design (.yaml) or a folder with designs{way}")


def _load_project(folder: Path, files: set[Path] | None, profile: str, check: "_Check") -> LoadedProject:
    from vicode.generators import collect_components
    from vicode.store import locate_findings, open_project

    if files is None:
        opened = _select_profile(open_project(folder), profile)
        return LoadedProject(
            open_project=opened,
            selected_components=None,
            findings=(
                *locate_findings([*opened.findings, *check(opened.project, None)], opened),
                *_check_classes(opened),
            ),
        )
    opened = _select_profile(open_project(min(files)), profile)
    found = (opened.find_component(file) for file in sorted(files))
    named = tuple(name for name in found if name is not None)
    components = collect_components(opened.project, named)
    relevant = {opened.files[name].resolve() for name in (*components, "") if name in opened.files}
    relevant |= {file.resolve() for file in files}
    findings = locate_findings([*opened.findings, *check(opened.project, components)], opened)
    kept = tuple(each for each in findings if each.location is None or Path(each.location.file).resolve() in relevant)
    used = {use.component for each in opened.project.designs if each.component in components for use in each.uses}
    return LoadedProject(
        open_project=opened,
        selected_components=components,
        requested=named,
        findings=(*kept, *_check_classes(opened, used)),
    )


def _check_classes(opened: "OpenProject", components: Collection[str] | None = None) -> tuple[Finding, ...]:
    """Compare hand-written classes with project.yaml."""
    from vicode.check.classes import check_classes
    from vicode.check.module_names import check_module_names
    from vicode.model.project import select_profile
    from vicode.store import read_python_module

    if "python" not in opened.project.languages:
        return ()
    projects = [opened.project, *(select_profile(opened.project, each.name) for each in opened.project.profiles)]
    read_module = partial(read_python_module, opened.folder)
    checks = (check_classes, check_module_names)
    found = (each for project in projects for check in checks for each in check(project, read_module, components))
    return tuple(dict.fromkeys(found))


def _select_profile(opened: "OpenProject", name: str) -> "OpenProject":
    from vicode.model.project import select_profile

    if not name:
        return opened
    try:
        return replace(opened, project=select_profile(opened.project, name))
    except KeyError:
        known = ", ".join(profile.name for profile in opened.project.profiles)
        hint = f"choose from: {known}" if known else "project.yaml has no profiles"
        raise OSError(f"unknown profile '{name}'; {hint}") from None
