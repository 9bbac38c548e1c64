"""Saving keeps the notation of the file: short forms, brackets, quotes, invalid parts, line ends."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from vicode.model.design import Assign, Code, Declaration, Design, Guard, RunCode, State, Transition
from vicode.store import read_design, save_design

TEXT = """\
# The head of the file.
vicode: 1
component: Player
doc: "quoted"   # beside
uses: {head: Head}
variables:
  tries: 0
states:
  Look:
    enter: |  # why
      go()
    code: work()
    requires: [head]

    # About the first transition.
    transitions:
      # Above it.
      - {to: Kick, when: seen}   # beside it

      # Detached.

      - when: lost   # the guard
        to: Look
  # About Kick.
  Kick: {final: true}
"""


def _edited(edit: Callable[[Design], Design], text: str = TEXT) -> str:
    design = read_design(text).design
    assert design is not None
    saved = save_design(edit(design), text)
    assert read_design(saved).design == edit(design)
    return saved


def _look(edit: Callable[[State], State]) -> Callable[[Design], Design]:
    return lambda design: replace(design, states=(edit(design.states[0]), *design.states[1:]))


def _with_variable(design: Design, *, type: str = "", initial: str = "") -> Design:  # noqa: A002
    return replace(design, variables=(Declaration(name="tries", type=type, initial=initial),))


def _run(text: str) -> RunCode:
    return RunCode(code=Code(texts=(("python", text),)))


@pytest.mark.parametrize(
    ("edit", "old", "new"),
    [
        (
            lambda design: replace(design, variables=(*design.variables, Declaration(name="lost", type="bool"))),
            "  tries: 0\n",
            "  tries: 0\n  lost: bool\n",
        ),
        (lambda design: _with_variable(design, type="float"), "tries: 0", "tries: float"),
        (lambda design: _with_variable(design, type="Side"), "tries: 0", "tries: {type: Side}"),
        (lambda design: _with_variable(design, initial="float"), "tries: 0", "tries: {initial: float}"),
        (lambda design: replace(design, doc="new"), 'doc: "quoted"   #', 'doc: "new"      #'),
        (lambda design: replace(design, doc=""), 'doc: "quoted"   # beside\n', ""),
        (
            lambda design: replace(design, uses=()),
            "uses: {head: Head}\n",
            "",
        ),
        (
            lambda design: replace(design, variables=(Declaration(name="tries", initial="0", unit="mm"),)),
            "tries: 0",
            "tries: {initial: 0, unit: mm}",
        ),
        (
            _look(lambda state: replace(state, enter=(_run("go()\nwait()\n"),))),
            "      go()\n",
            "      go()\n      wait()\n",
        ),
        (
            _look(lambda state: replace(state, enter=(_run("go()\n"), Assign(values=(("tries", "1"),))))),
            "    enter: |  # why\n      go()\n",
            "    enter:  # why\n      - code: |\n          go()\n      - set: {tries: 1}\n",
        ),
        (_look(lambda state: replace(state, actions=(_run("rest()"),))), "code: work()", "code: rest()"),
        (
            _look(lambda state: replace(state, actions=(Assign(values=(("tries", "1"),)),))),
            "    code: work()\n",
            "    actions:\n      - set: {tries: 1}\n",
        ),
        (_look(lambda state: replace(state, requires=("head", "feet"))), "[head]", "[head, feet]"),
        (_look(lambda state: replace(state, requires=())), "    requires: [head]\n\n", "\n"),
        (
            _look(lambda state: replace(state, transitions=state.transitions[1:])),
            "      # Above it.\n      - {to: Kick, when: seen}   # beside it\n",
            "",
        ),
        (
            _look(lambda state: replace(state, transitions=(state.transitions[0], Transition(to="Look")))),
            "      - when: lost   # the guard\n        to: Look\n",
            "      - to: Look\n",
        ),
        (
            _look(lambda state: replace(state, transitions=(*state.transitions, Transition(to="Kick")))),
            "        to: Look\n",
            "        to: Look\n\n      - {to: Kick}\n",
        ),
        (lambda design: replace(design, states=design.states[:1]), "  # About Kick.\n  Kick: {final: true}\n", ""),
        (
            lambda design: replace(design, states=(design.states[0], replace(design.states[1], at=(1.0, 2.5)))),
            "Kick: {final: true}",
            "Kick: {at: [1, 2.5], final: true}",
        ),
    ],
)
def test_an_edit_uses_the_notation_of_the_file(edit: Callable[[Design], Design], old: str, new: str) -> None:
    assert TEXT.count(old) == 1
    assert _edited(edit) == TEXT.replace(old, new)


def test_a_type_alone_becomes_a_value_in_place() -> None:
    text = TEXT.replace("tries: 0", "tries: int  # so far")
    assert "  tries: 3    # so far\n" in _edited(lambda design: _with_variable(design, initial="3"), text)


def test_unread_parts_are_kept() -> None:
    text = (
        "vicode: 1\ncomponent: Player\ncolour: red  # unknown\nstates:\n  Look:\n    at: far away\n    transitions:\n"
        "      - {when: no target}\n      - {to: Look}\n  Kick: [broken]\n"
    )
    saved = _edited(_look(lambda state: replace(state, doc="new")), text)
    assert saved == text.replace("  Look:\n", "  Look:\n    doc: new\n")
    saved = _edited(_look(lambda state: replace(state, transitions=(Transition(to="Kick"),))), text)
    assert saved == text.replace("{to: Look}", "{to: Kick}")


def test_line_ends_marks_and_a_missing_last_one_are_kept() -> None:
    for mark in ("", "\ufeff"):
        text = (mark + TEXT.removesuffix("\n")).replace("\n", "\r\n")
        saved = _edited(lambda design: replace(design, states=(*design.states, State(name="New"))), text)
        assert saved == f"{text}\r\n  New: {{}}"


def test_flow_style_becomes_block_style_for_multiline_code() -> None:
    guard = Guard(when="seen", code=Code(texts=(("python", "x = 1\nreturn x\n"),)))
    saved = _edited(_look(lambda state: replace(state, transitions=(Transition(to="Kick", guard=guard),))))
    transition = "      - to: Kick   # beside it\n        when: seen\n        code: |\n          x = 1\n"
    assert transition in saved


def test_duplicate_state_names_are_not_saved() -> None:
    design = Design(component="Player", states=(State(name="A"), State(name="A")))
    with pytest.raises(ValueError, match="duplicate names cannot be saved: A"):
        save_design(design)


def test_a_use_whose_position_is_removed_is_short_again() -> None:
    design = read_design(TEXT).design
    assert design is not None
    placed = replace(design, uses=(replace(design.uses[0], at=(40.0, 80.0)),))
    moved = save_design(placed, TEXT)
    assert "uses: {head: {component: Head, at: [40, 80]}}" in moved
    assert save_design(design, moved) == TEXT
