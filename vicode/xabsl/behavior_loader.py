"""Loads and compiles the behavior whose agents are in a file."""

from collections.abc import Iterator
from functools import partial
from pathlib import Path

from vicode.xabsl.compiler import CompileResult, compile_source
from vicode.xabsl.parser import parse
from vicode.xabsl.source_loader import ParseText, ProgramSource, find_agent_files, load_source
from vicode.xabsl.source_text import read_source

DOUBTFUL_ENCODING = "X611"
"""The rule about files that do not look like the encoding in which they are read."""

_FOLDERS_ABOVE = 4


def load_behavior(agents: Path, encoding: str = "", parse_text: ParseText = parse) -> ProgramSource:
    """Load the behavior whose agents are in this file.

    Raises:
        OSError: The file has no agents, so it cannot be compiled separately.
    """
    source = load_source(agents, partial(read_source, encoding=encoding), parse_text)
    main = source.files.get(source.main)
    if main is not None and main.file.body and not source.has_agents:
        suggestion = next(_nearby_agent_files(agents), None)
        raise OSError(
            f"{agents} has no agents; specify the file with the agents{f': {suggestion}' if suggestion else ''}"
        )
    return source


def _nearby_agent_files(file: Path) -> Iterator[Path]:
    folder = file.parent
    for _ in range(_FOLDERS_ABOVE):
        yield from find_agent_files(folder, recursive=False)
        folder = folder / ".." if folder.name in ("", "..") else folder.parent


def compile_behavior(agents: Path, encoding: str = "") -> CompileResult:
    """Compile the behavior whose agents are in this file.

    Raises:
        OSError: The file has no agents.
    """
    return compile_source(load_behavior(agents, encoding))
