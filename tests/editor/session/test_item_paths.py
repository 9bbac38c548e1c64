"""Items of designs and projects are found, changed, and followed while they are renamed and moved."""

from dataclasses import replace

import pytest

from vicode.editor.session.gestures.item_paths import TrackedItem, change_item, item_at, rebase_path
from vicode.findings import DesignPath
from vicode.model.design import (
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
from vicode.model.edits import remove_states, rename_state, rename_use
from vicode.model.project import Enumeration, Project

FIRST, SECOND = Assign(values=(("x", "1"),)), Call(alias="head")
CODE = RunCode(code=Code(texts=(("python", "pass"),)))
GROUP = DecisionGroup(guard=Guard(when="x"), then=(Stay(),), otherwise=(Transition(to="B"),))
DESIGN = Design(
    component="Player",
    uses=(Use(alias="head", component="Head"),),
    outputs=(
        Declaration(
            name="seen", doc="whether it is seen", arguments=(Declaration(name="team"), Declaration(name="id"))
        ),
        Declaration(name="age"),
    ),
    states=(
        State(
            name="A", doc="first", modulates=(Call(alias="head"),), actions=(FIRST, SECOND, CODE), transitions=(GROUP,)
        ),
        State(name="B"),
    ),
)
SIDE = Enumeration(name="Side", elements=(("left", "one"), ("right", "other")))
PROJECT = Project(name="Forward", enumerations=(Enumeration(name="Kick", elements=(("front", ""),)), SIDE))


def with_actions(*actions: Assign | Call | RunCode) -> Design:
    return replace(DESIGN, states=(replace(DESIGN.states[0], actions=actions), DESIGN.states[1]))


def with_outputs(*outputs: Declaration) -> Design:
    return replace(DESIGN, outputs=outputs)


@pytest.mark.parametrize(
    ("path", "new", "found"),
    [
        (("states", "A"), rename_state(DESIGN, "A", "Z"), ("states", "Z")),
        (("states", "A", "actions", 1), rename_state(DESIGN, "A", "Z"), ("states", "Z", "actions", 1)),
        (("states", "A"), remove_states(DESIGN, ["A"]), None),
        (("states", "A", "actions", 2), with_actions(CODE, FIRST, SECOND), ("states", "A", "actions", 0)),
        (("states", "A", "actions", 0), with_actions(SECOND, CODE), None),
        (("states", "A", "actions", 0), with_actions(Assign(values=()), SECOND, CODE), ("states", "A", "actions", 0)),
        (
            ("states", "A", "modulates", "head"),
            rename_use(DESIGN, "head", "neck"),
            ("states", "A", "modulates", "neck"),
        ),
        (("uses", "head"), rename_use(DESIGN, "head", "neck"), ("uses", "neck")),
        (("outputs", 1), with_outputs(DESIGN.outputs[1]), ("outputs", 0)),
        (("outputs", 1), with_outputs(DESIGN.outputs[0], Declaration(name="old", unit="s")), ("outputs", 1)),
        (("outputs", 0, "arguments", 1), with_outputs(*reversed(DESIGN.outputs)), ("outputs", 1, "arguments", 1)),
        (("outputs", 0, "arguments", 1), with_outputs(replace(DESIGN.outputs[0], arguments=None)), None),
        (
            ("states", "A", "transitions", 0, "else", 0),
            rename_state(DESIGN, "A", "Z"),
            ("states", "Z", "transitions", 0, "else", 0),
        ),
        (("common",), DESIGN, ("common",)),
        (("nonsense", 3), DESIGN, None),
    ],
)
def test_a_path_follows_its_item(path: DesignPath, new: Design, found: DesignPath | None) -> None:
    assert rebase_path(path, DESIGN, new) == found


def test_a_path_of_a_project_follows_its_node() -> None:
    new = replace(PROJECT, enumerations=(replace(SIDE, elements=(("new", ""), *SIDE.elements)),))
    assert rebase_path(("enumerations", 1, "elements", 1), PROJECT, new) is None
    renamed = replace(PROJECT, enumerations=(replace(PROJECT.enumerations[0], name="Shot"), SIDE))
    assert rebase_path(("enumerations", 0, "elements", 0), PROJECT, renamed) == ("enumerations", 0, "elements", 0)
    removed = replace(PROJECT, enumerations=(SIDE,))
    assert rebase_path(("enumerations", 1, "elements", 1), PROJECT, removed) == ("enumerations", 0, "elements", 1)
    assert rebase_path(("enumerations", 0), PROJECT, removed) is None


def test_an_item_is_read_and_changed() -> None:
    path = ("states", "A", "transitions", 0, "else", 0)
    assert item_at(DESIGN, path) == Transition(to="B")
    assert item_at(change_item(DESIGN, path, lambda old: replace(old, to="A")), path) == Transition(to="A")
    assert item_at(DESIGN, ("states", "C", "doc")) is None
    assert change_item(DESIGN, ("states", "C"), lambda old: old) == DESIGN


def test_an_item_is_tracked_until_it_is_removed() -> None:
    designs = [DESIGN]
    item = TrackedItem(lambda: designs[-1], ("states", "A", "actions", 2))
    designs.append(rename_state(designs[-1], "A", "Z"))
    assert item.path == ("states", "Z", "actions", 2)
    designs.append(change_item(designs[-1], ("states", "Z", "actions"), lambda actions: actions[:2]))
    assert item.path is None
    designs.append(DESIGN)
    assert item.path is None
