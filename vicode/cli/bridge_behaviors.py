"""Loads what `vicode bridge` runs: generated designs or XABSL agents, bound to the class of the world."""

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.console import print_findings
from vicode.model.project import BridgeSettings
from vicode.services.project_loader import XABSL_SUFFIXES, LoadedProject, load_projects

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from vicode.bridge import World
    from vicode.bridge.behaviors import BehaviorCatalog
    from vicode.bridge.binding import DeclaredType, Requirement


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedBehaviors:
    """Behaviors, what they require of the world, and the settings of their project."""

    catalog: "BehaviorCatalog"
    requirements: "Sequence[Requirement]"
    types: "Mapping[str, DeclaredType]"
    settings: BridgeSettings


def load_behaviors(args: argparse.Namespace, folder: Path) -> LoadedBehaviors | int:
    """Load the behaviors; the exit code, after the reasons were printed, if that is impossible.

    Args:
        args: The arguments of the command.
        folder: An empty folder for generated code.
    """
    is_xabsl = Path(args.path).suffix in XABSL_SUFFIXES
    loaded = _load_agents(args) if is_xabsl else _load_designs(args, folder)
    if isinstance(loaded, LoadedBehaviors) and args.behavior and args.behavior not in loaded.catalog.names:
        names = ", ".join(loaded.catalog.names)
        print(f"vicode: there is no behavior '{args.behavior}'; choose from: {names}", file=sys.stderr)
        return 2
    return loaded


def load_world(name: str, loaded: LoadedBehaviors) -> "type[World] | int":
    """Load the class of the world and bind it to the behaviors; the exit code, after the reasons were printed."""
    from vicode.bica.loader import UserCodeError, describe_user_error
    from vicode.bridge.binding import apply_types, find_declaration_problems, find_missing

    if not name:
        print("vicode: which world? Add 'bridge: {world: module:Class}' to project.yaml, or --world", file=sys.stderr)
        return 2
    try:
        world_class = _import_world(name)
        apply_types(world_class, loaded.types)
        world = world_class()
    except UserCodeError as error:
        print(f"vicode: {error}", file=sys.stderr)
        return 2
    except Exception as error:
        print(f"vicode: cannot create {name}: {describe_user_error(error)}", file=sys.stderr)
        return 2
    problems = [*find_declaration_problems(world_class), *find_missing(world, loaded.requirements)]
    if problems:
        print(f"vicode: {name} does not fit the behaviors:", *problems, sep="\n  ", file=sys.stderr)
        return 1
    return world_class


def _import_world(name: str) -> "type[World]":
    from vicode.bica.loader import UserCodeError, load_attribute
    from vicode.bridge import World

    world_class = load_attribute(name)
    if not (isinstance(world_class, type) and issubclass(world_class, World)):
        raise UserCodeError(f"{name} is no world of the bridge; derive it from vicode.bridge.World")
    return world_class


def _load_agents(args: argparse.Namespace) -> LoadedBehaviors | int:
    from vicode.bridge.behaviors import XabslCatalog
    from vicode.cli.xabsl_behavior import print_behavior_findings
    from vicode.findings import Severity
    from vicode.services.bridge_interfaces import xabsl_requirements
    from vicode.xabsl.behavior_loader import compile_behavior
    from vicode.xabsl.compiler import declared_symbols

    path = Path(args.path)
    compiled = compile_behavior(path)
    print_behavior_findings([each for each in compiled.findings if each.severity is Severity.ERROR], path)
    if compiled.program is None:
        return 1
    agents = [name for name, _root in compiled.program.agents]
    _add_import_path(args.import_path or path.parent)
    return LoadedBehaviors(
        catalog=XabslCatalog(
            program=compiled.program,
            symbols=declared_symbols(compiled.table),
            default=args.behavior or _only(agents),
        ),
        requirements=xabsl_requirements(compiled.program, compiled.table, path.parent),
        types={},
        settings=BridgeSettings(),
    )


def _load_designs(args: argparse.Namespace, folder: Path) -> LoadedBehaviors | int:
    from vicode.bridge.behaviors import DesignCatalog
    from vicode.generators import generate, python_class_path
    from vicode.output import apply_diffs, compare_files
    from vicode.services.bridge_interfaces import design_requirements, design_types

    projects = load_projects([args.path], args.profile)
    if len(projects) > 1:
        print(f"vicode: {args.path} contains {len(projects)} projects; specify one", file=sys.stderr)
        return 2
    (loaded,) = projects
    if errors := loaded.errors_for("python"):
        print_findings(errors, to_stderr=True)
        return 1
    roots = _list_roots(loaded)
    project = loaded.open_project.project
    used = sorted(set(roots.values()))
    files = generate(project, components=used, languages=["python"], sources=loaded.open_project.design_paths)
    apply_diffs(compare_files(files, folder), folder)
    _add_import_path(args.import_path or loaded.open_project.folder)
    _add_import_path(folder / "python")
    default = args.behavior or _only(list(dict.fromkeys(roots.values())))
    return LoadedBehaviors(
        catalog=DesignCatalog(
            classes={name: python_class_path(project, root) for name, root in roots.items()}, default=default
        ),
        requirements=design_requirements(loaded.open_project, used),
        types=design_types(project),
        settings=project.bridge,
    )


def _list_roots(loaded: LoadedProject) -> dict[str, str]:
    """The root components by the names that robots choose: agents, and the designs that were given."""
    project = loaded.open_project.project
    designs = loaded.requested or loaded.selected_designs
    agents = {agent.name: agent.root for agent in project.agents if agent.root in designs}
    return agents | {name: name for name in designs}


def _only(names: list[str]) -> str:
    return names[0] if len(names) == 1 else ""


def _add_import_path(folder: Path) -> None:
    path = str(folder.resolve())
    if path not in sys.path:
        sys.path.insert(0, path)
