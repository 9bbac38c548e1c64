"""Compares the code that a robot runs with the code generated from the open designs."""

import hashlib
from collections.abc import Mapping

from vicode.generators import UnsoundDesignError, generate, list_component_paths
from vicode.model.project import Project
from vicode.simulation.robots import RobotDescription


def find_other_versions(
    project: Project, sources: Mapping[str, str], robot: RobotDescription
) -> tuple[str, ...] | None:
    """The designs whose generated file differs from that of the robot; None if they cannot be generated.

    Args:
        project: The project with its current designs.
        sources: The design files by component.
        robot: The robot with the hashes of its files.
    """
    known = {name: each.code for name, each in robot.components.items() if each.code and project.design(name)}
    hashes: dict[str, set[str]] = {name: set() for name in known}
    try:
        for standalone in (False, True):
            files = generate(
                project, components=list(known), languages=("python",), sources=sources, standalone=standalone
            )
            texts = {file.path: file.text for file in files}
            for name, found in hashes.items():
                found |= {_hash(texts[path]) for path in list_component_paths(project, name) if path in texts}
    except UnsoundDesignError:
        return None
    return tuple(name for name, code in known.items() if code not in hashes[name])


def _hash(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()
