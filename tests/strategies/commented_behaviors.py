"""Texts of XABSL behaviors as people leave them: with comments, blank lines and line breaks between any two tokens."""

import random
from collections.abc import Iterator

from hypothesis import strategies as st

from tests.strategies.xabsl_behaviors import behaviors
from vicode.xabsl.lexer import tokenize
from vicode.xabsl.printer import print_file

_GAPS = (
    "\n",
    "\n\n\n",
    "  \t",
    " // ~{}\n",
    "\n// ~{}\n",
    " /* ~{} */ ",
    "\n/* ~{}\n   of two lines */\n",
    "\n\n// ~{}\n\n",
)


@st.composite
def commented_behaviors(draw: st.DrawFn) -> dict[str, str]:
    """The texts of a random behavior by file name."""
    files = draw(behaviors(with_functions=True))
    chance = random.Random(draw(st.integers(0, 2**32)))
    rate = draw(st.sampled_from((0.0, 0.03, 0.2)))
    texts = {name: "".join(_with_gaps(print_file(file), chance, rate)) for name, file in files.items()}
    newline = draw(st.sampled_from(("\n", "\r\n")))
    return {name: text.replace("\n", newline) for name, text in texts.items()}


def _with_gaps(text: str, chance: random.Random, rate: float) -> Iterator[str]:
    tokens, _findings = tokenize(text, "")
    end = 0
    for start, word in zip(tokens.starts, tokens.texts, strict=True):
        yield text[end:start]
        if end and word and chance.random() < rate:
            yield chance.choice(_GAPS).format(start)
        yield word
        end = start + len(word)
