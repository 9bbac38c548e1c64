"""DOT text is deterministic, has one edge per pair, and escapes names."""

import pytest

from tests.diagram.diagram_designs import HOSTILE_NAMES, ring_design
from vicode.diagram.layout_dot import LayoutEffort, RankDirection, write_layout_dot
from vicode.diagram.layout_graph import build_layout_graph
from vicode.model.design import Call, CommonSection, Design, Guard, State, Transition, Use


def _lines(design: Design) -> list[str]:
    text = write_layout_dot(build_layout_graph(design), RankDirection.RIGHT, LayoutEffort.FULL)
    return [line.strip() for line in text.splitlines()]


def _arrows(design: Design) -> list[str]:
    return [line.split(" [")[0] for line in _lines(design) if "->" in line]


def test_the_same_design_gives_the_same_text() -> None:
    assert _lines(ring_design(30)) == _lines(ring_design(30))


def test_edges_are_merged_and_self_loops_omitted() -> None:
    leads = tuple(Transition(to=to, guard=Guard(after="1")) for to in ("B", "B", "A", "nowhere"))
    design = Design(
        component="D", initial="A", states=(State(name="A", transitions=leads), State(name="B", transitions=leads))
    )
    assert _arrows(design) == ["s0 -> s1"]


def test_edges_point_away_from_the_initial_state() -> None:
    states = (State(name="End", transitions=(Transition(to="Start"),)), State(name="Start", transitions=()))
    design = Design(component="D", initial="Start", states=states)
    assert _arrows(design) == ["s1 -> s0"]


def test_links_weigh_less_than_transitions_and_need_no_separate_rank() -> None:
    first = State(name="A", requires=("eyes",), modulates=(Call(alias="legs"),), transitions=(Transition(to="B"),))
    design = Design(
        component="D",
        initial="A",
        uses=(Use(alias="eyes", component="Eyes"), Use(alias="legs", component="Legs")),
        common=CommonSection(transitions=(Transition(to="B"),)),
        states=(first, State(name="B")),
    )
    attributes = dict(line.split(" [") for line in _lines(design) if "->" in line)
    assert attributes == {
        "s0 -> s1": "weight=8]",
        "s0 -> u0": "minlen=0 weight=1]",
        "s0 -> u1": "minlen=0 weight=1]",
        "common -> s1": "weight=1]",
    }


def test_long_names_get_wider_boxes() -> None:
    nodes = build_layout_graph(
        Design(component="D", states=(State(name="A"), State(name="LookForTheBallAround")))
    ).nodes
    assert nodes[0].width == 140
    assert nodes[1].width > 200


@pytest.mark.parametrize("name", HOSTILE_NAMES)
def test_a_name_stays_on_one_line(name: str) -> None:
    states = (State(name=name, transitions=(Transition(to="Other"),)), State(name="Other"))
    plain = _lines(
        Design(component="D", states=(State(name="First", transitions=(Transition(to="Other"),)), states[1]))
    )
    hostile = _lines(Design(component="D", states=states))
    assert len(hostile) == len(plain)
    assert "\n".join(hostile).encode("utf-8")
