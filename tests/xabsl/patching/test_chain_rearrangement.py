"""Tests of a decision tree are added, moved and removed, unless braces or descriptions tie them to their place."""

from collections.abc import Sequence

import pytest

from vicode.matching import Match, find_unmoved
from vicode.xabsl import tree
from vicode.xabsl.parser import parse
from vicode.xabsl.patching.chain_rearrangement import ChainRearrangement
from vicode.xabsl.patching.decision_chains import Chain, read_chain
from vicode.xabsl.patching.decision_edits import DecisionEdits
from vicode.xabsl.patching.source_edits import SourceEdits

BEGIN, END = "option o { common decision { if (z) goto s; } initial state s { decision {", "} action { } } }"
COMMON_BEGIN, COMMON_END = "option o { common decision {", "} initial state s { action { } } }"


def option_of(file: SourceEdits) -> tree.OptionNode:
    (option,) = file.parsed.file.body
    assert isinstance(option, tree.OptionNode)
    return option


def chain_in_state(text: str) -> tuple[SourceEdits, Chain]:
    file = SourceEdits(parse(BEGIN + text + END, "o.xabsl"))
    decision = option_of(file).states[0].decision
    assert decision is not None
    return file, read_chain(decision.tree, decision.else_doc)


def common_chain(text: str) -> tuple[SourceEdits, Chain]:
    file = SourceEdits(parse(COMMON_BEGIN + text + COMMON_END, "o.xabsl"))
    decision = option_of(file).common_decision
    assert decision is not None
    return file, read_chain(decision, "")


def is_possible(read: tuple[SourceEdits, Chain], matches: Sequence[Match]) -> bool:
    """Whether the tests of a chain can be replaced by those with these numbers; None adds one."""
    file, chain = read
    kept, added = find_unmoved(matches), ["" if match is not None else "if (n) stay;" for match in matches]
    return ChainRearrangement(file=file, old=chain, after=chain, matches=matches, kept=kept, added=added).is_possible()


PLAIN = "if (a) goto s; else if (b) stay; else if (c) goto s; else stay;"


@pytest.mark.parametrize(
    "matches",
    [[0, 1, 2], [1, 2], [2], [], [0, 1], [0, 2], [2, 1, 0], [None, 0, 1, 2], [0, None, 1, 2], [0, 1, 2, None], [None]],
)
def test_plain_tests_can_be_in_any_order(matches: list[Match]) -> None:
    assert is_possible(chain_in_state(PLAIN), matches)


@pytest.mark.parametrize(
    ("matches", "expected"),
    [([], False), ([None], False), ([0], True), ([1], True), ([None, 0], True), ([1, 0], True)],
)
def test_an_open_chain_keeps_one_of_its_tests(matches: list[Match], expected: bool) -> None:
    """Without a last `else`, nothing is left to which an `else` could be added."""
    assert is_possible(common_chain("if (a) goto s; else if (b) goto s;"), matches) is expected


@pytest.mark.parametrize(
    ("text", "matches", "expected"),
    [
        # The description before an `else` cannot become that of the first test.
        ("if (a) goto s; /** d */ else if (b) stay; else stay;", [1], False),
        ("if (a) goto s; /** d */ else if (b) stay; else stay;", [0], True),
        ("if (a) goto s; /** d */ else if (b) stay; else stay;", [1, 0], True),
        ("if (a) goto s; /** d */ else if (b) stay; else stay;", [], False),
        ("if (a) goto s; else if (b) stay; /** d */ else stay;", [], False),
        ("if (a) goto s; else if (b) stay; /** d */ else stay;", [None], False),
        ("if (a) goto s; else if (b) stay; /** d */ else stay;", [0], True),
        ("if (a) goto s; else if (b) stay; /** d */ else stay;", [1], True),
        ("if (a) goto s; else if (b) stay; /** d */ else if (c) stay; else stay;", [2], False),
        ("if (a) goto s; else if (b) stay; /** d */ else if (c) stay; else stay;", [0, 2], True),
        # Its own description moves with a test.
        ("if (a) goto s; else /** d */ if (b) stay; else stay;", [1], True),
        ("/** d */ if (a) goto s; else if (b) stay; else stay;", [None, 0, 1], True),
        # The description before the first `else` stays before the first test.
        ("/** d */ else if (a) goto s; else if (b) stay; else stay;", [None, 0, 1], False),
        ("/** d */ else if (a) goto s; else if (b) stay; else stay;", [1, 0], False),
        ("/** d */ else if (a) goto s; else if (b) stay; else stay;", [None], False),
        ("/** d */ else if (a) goto s; else if (b) stay; else stay;", [0, None, 1], True),
        ("/** d */ else if (a) goto s; else if (b) stay; else stay;", [1], True),
        ("/** d */ else if (a) goto s; else if (b) stay; else stay;", [], True),
        ("else if (a) goto s; else if (b) stay; else stay;", [None, 0, 1], True),
    ],
)
def test_a_description_before_an_else_belongs_to_its_place(text: str, matches: list[Match], expected: bool) -> None:
    assert is_possible(chain_in_state(text), matches) is expected


