"""The declarations of gestures and methods agree between Python and JavaScript; malformed gestures are refused."""

import re
from pathlib import Path
from typing import Any

import pytest

from tests.editor.canvas.run_js import JS
from vicode.decoding import MalformedEventError
from vicode.editor.canvas import element
from vicode.editor.canvas.protocol import GESTURES, GestureReport, decode_gesture
from vicode.editor.session.gestures.canvas_gestures import MoveGesture, NodePosition
from vicode.editor.session.gestures.transition_gestures import LabelGesture

NODE = {"of": "states", "id": "Kick", "x": 10, "y": 20.5}
MOVE: dict[str, Any] = {"kind": "move", "rev": 3, "seq": 2, "items": [NODE], "how": "drag"}


def test_javascript_reports_exactly_the_declared_gestures() -> None:
    sources = [path.read_text(encoding="utf-8") for path in JS.glob("*.js")]
    reported = {kind for source in sources for kind in re.findall(r'\breport\("([a-z-]+)"', source)}
    assert reported == set(GESTURES)


def test_the_element_calls_existing_methods_of_the_canvas() -> None:
    called = set(re.findall(r'_call\("([\w.]+)"', Path(element.__file__).read_text(encoding="utf-8")))
    canvas = (JS / "canvas.js").read_text(encoding="utf-8")
    classes = dict(re.findall(r"this\.(\w+) = new (\w+)\(", canvas))
    modules = dict(re.findall(r'import \{ (\w+) \} from "\./(\w+\.js)"', canvas))
    assert len(called) > 10
    for path in called:
        part, _dot, method = path.rpartition(".")
        source = (JS / modules[classes[part]]).read_text(encoding="utf-8") if part else canvas
        assert re.search(rf"^  {method}\(", source, re.MULTILINE), path


def test_a_gesture_is_decoded() -> None:
    node = NodePosition(kind="states", id="Kick", x=10, y=20.5)
    assert decode_gesture(MOVE) == GestureReport(MoveGesture(items=(node,), how="drag"), 3, 2)
    reset = {"kind": "label", "rev": 1, "seq": 0, "id": "A/0", "at": None}
    assert decode_gesture(reset) == GestureReport(LabelGesture(id="A/0", at=None), 1, 0)
    nudge = {"kind": "label", "rev": 1, "seq": 0, "id": "A/0", "at": [0.5, -12], "by": "nudge"}
    assert decode_gesture(nudge) == GestureReport(LabelGesture(id="A/0", at=(0.5, -12), by="nudge"), 1, 0)


@pytest.mark.parametrize(
    ("payload", "reason"),
    [
        (None, "a gesture must be an object"),
        ({"kind": "fly", "rev": 3, "seq": 2}, "unknown kind of event: 'fly'"),
        ({"kind": ["move"], "rev": 3, "seq": 2}, "unknown kind of event"),
        ({**MOVE, "by": 1}, r"move: unknown fields \['by'\]"),
        ({"kind": "move", "rev": 3, "seq": 2}, r"move: missing fields \['items'\]"),
        ({**MOVE, "rev": "3"}, "rev: expected int, got '3'"),
        ({**MOVE, "seq": None}, "seq: expected int, got None"),
        ({**MOVE, "items": NODE}, "move.items: not a list"),
        ({**MOVE, "items": [{**NODE, "x": True}]}, "move.items.x: expected a finite number, got True"),
        ({**MOVE, "items": [{**NODE, "x": float("nan")}]}, "move.items.x: expected a finite number, got nan"),
        ({**MOVE, "items": [{**NODE, "of": "roads"}]}, "move.items.of: expected one of states, .*, got 'roads'"),
        ({"kind": "label", "rev": 1, "seq": 0, "id": "A/0", "at": [1]}, "label.at: 2 values expected"),
    ],
)
def test_malformed_gestures_are_refused(payload: object, reason: str) -> None:
    with pytest.raises(MalformedEventError, match=reason):
        decode_gesture(payload)
