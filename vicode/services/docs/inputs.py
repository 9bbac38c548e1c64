"""Loads the inputs of sites: projects of designs and XABSL behaviors."""

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from urllib.parse import quote

from vicode.check import check_project
from vicode.docsite import (
    ComponentFinding,
    SiteInput,
    SourceText,
    iter_action_paths,
    iter_documented_paths,
    make_site_input,
)
from vicode.findings import DesignPath as ThingPath
from vicode.findings import Finding, Severity
from vicode.importers import ImportResult, import_behavior
from vicode.model.design import Design
from vicode.services.display_paths import with_display_paths
from vicode.services.imported_behavior.cpp_sources import find_cpp_files, find_in_cpp, load_cpp
from vicode.services.project_loader import DESIGN_SUFFIXES, XABSL_SUFFIXES, LoadedProject, load_projects
from vicode.services.xabsl_encoding import find_encoding
from vicode.store import find_projects
from vicode.store.documents import default_project_name
from vicode.xabsl.behavior_loader import DOUBTFUL_ENCODING, load_behavior
from vicode.xabsl.compiler import CompileResult, compile_source
from vicode.xabsl.parser import ParsedFile, parse
from vicode.xabsl.source_loader import ProgramSource, find_agent_files


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedSiteInput:
    """A project or behavior on disk.

    `site_input` is None if nothing can be read. If `is_incomplete`, files are missing because of `read_errors`, which
    also contain doubts about encodings. `encoding` is that of XABSL files.
    `folders` contain its files; `root` is the folder from which the paths of sources start.
    """

    name: str
    site_input: SiteInput | None
    read_errors: tuple[Finding, ...]
    is_incomplete: bool
    folders: tuple[Path, ...]
    root: Path
    encoding: str = ""

    def source_url(self, template: str) -> str:
        """The address of lines in a repository, with {path} from the root of this input."""
        repository = next((each for each in (self.root, *self.root.parents) if (each / ".git").exists()), self.root)
        prefix = "".join(f"{quote(os.fsencode(part))}/" for part in self.root.relative_to(repository).parts)
        return template.replace("{path}", f"{prefix}{{path}}")


def load_site_inputs(paths: Sequence[Path], encoding: str = "") -> tuple[LoadedSiteInput, ...]:
    """Load the inputs at all paths, each once; `encoding` is that of XABSL files that are not UTF-8.

    Raises:
        OSError: A path does not exist or cannot be read.
    """
    readings: list[LoadedSiteInput] = []
    for path in dict.fromkeys(_find_behavior(each) or each for each in paths):
        if path.suffix in XABSL_SUFFIXES:
            readings.append(_load_behavior_input(path, encoding))
        elif files := find_cpp_files(path):
            readings.append(_load_cpp_input(path, files))
        elif path.is_file() and path.suffix not in DESIGN_SUFFIXES:
            raise OSError(
                f"{path} is neither a design nor an XABSL behavior; "
                "specify a design (.yaml), a folder with designs, or the .xabsl file with the agents"
            )
        else:
            readings += [_load_project_input(opened) for opened in load_projects([str(path)], with_warnings=True)]
    return tuple(readings)


def _find_behavior(folder: Path) -> Path | None:
    """The file with the agents if the folder contains one behavior and no designs."""
    if not folder.is_dir() or find_projects(folder):
        return None
    found = tuple(find_agent_files(folder))
    if len(found) > 1:
        more = f" and {len(found) - 2} more" if len(found) > 2 else ""
        raise OSError(f"{folder} contains several behaviors; specify one of {found[0]}, {found[1]}{more}")
    return found[0] if found else None


def _load_project_input(opened: LoadedProject) -> LoadedSiteInput:
    folder = opened.open_project.folder.resolve()
    # If nothing can be read, keep the existing pages.
    is_readable = bool(opened.selected_designs) or not opened.open_project.broken_files
    return LoadedSiteInput(
        name=folder.name,
        site_input=_project_site_input(opened) if is_readable else None,
        read_errors=tuple(each for each in opened.findings if each.severity is Severity.ERROR),
        is_incomplete=bool(opened.open_project.broken_files),
        folders=(folder,),
        root=folder,
    )


def _project_site_input(opened: LoadedProject) -> SiteInput:

    project = opened.open_project.project
    meant = set(opened.selected_designs)
    part = replace(project, designs=tuple(each for each in project.designs if each.component in meant))
    faulty = {language: opened.components_with_errors(language) for language in project.languages}
    return make_site_input(opened.open_project, part, opened.findings, faulty)


