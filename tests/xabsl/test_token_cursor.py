"""The token cursor returns the complete text of comments, with or without space next to the delimiters."""

import pytest

from vicode.xabsl.cursor import TokenCursor, XabslSyntaxError
from vicode.xabsl.lexer import tokenize
from vicode.xabsl.parser import parse


def make_cursor(text: str) -> TokenCursor:
    return TokenCursor(tokenize(text, "f")[0])


@pytest.mark.parametrize("comment", ["/**far away*/", "/** far away */", "/**\r\n far away\r\n*/"])
def test_a_description_keeps_its_first_and_last_letter(comment: str) -> None:
    cursor = make_cursor(f"{comment} option")
    assert cursor.accept_doc() == "far away"
    assert cursor.kind == "option"


def test_without_a_description_no_token_is_consumed() -> None:
    cursor = make_cursor("// far away\noption")
    assert cursor.accept_doc() == ""
    assert cursor.position == 0


def test_a_header_keeps_its_first_and_last_letter() -> None:
    assert parse("/***Title: x*/").file.header == "Title: x"


def test_an_unexpected_token_is_reported_with_the_expected_one() -> None:
    cursor = make_cursor("option {")
    cursor.advance()
    with pytest.raises(XabslSyntaxError):
        cursor.expect_name("for the option")
    assert [finding.message for finding in cursor.findings] == ["expected a name for the option, found '{'"]


def test_the_end_of_the_file_is_reported_once() -> None:
    cursor = make_cursor("option")
    cursor.advance()
    for _ in range(2):
        with pytest.raises(XabslSyntaxError):
            cursor.expect("{", "after the name")
    assert [finding.message for finding in cursor.findings] == ["unexpected end of file: expected '{' after the name"]
