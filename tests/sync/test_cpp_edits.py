"""Edits of generated C++ outside regions, as a person makes them: taken, or a patch with the reason."""

from dataclasses import replace
from pathlib import Path

import pytest

from tests.sync.cpp_law import source_of
from tests.sync.cpp_player_edits import PLAYER_EDITS, edit_player
from tests.sync.patches import apply_patch
from tests.sync.player_edits import FORWARD
from vicode.generators.cpp import cpp_generator
from vicode.model.design import Design
from vicode.sync.interpret import Interpretation, interpret_cpp_edits

PROJECT = replace(FORWARD, languages=("cpp",))
PLAYER = source_of(PROJECT, "Player")


def interpret(edited: str, file: str = "player.cpp", generated: str = PLAYER) -> Interpretation:
    return interpret_cpp_edits(PROJECT, "Player", generated=generated, edited=edited, file=file)


def player() -> Design:
    design = PROJECT.design("Player")
    assert design is not None
    return design


def header_of(design: Design) -> str:
    return cpp_generator(PROJECT, {})(design).header


HEADER = header_of(player())
TAKEN = [name for name, edit in PLAYER_EDITS.items() if edit.words]
LEFT = [name for name, edit in PLAYER_EDITS.items() if not edit.words]


@pytest.mark.parametrize("name", TAKEN)
def test_an_edit_is_taken(name: str) -> None:
    found = interpret(edit_player(PLAYER, name))
    assert tuple(edit.words for edit in found.edits) == PLAYER_EDITS[name].words
    assert found.leftover == ""


@pytest.mark.parametrize("name", LEFT)
def test_an_edit_stays_a_patch_with_its_reason(name: str, tmp_path: Path) -> None:
    edited = edit_player(PLAYER, name)
    found = interpret(edited, "Player")
    assert found.design == player()
    assert found.edits == ()
    assert any(PLAYER_EDITS[name].reason in reason for reason in found.reasons), found.reasons
    assert apply_patch(PLAYER, found.leftover, tmp_path) == edited


LAYOUT = {
    "number of the same value": PLAYER.replace("210.0", "210"),
    "line ends": PLAYER.replace("\n", "\r\n"),
    "indentation": PLAYER.replace("    ", "  "),
    "braces": PLAYER.replace(" {\n    switch", "\n{\n    switch"),
    "words for operators": PLAYER.replace(" && ", " and "),
}


@pytest.mark.parametrize("name", LAYOUT)
def test_layout_is_no_edit(name: str) -> None:
    found = interpret(LAYOUT[name])
    assert (found.design, found.edits, found.leftover) == (player(), (), "")
    taken = interpret(LAYOUT[name].replace("kicks += 1", "kicks += 2"))
    assert [edit.words for edit in taken.edits] == ["enter action of state Kick: set kicks: kicks + 2"]
    assert taken.leftover == ""


def test_moved_functions_and_cases_are_no_edit() -> None:
    start, end = PLAYER.index("void Player::enter()"), PLAYER.index("BICA_INLINE void Player::change_to")
    place = PLAYER.index("bool Player::when_")
    moved = PLAYER[:start] + PLAYER[end:place] + PLAYER[start:end] + PLAYER[place:]
    assert interpret(moved).leftover == ""
    first, second = moved.rindex("        case State::Kick:\n"), moved.rindex("        case State::WatchBall:\n")
    last = moved.index("        default:", second)
    reordered = moved[:first] + moved[second:last] + moved[first:second] + moved[last:]
    assert (interpret(reordered).edits, interpret(reordered).leftover) == ((), "")
    found = interpret(reordered.replace("kicks += 1", "kicks += 2"))
    assert [edit.words for edit in found.edits] == ["enter action of state Kick: set kicks: kicks + 2"]
    assert found.leftover == ""


def test_a_function_is_taken_whole_or_not_at_all(tmp_path: Path) -> None:
    edited = edit_player(edit_player(edit_player(PLAYER, "number"), "statement in a decision"), "added set")
    found = interpret(edited, "Player")
    assert [edit.words for edit in found.edits] == ["added enter action of state Kick: set side: Side.left"]
    assert "20.0" in found.leftover
    assert "seen" in found.leftover
    assert (
        apply_patch(source_of(replace(PROJECT, designs=_with(found.design)), "Player"), found.leftover, tmp_path)
        == edited
    )


