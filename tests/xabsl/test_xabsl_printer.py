"""The printer keeps all tokens and comments, and its output is a fixed point."""

import pytest

from tests.xabsl.xabsl_cases import CASES, PROGRAMS, read_probes
from vicode.xabsl.parser import parse
from vicode.xabsl.printer import print_file

FILES = sorted(path for name in PROGRAMS for path in (CASES / "programs" / name).rglob("*.xabsl"))
TEXTS = [text for probe in read_probes() if probe.accepted for text in probe.files.values()]


def assert_printing_is_stable(text: str) -> None:
    parsed = parse(text)
    printed = print_file(parsed.file)
    again = parse(printed)
    assert again.file == parsed.file
    assert again.tokens.kinds == parsed.tokens.kinds
    assert print_file(again.file) == printed
    assert not any(line != line.rstrip() for line in printed.split("\n") if "*" not in line)


@pytest.mark.parametrize("name", PROGRAMS)
def test_complete_behaviors_are_printed(name: str) -> None:
    for path in (CASES / "programs" / name).rglob("*.xabsl"):
        assert_printing_is_stable(path.read_text(encoding="utf-8"))


def test_probes_are_printed() -> None:
    for text in dict.fromkeys(TEXTS):
        assert_printing_is_stable(text)


COMMENTED = """// first of all
/***
Title: not the first any more */
include "a.xabsl"; // after an include
// before an option
option crowded { // after a brace
  float @x /* in the middle */ [0..1] "m"; /** doc */ /* no doc */ bool @y;
  common decision { if (a // why
    && b /* and */ || !c) /* here */ goto one; /* open */ }
  common action { /* nothing */ }
  initial target state one capacity 3 { decision { /** d */ else /** e */ if (x) { stay; } /** f */ else /* g */ stay; }
    // before the actions

    action { go(x = - 3, y = f(a = 1,),); // trailing

      /* alone */
    } /* after actions */ }
  // at the end of the option
}
// at the end of the file"""


def test_all_comments_are_kept() -> None:
    assert_printing_is_stable(COMMENTED)
    printed = print_file(parse(COMMENTED).file)
    for comment in (
        "// first of all",
        "/* in the middle */",
        "// why",
        "/* g */",
        "/* alone */",
        "// at the end of the file",
    ):
        assert printed.count(comment) == 1


def test_a_long_condition_is_broken_before_its_operators() -> None:
    condition = " && ".join(f"some.symbol.number{number} > {number}" for number in range(8))
    text = f"option o {{ initial state s {{ decision {{ if ({condition}) stay; else stay; }} action {{ }} }} }}\n"
    assert_printing_is_stable(text)
    lines = print_file(parse(text).file).split("\n")
    assert max(map(len, lines)) < 60
    assert sum(line.strip().startswith("&&") for line in lines) == 7


def test_a_long_conditional_is_broken_in_its_condition_too() -> None:
    condition = " && ".join(f"some.symbol.number{number} > {number}" for number in range(8))
    text = (
        f"option o {{ initial state s {{ decision {{ if ({condition} ? a : b) stay; else stay; }} action {{ }} }} }}\n"
    )
    assert_printing_is_stable(text)
    assert max(map(len, print_file(parse(text).file).split("\n"))) < 60


def test_windows_line_endings_are_not_part_of_texts() -> None:
    text = "/** two\r\nlines */\r\noption o {\r\n  initial state s {\r\n    action { /* a\r\nb */ }\r\n  }\r\n}\r\n"
    assert "\r" not in print_file(parse(text).file)
    assert parse(text).file == parse(text.replace("\r", "")).file
