"""Reads an option of an XABSL behavior as a design."""

from dataclasses import dataclass
from functools import partial
from pathlib import Path

from vicode.findings import Finding, Severity
from vicode.importers import import_behavior
from vicode.model.design import Design
from vicode.services.display_paths import with_display_paths
from vicode.services.xabsl_encoding import find_encoding
from vicode.xabsl.behavior_loader import DOUBTFUL_ENCODING
from vicode.xabsl.compiler import compile_source
from vicode.xabsl.source_loader import find_main_file, load_source
from vicode.xabsl.source_text import read_source


@dataclass(frozen=True, slots=True, kw_only=True)
class OptionReading:
    """The design of an option; None if the behavior has errors, or the file has no option.

    `doubts` name files that do not look like `encoding`, in which they were read.
    """

    design: Design | None = None
    errors: tuple[Finding, ...] = ()
    doubts: tuple[Finding, ...] = ()
    encoding: str


def read_option(file: Path, encoding: str) -> OptionReading:
    """Read the option of a file; its behavior is searched in the folder of the file and those above.

    Raises:
        OSError: A file cannot be read, or no behavior includes the file.
    """
    path = file.resolve(strict=True)
    main = find_main_file(path)
    encoding = find_encoding(main, encoding)
    source = load_source(main, partial(read_source, encoding=encoding))
    if not source.has_agents and any(each.file.body for each in source.files.values()):
        raise OSError(f"no file with agents in the folder of {file}, or in those above it, includes it")
    compiled = compile_source(source)
    if compiled.program is None:
        errors = [each for each in compiled.findings if each.severity is Severity.ERROR]
        return OptionReading(errors=with_display_paths(errors, main), encoding=encoding)
    doubts = [each for each in source.findings if each.rule.code == DOUBTFUL_ENCODING]
    imported = import_behavior(source, compiled, "behavior")
    component = next((about.component for about in imported.designs if about.file == path), None)
    return OptionReading(
        design=imported.project.design(component) if component else None,
        doubts=with_display_paths(doubts, main),
        encoding=encoding,
    )
