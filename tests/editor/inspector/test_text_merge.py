"""Two people change one text at the same time: server and browser merge it alike, and nobody's letters are lost."""

import json
import subprocess
from pathlib import Path

import playwright
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.editor.session.forms.text_merge import merge_texts

NODE = Path(playwright.__file__).parent / "driver" / "node"
JS = Path(__file__).parents[3] / "vicode/editor/inspector/js"
LAW = Path(__file__).with_name("typing_law.js")
TEXTS = st.text(alphabet="ab .", max_size=6)

CASES = (
    ("OLD TEXT", "NEW", "OLD TEXT!!", "NEW!!"),
    ("OLD TEXT", "OLD TEXT!!", "NEW", "NEW!!"),
    ("x < 1", "x < 15", "y < 1", "y < 15"),
    ("abc", "abXc", "abYc", "abXYc"),
    ("abcdef", "af", "abXdef", "aXf"),
    ("abc", "", "abcd", "d"),
    ("", "a", "b", "ab"),
)


def node(source: str) -> str:
    """Run a module in the node of Playwright and return what it prints."""
    options = ["--no-warnings", "--experimental-detect-module", "--input-type=module", "--eval", source]
    done = subprocess.run([NODE, *options], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize(("base", "ours", "theirs", "merged"), CASES)
def test_both_changes_are_kept(base: str, ours: str, theirs: str, merged: str) -> None:
    assert merge_texts(base, ours, theirs) == merged


@given(TEXTS, TEXTS)
def test_a_change_of_one_side_alone_is_the_text_of_that_side(base: str, text: str) -> None:
    assert merge_texts(base, text, base) == text
    assert merge_texts(base, base, text) == text
    assert merge_texts(base, text, text) == text


@given(st.text(alphabet="abc", min_size=4, max_size=12), st.data())
def test_insertions_at_different_places_are_both_there(base: str, data: st.DataObject) -> None:
    first = data.draw(st.integers(0, len(base) - 1))
    second = data.draw(st.integers(first + 1, len(base)))
    ours = f"{base[:first]}XX{base[first:]}"
    theirs = f"{base[:second]}YY{base[second:]}"
    both = f"{base[:first]}XX{base[first:second]}YY{base[second:]}"
    assert merge_texts(base, ours, theirs) == both
    assert merge_texts(base, theirs, ours) == both


def test_the_browser_merges_as_the_server() -> None:
    letters = ("", "a", "b", "ab", "ba", "aab", "abb", "a b", "b a b")
    texts = [(base, ours, theirs) for base in letters for ours in letters for theirs in letters]
    source = f"""
        const {{ mergeTexts }} = await import("file://{JS}/text_merge.js");
        console.log(JSON.stringify({json.dumps(texts)}.map((each) => mergeTexts(...each))));
    """
    assert json.loads(node(source)) == [merge_texts(*each) for each in texts]


@pytest.mark.parametrize("people", [1, 2])
@pytest.mark.parametrize("stored", ["as typed", "without outer spaces", "when it is finished"])
def test_no_letter_is_lost_whatever_the_connection_does(people: int, stored: str) -> None:
    """Random typing, delays in both directions, and a design that may store texts without their outer spaces."""
    assert find_fault(people, stored) == "none"


def test_no_letter_is_lost_when_texts_are_refused_on_the_way() -> None:
    assert find_fault(1, "whole words only") == "none"


def find_fault(people: int, stored: str) -> str:
    source = f"""
        const {{ findFault }} = await import("file://{LAW}");
        console.log(await findFault("file://{JS}", {people}, "{stored}"));
    """
    return node(source).strip()
