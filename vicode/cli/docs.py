"""Write the documentation of a project as a site of plain files."""

import argparse
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.opening import Opened, open_paths
from vicode.cli.printing import count_findings, print_findings
from vicode.findings import Severity
from vicode.output import Difference, Status, apply, compare

if TYPE_CHECKING:
    from vicode.docsite import SourceText, Subject
    from vicode.findings import Path as ThingPath
    from vicode.importers import Imported
    from vicode.output import OutputFile
    from vicode.xabsl.sources import Source


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `vicode docs`."""
    parser.add_argument(
        "path", metavar="PATH", type=Path, help="a design, a project's folder, a folder of projects, an agents.xabsl"
    )
    parser.add_argument("--out", metavar="DIR", type=Path, default=Path("site"), help="where to write (site)")
    parser.add_argument("--strict", action="store_true", help="fail on findings; the site is written all the same")


def run(args: argparse.Namespace) -> int:
    """Write the site; 1 when a design or behavior cannot be read, or with --strict has findings."""
    if args.path.suffix in (".xabsl", ".yabsl"):
        subject = _subject_of_behavior(args.path)
        return _write(subject, args.out, is_strict=args.strict) if subject else 1
    projects = open_paths([str(args.path)])
    codes = []
    for opened in projects:
        # Each project of a folder gets a site of its own.
        out = args.out / opened.opened.folder.resolve().name if len(projects) > 1 else args.out
        unread = [each for each in opened.findings if each.severity is Severity.ERROR]
        print_findings(unread, to_stderr=True)
        code = _write(_subject_of_project(opened), out, is_strict=args.strict)
        codes.append(max(code, int(bool(opened.opened.broken))))
    return max(codes)


def _subject_of_project(opened: Opened) -> "Subject":
    from vicode.docsite import subject_of

    project = opened.opened.project
    meant = set(opened.meant)
    part = replace(project, designs=tuple(each for each in project.designs if each.component in meant))
    faulty = {language: opened.faulty_in(language) for language in project.languages}
    return subject_of(opened.opened, part, opened.findings, faulty)


def _subject_of_behavior(agents: Path) -> "Subject | None":
    """A behavior as a project, with its files of XABSL as sources; None when it cannot be compiled."""
    from vicode.check import check_project
    from vicode.cli.behaviors import tell
    from vicode.docsite import OwnFinding, Subject
    from vicode.importers import import_behavior
    from vicode.store.documents import default_name
    from vicode.xabsl.compiler import compile_source
    from vicode.xabsl.sources import load

    source = load(agents)
    compiled = compile_source(source)
    if compiled.program is None:
        tell([each for each in compiled.findings if each.severity is Severity.ERROR], agents)
        return None
    imported = import_behavior(source, compiled, default_name(agents.resolve().parent.name))
    project = imported.project
    found = [
        OwnFinding(component=each.thing.component if each.thing else "", line=0, finding=each)
        for each in check_project(project)
    ]
    errors = [each for each in found if each.finding.severity is Severity.ERROR]
    faulty = {
        language: frozenset(each.component for each in errors if each.finding.concerns(language))
        for language in project.languages
    }
    return Subject(project=project, findings=tuple(found), sources=_sources(source, imported), faulty=faulty)


def _sources(source: "Source", imported: "Imported") -> "dict[str, SourceText]":
    """The files of a behavior by component, each with the lines of its option's states, decisions and parameters."""
    from vicode.docsite import SourceText, described_paths
    from vicode.xabsl.sources import read_text

    def text_of(path: Path, lines: "dict[ThingPath, int]") -> SourceText:
        folder = source.main.parent
        shown = path.relative_to(folder).as_posix() if path.is_relative_to(folder) else path.name
        return SourceText(path=shown, text=read_text(path), language="xabsl", lines=lines)

    sources = {"": text_of(source.main, {})}
    for made, design in zip(imported.designs, imported.project.designs, strict=True):
        tokens, described = source.files[made.file].tokens, set(described_paths(design))
        lines: dict[ThingPath, int] = {}
        for token, path in made.anchors:
            if path in described:
                lines.setdefault(path, tokens.line_at(tokens.starts[token]))
        sources[made.component] = text_of(made.file, lines)
    return sources


def _write(subject: "Subject", out: Path, *, is_strict: bool) -> int:
    """Write what is new, take away the pages of what is gone; 2 when it would write over files of others."""
    from vicode.docsite import build_site

    files = build_site(subject)
    differences = (*compare(files, out), *_stale(files, out))
    foreign = [each.path for each in differences if each.old is not None and not _is_ours(each.old)]
    if foreign:
        print(f"vicode: {(out / foreign[0]).as_posix()} is no page of ours; choose another --out", file=sys.stderr)
        return 2
    touched = apply(differences, out)
    findings = [each.finding for each in subject.findings]
    counts = f"{len(files)} files, {len(touched)} changed, {count_findings(findings)}"
    print(f"wrote {(out / 'index.html').as_posix()}: {counts}")
    return int(is_strict and bool(findings))


def _stale(files: "tuple[OutputFile, ...]", out: Path) -> list[Difference]:
    """Pages that an earlier site had and this one has not."""
    wanted = {file.path for file in files}
    there = sorted(each for each in out.glob("*.html") if each.name not in wanted)
    texts = {each.name: each.read_text(encoding="utf-8", errors="replace") for each in there}
    return [
        Difference(path=name, status=Status.STALE, old=text, new=None) for name, text in texts.items() if _is_ours(text)
    ]


def _is_ours(text: str) -> bool:
    from vicode.docsite import MARK

    return MARK in text[:400]
