"""The declarations of gestures and methods agree between Python and JavaScript; malformed gestures are refused."""

import re
from pathlib import Path
from typing import Any

import pytest

from tests.editor.canvas.run_js import JS
from vicode.editor.canvas import element
from vicode.editor.canvas.decoding import MalformedEventError
from vicode.editor.canvas.protocol import GESTURES, LabelGesture, MoveGesture, decode_gesture, gesture_payload

NODE = {"of": "states", "id": "Kick", "x": 10, "y": 20.5}
MOVE: dict[str, Any] = {"kind": "move", "rev": 3, "items": [NODE], "how": "drag"}


def test_javascript_reports_exactly_the_declared_gestures() -> None:
    sources = [path.read_text(encoding="utf-8") for path in JS.glob("*.js")]
    reported = {kind for source in sources for kind in re.findall(r'\breport\("([a-z-]+)"', source)}
    assert reported == set(GESTURES)


def test_the_element_calls_exactly_the_methods_of_its_component() -> None:
    called = set(re.findall(r'_call\("(\w+)"', Path(element.__file__).read_text(encoding="utf-8")))
    component = (JS / "vicode_canvas.js").read_text(encoding="utf-8")
    methods = set(re.findall(r"^    (\w+)\(.*\) \{$", component[component.index("methods:") :], re.MULTILINE))
    assert called == methods


def test_a_gesture_is_decoded_and_encoded() -> None:
    gesture = decode_gesture(MOVE)
    assert isinstance(gesture, MoveGesture)
    assert gesture.items == (NODE,)
    assert gesture_payload(gesture) == MOVE
    reset = {"kind": "label", "rev": 1, "id": "A/0", "at": None}
    assert decode_gesture(reset) == LabelGesture(rev=1, id="A/0", at=None)
    assert gesture_payload(decode_gesture(reset)) == reset
    nudge = {"kind": "label", "rev": 1, "id": "A/0", "at": [0.5, -12], "by": "nudge"}
    assert gesture_payload(decode_gesture(nudge)) == nudge


@pytest.mark.parametrize(
    ("payload", "reason"),
    [
        (None, "a gesture must be an object"),
        ({"kind": "fly"}, "unknown kind of gesture: 'fly'"),
        ({"kind": ["move"]}, "unknown kind of gesture"),
        ({**MOVE, "by": 1}, r"move: unknown fields \['by'\]"),
        ({"kind": "move", "rev": 3}, r"move: missing fields \['how', 'items'\]"),
        ({**MOVE, "rev": "3"}, "move.rev: expected int, got '3'"),
        ({**MOVE, "items": NODE}, "move.items: not a list"),
        ({**MOVE, "items": [{**NODE, "x": True}]}, "move.items.x: expected a finite number, got True"),
        ({**MOVE, "items": [{**NODE, "x": float("nan")}]}, "move.items.x: expected a finite number, got nan"),
        ({**MOVE, "items": [{**NODE, "of": "roads"}]}, "move.items.of: expected one of states, .*, got 'roads'"),
        ({"kind": "label", "rev": 1, "id": "A/0", "at": [1]}, "label.at: 2 values expected"),
    ],
)
def test_malformed_gestures_are_refused(payload: object, reason: str) -> None:
    with pytest.raises(MalformedEventError, match=reason):
        decode_gesture(payload)
