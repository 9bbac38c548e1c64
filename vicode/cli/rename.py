"""Rename a state, component or declaration and all its uses in the designs of a project."""

import argparse
import sys
from difflib import unified_diff
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from vicode.model.rename import SymbolRef
    from vicode.services.rename.files import FileRenamePlan
    from vicode.services.rename.project_files import FilesOnDisk

_KINDS = {
    "component": "components",
    "state": "states",
    "use": "uses",
    "parameter": "parameters",
    "output": "outputs",
    "variable": "variables",
    "argument": "arguments",
    "constant": "constants",
    "enumeration": "enumerations",
    "element": "elements",
    "agent": "agents",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "old",
        metavar="OLD",
        help="COMPONENT, CONSTANT, ENUMERATION or AGENT; COMPONENT.NAME of a state, use or declaration; "
        "ENUMERATION.ELEMENT; COMPONENT.OUTPUT.ARGUMENT",
    )
    parser.add_argument("new", metavar="NEW", help="the new name")
    parser.add_argument(
        "path",
        metavar="PATH",
        nargs="?",
        default=".",
        help="project folder, design, or folder of projects (default: the current folder)",
    )
    parser.add_argument("--kind", choices=_KINDS, help="what OLD is, if several things have this name")
    parser.add_argument("--dry-run", action="store_true", help="write nothing; print a diff")


def run(args: argparse.Namespace) -> int:
    """Rename in all files or none; return 1 if the rename is refused."""
    from vicode.services.rename.files import plan_rename, write_changes

    found = _find(args)
    if found is None:
        return 1
    project_files, symbol = found
    new = args.new.removeprefix(f"{args.old.rpartition('.')[0]}.") if "." in args.old else args.new
    try:
        plan = plan_rename(project_files, symbol, new)
    except ValueError as error:
        print(f"vicode: {error}", file=sys.stderr)
        return 1
    if plan.error:
        print(f"vicode: {plan.error}", file=sys.stderr)
        return 1
    if args.dry_run:
        print(_format_diff(plan), end="")
    else:
        write_changes(plan.changes, plan.removed)
        _print_written(plan)
    for note in plan.notes:
        print(f"vicode: {note}", file=sys.stderr)
    return 0


def _find(args: argparse.Namespace) -> "tuple[FilesOnDisk, SymbolRef] | None":
    """The only symbol with the name and its project; otherwise, print why there is none."""
    from vicode.findings import did_you_mean
    from vicode.model.rename import find_symbols, list_names
    from vicode.services.rename.project_files import FilesOnDisk
    from vicode.store import find_projects, open_project

    projects = [FilesOnDisk(opened=open_project(folder)) for folder in find_projects(Path(args.path))]
    if not projects:
        raise OSError(f"no designs in {args.path}")
    found = [(each, symbol) for each in projects for symbol in find_symbols(each.project, args.old)]
    wanted = [pair for pair in found if args.kind is None or pair[1].section == _KINDS[args.kind]]
    if len(wanted) == 1:
        return wanted[0]
    kinds = {section: kind for kind, section in _KINDS.items()}
    if wanted:
        places = ", ".join(f"{kinds[symbol.section]} in {each.folder.as_posix()}" for each, symbol in wanted)
        print(f"vicode: '{args.old}' is ambiguous: {places}; specify --kind or the project", file=sys.stderr)
        return None
    if found:
        print(f"vicode: there is no {args.kind} '{args.old}': it is a {kinds[found[0][1].section]}", file=sys.stderr)
        return None
    known = [name for each in projects for name in list_names(each.project)]
    hint = did_you_mean(args.old, known)
    print(f"vicode: there is no '{args.old}'{f'; {hint}' if hint else ''}", file=sys.stderr)
    return None


def _format_diff(plan: "FileRenamePlan") -> str:
    lines: list[str] = []
    for change in plan.changes:
        source = plan.removed if change.old is None and plan.removed is not None else change.file
        old = change.old if change.old is not None else source.read_bytes().decode("utf-8")
        lines += unified_diff(
            old.splitlines(keepends=True),
            change.new.splitlines(keepends=True),
            f"a/{_shown(source)}",
            f"b/{_shown(change.file)}",
        )
    return "".join(line if line.endswith("\n") else f"{line}\n" for line in lines)


def _print_written(plan: "FileRenamePlan") -> None:
    for change in plan.changes:
        print(f"wrote {_shown(change.file)}")
    if plan.removed is not None:
        print(f"deleted {_shown(plan.removed)}")


def _shown(file: Path) -> str:
    from vicode.store.projects import display_path

    return Path(display_path(file)).as_posix()
