"""The files of a program: found by their includes, each read once, however it is spelt."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from vicode.findings import Finding, Place, Severity, did_you_mean, rule
from vicode.xabsl.parser import Parsed, parse
from vicode.xabsl.printer import print_file
from vicode.xabsl.tree import Agent

ReadText = Callable[[Path], str]
ParseText = Callable[[str, str], Parsed]
_EXTENSIONS = (".xabsl", ".yabsl")


_AGENT = re.compile(r"^[ \t]*agent\s+\w+\s*\(", re.MULTILINE)


@dataclass(slots=True)
class Source:
    """All files of a program in the order in which they were first included, by their real paths."""

    main: Path
    files: dict[Path, Parsed] = field(default_factory=dict)
    findings: list[Finding] = field(default_factory=list)

    @property
    def title(self) -> str:
        """The title that the first comment of the main file tells."""
        return header_of(self.files[self.main].file.initial).get("Title", "") if self.main in self.files else ""

    @property
    def has_agents(self) -> bool:
        """Whether any of its files has an agent."""
        return any(isinstance(each, Agent) for parsed in self.files.values() for each in parsed.file.body)


def header_of(initial: str) -> dict[str, str]:
    """What the first comment of a file says of "Title", "Platform" and "Software-Environment"."""
    lines = (line.partition(":") for line in initial.splitlines())
    return {key.strip(): value.strip() for key, colon, value in lines if colon}


def read_text(path: Path) -> str:
    """The text of a file: UTF-8, with or without mark; else the one-byte encoding of western Europe, as teams had it.

    Raises:
        OSError: It cannot be read.
    """
    data = path.read_bytes()
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace")


def files_with_agents(folder: Path, *, is_deep: bool = True) -> Iterator[Path]:
    """The files of a folder, and of those in it, that look as if they declared agents: a behavior begins there."""
    for path in sorted(folder.rglob("*") if is_deep else folder.glob("*")):
        if path.suffix in _EXTENSIONS and path.is_file() and _AGENT.search(read_text(path)):
            yield path


def load(main: Path, read: ReadText = read_text, parse_text: ParseText = parse) -> Source:
    """Read a program from the file with its agents; what cannot be read is told in the findings."""
    source = Source(main.resolve())
    waiting: list[tuple[Path, Place | None, str]] = [(source.main, None, str(main))]
    while waiting:
        path, place, shown = waiting.pop()
        text = _read(source, path, place, shown, read)
        parsed = _parse(source, path, text, parse_text) if text is not None else None
        if parsed is None:
            continue
        source.files[path] = parsed
        source.findings += parsed.findings
        # The stack gives them back in the order of the text.
        waiting += reversed(_includes(source, path, parsed))
    _look_for_agents(source)
    return source


@dataclass(frozen=True, slots=True)
class Formatted:
    """A file as it was and as it should be, or what cannot be read in it."""

    before: str
    text: str
    findings: tuple[Finding, ...]


def format_file(path: Path, read: ReadText = read_text) -> Formatted:
    """Lay a file out; line ends stay as most of them are.

    Raises:
        OSError: It cannot be read.
    """
    before = read(path)
    parsed = parse(before, str(path))
    errors = tuple(each for each in parsed.findings if each.severity is Severity.ERROR)
    if errors:
        return Formatted(before, before, errors)
    text = print_file(parsed.file)
    is_windows = before.count("\r\n") * 2 > before.count("\n")
    return Formatted(before, text.replace("\n", "\r\n") if is_windows else text, ())


def _includes(source: Source, path: Path, parsed: Parsed) -> list[tuple[Path, Place | None, str]]:
    found: dict[Path, tuple[Path, Place | None, str]] = {}
    for include in parsed.file.includes:
        written = include.path.replace("\\", "/")
        target = (path.parent / written).resolve()
        place = parsed.tokens.place(include.at + 1)
        if target in found:
            _complain(source, place, "X608", f"{include.path} is included twice", "remove one of them")
        else:
            found[target] = (target, place, include.path)
    return list(found.values())


def _read(source: Source, path: Path, place: Place | None, shown: str, read: ReadText) -> str | None:
    if path in source.files:
        return None
    if path.suffix.lower() not in _EXTENSIONS:
        _complain(source, place, "X607", f"{shown} does not end in .xabsl", "rename it", shown=shown)
        return None
    try:
        return read(path)
    except OSError as error:
        mend = did_you_mean(path.name, _neighbours(path), "check the path, which begins at the including file")
        reason = error.strerror or type(error).__name__
        _complain(source, place, "X606", f"{shown} cannot be read: {reason}", mend, shown=shown)
        return None


def _parse(source: Source, path: Path, text: str, parse_text: ParseText) -> Parsed:
    name = str(path.relative_to(source.main.parent)) if path.is_relative_to(source.main.parent) else str(path)
    parsed = parse_text(text, name)
    if not parsed.file.body and not any(each.rule.code in ("X604", "X605") for each in parsed.findings):
        at = parsed.tokens.place(len(parsed.tokens.kinds) - 1)
        _complain(source, at, "X609", "the file defines nothing", "write an option, a namespace or an agent into it")
    return parsed


def _neighbours(path: Path) -> list[str]:
    try:
        return [each.name for each in path.parent.iterdir() if each.suffix in _EXTENSIONS]
    except OSError:
        return []


def _look_for_agents(source: Source) -> None:
    with_agents = [
        (parsed, first)
        for parsed in source.files.values()
        if (first := next((each for each in parsed.file.body if isinstance(each, Agent)), None)) is not None
    ]
    for parsed, agent in with_agents[1:]:
        message = f"agents in a second file: {agent.name.text}"
        _complain(source, parsed.tokens.place(agent.at), "X610", message, f"put them into {source.main.name}")
    if source.files and not with_agents and not source.findings:
        place = Place(file=source.main.name, line=1, column=1)
        _complain(source, place, "X609", "no file of the program has an agent", 'add agent name("Title", root_option);')


def _complain(source: Source, place: Place | None, code: str, message: str, mend: str, *, shown: str = "") -> None:
    place = place or Place(file=shown, line=1, column=1)
    source.findings.append(Finding(rule=rule(code), message=message, mend=mend, place=place))
