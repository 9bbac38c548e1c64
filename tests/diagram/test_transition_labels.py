"""What stays of a guard where its label has too little room, on the canvas and in exported diagrams."""

import pytest

from tests.editor.canvas.run_js import run_js
from vicode.diagram.diagram_model import build_diagram
from vicode.diagram.edge_routing import route_edges
from vicode.diagram.transition_labels import without_aliases
from vicode.model.design import Design, Guard, State, Transition


@pytest.mark.parametrize(
    ("label", "short"),
    [
        ("internal_symbols.ball_radius < 100", "ball_radius < 100"),
        ("game.phase == GamePhase.set and not world.goal", "phase == set and not goal"),
        ("left.angle < right.angle", "left.angle < right.angle"),
        ("battery < 1.5 and tries > 3", "battery < 1.5 and tries > 3"),
        ("wächter.höhe > 2", "höhe > 2"),
    ],
)
def test_aliases_are_dropped_unless_names_become_ambiguous(label: str, short: str) -> None:
    assert without_aliases(label) == short
    assert run_js("edge_labels.js", "withoutAliases", "withoutAliases(args[0])", label) == short


@pytest.mark.parametrize(
    ("doc", "guard", "label"),
    [
        ("ball near", "ball.radius < 100", "ball near"),
        ("", "ball.radius < 100", "ball.radius < 100"),
        ("", "internal_symbols.ball_is_near", "ball_is_near"),
        ("A long explanation that would fill several labels", "done(move)", "done(move)"),
    ],
)
def test_labels_show_the_informative_part(doc: str, guard: str, label: str) -> None:
    move = Transition(to="B", guard=Guard(when=guard), doc=doc)
    states = (State(name="A", at=(0, 0), transitions=(move,)), State(name="B", at=(300, 0)))
    (route,) = route_edges(build_diagram(Design(component="Robot", initial="A", states=states)))
    assert route.label is not None
    assert route.label.text == label


@pytest.mark.parametrize(
    ("name", "width", "lines"),
    [
        ("Kick", 120, ["Kick"]),
        ("MoveToKickoffPosition", 180, ["MoveTo", "KickoffPosition"]),
        ("wait_for_it", 90, ["wait_", "for_it"]),
    ],
)
def test_names_are_wrapped_where_that_makes_them_larger(name: str, width: int, lines: list[str]) -> None:
    # Without a browser, a letter is taken to be half as wide as high.
    pen = "{ measureText: (text) => ({ width: 7 * text.length }) }"
    stub = f"globalThis.document.createElement = () => ({{ getContext: () => ({pen}) }})"
    expression = f"({stub}, largestLines(...args))"
    found = run_js("text_metrics.js", "largestLines", expression, name, width, 52)
    assert found["lines"] == lines
    assert found["size"] > 14