@pytest.mark.parametrize(
    ("text", "matches", "expected"),
    [
        ("if (a) goto s; else { if (b) stay; else if (c) stay; else stay; }", [0, 1, 2], True),
        ("if (a) goto s; else { if (b) stay; else if (c) stay; else stay; }", [0, 2], False),
        ("if (a) goto s; else { if (b) stay; else if (c) stay; else stay; }", [0, 1], True),
        ("if (a) goto s; else { if (b) stay; else if (c) stay; else stay; }", [1, 2], True),
        ("if (a) goto s; else { if (b) stay; else if (c) stay; else stay; }", [2], False),
        ("if (a) goto s; else { if (b) stay; else if (c) stay; else stay; }", [], False),
        ("if (a) goto s; else if (b) stay; else { if (c) stay; else stay; }", [0, 1], False),
        ("if (a) goto s; else if (b) stay; else { if (c) stay; else stay; }", [2], True),
        ("if (a) goto s; else if (b) stay; else { if (c) stay; else stay; }", [0], False),
        ("{ if (a) goto s; else stay; }", [], True),
        ("{ if (a) goto s; else if (b) stay; else stay; }", [1], True),
    ],
)
def test_braces_around_the_rest_of_a_chain_keep_its_first_test(text: str, matches: list[Match], expected: bool) -> None:
    assert is_possible(chain_in_state(text), matches) is expected


# The edited text


def edited(old: str, after: str) -> str:
    """Edit a decision; each is the text in its braces."""
    file = SourceEdits(parse(f"option o {{ initial state s {{ decision {{{old}}} action {{ }} }} }}", "o.xabsl"))
    new = SourceEdits(parse(f"option o {{ initial state s {{ decision {{{after}}} action {{ }} }} }}", "o.xabsl"))
    was, now = (option_of(each).states[0].decision for each in (file, new))
    assert was is not None
    assert now is not None
    DecisionEdits(file, "  ", {}).edit(was.tree, was.tree, now.tree)
    text = file.result()
    assert text.startswith("option o { initial state s { decision {")
    return text.removeprefix("option o { initial state s { decision {").removesuffix("} action { } } }")


A = "  // one\n  {}if (a) {{\n    goto s;\n  }} // 1\n"
B = "  // two\n  {}if (b) {{\n    stay;\n  }} // 2\n"
C = "  // three\n  {}if (c)\n    goto s; // 3\n"
ADDED = "  {}if (n) {{\n    goto s;\n  }}\n"
REST = "  // rest\n  else\n    stay;\n"


def chain(*tests: str) -> str:
    """A chain of tests, each with its comments above and behind it."""
    return "\n" + "".join(test.format("else " if index else "") for index, test in enumerate(tests)) + REST


@pytest.mark.parametrize(
    "tests",
    [
        (B, C),
        (C,),
        (A, C),
        (A, B),
        (A,),
        (A, C, B),
        (B, A, C),
        (C, A, B),
        (C, B, A),
        (B, C, A),
        (C, A),
        (ADDED, A, B, C),
        (A, ADDED, B, C),
        (A, B, C, ADDED),
        (ADDED, C, A, B),
        (C, ADDED, A, B),
        (A, B, ADDED, ADDED.replace("(n)", "(m)"), C),
        (ADDED, ADDED.replace("(n)", "(m)"), A, B, C),
        (A, "  /** x y */\n" + ADDED, B, C),
        ("  /** x y */\n" + ADDED, A, B, C),
    ],
)
def test_tests_keep_the_comments_above_and_behind_them(tests: tuple[str, ...]) -> None:
    expected = chain(*tests)
    after = expected.replace("/** x y */\n  else if", "else /** x\n y */ if")
    assert edited(chain(A, B, C), after) == expected


@pytest.mark.parametrize(
    ("old", "expected"),
    [
        # The others begin lines, too.
        (
            "\n  if (a) {\n    goto s;\n  }\n  else {\n    stay;\n  }\n",
            "\n  if (a) {\n    goto s;\n  }\n  else if (n) {\n    goto s;\n  }\n  else {\n    stay;\n  }\n",
        ),
        # No brace precedes it.
        (
            "\n  if (a) {\n    goto s;\n  } else if (b)\n    stay;\n  else\n    stay;\n",
            (
                "\n  if (a) {\n    goto s;\n  } else if (b)\n    stay;\n"
                "  else if (n) {\n    goto s;\n  }\n  else\n    stay;\n"
            ),
        ),
    ],
)
def test_an_added_test_begins_a_line(old: str, expected: str) -> None:
    assert edited(old, expected) == expected


