"""Check designs, or state machines in C++ sources, and report problems."""

import argparse
from collections.abc import Iterator
from pathlib import Path

from vicode.cli.console import add_format_arguments, print_findings, print_formatted
from vicode.findings import Finding, Severity, count_findings
from vicode.services.imported_behavior.cpp_sources import find_cpp_files, find_in_cpp, load_cpp
from vicode.services.project_loader import LoadedProject, load_projects


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "paths",
        metavar="PATH",
        nargs="*",
        default=["."],
        help="design file, project folder, folder of projects, or C++ files or folders with state machines "
        "(default: the current folder)",
    )
    add_format_arguments(parser)
    parser.add_argument(
        "--deep",
        action="store_true",
        help="also check properties, and search for states that alternate, inactive designs, and robots that wait",
    )
    parser.add_argument("--strict", action="store_true", help="exit with code 1 on warnings, too")


def _patches(project: LoadedProject) -> Iterator[Finding]:
    """Patches of generated files with edits that the program does not contain."""
    from vicode.services.generation.project_output import output_folder
    from vicode.sync import find_patches

    folder = output_folder(project)
    return find_patches(folder, folder.as_posix())


def run(args: argparse.Namespace) -> int:
    """Print findings; return 1 for errors and, with --strict, for warnings."""
    files = [file for path in args.paths for file in find_cpp_files(Path(path))]
    if files:
        machines = load_cpp(files, "behavior")
        findings, designs, what = find_in_cpp(machines), len(machines.machines), "state machine"
    else:
        projects = load_projects(args.paths, with_warnings=True, deep=args.deep)
        findings = tuple(finding for project in projects for finding in (*project.findings, *_patches(project)))
        designs = sum(len(project.selected_designs) + len(project.open_project.broken_files) for project in projects)
        what = "design"
    if not print_formatted(findings, args):
        print_findings(findings)
        print(f"{count_findings(findings)} in {designs} {what}{'s' * (designs != 1)}")
    counted = {Severity.ERROR, Severity.WARNING} if args.strict else {Severity.ERROR}
    return int(any(finding.severity in counted for finding in findings))
