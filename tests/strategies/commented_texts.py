"""Texts of designs as people leave them: with comments and blank lines in every place that may have them."""

import re
from random import Random

from hypothesis import settings
from hypothesis import strategies as st

from tests.strategies.designs import designs_with_states
from vicode.store import read_design, save_design

fewer_examples = settings(max_examples=max(10, settings.default.max_examples // 3))
"""For laws whose examples take long to draw."""

COMMENT = re.compile(r"#~\d+")
"""A comment put in; its number makes it unique."""


def find_comments(text: str) -> set[str]:
    """The comments that were put into a text."""
    return set(COMMENT.findall(text))


@st.composite
def commented_texts(draw: st.DrawFn, largest: int = 8) -> str:
    """The text of a random design with comments, blank lines and line ends put in where they change nothing."""
    text = save_design(draw(designs_with_states))
    meant = read_design(text).design
    random = Random(draw(st.integers(0, 2**32)))
    for number in range(random.randint(0, largest)):
        changed = _insert_comment(text, number, random)
        read = read_design(changed)
        # Inside code a comment would be code, and a number in quotes is none.
        text = changed if read.design == meant and not read.findings else text
    if random.random() < 0.5 and read_design(text.removesuffix("\n")).design == meant:
        text = text.removesuffix("\n")
    return text.replace("\n", "\r\n") if random.random() < 0.3 and "\r" not in text else text


def _insert_comment(text: str, number: int, random: Random) -> str:
    lines = text.split("\n")
    line = random.randrange(len(lines))
    column = len(lines[line]) - len(lines[line].lstrip())
    match random.choice(["beside", "above", "blank", "quoted"]):
        case "beside":
            lines[line] += f"  #~{number}"
        case "above":
            lines.insert(line, " " * column + f"#~{number}")
        case "blank":
            lines.insert(line, "")
        case _:
            lines[line] = re.sub(r": (\w+)$", r': "\1"', lines[line])
    return "\n".join(lines)
