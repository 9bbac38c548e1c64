"""Compares the code that a robot runs with the code generated from the open designs."""

import hashlib
from collections.abc import Mapping
from dataclasses import replace
from itertools import product

from vicode.generators import UnsoundDesignError, generate, list_component_paths, list_outputs
from vicode.generators.cpp.live import find_code_hash
from vicode.model.design import Declaration
from vicode.model.project import Project, select_profile
from vicode.robots import RobotDescription

WrittenValues = Mapping[tuple[str, str], tuple[str, str]]
"""Values of a running robot that were written into the files, by component ("" for constants) and name: what the file
had when the robot started, and what it has now."""


def find_other_versions(
    project: Project, sources: Mapping[str, str], robot: RobotDescription, written: WrittenValues | None = None
) -> tuple[str, ...] | None:
    """The designs and shared modules whose generated file differs from that of the robot; None if there are errors.

    The robot may use any profile, with or without its own copy of the runtime.

    Args:
        project: The project with its current designs.
        sources: The design files by component.
        robot: The robot with the hashes of its files.
        written: Values that the robot has although its files have others.
    """
    project = _with_values_at_start(project, written or {})
    known = {name: each.code for name, each in robot.components.items() if each.code and project.design(name)}
    project = replace(project, languages=(robot.language,), live=True)
    outputs = list_outputs(project)
    paths = {name: list_component_paths(project, name) for name in known}
    paths |= {name: tuple(path for path in outputs if path.endswith(f"/{name}")) for name in robot.shared}
    running = {**known, **robot.shared}
    hashes: dict[str, set[str]] = {name: set() for name in running}
    try:
        projects = (project, *(select_profile(project, each.name) for each in project.profiles))
        for each, standalone in product(projects, (False, True)):
            files = generate(
                each,
                components=[name for name in known if each.design(name)],
                languages=(robot.language,),
                sources=sources,
                standalone=standalone,
            )
            texts = {file.path: file.text for file in files}
            for name, found in hashes.items():
                # A component has one file in Python; in C++, the source has a hash of it and the header.
                text = "".join(texts[path] for path in paths[name] if path in texts)
                found.add(find_code_hash(text) or _hash(text))
    except UnsoundDesignError:
        return None
    return tuple(name for name, code in running.items() if code not in hashes[name])


def _with_values_at_start(project: Project, written: WrittenValues) -> Project:
    """The project with the values of the robot's files in place of those that were written since."""

    def restore(component: str, declared: tuple[Declaration, ...]) -> tuple[Declaration, ...]:
        known = ((each, written.get((component, each.name))) for each in declared)
        return tuple(
            replace(each, initial=texts[0]) if texts is not None and each.initial == texts[1] else each
            for each, texts in known
        )

    designs = (replace(each, parameters=restore(each.component, each.parameters)) for each in project.designs)
    return replace(project, constants=restore("", project.constants), designs=tuple(designs)) if written else project


def _hash(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()
