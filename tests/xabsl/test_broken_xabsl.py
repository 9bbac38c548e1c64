"""Randomly damaged files parse and compile without an exception, and every finding is located inside its file."""

import contextlib
import random
from collections.abc import Iterator
from functools import lru_cache

import pytest

from tests.xabsl.xabsl_cases import CASES, PROGRAMS, load_texts
from vicode.findings import Finding
from vicode.xabsl.compiler import compile_source
from vicode.xabsl.engine.code_reader import CodeError, read_code
from vicode.xabsl.engine.symbols import SymbolListError, read_symbols
from vicode.xabsl.parser import ParsedFile, parse
from vicode.xabsl.printer import print_file

FILES = {
    name: {
        str(path.relative_to(CASES / "programs" / name)): path.read_text(encoding="utf-8")
        for path in sorted((CASES / "programs" / name).rglob("*.xabsl"))
    }
    for name in PROGRAMS
}
TEXTS = [text for files in FILES.values() for text in files.values()]
INVALID = ("/*", "/**", "*/", '"', "[", "\ufeff", "\x00", "&", "😀")
WORDS = (*sorted({word for text in TEXTS for word in text.split()}), *INVALID * 5)


def mutate(rng: random.Random, text: str) -> str:
    """Apply one to four random changes: delete, duplicate, insert, move, or copy from another file."""
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
                donor = rng.choice(TEXTS)
                position = rng.randrange(len(donor) + 1)
                text = text[:start] + donor[position : position + rng.randrange(80)] + text[end:]
            case 5:
                target = rng.randrange(len(text) + 1)
                text = text[:start] + text[end:target] + text[start:end] + text[max(target, end) :]
    return text


def assert_located_inside(findings: list[Finding] | tuple[Finding, ...], files: dict[str, str]) -> None:
    for finding in findings:
        assert finding.location
        lines = files[finding.location.file].split("\n")
        assert 1 <= finding.location.line <= len(lines)
        line = lines[finding.location.line - 1]
        assert 1 <= finding.location.column <= len(line) + 1
        assert finding.location.column - 1 + finding.location.length <= max(len(line), finding.location.column)


def broken_texts(count: int, seed: int) -> Iterator[str]:
    rng = random.Random(seed)
    for _ in range(count):
        yield mutate(rng, rng.choice(TEXTS))


def parse_broken(count: int, seed: int) -> None:
    for text in broken_texts(count, seed):
        parsed = parse(text, "f")
        assert_located_inside(parsed.findings, {"f": text})
        printed = print_file(parsed.file)
        if not parsed.findings:
            assert parse(printed).file == parsed.file


@lru_cache(maxsize=512)
def parse_cached(text: str, name: str) -> ParsedFile:
    """Parse a file. The undamaged files of a program occur in many of its variants."""
    return parse(text, name)


def compile_broken(count: int, seed: int) -> None:
    rng = random.Random(seed)
    for _ in range(count):
        files = dict(FILES[rng.choice(PROGRAMS)])
        name = rng.choice(sorted(files))
        files[name] = mutate(rng, files[name])
        compiled = compile_source(load_texts(files, parse_text=parse_cached))
        assert_located_inside(compiled.findings, files)


@pytest.mark.parametrize("seed", range(4))
def test_broken_files_parse_without_exception(seed: int) -> None:
    parse_broken(1000, seed)


def test_broken_behaviors_compile_without_exception() -> None:
    compile_broken(150, 1)


@pytest.mark.nightly
@pytest.mark.parametrize("seed", range(20))
def test_a_million_broken_files_parse_without_exception(seed: int) -> None:
    parse_broken(50_000, seed + 1000)


@pytest.mark.nightly
@pytest.mark.parametrize("seed", range(4))
def test_many_broken_behaviors_compile_without_exception(seed: int) -> None:
    compile_broken(5000, seed + 2000)


def test_broken_code_and_symbol_lists_raise_their_own_errors() -> None:
    rng = random.Random(5)
    texts = [(CASES / "programs" / name / "intermediate.dat").read_text() for name in PROGRAMS[:5]]
    lists = [(CASES / "programs" / name / "symbols.txt").read_text() for name in PROGRAMS]
    for _ in range(300):
        for text, read, error in (
            (rng.choice(texts), read_code, CodeError),
            (rng.choice(lists), read_symbols, SymbolListError),
        ):
            with contextlib.suppress(error):
                read(mutate(rng, text))
