"""Each transition that a construct means is drawn once, as part of its rule."""

import pytest
from hypothesis import given, settings

from tests.strategies.designs import lowered_designs
from vicode.diagram.diagram_model import build_diagram
from vicode.diagram.drawn_transitions import draw_transitions
from vicode.diagram.export_formats import EXPORT_FORMATS, ExportOptions
from vicode.model.decision_keys import transition_key
from vicode.model.design import COMMON, Design
from vicode.model.traversal import iter_transitions
from vicode.store import read_design

INTERRUPTS = """\
vicode: 1
component: Walk
uses: {eyes: Eyes}
initial: GotoA
interrupts:
  - {do: Wait, while: [Goto*], when: eyes.person, doc: a person}
  - {do: Stop, when: eyes.stop, until: state_time > 1, then: fail}
  - {do: Look, while: [GotoB], when: eyes.lost, every: 5}
states:
  Wait: {}
  GotoA: {transitions: [{to: GotoB, when: eyes.near}]}
  GotoB: {}
  Look: {}
  Stop: {}
  End: {final: true, failed: true}
"""
COMPETENCE = """\
vicode: 1
component: Fetch
uses: {eyes: Eyes, arm: Arm}
competence:
  goal: eyes.held
  steps:
    Grab: {when: eyes.near, modulates: [arm], retries: 3}
    Walk: {when: eyes.seen}
    Turn: {}
"""
LAYERS = """\
vicode: 1
component: Roam
uses: {eyes: Eyes}
layers:
  Wander: {}
  Avoid: {when: eyes.near, for: 0.5}
"""


def parse(text: str) -> Design:
    design = read_design(text).design
    assert design is not None
    return design


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            INTERRUPTS,
            [
                "GotoA -> GotoB: eyes.near",
                "GotoB <-> Look: eyes.lost, every 5 s",
                "Stop -> End: state_time > 1",
                "@common <-> Wait: in Goto*: a person",
                "@common -> Stop: eyes.stop",
            ],
        ),
        (
            COMPETENCE,
            [
                "Choose -> Done: eyes.held",
                "Choose <-> Grab: eyes.near, 3 tries",
                "Choose <-> Walk: eyes.seen",
                "Choose -> Turn: ",
                "Choose -> Failed: ",
            ],
        ),
        (LAYERS, ["@common -> Avoid: eyes.near, for 0.5 s", "@common -> Wander: "]),
    ],
)
def test_a_rule_is_one_edge(text: str, expected: list[str]) -> None:
    drawn = draw_transitions(parse(text))
    assert [f"{each.source} {'<->' if each.leads_back else '->'} {each.target}: {each.label}" for each in drawn] == (
        expected
    )


def test_interrupts_of_some_states_are_drawn_from_these() -> None:
    edges = build_diagram(parse(INTERRUPTS), only={"GotoA", "Wait"}).edges
    assert {(edge.source, edge.target, edge.label) for edge in edges} == {
        ("s:GotoA", "s:Wait", "a person"),
        ("s:Wait", "s:GotoA", "not (eyes.person) › wait_from == 2"),
    }


@given(lowered_designs)
@settings(max_examples=100)
def test_each_transition_is_drawn_once(design: Design) -> None:
    drawn = [key for each in draw_transitions(design) for key in each.keys]
    assert sorted(drawn) == sorted(transition_key(each.path) for each in iter_transitions(design))
    alone = [each for each in draw_transitions(design) if not each.derived]
    written = [each for each in iter_transitions(design) if not getattr(each.decision, "origin", ())]
    assert [each.paths for each in alone] == [(each.path,) for each in written]
    assert all(each.source == COMMON or design.state(each.source) for each in draw_transitions(design))


@pytest.mark.parametrize("form", ["mermaid", "plantuml", "dot"])
def test_text_formats_show_the_rule_and_the_way_back(form: str) -> None:
    text = EXPORT_FORMATS[form].write(parse(INTERRUPTS), ExportOptions()).decode()
    assert text.count("a person") == 1
    assert text.count("back") == 2
    assert "wait_from" not in text


def test_derived_actions_alone_have_no_sign() -> None:
    figure = build_diagram(parse(COMPETENCE))
    assert {node.key: node.badges for node in figure.nodes if node.badges} == {"s:Grab": (("modulates", 1),)}
    assert "common" not in {node.key for node in figure.nodes}
