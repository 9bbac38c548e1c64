"""Edits of one file: which comments belong to a token, and how edits of ranges combine."""

import pytest

from vicode.xabsl.parser import parse
from vicode.xabsl.patching.source_edits import PatchError, SourceEdits, indented


def edits(text: str) -> SourceEdits:
    return SourceEdits(parse(text, "some.xabsl"))


def token(file: SourceEdits, text: str) -> int:
    return file.tokens.texts.index(text)


def test_an_error_names_its_option() -> None:
    plain, named = PatchError("no"), PatchError("no", "play")
    assert [(str(each), each.option) for each in (plain, named)] == [("no", ""), ("no", "play")]


# Positions


def test_start_and_end_of_a_token() -> None:
    file = edits("one two;")
    assert (file.start(1), file.end(1)) == (4, 7)


@pytest.mark.parametrize(
    ("text", "word", "indent"),
    [
        ("one", "one", ""),
        ("  one", "one", "  "),
        ("a\n\t one two", "two", "\t "),
        ("a\n   \n b", "b", " "),
        ("\n  one", "one", "  "),
    ],
)
def test_the_indentation_is_that_of_the_line(text: str, word: str, indent: str) -> None:
    file = edits(text)
    assert file.indent_at(file.start(token(file, word))) == indent


@pytest.mark.parametrize(
    ("text", "word", "is_first"),
    [
        ("one", "one", True),
        (" \tone", "one", True),
        ("\ufeffone", "one", True),
        ("a one", "one", False),
        ("a\none", "one", True),
        ("b\na one", "one", False),
        ("a one\n", "one", False),
        ("/* c */ one", "one", False),
        ("\n one", "one", True),
        ("z\nx one", "one", False),
    ],
)
def test_the_first_word_of_a_line(text: str, word: str, is_first: bool) -> None:
    file = edits(text)
    assert file.is_first_in_line(file.start(token(file, word))) is is_first


@pytest.mark.parametrize(
    ("behind", "comments"),
    [
        ("", ""),
        ("\nb", ""),
        (" // c\nb", " // c"),
        (" /* c */ /* d */ // e\n", " /* c */ /* d */ // e"),
        ("\t/* c */  \nb", "\t/* c */  "),
        (" /* c */ b", ""),
        (" /** c */\nb", ""),
        (" /* c\n */\nb", ""),
        (" // c\r\nb", " // c"),
        (" // c", " // c"),
    ],
)
def test_comments_behind_a_token_belong_to_it(behind: str, comments: str) -> None:
    file = edits(f"a{behind}")
    assert file.text[1 : file.end_with_comment(0)] == comments


@pytest.mark.parametrize(
    ("text", "starts_line"),
    [
        ("b", True),
        ("  b", True),
        ("/* c */ b", True),
        ("a b", False),
        ("x\na b", False),
        ("a\nb", True),
        ("a // c\nb", True),
        ("a\n/* c */ b", True),
        ("a /* c */ b", False),
        ("a /* c\nd */ b", False),
        ("a //c\n//d\nb", True),
    ],
)
def test_only_comments_precede_a_token_that_starts_a_line(text: str, starts_line: bool) -> None:
    file = edits(text)
    assert file.starts_line(token(file, "b")) is starts_line


@pytest.mark.parametrize(
    ("before", "own"),
    [
        ("", ""),
        ("", "// c\n"),
        ("", "  // c\n  "),
        ("// c\n\n", ""),
        ("// c\n\n", "/* d */\n"),
        ("a ", ""),
        ("a /* c */ ", ""),
        ("a\n", "  "),
        ("a // c\n", "  // d\n  // e\n  "),
        ("a\n\n", "// d\n"),
        ("a\n// c\n \t\n", "// d\n"),
        ("a\n// c\n\n\n\n", " // d\n "),
        ("a\n// c\n\n\n", " // d\n "),
        ("a /* c\n d */\n", "  // e\n  "),
        ("", "/* c\n\n d */\n"),
        ("a\r\n// c\r\n\r\n", "// d\r\n"),
        ("a\n", "/* c\n\n d */\n"),
        ("a\n// c\n\n// d\n\n", "// e\n"),
    ],
)
def test_comments_directly_above_a_token_belong_to_it(before: str, own: str) -> None:
    file = edits(f"{before}{own}b")
    assert file.text[: file.start_with_comments(token(file, "b"))] == before


def test_comments_in_a_range() -> None:
    text = 'a /* b */ c // d \n"//e" /** f */ /* g\n */ h'
    file = edits(text)
    assert file.comments_between(0, len(text)) == ["/* b */", "// d", "/* g\n */"]
    assert [text[start:end] for start, end in file.comment_spans(0, len(text))] == ["/* b */", "// d ", "/* g\n */"]
    assert file.comment_spans(text.index("c"), text.index("h")) == [
        (text.index("//"), text.index("\n")),
        (text.index("/* g"), text.index(" h")),
    ]
    assert file.comments_between(0, text.index("/*")) == []
    assert file.comments_between(text.index("c"), text.index("c") + 1) == []


