"""Locations of findings: lines and columns, also of characters in each style of text."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.strategies.commented_texts import commented_texts, fewer_examples
from vicode.findings import DesignPath as ThingPath
from vicode.findings import Finding, FindingSubject, Note, SourceLocation, get_rule
from vicode.model.traversal import iter_code, iter_expressions
from vicode.store import locate_findings, open_project, read_design

TEXT = """\
vicode: 1
component: Player
states:
  Look:
    enter: |
      first()
      second()
    transitions:
      - {to: Kick, when: "seen\\t and \\x41ha"}
      - to: Kick
        when: >
          seen and
          near
      - to: Kick
        when: 'it''s near'
      - when: seen
          and near
        then: [{to: Kick}]
  Kick: {final: true}
"""

WHEN = ("states", "Look", "transitions")


def _underlined(path: ThingPath, span: tuple[int, int] | None = None, *, of_key: bool = False) -> str:
    place = read_design(TEXT).source_map.locate(path, span, of_key=of_key)
    return TEXT.splitlines()[place.line - 1][place.column - 1 :][: place.length]


@pytest.mark.parametrize(
    ("path", "span", "expected"),
    [
        (("component",), None, "Player"),
        (("states", "Look"), None, "Look"),
        (("states", "Kick"), None, "{final: true}"),
        (("states", "Kick", "transitions", 0), None, "Kick"),
        (("states", "Look", "enter", 0, "code"), (8, 14), "second"),
        (("states", "Look", "enter", 0, "code"), (0, 5), "first"),
        (("component",), (0, 1), "P"),
        (("component",), (2, 2), "a"),
        ((*WHEN, 0, "when"), (6, 9), "and"),
        ((*WHEN, 0, "when"), (10, 13), "\\x41ha"),
        ((*WHEN, 1, "when"), (0, 4), "seen"),
        ((*WHEN, 1, "when"), (9, 13), "near"),
        ((*WHEN, 2, "when"), (3, 4), "s"),
        ((*WHEN, 2, "when"), (5, 9), "near"),
        ((*WHEN, 3, "when"), (5, 8), "and"),
        ((*WHEN, 3, "then", 0, "to"), None, "Kick"),
        ((*WHEN, 3, "then", 0, "when"), None, "{to: Kick}"),
        ((*WHEN, 1), None, "to"),
        (("nowhere",), None, "vicode"),
    ],
)
def test_a_path_leads_to_its_characters(path: ThingPath, span: tuple[int, int] | None, expected: str) -> None:
    assert _underlined(path, span) == expected


def test_of_key_locates_the_key() -> None:
    assert _underlined(("states", "Kick"), of_key=True) == "Kick"
    assert _underlined((*WHEN, 0, "when"), of_key=True) == "when"


def test_findings_and_notes_get_locations(tmp_path: Path) -> None:
    (tmp_path / "player.yaml").write_text(TEXT, encoding="utf-8")
    project = open_project(tmp_path)
    first = Finding(
        rule=get_rule("D402"),
        message="no such state",
        subject=FindingSubject(component="Player", path=(*WHEN, 1, "to")),
        notes=(
            Note(
                message="in this state",
                subject=FindingSubject(component="Player", path=("states", "Look"), is_key=True),
            ),
        ),
    )
    unknown = Finding(rule=get_rule("P202"), message="not here", subject=FindingSubject(component="Goalie"))
    placeless, located = locate_findings([first, unknown], project)
    assert placeless == unknown
    assert located.location is not None
    assert (located.location.line, located.location.column, located.location.length) == (10, 13, 4)
    assert located.notes[0].location is not None
    assert located.notes[0].location.line == 4
    kept = SourceLocation(file="other", line=7, column=7)
    assert locate_findings([Finding(rule=get_rule("P202"), message="", location=kept)], project)[0].location == kept


@fewer_examples
@given(commented_texts(), st.data())
def test_every_visible_character_is_found(text: str, data: st.DataObject) -> None:
    read = read_design(text)
    assert read.design is not None
    texts = [(each.path, each.text) for each in iter_expressions(read.design)]
    codes = [(each.path, each.code.texts) for each in iter_code(read.design)]
    texts += [(path, pairs[0][1]) for path, pairs in codes if pairs]
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    for path, value in texts:
        for index, char in enumerate(value):
            if char.isspace() or not char.isprintable() or not char.isascii():
                continue
            place = read.source_map.locate(path, (index, index + 1))
            shown = lines[place.line - 1][place.column - 1 :]
            assert shown.startswith((char, f"\\{char}"))
