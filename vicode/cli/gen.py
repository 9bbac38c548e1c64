"""Generate code from designs."""

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.console import describe_os_error, describe_python_topics, print_findings
from vicode.findings import Severity
from vicode.output import format_diff
from vicode.services.project_loader import LoadedProject, load_projects

if TYPE_CHECKING:
    from vicode.services.generation.project_output import OutputOptions
    from vicode.sync import Choices, GenerationPlan


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "paths",
        metavar="PATH",
        nargs="*",
        default=["."],
        help="design file, project folder, or folder of projects (default: the current folder)",
    )
    parser.add_argument("--check", action="store_true", help="write nothing; report missing, changed, and stale files")
    parser.add_argument("--diff", action="store_true", help="write nothing; print a diff")
    parser.add_argument("--apply", action="store_true", help="apply edits of generated files to the designs first")
    add_output_arguments(parser)
    parser.add_argument(
        "--single-header", metavar="FILE", help="write all C++ of one project into one header and nothing else"
    )
    parser.add_argument("--force", action="store_true", help="overwrite edited files, keeping a copy as NAME.edited")


def add_output_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options that say what is generated, and where."""
    parser.add_argument(
        "--take",
        metavar="SIDE[=ITEM]",
        action="append",
        type=_read_choice,
        help="on a conflict, take the text of the generated 'file' or of the 'design' (in gen: with --apply); ITEM is "
        "one conflict: the id of its region, or FILE:LINE",
    )
    parser.add_argument(
        "--out", metavar="DIR", help="output folder (default: as set in project.yaml, else generated/ next to it)"
    )
    parser.add_argument("--profile", metavar="NAME", default="", help="use the implementations of this profile")
    parser.add_argument("--language", metavar="L", action="append", help="generate only this language; can be repeated")
    parser.add_argument(
        "--standalone", action="store_true", help="include a copy of the runtime, so that the code runs without vicode"
    )


def _read_choice(text: str) -> tuple[str, str]:
    side, _equals, item = text.partition("=")
    if side not in ("file", "design") or text.endswith("="):
        raise argparse.ArgumentTypeError(f"'{text}': expected file, design, file=ITEM or design=ITEM")
    return side, item


def read_choices(args: argparse.Namespace) -> "Choices":
    """The sides that win conflicts."""
    from vicode.sync import Choices

    given = args.take or ()
    default = [side for side, item in given if not item]
    return Choices(default=default[-1] if default else None, items=tuple((item, side) for side, item in given if item))


def read_output_options(args: argparse.Namespace) -> "OutputOptions":
    """What is generated, and where."""
    from vicode.services.generation.project_output import OutputOptions

    return OutputOptions(out=args.out, languages=args.language, standalone=args.standalone)


def run(args: argparse.Namespace) -> int:
    """Generate every project; return 1 if edits prevent it or, with --check or --diff, if files are outdated."""
    return for_each_project(args, _generate)


def for_each_project(args: argparse.Namespace, generate: Callable[[LoadedProject, argparse.Namespace], int]) -> int:
    """Run `generate` for every project and return the worst exit code."""
    from vicode.generators import GENERATORS

    unknown = sorted(set(args.language or ()) - set(GENERATORS))
    if unknown:
        print(f"vicode: unknown language {unknown[0]}; choose from {', '.join(GENERATORS)}", file=sys.stderr)
        return 2
    return max(_run_or_report(opened, args, generate) for opened in load_projects(args.paths, args.profile))


def _run_or_report(
    opened: LoadedProject, args: argparse.Namespace, generate: Callable[[LoadedProject, argparse.Namespace], int]
) -> int:
    """Handle one project; an OSError is reported so that the other projects are still handled."""
    try:
        return generate(opened, args)
    except BrokenPipeError:
        raise
    except OSError as error:
        sys.stdout.flush()
        print(f"vicode: {describe_os_error(error)}", file=sys.stderr)
        return 2


def _generate(opened: LoadedProject, args: argparse.Namespace) -> int:
    from vicode.services.generation.project_output import generation_input, list_outdated, require_known_items
    from vicode.sync import find_patches, plan_generation

    if args.single_header:
        return _write_single_header(opened, args)
    has_errors = print_errors(opened)
    _print_topics(opened, args)
    choices = read_choices(args)
    plan = plan_generation(
        generation_input(opened, read_output_options(args)), applies_edits=args.apply, choices=choices
    )
    if args.diff:
        print("".join(format_diff(difference) for difference in plan.differences), end="")
    patches = tuple(find_patches(plan.folder, plan.folder.as_posix())) if args.check else ()
    if args.check:
        print_findings((*list_outdated(plan), *patches))
    if args.diff or args.check:
        return int(bool(plan.differences or patches) or has_errors)
    if args.apply:
        require_known_items(plan, choices)
    return int(not write_plan(opened, plan, is_forced=args.force) or has_errors)


def _print_topics(opened: LoadedProject, args: argparse.Namespace) -> None:
    project = opened.open_project.project
    topics = tuple(each.component for each in project.components if each.is_topic)
    for language in ("cpp", "javascript"):
        if topics and language in (args.language or project.languages):
            print(describe_python_topics(topics, language), file=sys.stderr)


def _write_single_header(opened: LoadedProject, args: argparse.Namespace) -> int:
    from vicode.generators.cpp.single_header import join_headers
    from vicode.output import write_atomically
    from vicode.services.generation.project_output import OutputOptions, generate_files

    has_errors = print_errors(opened)
    options = OutputOptions(languages=("cpp",), standalone=args.standalone)
    files = generate_files(opened, opened.open_project.project, options)
    if not files or has_errors:
        print("vicode: no single header: the project has errors or no designs", file=sys.stderr)
        return 1
    write_atomically(Path(args.single_header), join_headers(files))
    print(f"wrote {args.single_header}")
    return 0


def print_errors(opened: LoadedProject) -> bool:
    """Print the errors of a project; return whether there are any."""
    errors = [finding for finding in opened.findings if finding.severity is Severity.ERROR]
    print_findings(errors, to_stderr=True)
    return bool(errors)


def write_plan(opened: LoadedProject, plan: "GenerationPlan", *, is_forced: bool = False) -> bool:
    """Save the designs of a plan and write its files, all or none.

    Returns:
        Whether they were written, and the program contains all edits: none of them is in a patch.
    """
    from vicode.cli.plan_output import print_refusal, print_written
    from vicode.services.generation.project_output import back_up_designs, saved_designs
    from vicode.sync import back_up, describe_patch, write_generated

    if plan.findings and not is_forced:
        print_refusal(opened, plan)
        return False
    for copy in (*back_up(plan), *back_up_designs(opened, plan)):
        print(f"backed up {copy.as_posix()}")
    write_generated(plan, lambda: saved_designs(opened, plan))
    print_written(opened, plan)
    print_findings((describe_patch((plan.folder / path).as_posix()) for path in plan.patches), to_stderr=True)
    return not plan.patches
