"""Prints findings with their source lines, in color on a terminal."""

import argparse
import sys
from collections.abc import Iterable
from functools import lru_cache, partial
from pathlib import Path

from vicode.findings import Finding, Severity, escape_text, render_json, render_sarif, render_text
from vicode.languages import language_title

_MAX_BYTES = 2_000_000
_XABSL_SUFFIXES = (".xabsl", ".yabsl")
_COLORS = {Severity.ERROR: "bold red", Severity.WARNING: "yellow", Severity.NOTE: "cyan"}


def format_findings(findings: Iterable[Finding], encoding: str = "") -> str:
    """Format findings in the given order, with their source lines; `encoding` is that of XABSL files."""
    lines_of = lru_cache(maxsize=64)(partial(_read_lines, encoding=encoding))

    def source_line(file: str, line: int) -> str | None:
        lines = lines_of(file)
        return lines[line - 1] if 0 < line <= len(lines) else None

    return render_text(findings, source_line)


def print_findings(findings: Iterable[Finding], *, to_stderr: bool = False, encoding: str = "") -> None:
    """Print findings in the given order; on a terminal, color marks the severity."""
    text = format_findings(findings, encoding)
    stream = sys.stderr if to_stderr else sys.stdout
    if not text:
        return
    if not stream.isatty():
        stream.write(text)
        return
    from rich.console import Console
    from rich.text import Text

    shown = Text(text.rstrip("\n"))
    for severity, color in _COLORS.items():
        shown.highlight_regex(rf"(?m)(?<=: ){severity} [A-Z]\d+|^{severity} [A-Z]\d+", color)
    shown.highlight_regex(r"(?m)^ +\^+$", "bold green")
    Console(file=stream, soft_wrap=True).print(shown)


def add_format_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of other formats of findings."""
    formats = parser.add_mutually_exclusive_group()
    formats.add_argument("--json", action="store_true", help="print findings as JSON")
    formats.add_argument("--sarif", action="store_true", help="print findings as SARIF, which code hosts read")


def print_formatted(findings: Iterable[Finding], args: argparse.Namespace) -> bool:
    """Print findings in the format that an option chose; False if none did."""
    if args.json or args.sarif:
        print((render_json if args.json else render_sarif)(findings), end="")
    return bool(args.json or args.sarif)


def describe_os_error(error: OSError) -> str:
    words = error.strerror or str(error)
    return escape_text(words if error.filename is None else f"{error.filename}: {words}")


def describe_python_topics(topics: Iterable[str], language: str) -> str:
    """What a language without topics of ROS 2 generates for these components."""
    return f"{', '.join(topics)}: a topic of ROS 2 only in Python; write the class in {language_title(language)}"


def _read_lines(file: str, *, encoding: str) -> tuple[str, ...]:
    """The lines of a regular file, up to a size limit; reading a pipe or device could block."""
    path = Path(file)
    try:
        if not path.is_file():
            return ()
        with path.open("rb") as stream:
            content = stream.read(_MAX_BYTES)
    except OSError:
        return ()
    if len(content) == _MAX_BYTES:
        # The limit may cut a character.
        content = content[: content.rfind(b"\n") + 1]
    # The same line ends as the readers: XABSL has only line feeds, and `splitlines` has more than YAML.
    if path.suffix in _XABSL_SUFFIXES:
        from vicode.xabsl.source_text import decode_source

        return tuple(decode_source(content, encoding).text.split("\n"))
    return tuple(content.decode(errors="replace").replace("\r\n", "\n").replace("\r", "\n").split("\n"))
