"""The declarations of table events and methods agree between Python and JavaScript; malformed events are refused."""

import re
from pathlib import Path
from typing import Any, get_args

import pytest

from vicode.decoding import MalformedEventError, decode_event
from vicode.editor.js_modules import TABLE_JS
from vicode.editor.session.gestures.table_edits import FlagColumn, MoveRow, SetCell, TextColumn
from vicode.editor.table import element
from vicode.editor.table.protocol import TABLE_EVENTS, SelectRow

SET: dict[str, Any] = {"kind": "set", "row": "states/Kick", "column": "doc", "value": "new", "base": "old"}


def test_javascript_reports_exactly_the_declared_events() -> None:
    sources = [path.read_text(encoding="utf-8") for path in TABLE_JS.glob("*.js")]
    reported = {kind for source in sources for kind in re.findall(r'\breport\("([a-z-]+)"', source)}
    assert reported == set(TABLE_EVENTS)


def test_the_columns_are_declared_in_both_languages() -> None:
    source = (TABLE_JS / "columns.js").read_text(encoding="utf-8")
    columns = re.findall(r'\{ name: "(\w+)", .*?kind: "(\w+)"', source)
    assert [name for name, kind in columns if kind == "text"] == list(get_args(TextColumn))
    assert [name for name, kind in columns if kind == "flag"] == list(get_args(FlagColumn))


def test_the_element_calls_existing_methods_of_the_table() -> None:
    called = set(re.findall(r'_call\("(\w+)"', Path(element.__file__).read_text(encoding="utf-8")))
    table = (TABLE_JS / "table.js").read_text(encoding="utf-8")
    assert called
    assert called <= set(re.findall(r"^  (\w+)\(", table, re.MULTILINE))


def test_an_event_is_decoded() -> None:
    assert decode_event(SET, TABLE_EVENTS) == SetCell(row="states/Kick", column="doc", value="new", base="old")
    assert decode_event({"kind": "select", "row": "states/Kick"}, TABLE_EVENTS) == SelectRow(row="states/Kick")
    assert decode_event({"kind": "move", "row": "A", "by": -1}, TABLE_EVENTS) == MoveRow(row="A", by=-1)


@pytest.mark.parametrize(
    ("payload", "reason"),
    [
        ("states/Kick", "an event must be an object"),
        ({"kind": "paint"}, "unknown kind of event: 'paint'"),
        ({**SET, "by": 1}, r"set: unknown fields \['by'\]"),
        ({"kind": "toggle", "row": "states/Kick"}, r"toggle: missing fields \['column'\]"),
        ({**SET, "column": "final"}, "set.column: expected one of name, .*, got 'final'"),
        ({**SET, "value": 7}, "set.value: expected str, got 7"),
        ({"kind": "move", "row": "states/Kick", "by": True}, "move.by: expected int, got True"),
    ],
)
def test_malformed_events_are_refused(payload: object, reason: str) -> None:
    with pytest.raises(MalformedEventError, match=reason):
        decode_event(payload, TABLE_EVENTS)
