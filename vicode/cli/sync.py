"""Apply edits of generated code to the designs, then generate."""

import argparse

from vicode.cli.console import print_findings
from vicode.cli.gen import (
    add_output_arguments,
    for_each_project,
    print_errors,
    read_choices,
    read_output_options,
    write_plan,
)
from vicode.services.project_loader import LoadedProject


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "paths",
        metavar="PATH",
        nargs="*",
        default=["."],
        help="design file, project folder, or folder of projects (default: the current folder)",
    )
    parser.add_argument("--check", action="store_true", help="write nothing; report edits missing from the designs")
    parser.add_argument("--watch", action="store_true", help="sync again after each change, until interrupted")
    parser.add_argument(
        "--outside-regions",
        action="store_true",
        help="also apply edits outside regions that the design can express; keep the rest as NAME.patch",
    )
    add_output_arguments(parser)


def run(args: argparse.Namespace) -> int:
    """Sync every project; return 1 on conflicts, if a patch was kept or, with --check, if edits are missing."""
    if args.watch:
        from vicode.cli.sync_watch import watch_projects

        return watch_projects(args, _sync)
    return for_each_project(args, _sync)


def _sync(opened: LoadedProject, args: argparse.Namespace) -> int:
    from vicode.services.generation.project_output import generation_input, require_known_items
    from vicode.sync import find_patches, plan_generation

    choices = read_choices(args)
    has_errors = print_errors(opened)
    plan = plan_generation(
        generation_input(opened, read_output_options(args)),
        applies_edits=not args.check,
        choices=choices,
        outside_regions=args.outside_regions,
    )
    if args.check:
        findings = (*plan.findings, *find_patches(plan.folder, plan.folder.as_posix()))
        print_findings(findings)
        return int(bool(findings) or has_errors)
    require_known_items(plan, choices)
    return int(not write_plan(opened, plan) or has_errors)
