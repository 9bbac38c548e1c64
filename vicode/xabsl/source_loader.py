"""Loads the files of a program by following its includes; each file is read once, by its real path."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from vicode.findings import Finding, Severity, SourceLocation, did_you_mean, get_rule
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.parser import ParsedFile, parse
from vicode.xabsl.printer import print_file
from vicode.xabsl.source_text import EncodedText, ReadText, encoding_title, read_source
from vicode.xabsl.tree import AgentNode

ParseText = Callable[[str, str], ParsedFile]
EXTENSIONS = (".xabsl", ".yabsl")
_MAX_FOLDERS = 8
_UTF16_MARKS = ("ÿþ", "þÿ")
"""The byte order marks of UTF-16, read as Windows-1252."""


_WINDOWS_LINE_END = re.compile(r"\r+\n")
_AGENT = re.compile(r"^[ \t]*agent\s+\w+\s*\(", re.MULTILINE)


@dataclass(slots=True)
class ProgramSource:
    """All files of a program by their real paths, in the order of their first include, with their encodings."""

    main: Path
    files: dict[Path, ParsedFile] = field(default_factory=dict)
    encodings: dict[Path, str] = field(default_factory=dict)
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


def find_agent_files(folder: Path, *, recursive: bool = True) -> Iterator[Path]:
    """Yield the files of a folder, except hidden ones, that appear to declare agents: the main files of behaviors."""
    for path in sorted(folder.rglob("*") if recursive else folder.glob("*")):
        is_hidden = any(part.startswith(".") for part in path.relative_to(folder).parts)
        if path.suffix in EXTENSIONS and not is_hidden and path.is_file() and _AGENT.search(read_source(path).text):
            yield path


def find_main_file(path: Path) -> Path:
    """Find the file with the agents of the behavior that includes a file; the file itself if there is none."""
    for folder in [path.parent, *path.parent.parents][:_MAX_FOLDERS]:
        candidates = sorted(find_agent_files(folder, recursive=False), key=lambda each: each.name != "agents.xabsl")
        for candidate in candidates:
            if path in load_source(candidate).files:
                return candidate.resolve()
    return path


def load_source(main: Path, read: ReadText = read_source, parse_text: ParseText = parse) -> ProgramSource:
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
    """The original and the formatted text of a file, and findings: its syntax errors, doubts about its encoding."""

    original: EncodedText
    formatted: str
    findings: tuple[Finding, ...]


def format_file(path: Path, read: Callable[[Path], EncodedText] = read_source) -> FormatResult:
    """Format a file; the most frequent kind of line ending is kept.

    Raises:
        OSError: The file cannot be read.
    """
    original = read(path)
    before = original.text
    findings = tuple(_check_encoding(original, str(path)))
    # Before parsing, because titles and comments can contain line ends.
    parsed = parse(_WINDOWS_LINE_END.sub("\n", before), str(path))
    if original.invalid_at is None:
        findings += tuple(finding for finding in parsed.findings if finding.severity is Severity.ERROR)
    if any(finding.severity is Severity.ERROR for finding in findings):
        return FormatResult(original, before, findings)
    text = print_file(parsed.file)
    is_windows = before.count("\r\n") * 2 > before.count("\n")
    return FormatResult(original, text.replace("\n", "\r\n") if is_windows else text, findings)


def _check_encoding(text: EncodedText, name: str) -> Iterator[Finding]:
    """Report bytes that are not text in the assumed encoding, or do not look like it."""
    title = encoding_title(text.encoding)
    if text.invalid_at is not None:
        message, fix = f"{name} is not encoded in {title}", "specify its encoding with --encoding, or save it as UTF-8"
        location = Tokens(name, text.text).location_at(text.invalid_at)
        yield Finding(rule=get_rule("X612"), message=message, fix=fix, location=location)
    elif text.doubtful_at is not None:
        message = f"{name} is read as {title}, but does not look like it"
        fix = "specify its encoding, such as --encoding gbk, or save it as UTF-8"
        location = Tokens(name, text.text).location_at(text.doubtful_at)
        yield Finding(rule=get_rule("X611"), message=message, fix=fix, location=location)


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
        found = read(path)
    except OSError as error:
        fix = did_you_mean(path.name, _sibling_files(path), "check the path, which is relative to the including file")
        reason = error.strerror or type(error).__name__
        _add_finding(source, location, "X606", f"{shown} cannot be read: {reason}", fix, shown=source.main.name)
        return None
    encoded = EncodedText(text=found) if isinstance(found, str) else found
    if encoded.text.startswith(_UTF16_MARKS) and "\0" in encoded.text:
        message = f"{shown} is encoded in UTF-16"
        _add_finding(source, location, "X601", message, "save it as UTF-8", shown=source.main.name)
        return None
    source.encodings[path] = encoded.encoding
    source.findings += _check_encoding(encoded, _name_of(source, path))
    # Also what is invalid is read, so that all such files are reported at once.
    return encoded.text


def _parse(source: ProgramSource, path: Path, text: str, parse_text: ParseText) -> ParsedFile:
    parsed = parse_text(text, _name_of(source, path))
    if not parsed.file.body and not any(finding.rule.code in ("X604", "X605") for finding in parsed.findings):
        location = parsed.tokens.location(len(parsed.tokens.kinds) - 1)
        _add_finding(source, location, "X609", "the file defines nothing", "add an option, a namespace or an agent")
    return parsed


def _name_of(source: ProgramSource, path: Path) -> str:
    """The name of a file in findings."""
    return str(path.relative_to(source.main.parent)) if path.is_relative_to(source.main.parent) else str(path)


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