def _load_cpp_input(path: Path, files: Sequence[Path]) -> LoadedSiteInput:
    """Load the state machines of C++ files, with their sources."""
    folder = path.resolve() if path.is_dir() else path.resolve().parent
    imported = load_cpp(files, default_project_name(folder.name))
    sources = {
        component: SourceText(
            path=machine.source.path.resolve().relative_to(folder).as_posix(),
            text=machine.source.text,
            language="cpp",
            line_numbers={place: location.line for place, location in machine.locations().items()},
        )
        for component, machine in imported.machines.items()
    }
    found = (
        ComponentFinding(
            component=each.subject.component, line=each.location.line if each.location else 0, finding=each
        )
        for each in find_in_cpp(imported)
        if each.subject
    )
    return LoadedSiteInput(
        name=folder.name,
        site_input=SiteInput(project=imported.result.project, findings=tuple(found), sources=sources),
        read_errors=imported.errors,
        is_incomplete=bool(imported.errors),
        folders=tuple(sorted({file.resolve().parent for file in files})),
        root=folder,
    )


def _load_behavior_input(agents: Path, encoding: str) -> LoadedSiteInput:
    """Load a behavior as a project with XABSL sources."""
    encoding = find_encoding(agents, encoding)
    source = load_behavior(agents, encoding, _parse_cached)
    compiled = compile_source(source)
    errors = [each for each in compiled.findings if each.severity is Severity.ERROR]
    doubts = [each for each in compiled.findings if each.rule.code == DOUBTFUL_ENCODING]
    is_broken = compiled.program is None
    return LoadedSiteInput(
        name=agents.resolve().parent.name,
        site_input=None if is_broken else _behavior_site_input(agents, source, compiled),
        read_errors=with_display_paths([*doubts, *errors] if is_broken else doubts, agents),
        is_incomplete=is_broken,
        folders=tuple(sorted({path.resolve().parent for path in (agents, *source.files)})),
        root=agents.resolve().parent,
        encoding=encoding,
    )


# With --watch, most files are unchanged after an edit.
@lru_cache(maxsize=2000)
def _parse_cached(text: str, name: str) -> ParsedFile:

    return parse(text, name)


def _behavior_site_input(agents: Path, source: ProgramSource, compiled: CompileResult) -> SiteInput:

    imported = import_behavior(source, compiled, default_project_name(agents.resolve().parent.name))
    project = imported.project
    found = [
        ComponentFinding(component=each.subject.component if each.subject else "", line=0, finding=each)
        for each in check_project(project)
    ]
    errors = [each for each in found if each.finding.severity is Severity.ERROR]
    faulty = {
        language: frozenset(each.component for each in errors if each.finding.applies_to(language))
        for language in project.languages
    }
    # In XABSL, only agents have titles.
    title = project.agents[0].title if len(project.agents) == 1 else ""
    return SiteInput(
        project=project,
        findings=tuple(found),
        sources=_sources(source, imported),
        components_with_errors=faulty,
        title=title,
    )


def _sources(source: ProgramSource, imported: ImportResult) -> dict[str, SourceText]:
    """The XABSL files by component, with the lines of the states, decisions and parameters of its option."""

    def text_of(path: Path, lines: dict[ThingPath, int], action_lines: dict[ThingPath, int]) -> SourceText:
        folder = source.main.parent
        shown = path.relative_to(folder).as_posix() if path.is_relative_to(folder) else path.name
        return SourceText(
            path=shown,
            text=source.files[path].tokens.text,
            language="xabsl",
            line_numbers=lines,
            action_lines=action_lines,
        )

    sources = {"": text_of(source.main, {}, {})}
    for made, design in zip(imported.designs, imported.project.designs, strict=True):
        tokens, described = source.files[made.file].tokens, set(iter_documented_paths(design))
        lines: dict[ThingPath, int] = {}
        action_lines: dict[ThingPath, int] = {}
        assignments = _assignment_paths(design)
        for token, path in made.anchors:
            line = tokens.line_at(tokens.starts[token])
            if path in described:
                lines.setdefault(path, line)
            elif path in assignments:
                # One action in the design, but several statements in XABSL.
                action_lines.setdefault(path, line)
                action_lines[next(assignments[path], path)] = line
            else:
                action_lines.setdefault(path, line)
        sources[made.component] = text_of(made.file, lines, action_lines)
    return sources


def _assignment_paths(design: Design) -> dict[ThingPath, Iterator[ThingPath]]:
    """The paths of the assignments of each action that assigns, in order."""
    found: dict[ThingPath, list[ThingPath]] = {}
    for path in iter_action_paths(design):
        if len(path) > 1 and path[-2] == "set":
            found.setdefault(path[:-2], []).append(path)
    return {path: iter(paths) for path, paths in found.items()}
