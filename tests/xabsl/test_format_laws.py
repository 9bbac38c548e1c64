"""`vicode xabsl format` changes layout only, and its output stays as it is when it is formatted again."""

import random
import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.strategies.commented_behaviors import commented_behaviors
from tests.xabsl.xabsl_cases import load_texts
from vicode.xabsl.compiler import compile_source
from vicode.xabsl.engine.code_writer import write_code
from vicode.xabsl.source_loader import format_file
from vicode.xabsl.source_text import EncodedText

LINE_ENDS = ("\n", "\r\n", "\r\r\n", "\r\r\r\n", " \r\n", "\t\r\r\n", "\n\r\n", "\n\r\r\n\n")
HEADERS = (
    "/***\nTitle: A\nPlatform: B\n*/\n",
    "/*** x\r\r\n y\rz\r*/",
    "/***\r\r\n\r\n*/\r\r\n",
    "/****\n * a\n ***/\n",
)
INNER = (
    "/*** a\n  b */",
    "/*\n\n a \r b\n*/",
    "// a \r b\r\n",
    "// \u00a0x\u3000\r\n",
    "/** doc\n of two */",
    "\x0b\x0c",
    "\r",
    " ",
)


def format_text(text: str) -> str:
    result = format_file(Path("agents.xabsl"), lambda _path: EncodedText(text=text))
    assert not result.findings
    return result.formatted


def intermediate_code(texts: dict[str, str]) -> str:
    program = compile_source(load_texts(texts)).program
    assert program is not None
    return write_code(program)


def characters(text: str) -> str:
    """The text without layout and the marks of comments: what a person wrote."""
    return re.sub(r"[/*\s]+", "", text)


@st.composite
def strange_texts(draw: st.DrawFn) -> dict[str, str]:
    """The texts of a random behavior with mixed line ends, headers, and comments between its definitions."""
    chance = random.Random(draw(st.integers(0, 2**32)))
    ends = chance.choices(LINE_ENDS, k=chance.randint(1, 4))

    def change(text: str) -> str:
        lines = text.replace("\r\n", "\n").split("\n")
        places = [at for at, line in enumerate(lines) if re.match("(option|namespace|agent) ", line)]
        for at in chance.sample(places, k=min(len(places), chance.randint(0, 3))):
            lines[at] = f"{chance.choice(INNER)}\n{lines[at]}"
        return chance.choice(("", *HEADERS)) + "".join(line + chance.choice(ends) for line in lines)

    return {name: change(text) for name, text in draw(commented_behaviors()).items()}


@given(strange_texts())
def test_formatting_again_changes_nothing_and_the_program_stays(texts: dict[str, str]) -> None:
    formatted = {name: format_text(text) for name, text in texts.items()}
    assert {name: format_text(text) for name, text in formatted.items()} == formatted
    assert intermediate_code(formatted) == intermediate_code(texts)
    for name, text in texts.items():
        assert characters(formatted[name]) == characters(text)
        assert "\r\r" not in formatted[name]


@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r\r\n"])
def test_line_ends_in_a_header_are_those_of_the_file(newline: str) -> None:
    text = '/***\nTitle: A\nPlatform: B\n*/\n\nagent a("A", b);\n'
    expected = text if newline == "\n" else text.replace("\n", "\r\n")
    assert format_text(text.replace("\n", newline)) == expected