# Edits


def test_edits_are_read_in_the_order_of_the_text() -> None:
    file = edits("one two three")
    file.replace(8, 13, "3")
    file.insert(4, "and ")
    file.replace(0, 3, "1")
    file.replace(4, 7, "2")
    file.insert(4, "or ")
    assert file.result() == "1 and or 2 3"
    assert file.read(4, 7) == "and or 2"
    assert file.read(5, 13) == "wo 3"
    assert file.read(0, 2) == "on"


def test_an_edit_to_the_same_text_is_none() -> None:
    file = edits("one two")
    file.replace(0, 3, "one")
    file.insert(3, "")
    assert file.edits == []


def test_changes_that_overlap_are_refused() -> None:
    file = edits("one\ntwo three\n")
    file.replace(4, 9, "x")
    file.replace(8, 13, "y")
    with pytest.raises(PatchError, match=r"^two changes overlap at line 2$"):
        file.result()


def test_a_node_is_replaced_with_all_its_tokens() -> None:
    file = edits("/** d */ option a { initial state s { action { } } } // end")
    (option,) = file.parsed.file.body
    file.replace_node(option, "x")
    assert file.result() == "x // end"


def test_a_deleted_range_loses_its_edits() -> None:
    file = edits("one two three four")
    file.replace(4, 7, "2")
    file.insert(8, "x ")
    file.insert(14, "y ")
    file.insert(4, "z ")
    file.delete(4, 14)
    assert file.result() == "one z y four"
    file.overwrite(0, 18, "all")
    assert file.result() == "all"


def test_edits_that_touch_a_deleted_range_stay() -> None:
    file = edits("one two three four")
    file.replace(0, 4, "1 ")
    file.replace(14, 18, "4")
    file.replace(7, 9, "!")
    file.delete(4, 14)
    assert file.result() == "1 4"


@pytest.mark.parametrize(
    ("text", "newline"),
    [
        ("a b", "\n"),
        ("a\nb", "\n"),
        ("a\r\nb", "\r\n"),
        ("a\r\nb\r\nc\n", "\r\n"),
        ("a\r\nb\nc\n", "\n"),
        ("a\r\nb\n", "\n"),
    ],
)
def test_edits_have_the_line_ends_of_the_file(text: str, newline: str) -> None:
    file = edits(text)
    file.insert(len(text), "x\ny")
    assert (file.newline, file.result()) == (newline, f"{text}x{newline}y")


# Each case: the text, where its line comment ends as |, the new text, what follows. "~" ends the replaced range.
COMMENTED = {
    "  a // c|\n    ~b": ("", "  a // c\n  b"),
    "  a // c|\n~    b": ("", "  a // c\n  b"),
    "  a // c|\n    b ~d": (" x ", "  a // c\n  x d"),
    "  a // c|\n    b~ d": ("x", "  a // c\n  x d"),
    "  a // c|\n    b~\nd": ("", "  a // c\nd"),
    "  a // c|\n    b~  \r\nd": ("", "  a // c  \r\nd"),
    "  a // c|\n    b~": ("", "  a // c"),
    "  a // c|\n    b;~ d": ("\nx", "  a // c\nx d"),
    "  a // c|~\nd": (" y", "  a // c y\nd"),
    "  a // c|\n\n    ~b": (" ", "  a // c\n  b"),
    "  a /* c */|\n  ~b": ("x ", "  a /* c */x b"),
}


@pytest.mark.parametrize("case", COMMENTED)
def test_what_follows_a_line_comment_does_not_become_part_of_it(case: str) -> None:
    before, _bar, rest = case.partition("|")
    replaced, _mark, after = rest.partition("~")
    text, expected = COMMENTED[case]
    file = edits(before + replaced + after)
    file.replace(len(before), len(before) + len(replaced), text)
    assert file.result() == expected


@pytest.mark.parametrize(
    ("printed", "expected"),
    [
        ("a", "a"),
        ("a {\n  b\n    c\n}", "a {\n..\tb\n..\t\tc\n..}"),
        ("a\n\n  b", "a\n\n..\tb"),
        ("a\n   b", "a\n..\t b"),
        ("a\nb  ", "a\n..b"),
    ],
)
def test_a_printed_text_gets_the_indentation_of_the_file(printed: str, expected: str) -> None:
    found = indented(printed, "  ", "\t")
    assert found.replace("\n  ", "\n..") == expected
