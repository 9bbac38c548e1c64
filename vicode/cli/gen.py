"""Generate code from designs."""

import argparse
import os
import sys
from collections.abc import Callable, Iterator
from difflib import unified_diff
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.console import describe_os_error, print_findings
from vicode.cli.project_loader import LoadedProject, load_projects
from vicode.findings import Finding, Severity, SourceLocation, get_rule
from vicode.output import FileDiff, FileStatus, format_diff, require_unchanged

if TYPE_CHECKING:
    from vicode.model.project import Project
    from vicode.output import OutputFile
    from vicode.sync import GenerationInput, GenerationPlan


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
        choices=("file", "design"),
        help="on a conflict, take the text of the generated file or of the design (in gen: with --apply)",
    )
    parser.add_argument(
        "--out", metavar="DIR", help="output folder (default: as set in project.yaml, else generated/ next to it)"
    )
    parser.add_argument("--profile", metavar="NAME", default="", help="use the implementations of this profile")
    parser.add_argument("--language", metavar="L", action="append", help="generate only this language; can be repeated")
    parser.add_argument(
        "--standalone", action="store_true", help="include a copy of the runtime, so that the code runs without vicode"
    )


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
    from vicode.sync import plan_generation

    if args.single_header:
        return _write_single_header(opened, args)
    has_errors = print_errors(opened)
    plan = plan_generation(generation_input(opened, args), applies_edits=args.apply, take=args.take)
    if args.diff:
        print("".join(format_diff(difference) for difference in plan.differences), end="")
    if args.check:
        print_findings(_outdated_findings(plan))
    if args.diff or args.check:
        return int(bool(plan.differences) or has_errors)
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
    """Save the designs of a plan and write its files, all or none; return whether they were written."""
    from vicode.sync import back_up, write_generated

    if is_forced:
        for copy in back_up(plan):
            print(f"backed up {copy.as_posix()}")
    elif plan.findings:
        from vicode.store import locate_findings

        print_findings(locate_findings(plan.findings, opened.open_project), to_stderr=True)
        print("".join(_conflict_diffs(plan)), end="", file=sys.stderr)
        for line in _describe_outside_readings(plan):
            print(line, file=sys.stderr)
        return False
    require_unchanged(plan.differences, plan.folder)
    _save_designs(opened, plan)
    write_generated(plan)
    for each in plan.outside_readings:
        if each.leftover and each.file not in plan.edits:
            print(f"kept the rest of the edit as {(plan.folder / each.file.path).as_posix()}.patch")
    for difference in plan.differences:
        verb = "deleted" if difference.status is FileStatus.STALE else "wrote"
        print(f"{verb} {(plan.folder / difference.path).as_posix()}")
    return True


def _describe_outside_readings(plan: "GenerationPlan") -> Iterator[str]:
    """The edits outside regions: which of them the design can express, and the rest."""
    for each in plan.outside_readings:
        path = (plan.folder / each.file.path).as_posix()
        yield from (f"{path}:{edit.line}: the design can express: {edit.words}" for edit in each.edits)
        if each.edits:
            yield "apply these edits with 'vicode sync --outside-regions'; it keeps the rest as NAME.patch"
        if each.leftover:
            yield f"the design cannot express:\n{each.leftover.rstrip()}"


def _conflict_diffs(plan: "GenerationPlan") -> Iterator[str]:
    """Both sides of each conflict, as differences of the file from the design."""
    for file in plan.edits:
        for region in file.regions:
            if region.is_conflict:
                design, found = (f"{text}\n".splitlines(True) for text in (region.design_text, region.file_text))
                yield from unified_diff(design, found, f"design: {region.id}", f"file: {region.id}")


def _save_designs(opened: LoadedProject, plan: "GenerationPlan") -> None:
    from vicode.store import replace_text, save_design

    project = opened.open_project
    texts = {name: save_design(design, project.texts[name]) for name, design in plan.designs.items()}
    for name, text in texts.items():
        replace_text(project.files[name], project.texts[name], text)
        for reading in (each for each in plan.outside_readings if each.file.component == name):
            for applied in reading.edits:
                place = f"{(plan.folder / reading.file.path).as_posix()}:{applied.line}"
                print(f"applied from {place} to {project.files[name].as_posix()}: {applied.words}")
        for edit in plan.applied:
            if edit.file.component == name:
                place = f"{(plan.folder / edit.file.path).as_posix()}:{edit.region.line}"
                verb = "merged" if edit.region.is_merged else "applied"
                print(f"{verb} {edit.region.id} from {place} to {project.files[name].as_posix()}")


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
