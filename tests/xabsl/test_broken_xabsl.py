"""Broken files: whatever is done to them, they are read without exception, and every message stands inside the file."""

import contextlib
import random
from collections.abc import Iterator

import pytest

from tests.xabsl.xabsl_cases import CASES, PROGRAMS, load_texts
from vicode.findings import Finding
from vicode.xabsl.compiler import compile_source
from vicode.xabsl.engine.code_reader import CodeError, read_code
from vicode.xabsl.engine.symbols import SymbolListError, read_symbols
from vicode.xabsl.parser import parse
from vicode.xabsl.printer import print_file

FILES = {
    name: {
        str(path.relative_to(CASES / "programs" / name)): path.read_text(encoding="utf-8")
        for path in sorted((CASES / "programs" / name).rglob("*.xabsl"))
    }
    for name in PROGRAMS
}
TEXTS = [text for files in FILES.values() for text in files.values()]
ODD = ("/*", "/**", "*/", '"', "[", "\ufeff", "\x00", "&", "😀")
WORDS = (*sorted({word for text in TEXTS for word in text.split()}), *ODD * 5)


def mutations(rng: random.Random, text: str) -> str:
    """The text after one to four changes: something is cut, doubled, moved, or comes from elsewhere."""
    for _ in range(rng.randint(1, 4)):
        start = rng.randrange(len(text) + 1)
        end = min(len(text), start + rng.choice((1, 1, 2, 5, 20, 200)))
        match rng.randrange(6):
            case 0:
                text = text[:start] + text[end:]
            case 1:
                text = text[:start] + text[start:end] * 2 + text[end:]
            case 2:
                text = text[:start] + rng.choice(WORDS) + text[start:]
            case 3:
                text = text[:start] + rng.choice(WORDS) + text[end:]
            case 4:
                other = rng.choice(TEXTS)
                at = rng.randrange(len(other) + 1)
                text = text[:start] + other[at : at + rng.randrange(80)] + text[end:]
            case 5:
                place = rng.randrange(len(text) + 1)
                text = text[:start] + text[end:place] + text[start:end] + text[max(place, end) :]
    return text


def assert_inside(findings: list[Finding] | tuple[Finding, ...], files: dict[str, str]) -> None:
    for finding in findings:
        assert finding.location
        lines = files[finding.location.file].split("\n")
        assert 1 <= finding.location.line <= len(lines)
        line = lines[finding.location.line - 1]
        assert 1 <= finding.location.column <= len(line) + 1
        assert finding.location.column - 1 + finding.location.length <= max(len(line), finding.location.column)


def _broken(count: int, seed: int) -> Iterator[str]:
    rng = random.Random(seed)
    for _ in range(count):
        yield mutations(rng, rng.choice(TEXTS))


def read_broken(count: int, seed: int) -> None:
    for text in _broken(count, seed):
        parsed = parse(text, "f")
        assert_inside(parsed.findings, {"f": text})
        printed = print_file(parsed.file)
        if not parsed.findings:
            assert parse(printed).file == parsed.file


def compile_broken(count: int, seed: int) -> None:
    rng = random.Random(seed)
    for _ in range(count):
        files = dict(FILES[rng.choice(PROGRAMS)])
        name = rng.choice(sorted(files))
        files[name] = mutations(rng, files[name])
        compiled = compile_source(load_texts(files))
        assert_inside(compiled.findings, files)


@pytest.mark.parametrize("seed", range(4))
def test_broken_files_are_read(seed: int) -> None:
    read_broken(1000, seed)


def test_broken_behaviors_are_compiled() -> None:
    compile_broken(150, 1)


@pytest.mark.nightly
@pytest.mark.parametrize("seed", range(20))
def test_a_million_broken_files_are_read(seed: int) -> None:
    read_broken(50_000, seed + 1000)


@pytest.mark.nightly
@pytest.mark.parametrize("seed", range(4))
def test_many_broken_behaviors_are_compiled(seed: int) -> None:
    compile_broken(5000, seed + 2000)


def test_broken_code_and_symbol_lists_are_refused() -> None:
    rng = random.Random(5)
    texts = [(CASES / "programs" / name / "intermediate.dat").read_text() for name in PROGRAMS[:5]]
    lists = [(CASES / "programs" / name / "symbols.txt").read_text() for name in PROGRAMS]
    for _ in range(300):
        for text, read, error in (
            (rng.choice(texts), read_code, CodeError),
            (rng.choice(lists), read_symbols, SymbolListError),
        ):
            with contextlib.suppress(error):
                read(mutations(rng, text))
