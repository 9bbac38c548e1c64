"""Generate code from designs."""

import argparse
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.console import describe_os_error, print_findings
from vicode.findings import Finding, Severity, SourceLocation, get_rule
from vicode.output import FileDiff, FileStatus, back_up_edited, format_diff
from vicode.services.project_loader import LoadedProject, load_projects

if TYPE_CHECKING:
    from vicode.model.project import Project
    from vicode.output import OutputFile
    from vicode.sync import Choices, GenerationInput, GenerationPlan


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
    from vicode.sync import find_patches, plan_generation

    if args.single_header:
        return _write_single_header(opened, args)
    has_errors = print_errors(opened)
    choices = read_choices(args)
    plan = plan_generation(generation_input(opened, args), applies_edits=args.apply, choices=choices)
    if args.diff:
        print("".join(format_diff(difference) for difference in plan.differences), end="")
    patches = tuple(find_patches(plan.folder, plan.folder.as_posix())) if args.check else ()
    if args.check:
        print_findings((*_outdated_findings(plan), *patches))
    if args.diff or args.check:
        return int(bool(plan.differences or patches) or has_errors)
    if args.apply:
        require_known_items(plan, choices)
    return int(not write_plan(opened, plan, is_forced=args.force) or has_errors)


def _write_single_header(opened: LoadedProject, args: argparse.Namespace) -> int:
    from vicode.generators.cpp.single_header import join_headers
    from vicode.output import write_atomically

    has_errors = print_errors(opened)
    args.language = ["cpp"]
    files = _files(opened, opened.open_project.project, args)
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


def generation_input(opened: LoadedProject, args: argparse.Namespace) -> "GenerationInput":
    """What the options ask to generate."""
    from vicode.generators import list_outputs
    from vicode.sync import GeneratedHistory, GenerationInput

    folder = output_folder(opened, args.out)
    project = opened.open_project.project
    return GenerationInput(
        project=project,
        folder=folder,
        generate=lambda changed: _files(opened, changed, args),
        kept_paths=list_outputs(project, languages=args.language, standalone=args.standalone),
        # The component name of an unreadable design is unknown, so no file is certainly stale.
        may_delete=not opened.open_project.broken_files,
        history=GeneratedHistory(folder=folder, project_folder=opened.open_project.folder),
    )


def output_folder(opened: LoadedProject, out: str | None = None) -> Path:
    folder = Path(out) if out else opened.open_project.folder / opened.open_project.project.generated
    # Shorten paths such as `designs/forward/../../generated`.
    return Path(os.path.relpath(folder)) if not folder.is_absolute() else folder


def _files(opened: LoadedProject, project: "Project", args: argparse.Namespace) -> "list[OutputFile]":
    """The files of all designs without errors, for each language."""
    from vicode.generators import GENERATORS, generate

    files: list[OutputFile] = []
    for language in GENERATORS:
        faulty = opened.components_with_errors(language)
        wanted = [name for name in opened.selected_designs if name not in faulty]
        if wanted and language in (args.language or project.languages):
            files += generate(
                project,
                components=wanted,
                exclude=faulty,
                languages=(language,),
                standalone=args.standalone,
                sources=opened.design_paths,
            )
    return files


def write_plan(opened: LoadedProject, plan: "GenerationPlan", *, is_forced: bool = False) -> bool:
    """Save the designs of a plan and write its files, all or none.

    Returns:
        Whether they were written, and the program contains all edits: none of them is in a patch.
    """
    from vicode.cli.plan_output import print_refusal, print_written
    from vicode.sync import back_up, describe_patch, write_generated

    if plan.findings and not is_forced:
        print_refusal(opened, plan)
        return False
    for copy in (*back_up(plan), *_back_up_designs(opened, plan)):
        print(f"backed up {copy.as_posix()}")
    write_generated(plan, lambda: _saved_designs(opened, plan))
    print_written(opened, plan)
    print_findings((describe_patch((plan.folder / path).as_posix()) for path in plan.patches), to_stderr=True)
    return not plan.patches


def _back_up_designs(opened: LoadedProject, plan: "GenerationPlan") -> Iterator[Path]:
    """Copy the designs of which a conflict drops text to NAME.edited."""
    dropped = {each.path for each in plan.settled if each.side == "file"}
    for component in dict.fromkeys(file.component for file in plan.files if file.path in dropped):
        yield back_up_edited(opened.open_project.files[component])


@contextmanager
def _saved_designs(opened: LoadedProject, plan: "GenerationPlan") -> Iterator[None]:
    """Save the designs of a plan; restore them on an exception."""
    from vicode.store import replace_text, save_design

    project = opened.open_project
    texts = {name: save_design(design, project.texts[name]) for name, design in plan.designs.items()}
    with ExitStack() as undo:
        for name, text in texts.items():
            replace_text(project.files[name], project.texts[name], text)
            undo.callback(replace_text, project.files[name], text, project.texts[name])
        yield
        undo.pop_all()


def require_known_items(plan: "GenerationPlan", choices: "Choices") -> None:
    """Require that each chosen item is a conflict.

    Raises:
        OSError: There is no such conflict.
    """
    unused = choices.list_unused(name for each in plan.settled for name in each.names)
    if unused:
        raise OSError(f"--take: no conflict '{unused[0]}'; 'vicode sync' lists the conflicts")


def _outdated_findings(plan: "GenerationPlan") -> Iterator[Finding]:
    """Findings for outdated files; edited files yield their edits, because generating refuses them."""
    edited = {file.path for file in plan.edits}
    yield from plan.findings
    for difference in plan.differences:
        if difference.path not in edited:
            yield _outdated_finding(difference, plan.folder)


def _outdated_finding(difference: FileDiff, folder: Path) -> Finding:
    problem = {
        FileStatus.NEW: "missing: no such file",
        FileStatus.CHANGED: "changed: differs from the generated code",
        FileStatus.STALE: "stale: no design generates this file",
    }[difference.status]
    place = SourceLocation(file=(folder / difference.path).as_posix(), line=1, column=1)
    return Finding(rule=get_rule("G502"), message=problem, fix="run 'vicode gen'", location=place)
