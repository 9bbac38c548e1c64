"""Loads the files of a program by following its includes; each file is read once, by its real path."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from vicode.findings import Finding, Severity, SourceLocation, did_you_mean, get_rule
from vicode.xabsl.parser import ParsedFile, parse
from vicode.xabsl.printer import print_file
from vicode.xabsl.tree import AgentNode

ReadText = Callable[[Path], str]
ParseText = Callable[[str, str], ParsedFile]
EXTENSIONS = (".xabsl", ".yabsl")
_MAX_FOLDERS = 8
_UNDEFINED = (0x81, 0x8D, 0x8F, 0x90, 0x9D)
_WINDOWS_1252 = {byte: bytes([byte]).decode("cp1252") for byte in range(0x80, 0xA0) if byte not in _UNDEFINED}
"""The characters of Windows-1252 by their bytes, where it differs from latin-1."""
_UTF16_MARKS = ("ÿþ", "þÿ")
"""The byte order marks of UTF-16, read as Windows-1252."""


_AGENT = re.compile(r"^[ \t]*agent\s+\w+\s*\(", re.MULTILINE)


@dataclass(slots=True)
class ProgramSource:
    """All files of a program by their real paths, in the order of their first include."""

    main: Path
    files: dict[Path, ParsedFile] = field(default_factory=dict)
    findings: list[Finding] = field(default_factory=list)

    @property
    def title(self) -> str:
        """The title in the header of the main file."""
        return parse_header(self.files[self.main].file.header).get("Title", "") if self.main in self.files else ""

    @property
    def has_agents(self) -> bool:
        return any(isinstance(item, AgentNode) for parsed in self.files.values() for item in parsed.file.body)


def parse_header(header: str) -> dict[str, str]:
    """Read the keys of a file header: "Title", "Platform" and "Software-Environment"."""
    lines = (line.partition(":") for line in header.splitlines())
    return {key.strip(): value.strip() for key, colon, value in lines if colon}


def read_text(path: Path) -> str:
    """Read a file as UTF-8, with or without a byte order mark, or else as Windows-1252, which older behaviors use.

    Raises:
        OSError: The file cannot be read.
    """
    return decode_text(path.read_bytes())


def decode_text(data: bytes) -> str:
    """Decode the content of a file; `encode_text` returns the same bytes."""
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        # Unlike the codec, latin-1 maps every byte to a character.
        return data.decode("latin-1").translate(_WINDOWS_1252)


def encode_text(text: str, old: bytes) -> bytes:
    """Encode a text in the encoding of the old content of its file.

    Raises:
        UnicodeEncodeError: The encoding does not have a character of the text.
    """
    try:
        old.decode("utf-8")
        return text.encode("utf-8")
    except UnicodeDecodeError:
        return text.translate({ord(char): byte for byte, char in _WINDOWS_1252.items()}).encode("latin-1")


def find_agent_files(folder: Path, *, recursive: bool = True) -> Iterator[Path]:
    """Yield the files of a folder, except hidden ones, that appear to declare agents: the main files of behaviors."""
    for path in sorted(folder.rglob("*") if recursive else folder.glob("*")):
        is_hidden = any(part.startswith(".") for part in path.relative_to(folder).parts)
        if path.suffix in EXTENSIONS and not is_hidden and path.is_file() and _AGENT.search(read_text(path)):
            yield path


def find_main_file(path: Path) -> Path:
    """Find the file with the agents of the behavior that includes a file; the file itself if there is none."""
    for folder in [path.parent, *path.parent.parents][:_MAX_FOLDERS]:
        candidates = sorted(find_agent_files(folder, recursive=False), key=lambda each: each.name != "agents.xabsl")
        for candidate in candidates:
            if path in load_source(candidate).files:
                return candidate.resolve()
    return path


def load_source(main: Path, read: ReadText = read_text, parse_text: ParseText = parse) -> ProgramSource:
    """Load a program from the file with its agents. Files that cannot be read are reported as findings."""
    source = ProgramSource(main.resolve())
    pending: list[tuple[Path, SourceLocation | None, str]] = [(source.main, None, str(main))]
    while pending:
        path, location, shown = pending.pop()
        text = _read(source, path, location, shown, read)
        parsed = _parse(source, path, text, parse_text) if text is not None else None
        if parsed is None:
            continue
        source.files[path] = parsed
        source.findings += parsed.findings
        # Reversed, because the stack returns the last entry first.
        pending += reversed(_resolve_includes(source, path, parsed))
    _check_agents(source)
    return source


@dataclass(frozen=True, slots=True)
class FormatResult:
    """The original and the formatted text of a file, or its syntax errors."""

    original: str
    formatted: str
    findings: tuple[Finding, ...]


def format_file(path: Path, read: ReadText = read_text) -> FormatResult:
    """Format a file; the most frequent kind of line ending is kept.

    Raises:
        OSError: The file cannot be read.
    """
    before = read(path)
    parsed = parse(before, str(path))
    errors = tuple(finding for finding in parsed.findings if finding.severity is Severity.ERROR)
    if errors:
        return FormatResult(before, before, errors)
    text = print_file(parsed.file)
    is_windows = before.count("\r\n") * 2 > before.count("\n")
    return FormatResult(before, text.replace("\n", "\r\n") if is_windows else text, ())


def _resolve_includes(
    source: ProgramSource, path: Path, parsed: ParsedFile
) -> list[tuple[Path, SourceLocation | None, str]]:
    includes: dict[Path, tuple[Path, SourceLocation | None, str]] = {}
    for include in parsed.file.includes:
        written = include.path.replace("\\", "/")
        target = (path.parent / written).resolve()
        location = parsed.tokens.location(include.first_token + 1)
        if target in includes:
            _add_finding(source, location, "X608", f"{include.path} is included twice", "remove one of the includes")
        else:
            includes[target] = (target, location, include.path)
    return list(includes.values())


def _read(source: ProgramSource, path: Path, location: SourceLocation | None, shown: str, read: ReadText) -> str | None:
    if path in source.files:
        return None
    if path.suffix.lower() not in EXTENSIONS:
        _add_finding(
            source, location, "X607", f"{shown} does not end in .xabsl", "rename the file", shown=source.main.name
        )
        return None
    try:
        text = read(path)
    except OSError as error:
        fix = did_you_mean(path.name, _sibling_files(path), "check the path, which is relative to the including file")
        reason = error.strerror or type(error).__name__
        _add_finding(source, location, "X606", f"{shown} cannot be read: {reason}", fix, shown=source.main.name)
        return None
    if text.startswith(_UTF16_MARKS) and "\0" in text:
        message = f"{shown} is encoded in UTF-16"
        _add_finding(source, location, "X601", message, "save it as UTF-8", shown=source.main.name)
        return None
    return text


def _parse(source: ProgramSource, path: Path, text: str, parse_text: ParseText) -> ParsedFile:
    name = str(path.relative_to(source.main.parent)) if path.is_relative_to(source.main.parent) else str(path)
    parsed = parse_text(text, name)
    if not parsed.file.body and not any(finding.rule.code in ("X604", "X605") for finding in parsed.findings):
        location = parsed.tokens.location(len(parsed.tokens.kinds) - 1)
        _add_finding(source, location, "X609", "the file defines nothing", "add an option, a namespace or an agent")
    return parsed


def _sibling_files(path: Path) -> list[str]:
    try:
        return [sibling.name for sibling in path.parent.iterdir() if sibling.suffix in EXTENSIONS]
    except OSError:
        return []


def _check_agents(source: ProgramSource) -> None:
    with_agents = [
        (parsed, first)
        for parsed in source.files.values()
        if (first := next((item for item in parsed.file.body if isinstance(item, AgentNode)), None)) is not None
    ]
    for parsed, agent in with_agents[1:]:
        message = f"a second file declares agents: {agent.name.text}"
        _add_finding(
            source, parsed.tokens.location(agent.first_token), "X610", message, f"move them to {source.main.name}"
        )
    if source.files and not with_agents and not source.findings:
        location = SourceLocation(file=source.main.name, line=1, column=1)
        _add_finding(
            source, location, "X609", "no file of the program has an agent", 'add agent name("Title", root_option);'
        )


def _add_finding(
    source: ProgramSource, location: SourceLocation | None, code: str, message: str, fix: str, *, shown: str = ""
) -> None:
    location = location or SourceLocation(file=shown, line=1, column=1)
    source.findings.append(Finding(rule=get_rule(code), message=message, fix=fix, location=location))
