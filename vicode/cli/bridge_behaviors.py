"""Loads what `vicode bridge` runs: generated designs or XABSL agents, and the class of the world."""

import argparse
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.console import print_findings
from vicode.cli.project_loader import XABSL_SUFFIXES, LoadedProject, load_projects

if TYPE_CHECKING:
    from vicode.bridge import World
    from vicode.bridge.behaviors import BehaviorCatalog

_DEFAULT_PORT, _DEFAULT_TICK_MS = 7001, 50.0


@dataclass(frozen=True, slots=True, kw_only=True)
class BridgeSetup:
    """What a server runs, and its settings from the command line or project.yaml."""

    catalog: "BehaviorCatalog"
    make_world: "Callable[[], World]"
    port: int
    tick_ns: int


def load_bridge(args: argparse.Namespace, folder: Path) -> BridgeSetup | int:
    """Load behaviors and world; the exit code, after the reasons were printed, if that is impossible.

    Args:
        args: The arguments of the command.
        folder: An empty folder for generated code.
    """
    path = Path(args.path)
    catalog = _load_agents(args, path) if path.suffix in XABSL_SUFFIXES else _load_designs(args, path, folder)
    if isinstance(catalog, int):
        return catalog
    make_world = _load_world(args.world or "arena.bridge:RescueWorld")
    if make_world is None:
        return 2
    return BridgeSetup(
        catalog=catalog,
        make_world=make_world,
        port=_DEFAULT_PORT if args.port is None else args.port,
        tick_ns=round((args.tick_ms or _DEFAULT_TICK_MS) * 1e6),
    )


def _load_agents(args: argparse.Namespace, path: Path) -> "BehaviorCatalog | int":
    from vicode.bridge.behaviors import XabslCatalog
    from vicode.cli.xabsl_behavior import compile_behavior, print_behavior_findings
    from vicode.findings import Severity
    from vicode.xabsl.compiler import declared_symbols

    compiled = compile_behavior(path)
    print_behavior_findings([each for each in compiled.findings if each.severity is Severity.ERROR], path)
    if compiled.program is None:
        return 1
    _add_import_path(args.import_path or path.parent)
    agents = [name for name, _root in compiled.program.agents]
    default = args.behavior or (agents[0] if len(agents) == 1 else "")
    return XabslCatalog(program=compiled.program, symbols=declared_symbols(compiled.table), default=default)


def _load_designs(args: argparse.Namespace, path: Path, folder: Path) -> "BehaviorCatalog | int":
    from vicode.bridge.behaviors import DesignCatalog
    from vicode.generators import generate, python_class_path
    from vicode.output import apply_diffs, compare_files

    loaded = load_projects([args.path], args.profile)
    if len(loaded) > 1:
        print(f"vicode: {path} contains {len(loaded)} projects; specify one", file=sys.stderr)
        return 2
    errors = loaded[0].errors_for("python")
    if errors:
        print_findings(errors, to_stderr=True)
        return 1
    default = next(iter(loaded[0].requested), "")
    (whole,) = load_projects([str(loaded[0].open_project.folder)], args.profile)
    project = whole.open_project.project
    names = [each for each in whole.selected_designs if each not in whole.components_with_errors("python")]
    files = generate(project, components=names, languages=["python"], sources=whole.design_paths)
    apply_diffs(compare_files(files, folder), folder)
    _add_import_path(whole.open_project.folder)
    _add_import_path(folder / "python")
    roots = {agent.name: agent.root for agent in project.agents if agent.root in names} | {name: name for name in names}
    classes = {name: python_class_path(project, root) for name, root in roots.items()}
    return DesignCatalog(classes=classes, default=args.behavior or default or _only_agent(whole))


def _only_agent(whole: LoadedProject) -> str:
    agents = [agent.name for agent in whole.open_project.project.agents] or list(whole.selected_designs)
    return agents[0] if len(agents) == 1 else ""


def _load_world(name: str) -> "Callable[[], World] | None":
    from vicode.bica.loader import UserCodeError, load_attribute
    from vicode.bridge import World

    try:
        world_class = load_attribute(name)
    except UserCodeError as error:
        print(f"vicode: {error}", file=sys.stderr)
        return None
    if not (isinstance(world_class, type) and issubclass(world_class, World)):
        print(f"vicode: {name} is no world of the bridge; derive it from vicode.bridge.World", file=sys.stderr)
        return None
    return world_class


def _add_import_path(folder: Path) -> None:
    sys.path.insert(0, str(folder.resolve()))
