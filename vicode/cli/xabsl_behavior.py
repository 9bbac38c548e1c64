"""Loads and compiles XABSL behaviors for several commands, and prints their findings."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.console import print_findings

if TYPE_CHECKING:
    from vicode.findings import Finding
    from vicode.xabsl.compiler import CompileResult
    from vicode.xabsl.source_loader import ParseText, ProgramSource


DOUBTFUL_ENCODING = "X611"
"""The rule about files that do not look like the encoding in which they are read."""

_FOLDERS_ABOVE = 4


def load_behavior(agents: Path, encoding: str = "", parse_text: "ParseText | None" = None) -> "ProgramSource":
    """Load the behavior whose agents are in this file.

    Raises:
        OSError: The file has no agents, so it cannot be compiled separately.
    """
    from vicode.xabsl.parser import parse
    from vicode.xabsl.source_loader import load_source
    from vicode.xabsl.source_text import read_source

    source = load_source(agents, partial(read_source, encoding=encoding), parse_text or parse)
    main = source.files.get(source.main)
    if main is not None and main.file.body and not source.has_agents:
        suggestion = next(_nearby_agent_files(agents), None)
        raise OSError(
            f"{agents} has no agents; specify the file with the agents{f': {suggestion}' if suggestion else ''}"
        )
    return source


def _nearby_agent_files(file: Path) -> Iterator[Path]:
    from vicode.xabsl.source_loader import find_agent_files

    folder = file.parent
    for _ in range(_FOLDERS_ABOVE):
        yield from find_agent_files(folder, recursive=False)
        folder = folder / ".." if folder.name in ("", "..") else folder.parent


def compile_behavior(agents: Path, encoding: str = "") -> "CompileResult":
    """Compile the behavior whose agents are in this file.

    Raises:
        OSError: The file has no agents.
    """
    from vicode.xabsl.compiler import compile_source

    return compile_source(load_behavior(agents, encoding))


def with_display_paths(findings: "Sequence[Finding]", agents: Path) -> "tuple[Finding, ...]":
    """Replace the paths in findings by paths relative to the working directory."""

    def shown(file: str) -> str:
        path = agents.parent / file
        if not path.is_absolute():
            return str(path)
        from vicode.store.projects import display_path

        return display_path(path)

    return tuple(
        replace(finding, location=replace(finding.location, file=shown(finding.location.file)))
        if finding.location
        else finding
        for finding in findings
    )


def print_behavior_findings(
    findings: "Sequence[Finding]", agents: Path, encoding: str = "", *, to_stderr: bool = True
) -> None:
    print_findings(with_display_paths(findings, agents), to_stderr=to_stderr, encoding=encoding)


def print_encoding_doubts(source: "ProgramSource", agents: Path) -> None:
    """Warn of files that do not look like the encoding in which they were read."""
    print_behavior_findings([each for each in source.findings if each.rule.code == DOUBTFUL_ENCODING], agents)