def test_a_test_is_moved_within_braces_in_a_line() -> None:
    old = "\n    { if (a) goto s; else if (b) stay; else stay; }"
    expected = "\n    { if (b) stay;\n    else if (a) goto s; else stay; }"
    assert edited(old, expected) == expected


def test_a_comment_behind_the_brace_stays() -> None:
    assert edited(" // note" + chain(A, B, C), chain(B, C, A)) == " // note" + chain(B, C, A)


def test_all_tests_are_removed() -> None:
    assert edited(chain(A, B, C), "stay;") == "\n  // rest\n  stay;\n"


BRACED = "\n  if (a) {\n    goto s;\n  } else if (b) { // 2\n    stay;\n  } else {\n    stay;\n  }\n"


@pytest.mark.parametrize(
    "expected",
    [
        "\n  if (b) { // 2\n    stay;\n  } else {\n    stay;\n  }\n",
        "\n  if (a) {\n    goto s;\n  } else {\n    stay;\n  }\n",
        "\n  if (b) { // 2\n    stay;\n  } else if (a) {\n    goto s;\n  } else {\n    stay;\n  }\n",
        BRACED.replace("if (a)", "if (n) {\n    goto s;\n  } else if (a)"),
        BRACED.replace("if (a)", "if (n) {\n    goto s;\n  } else if (m) {\n    goto s;\n  } else if (a)"),
        BRACED.replace(
            "if (a)", "if (n) {\n    goto s;\n  }\n  /** x */\n  else if (m) {\n    goto s;\n  } else if (a)"
        ),
        BRACED.replace("if (b)", "if (n) {\n    goto s;\n  } else if (b)"),
        BRACED.replace("} else {", "} else if (n) {\n    goto s;\n  } else {"),
        BRACED.replace("} else {", "}\n  /** x */\n  else if (n) {\n    goto s;\n  } else {"),
    ],
)
def test_an_else_stays_behind_a_closing_brace(expected: str) -> None:
    assert edited(BRACED, expected.replace("/** x */\n  else", "else /** x */")) == expected


@pytest.mark.parametrize(
    ("after", "expected"),
    [
        ("if (b) stay; else stay;", " if (b) stay; else stay; "),
        ("if (a) goto s; else stay;", " if (a) goto s; else stay; "),
        ("if (b) stay; else if (a) goto s; else stay;", " if (b) stay;\nelse if (a) goto s; else stay; "),
        (
            "if (a) goto s; else if (n) goto s; else if (b) stay; else stay;",
            " if (a) goto s;\nelse if (n)\n  goto s; else if (b) stay; else stay; ",
        ),
        (
            "if (n) goto s; else if (a) goto s; else if (b) stay; else stay;",
            " if (n)\n  goto s;\nelse if (a) goto s; else if (b) stay; else stay; ",
        ),
    ],
)
def test_an_added_else_begins_a_line_where_no_brace_precedes_it(after: str, expected: str) -> None:
    assert edited(" if (a) goto s; else if (b) stay; else stay; ", after) == expected


THIRD = """
  if (a) {
    goto s;
  }
  else if (b) {
    stay;
  }
  else /** third */ if (c && x) {
    goto s;
  }
  else
    stay;
"""


def test_a_moved_test_takes_its_edits_and_its_description_along() -> None:
    moved = "\n  /** last */\n  if (c && y) {\n    goto s;\n  }\n  else if (a) {\n    goto s;\n  }\n  else if (b)"
    expected = moved + " {\n    stay;\n  }\n  else\n    stay;\n"
    assert edited(THIRD, expected) == expected


def test_a_test_that_is_no_longer_the_first_keeps_its_description() -> None:
    expected = (
        "\n  if (b) {\n    stay;\n  }\n  else /** second */\n  if (a && y) {\n    goto s;\n  }\n  else\n    stay;\n"
    )
    old = "\n  /** first */\n  if (a && x) {\n    goto s;\n  }\n  else if (b) {\n    stay;\n  }\n  else\n    stay;\n"
    assert edited(old, expected) == expected


def test_line_ends_of_a_moved_test_stay() -> None:
    old, expected = chain(A, B, C).replace("\n", "\r\n"), chain(C, A, B).replace("\n", "\r\n")
    assert edited(old, expected) == expected