def _with(design: Design) -> tuple[Design, ...]:
    return tuple(design if each.component == design.component else each for each in PROJECT.designs)


def test_a_deleted_state_goes_with_its_transitions_and_code() -> None:
    edited = PLAYER
    for line in ('        case State::CircleBall:\n            return "CircleBall";\n',):
        edited = edited.replace(line, "")
    start, end = (
        edited.index("        case State::CircleBall:\n            // net"),
        edited.index("        case State::AlignFront:\n        case"),
    )
    edited = edited[:start] + edited[end:]
    start, end = (
        edited.index("        case State::CircleBall:\n            call"),
        edited.index("        case State::AlignFront:\n            call"),
    )
    edited = edited[:start] + edited[end:]
    start, end = (
        edited.index("        case State::CircleBall:\n            side"),
        edited.index("        case State::AlignFront:\n            kick"),
    )
    edited = edited[:start] + edited[end:]
    left = interpret(edited)
    assert (left.design, left.edits) == (player(), ())
    start, end = (
        edited.index("            // no net"),
        edited.index("            break;", edited.index("            // no net")),
    )
    found = interpret(edited[:start] + edited[end:])
    assert found.design.state("CircleBall") is None
    assert found.leftover == ""


def test_an_added_state_is_taken_with_its_content() -> None:
    edited = PLAYER.replace(
        '            return "GetUp";\n',
        '            return "GetUp";\n        case State::Rest:\n            return "Rest";\n',
    )
    edited = edited.replace(
        "        case State::GetUp:\n            call",
        "        case State::Rest:\n            kicks = 0;\n            break;\n"
        "        case State::GetUp:\n            call",
    )
    found = interpret(edited)
    state = found.design.state("Rest")
    assert state is not None
    assert len(state.actions) == 1
    assert found.leftover == ""


HEADERS = {
    "initial value": ("kicks = 0;", "kicks = 5;", "value of output kicks: 5"),
    "element": ("kick = Kick::front", "kick = Kick::lateral", "value of variable kick: Kick.lateral"),
    "doc": ("/// Kicks so far.", "/// All kicks.", "description of output kicks: All kicks."),
    "member": (
        "distance_count_ = 0;\n    // </vicode>",
        "distance_count_ = 0;\n    // </vicode>\n    int tries_ = 0;",
        "class code: int tries_ = 0;",
    ),
    "include": (
        "<cstdio>\n// </vicode>",
        "<cstdio>\n// </vicode>\n#include <iostream>",
        "module code: #include <iostream>",
    ),
}


@pytest.mark.parametrize("name", HEADERS)
def test_an_edit_of_a_header_is_taken(name: str) -> None:
    old, new, words = HEADERS[name]
    assert old in HEADER
    found = interpret(HEADER.replace(old, new), "player.hpp", HEADER)
    assert [edit.words for edit in found.edits] == [words]
    assert found.leftover == ""


@pytest.mark.parametrize(
    ("old", "new"), [("        GetUp,\n", "        GetUp,\n        Rest,\n"), ("void start();", "void begin();")]
)
def test_other_edits_of_a_header_stay_a_patch(old: str, new: str, tmp_path: Path) -> None:
    edited = HEADER.replace(old, new).replace("kicks = 0;", "kicks = 5;")
    found = interpret(edited, "player.hpp", HEADER)
    assert (found.design, found.edits) == (player(), ())
    assert found.reasons
    assert apply_patch(HEADER, found.leftover, tmp_path) == edited


def test_a_header_is_read_after_the_source_was_taken() -> None:
    taken = interpret(edit_player(PLAYER, "log line"))
    project = replace(PROJECT, designs=_with(taken.design))
    edited = HEADER.replace("kicks = 0;", "kicks = 5;")
    found = interpret_cpp_edits(project, "Player", generated=HEADER, edited=edited, file="player.hpp")
    assert [edit.words for edit in found.edits] == ["value of output kicks: 5"]
    assert "do_kick_enter2" in header_of(found.design) or "do_kick_enter_2" in header_of(found.design)
    assert found.leftover == ""
