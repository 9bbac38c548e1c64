"""Import an XABSL behavior as a project of designs."""

import argparse
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.console import count_findings
from vicode.cli.xabsl_behavior import load_behavior, print_behavior_findings

if TYPE_CHECKING:
    from vicode.importers import ImportResult
    from vicode.model.project import Project


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("agents", metavar="AGENTS.xabsl", type=Path, help="XABSL file with the agents")
    parser.add_argument(
        "--out", metavar="DIR", type=Path, required=True, help="project folder to create, such as designs/NAME"
    )
    parser.add_argument("--name", help="project name (default: the name of the folder)")
    parser.add_argument("--force", action="store_true", help="overwrite existing designs")


def run(args: argparse.Namespace) -> int:
    """Write the designs; return 1 if the behavior has errors or files would be overwritten."""
    from vicode.findings import Severity
    from vicode.importers import import_behavior, render_robot_class
    from vicode.store.documents import default_project_name
    from vicode.xabsl.compiler import compile_source

    source = load_behavior(args.agents)
    compiled = compile_source(source)
    if compiled.program is None:
        print_behavior_findings([each for each in compiled.findings if each.severity is Severity.ERROR], args.agents)
        print(f"nothing written: {count_findings(compiled.findings)}", file=sys.stderr)
        return 1
    imported = import_behavior(source, compiled, args.name or default_project_name(args.out.resolve().name))
    texts = _texts(replace(imported, project=_with_layout(imported.project)))
    there = [path for path in texts if (args.out / path).exists()]
    if there and not args.force:
        more = f" and {len(there) - 1} more" if len(there) > 1 else ""
        print(f"vicode: {args.out / there[0]}{more} would be overwritten; use --force", file=sys.stderr)
        return 1
    _write(args.out, texts)
    robot = args.out / "robot.py"
    # Edited by hand: never overwritten.
    if not robot.exists():
        _write(args.out, {robot.name: render_robot_class(imported.project)})
    print(_summary(imported, args.out))
    return 0


def _with_layout(project: "Project") -> "Project":
    from vicode.diagram.layout import LayoutService
    from vicode.model.edits import move_nodes

    designs = []
    with LayoutService() as service:
        for design in project.designs:
            places = service.compute(design).layout
            common = places.common if design.common.transitions or design.common.actions else None
            designs.append(
                move_nodes(design, _rounded(places.states), _rounded(places.uses), common and _round(common))
            )
    return replace(project, designs=tuple(designs))


def _rounded(places: "dict[str, tuple[float, float]]") -> "dict[str, tuple[float, float]]":
    return {name: _round(at) for name, at in places.items()}


def _round(at: "tuple[float, float]") -> "tuple[float, float]":
    return (round(at[0]), round(at[1]))


def _texts(imported: "ImportResult") -> "dict[str, str]":
    from vicode.store import add_comments, save_design, save_project_file

    project = imported.project
    texts = {"project.yaml": add_comments(save_project_file(project), imported.comments, is_project_file=True)}
    for design, about in zip(project.designs, imported.designs, strict=True):
        texts[about.path] = add_comments(save_design(design), about.comments)
    return texts


def _write(folder: Path, texts: "dict[str, str]") -> None:
    from vicode.output import write_atomically

    for path, text in texts.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        write_atomically(folder / path, text)


def _summary(imported: "ImportResult", folder: Path) -> str:
    project = imported.project
    remarks = len(imported.comments) + sum(len(each.comments) for each in imported.designs)
    parts = [
        _count(len(project.designs), "design"),
        _count(sum(len(design.states) for design in project.designs), "state"),
        _count(len(project.components), "hand-written component"),
        _count(len(project.agents), "agent"),
        _count(remarks, "comment"),
    ]
    return f"wrote {folder.as_posix()}: {', '.join(parts)}"


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"
