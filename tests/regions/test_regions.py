"""Marks around code: what is wrapped is found again, whatever the code; broken marks are named with their line."""

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode import regions

BODIES = [
    "x = 1",
    "if x:\n    y = 2\n\nz = 3",
    'text = """one\n  two\nthree"""\nprint(text)',
    "def inner():\n    return 1",
    "# </vicode>\nx = 1",
    "# <vicode a 12345678>\nx = 1\n# </vicode>\ny = 2",
    "x = '",
    "",
    "\tif x:\n\t\ty = 1",
    "    x = 1\n    y = 2",
]


def find_one(text: str) -> regions.Region:
    found = regions.find_regions(text)
    assert not found.findings
    (region,) = found.regions
    return region


@pytest.mark.parametrize("body", BODIES)
def test_what_is_wrapped_is_found_unedited(body: str) -> None:
    text = "before\n" + regions.wrap_region("Kick.enter", body, indent="        ") + "after\n"
    region = find_one(text)
    assert (region.id, region.line, region.indent) == ("Kick.enter", 2, "        ")
    assert not regions.is_edited(region)


@given(st.text(st.sampled_from(" \t\r\n#</>vicode\"'\\ab:=()f{}1"), max_size=60))
def test_any_text_is_found_again_unedited(body: str) -> None:
    found = regions.find_regions(regions.wrap_region("a", body, indent="    "))
    assert found.regions
    assert not regions.is_edited(found.regions[0])


@given(st.text(st.sampled_from(" \n#</>vicode ab12345678"), max_size=80) | st.text())
def test_any_text_can_be_searched(text: str) -> None:
    found = regions.find_regions(text)
    assert regions.find_regions(regions.strip_bodies(text)).regions == () or found.regions


def test_indentation_does_not_change_strings() -> None:
    code = 'text = """one\n  two\n      three"""\nend = 1'
    wrapped = regions.wrap_region("a", code, indent="    ")
    assert wrapped.splitlines()[1:5] == ['    text = """one', "  two", '      three"""', "    end = 1"]
    assert find_one(wrapped).body == code


def test_indented_code_loses_its_margin() -> None:
    assert find_one(regions.wrap_region("a", "    x = 1\n      y\n")).body == "x = 1\n  y"


def test_an_edit_is_seen() -> None:
    text = regions.wrap_region("a", "x = 1", indent="    ")
    assert regions.is_edited(find_one(text.replace("x = 1", "x = 2")))


def test_line_ends_and_blanks_at_them_are_no_edit() -> None:
    text = regions.wrap_region("a", "x = 1\ny = 2", indent="    ")
    assert not regions.is_edited(find_one(text.replace("\n", "  \r\n")))


def test_a_definition_keeps_the_distance_formatters_want() -> None:
    assert regions.wrap_region("a", "def f():\n    pass").endswith("pass\n\n\n# </vicode>\n")
    assert regions.wrap_region("a", "def f():\n    pass", indent="    ").endswith("pass\n\n    # </vicode>\n")


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("# <vicode a 12345678>\nx = 1\n", 1, "no end mark"),
        ("# <vicode a 12345678>\n# <vicode b 12345678>\n# </vicode>\n", 1, "no end mark"),
        ("x = 1\n# </vicode>\n", 2, "end mark without begin mark"),
        ("# <vicode a>\n", 1, "invalid mark"),
        (regions.wrap_region("a", "x") + regions.wrap_region("a", "x"), 4, "duplicate region id 'a'"),
    ],
)
def test_broken_marks_are_named(text: str, line: int, message: str) -> None:
    (finding, *_others) = regions.find_regions(text, file="player.py").findings
    assert finding.rule.code == "G503"
    assert message in finding.message
    assert finding.location is not None
    assert (finding.location.file, finding.location.line) == ("player.py", line)


def test_other_languages_have_other_comments() -> None:
    text = regions.wrap_region("a", "int x = 1;", comment="//", indent="  ")
    assert text == f"  // <vicode a {regions.compute_checksum('int x = 1;')}>\n  int x = 1;\n  // </vicode>\n"
    assert regions.find_regions(text, "//").regions[0].body == "int x = 1;"


def test_a_text_without_bodies_keeps_what_stands_around() -> None:
    one, other = (f"a\n{regions.wrap_region('r', body)}b\n" for body in ("x = 1", "y = 2\nz = 3"))
    assert regions.strip_bodies(one) == regions.strip_bodies(other) != regions.strip_bodies(one + "c")


def test_defused_text_is_no_mark() -> None:
    text = "# <vicode a 12345678>\n# </vicode>"
    assert regions.find_regions(regions.escape_marks(text)) == regions.ParsedRegions()


def test_the_header_does_not_depend_on_the_code() -> None:
    one, other = (regions.add_header(f"a = {value}\n", "player.yaml") for value in (1, 2))
    assert regions.has_header(one)
    assert one.split("\n")[0] == other.split("\n")[0]


def test_no_file_name_can_choose_an_encoding() -> None:
    first = regions.add_header("", "coding: utf-7\n.yaml").split("\n")[0]
    assert not re.search(r"coding[:=]", first)
