"""Incomplete designs can be saved and read back; values that YAML cannot represent raise an error."""

from dataclasses import replace
from pathlib import Path

import pytest

from vicode.check import check_design
from vicode.model.design import Assign, Call, Code, Declaration, Design, Guard, RunCode, State, Transition
from vicode.model.project import Project
from vicode.store import read_design, save_design

PLAYER = (Path(__file__).parents[2] / "designs" / "forward" / "player.yaml").read_text()
BLANKS = (" ", "\n", "\t\n ", "\x85")


def player() -> Design:
    design = read_design(PLAYER).design
    assert design is not None
    return design


def with_state(state: State) -> Design:
    design = player()
    return replace(design, states=(*design.states, state))


@pytest.mark.parametrize("old_text", [PLAYER, ""], ids=["patched", "fresh"])
def test_a_name_with_empty_expression_is_kept(old_text: str) -> None:
    half = State(
        name="Half",
        enter=(Assign(values=(("kicks", ""),)),),
        modulates=(Call(alias="kicker", arguments=(("kick", ""),)),),
    )
    design = with_state(half)
    read = read_design(save_design(design, old_text))
    assert read.design == design
    # It is told once, by the rules.
    assert read.findings == ()
    told = [each for each in check_design(Project(name="p", designs=(design,)), design) if each.rule.code == "E301"]
    assert len(told) == 2


@pytest.mark.parametrize("blank", BLANKS)
def test_blank_texts_are_saved_as_empty(blank: str) -> None:
    transition = Transition(to="Kick", guard=Guard(when=blank, after=blank))
    design = with_state(State(name="Half", enter=(Assign(values=(("kicks", blank),)),), transitions=(transition,)))
    design = replace(design, variables=(*design.variables, Declaration(name="extra", type=blank, initial=blank)))
    read = read_design(save_design(design, PLAYER)).design
    assert read is not None
    half = read.state("Half")
    assert half is not None
    assert (half.enter, half.transitions) == ((Assign(values=(("kicks", ""),)),), (Transition(to="Kick"),))
    assert read.variables[-1] == Declaration(name="extra")


def test_a_lone_surrogate_is_replaced() -> None:
    code = RunCode(code=Code(texts=(("python", "a = '\ud83d'\n"),)))
    text = save_design(with_state(State(name="Half", doc="\ud83d", actions=(code,))), PLAYER)
    assert text.encode("utf-8").count("\ufffd".encode()) == 2


def test_unwritable_values_raise_an_error() -> None:
    design = replace(player(), variables=(Declaration(name="x" * 5000),))
    with pytest.raises(ValueError, match="cannot be written as YAML"):
        save_design(design, PLAYER)
