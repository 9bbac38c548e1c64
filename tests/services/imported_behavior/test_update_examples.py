"""Each edit of an imported design changes the lines of a behavior that a person would change, and no others."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from tests.services.imported_behavior.kickoff_behavior import KICKOFF, TEXTS, changed_lines, paired
from tests.services.imported_behavior.test_behavior_update import imported, updated
from tests.strategies.project_edits import with_design
from vicode.model import edits
from vicode.model.design import Assign, Call, DecisionGroup, Declaration, Design, Guard, State, Stay, Transition

ChangeDesign = Callable[[Design], Design]
NEW = Transition(to="kick", guard=Guard(when="ball.ball_x > 5"), doc="far")


def change_state(name: str, **changes: object) -> ChangeDesign:
    return lambda design: edits.update_state(design, name, lambda state: replace(state, **changes))  # type: ignore[arg-type]


def transitions(design: Design, state: str) -> tuple[Transition | Stay | DecisionGroup, ...]:
    found = design.state(state)
    assert found is not None
    return found.transitions


def with_transitions(state: str, change: Callable[..., tuple[object, ...]]) -> ChangeDesign:
    return lambda design: change_state(state, transitions=change(*transitions(design, state)))(design)


def guard(when: str, after: str = "") -> ChangeDesign:
    return with_transitions("wait", lambda first, *rest: (replace(first, guard=Guard(when=when, after=after)), *rest))


DESIGN_EDITS: dict[str, tuple[ChangeDesign, list[str]]] = {
    "nothing": (lambda design: design, []),
    "a position": (change_state("turn", at=(1, 2)), []),
    "one operand of a guard": (
        guard("(ball.ball_x < near) and not ball.ball_seen"),
        ["- if((ball.x<near)  &&  ball.seen) { // now", "+ if((ball.x<near)  &&  !ball.seen) { // now"],
    ),
    "a comparison": (
        guard("(ball.ball_x <= near) and ball.ball_seen"),
        ["- if((ball.x<near)  &&  ball.seen) { // now", "+ if((ball.x<=near)  &&  ball.seen) { // now"],
    ),
    "a further operand": (
        guard("(ball.ball_x < near) and ball.ball_seen and reach > 3"),
        ["- if((ball.x<near)  &&  ball.seen) { // now", "+ if((ball.x<near)  &&  ball.seen && @reach > 3) { // now"],
    ),
    "an alternative": (
        guard("(ball.ball_x < near) and ball.ball_seen or reach > 3"),
        ["- if((ball.x<near)  &&  ball.seen) { // now", "+ if(((ball.x<near)  &&  ball.seen) || @reach > 3) { // now"],
    ),
    "one operand fewer": (
        guard("ball.ball_seen"),
        ["- if((ball.x<near)  &&  ball.seen) { // now", "+ if(ball.seen) { // now"],
    ),
    "a timer": (
        with_transitions("turn", lambda first: (replace(first, guard=Guard(after="750")),)),
        ["- if(state_time>=500) goto wait;", "+ if(state_time>=750) goto wait;"],
    ),
    "a target": (
        with_transitions("wait", lambda one, two: (one, replace(two, to="kick"))),
        ["- /* to the left */ goto turn;", "+ /* to the left */ goto kick;"],
    ),
    "an added transition": (
        with_transitions("wait", lambda one, two: (one, NEW, two)),
        ["+ }", "+ /** far */", "+ else if (ball.x > 5) {", "+ goto kick;"],
    ),
    "an added first transition": (
        with_transitions("turn", lambda one: (replace(NEW, doc=""), one)),
        [
            "- if(state_time>=500) goto wait;",
            "+ if (ball.x > 5)",
            "+ goto kick;",
            "+ else if(state_time>=500) goto wait;",
        ],
    ),
    "a removed transition": (
        with_transitions("wait", lambda one, two: (one,)),
        ["- } else if(ball.side==left) {", "- /* to the left */ goto turn;"],
    ),
    "moved transitions": (
        with_transitions("wait", lambda one, two: (two, one)),
        [
            "+ if(ball.side==left) {",
            "+ /* to the left */ goto turn;",
            "+ }",
            "- if((ball.x<near)  &&  ball.seen) { // now",
            "+ else if((ball.x<near)  &&  ball.seen) { // now",
            "- } else if(ball.side==left) {",
            "- /* to the left */ goto turn;",
        ],
    ),
    "a description of a transition": (
        with_transitions("turn", lambda one: (replace(one, doc="in time"),)),
        ["+ /** in time */"],
    ),
    "one word of a state's description": (
        change_state("wait", doc="waits for a\nreferee"),
        ["- // waits for the", "+ // waits for a"],
    ),
    "a new description of a state": (change_state("kick", doc="shoots"), ["+ // shoots"]),
    "no description of a state": (change_state("turn", doc=""), ["- // turns"]),
    "one word of the option's description": (
        lambda design: replace(design, doc=design.doc.replace("the", "a")),
        ["- /** Plays the", "+ /** Plays a"],
    ),
    "an argument": (
        change_state("kick", actions=(Call(alias="walk", arguments=(("speed", "2"), ("fast", "True"))),)),
        ["- walk(fast=true);", "+ walk(speed = 2, fast=true);"],
    ),
    "an added action": (
        change_state("turn", actions=(Assign(values=(("ball.speed", "1"),)),)),
        ["- action { }", "+ action {", "+ speed = 1;", "+ }"],
    ),
    "a removed action": (
        change_state("wait", actions=(Assign(values=(("ball.speed", "10"),)),)),
        ["- walk(speed=ball.x*2,", "- fast=false);"],
    ),
    "final and initial": (
        lambda design: replace(change_state("kick", final=False)(design), initial="turn"),
        [
            "- initial state wait {",
            "+ state wait {",
            "- state turn {",
            "+ initial state turn {",
            "- target state kick",
            "+ state kick",
        ],
    ),
    "a renamed state": (
        lambda design: edits.rename_state(design, "kick", "shoot"),
        ["- goto kick;", "+ goto shoot;", "- target state kick", "+ target state shoot"],
    ),
    "a removed state": (
        lambda design: edits.remove_states(design, ["turn"]),
        [
            "- } else if(ball.side==left) {",
            "- /* to the left */ goto turn;",
            "- // turns",
            "- state turn {",
            "- decision {",
            "- if(state_time>=500) goto wait;",
            "- else stay;",
            "- }",
            "- action { }",
            "- }",
            "-",
        ],
    ),
    "an added state": (
        lambda design: replace(design, states=(*design.states, State(name="rest", doc="rests", transitions=(NEW,)))),
        [
            "+",
            "+ // rests",
            "+ state rest {",
            "+ decision {",
            "+ /** far */",
            "+ if (ball.x > 5)",
            "+ goto kick;",
            "+ else",
            "+ stay;",
            "+ }",
            "+ action {",
            "+ }",
            "+ }",
        ],
    ),
    "a common transition": (
        lambda design: replace(design, common=replace(design.common, transitions=(replace(NEW, doc=""),))),
        [
            "+ common decision {",
            "+ if (ball.x > 5)",
            "+ goto kick;",
            "+ }",
            "+",
            "- if((ball.x<near)  &&  ball.seen) { // now",
            "+ else if((ball.x<near)  &&  ball.seen) { // now",
            "- if(state_time>=500) goto wait;",
            "+ else if(state_time>=500) goto wait;",
        ],
    ),
    "a parameter": (
        lambda design: replace(design, parameters=(*design.parameters, Declaration(name="fast", type="bool"))),
        ["+ bool @fast;"],
    ),
    "a unit": (
        lambda design: replace(design, parameters=(replace(design.parameters[0], unit="m"),)),
        ['- float @reach "mm";', '+ float @reach "m";'],
    ),
}


@pytest.mark.parametrize("name", DESIGN_EDITS)
def test_an_edited_design_changes_these_lines(name: str) -> None:
    project = imported(TEXTS)
    (design,) = project.designs
    change, expected = DESIGN_EDITS[name]
    assert paired(changed_lines(with_design(project, change(design)))) == paired(expected)


def test_added_lines_are_indented_like_those_beside_them() -> None:
    project = imported(TEXTS)
    (design,) = project.designs
    design = replace(design, states=(*design.states, State(name="rest", transitions=(replace(NEW, doc=""),))))
    new = updated(TEXTS, with_design(project, design))["Options/SetPlays/kickoff.xabsl"]
    added = new.removeprefix(KICKOFF.removesuffix("}\n")).splitlines()
    assert added[:5] == ["", "\tstate rest {", "\t\tdecision {", "\t\t\tif (ball.x > 5)", "\t\t\t\tgoto kick;"]
