"""Check designs and report problems."""

import argparse
from collections.abc import Iterator

from vicode.cli.console import add_format_arguments, print_findings, print_formatted
from vicode.findings import Finding, Severity, count_findings
from vicode.services.project_loader import LoadedProject, load_projects


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "paths",
        metavar="PATH",
        nargs="*",
        default=["."],
        help="design file, project folder, or folder of projects (default: the current folder)",
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
    projects = load_projects(args.paths, with_warnings=True, deep=args.deep)
    findings = tuple(finding for project in projects for finding in (*project.findings, *_patches(project)))
    if not print_formatted(findings, args):
        print_findings(findings)
        designs = sum(len(project.selected_designs) + len(project.open_project.broken_files) for project in projects)
        print(f"{count_findings(findings)} in {designs} design{'s' * (designs != 1)}")
    counted = {Severity.ERROR, Severity.WARNING} if args.strict else {Severity.ERROR}
    return int(any(finding.severity in counted for finding in findings))
