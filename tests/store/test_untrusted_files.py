"""No text makes the reader raise, hang or run code."""

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.strategies.commented_texts import commented_texts, fewer_examples
from vicode.store import read_design, read_project_file, save_design

DESIGNS = Path(__file__).parents[2] / "designs"
TEXTS = [path.read_text(encoding="utf-8") for path in sorted(DESIGNS.rglob("*.yaml"))]
FRAGMENTS = "\n  - :#{}[]&*!|>'\",%@`?\t\r\u2028\ufeff\x85é"


def _codes(text: str | bytes) -> list[str]:
    return [finding.rule.code for finding in read_design(text).findings]


@given(st.text() | st.text(FRAGMENTS + "abc1"))
def test_any_text_is_read(text: str) -> None:
    _read_both(text)


@given(st.binary())
def test_any_bytes_are_read(content: bytes) -> None:
    _read_both(content)


@given(st.sampled_from(TEXTS), st.lists(st.tuples(st.floats(0, 1), st.text(FRAGMENTS, max_size=3), st.integers(0, 8))))
def test_any_damaged_design_is_read_and_saved(text: str, damages: list[tuple[float, str, int]]) -> None:
    for place, new, removed in damages:
        start = int(place * len(text))
        text = text[:start] + new + text[start + removed :]
    _read_both(text)
    read = read_design(text)
    if read.design is not None:
        assert save_design(read.design, text) == text or read.findings


@fewer_examples
@given(commented_texts(4), st.randoms(use_true_random=False))
def test_any_design_with_other_keys_is_read(text: str, random: object) -> None:
    words = re.findall(r"\w+", text)
    damaged = re.sub(r"\w+(?=:)", lambda match: random.choice([match.group(), *words]), text)  # type: ignore[attr-defined]
    _read_both(damaged)


def test_large_files_are_rejected() -> None:
    assert _codes("vicode: 1\n" + "# filler\n" * 600_000) == ["Y108"]
    assert _codes(b"\xc3\xa4" * 3_000_000) == ["Y108"]
    assert _codes("- a\n" * 400_000) == ["Y108"]


@pytest.mark.parametrize("opening", ["[", "{a: ", "- ", "{", "? "])
def test_deep_nesting_is_rejected(opening: str) -> None:
    assert _codes(opening * 100_000)[-1] in ("Y108", "Y101")


def test_aliases_are_never_followed() -> None:
    levels = "".join(f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]\n" for n in range(1, 20))
    assert set(_codes("a0: &a0 x\n" + levels)) <= {"Y102", "Y104", "Y107"}


def test_the_number_of_findings_is_limited() -> None:
    assert len(_codes("".join(f"key{n}: *a\n" for n in range(50_000)))) <= 200
    assert len(_codes("vicode: 1\n" + "".join(f"key{n}: 1\n" for n in range(50_000)))) <= 200


def test_tags_do_not_run_code(tmp_path: Path) -> None:
    target = tmp_path / "ran"
    text = f"vicode: 1\ncomponent: !!python/object/apply:pathlib.Path.touch ['{target}']\n"
    assert "Y106" in _codes(text)
    assert not target.exists()


def _read_both(text: str | bytes) -> None:
    for finding in (*read_design(text).findings, *read_project_file(text).findings):
        assert finding.location is not None
        assert finding.location.line >= 1
        assert finding.location.column >= 1
