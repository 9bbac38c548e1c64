"""A form is rebuilt exactly when its fields change, not while their values do."""

from dataclasses import replace

import pytest

from vicode.editor.session.form_key import MAX_STATES_IN_MENU, form_structure_key, has_same_structure
from vicode.editor.view import ItemRef
from vicode.findings import DesignPath
from vicode.model.design import (
    Action,
    Assign,
    Call,
    Code,
    DecisionGroup,
    Declaration,
    Design,
    Guard,
    RunCode,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.model.edits import update_state

GROUP = DecisionGroup(guard=Guard(when="x"), then=(Stay(),))
LOOK = State(
    name="Look",
    actions=(Assign(values=(("n", "1"),)), Call(alias="legs", arguments=(("speed", "1"),))),
    transitions=(Transition(to="Go", guard=Guard(when="x")), GROUP),
)
DESIGN = Design(
    component="Player",
    initial="Look",
    uses=(Use(alias="legs", component="Legs"), Use(alias="eyes", component="Eyes")),
    outputs=(Declaration(name="n", type="int"), Declaration(name="at", arguments=(Declaration(name="x"),))),
    states=(LOOK, State(name="Go")),
)
STATE, TRANSITION = ItemRef(kind="states", id="Look"), ItemRef(kind="transitions", id="Look/0")
CODE = Code(texts=(("python", "return True"),))


def with_actions(*actions: Action) -> Design:
    return update_state(DESIGN, "Look", lambda state: replace(state, actions=actions))


def with_first(transition: Transition) -> Design:
    return update_state(DESIGN, "Look", lambda state: replace(state, transitions=(transition, GROUP)))


@pytest.mark.parametrize(
    ("item", "changed", "is_rebuilt"),
    [
        (STATE, with_actions(Assign(values=(("n", "2"),)), Call(alias="legs")), False),
        (STATE, with_actions(*LOOK.actions, RunCode(code=CODE)), True),
        (STATE, with_actions(LOOK.actions[0], Call(alias="eyes")), True),
        (STATE, replace(DESIGN, uses=DESIGN.uses[:1]), True),
        (STATE, update_state(DESIGN, "Look", lambda state: replace(state, doc="Looks.")), False),
        (STATE, update_state(DESIGN, "Look", lambda state: replace(state, modulates=(Call(alias="legs"),))), True),
        (STATE, replace(DESIGN, states=(LOOK, *(State(name=f"S{n}") for n in range(MAX_STATES_IN_MENU)))), True),
        (STATE, replace(DESIGN, states=(LOOK, *(State(name=f"S{n}") for n in range(MAX_STATES_IN_MENU - 1)))), False),
        (TRANSITION, with_first(Transition(to="Look", guard=Guard(when="y"))), False),
        (TRANSITION, with_first(Transition(to="Go", guard=Guard(code=CODE))), True),
        (None, replace(DESIGN, doc="Plays.", outputs=(replace(DESIGN.outputs[0], name="m"), DESIGN.outputs[1])), False),
        (None, replace(DESIGN, outputs=(DESIGN.outputs[0], replace(DESIGN.outputs[1], arguments=()))), True),
        (None, replace(DESIGN, variables=DESIGN.outputs), True),
        (ItemRef(kind="common", id=""), with_actions(), False),
        (ItemRef(kind="components", id="legs"), with_actions(), False),
    ],
)
def test_a_form_is_rebuilt_when_its_fields_change(item: ItemRef | None, changed: Design, is_rebuilt: bool) -> None:
    assert (form_structure_key(changed, item) != form_structure_key(DESIGN, item)) is is_rebuilt


@pytest.mark.parametrize(
    ("path", "now", "is_same"),
    [
        (("states", "Look", "actions", 0), with_actions(Assign(values=(("m", "1"),)), Call(alias="legs")), True),
        (("states", "Look", "actions", 0), with_actions(*reversed(LOOK.actions)), False),
        (("states", "Look", "transitions", 0), with_first(Transition(to="Go")), True),
        (("states", "Look", "transitions", 0), with_first(Transition(to="Look")), False),
        (("outputs", "n"), replace(DESIGN, outputs=(Declaration(name="m"), DESIGN.outputs[1])), True),
        (("outputs", "n"), replace(DESIGN, outputs=DESIGN.outputs[::-1]), False),
        (("outputs", "n"), replace(DESIGN, outputs=DESIGN.outputs[:1]), False),
        (("doc",), replace(DESIGN, doc="Plays."), True),
    ],
)
def test_paths_keep_their_meaning_while_nothing_moves(path: DesignPath, now: Design, is_same: bool) -> None:
    assert has_same_structure(DESIGN, now, path) is is_same
