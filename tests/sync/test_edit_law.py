"""Random edits of generated modules are taken whole or not at all; nothing is lost, invented or changed in effect."""

import ast
import random
from collections.abc import Callable

import pytest
from hypothesis import Phase, assume, given, settings
from hypothesis import strategies as st

from tests.generators.sound_designs import project_of, sound_designs
from tests.sync.edit_law import Case, check_edit, edit_text
from tests.sync.module_text import Module
from tests.sync.player_edits import FORWARD
from tests.sync.program_trace import trace_program
from tests.sync.test_interpret_laws import is_sound
from tests.sync.written_edits import EDITS
from vicode.model.design import Design
from vicode.sync.interpret import equivalent_expressions, interpretation, search

SAMPLES = [Case.of(FORWARD, name) for name in ("Player", "SearchNet")]
PLAYER = SAMPLES[0]
TEXT = PLAYER.text_of(PLAYER.design)

# Shrinking would generate thousands of times.
few = settings(
    max_examples=max(10, settings.default.max_examples // 4), phases=[Phase.explicit, Phase.reuse, Phase.generate]
)


@few
@given(st.sampled_from(SAMPLES), st.integers(0, 1 << 32))
def test_edits_of_a_sample(case: Case, seed: int) -> None:
    names, edited = edit_text(case.text_of(case.design), seed)
    assume(names)
    check_edit(case, edited)


@few
@given(sound_designs(), st.integers(0, 1 << 32))
def test_edits_of_random_designs(design: Design, seed: int) -> None:
    project = project_of(design)
    assume(is_sound(project))
    case = Case.of(project, design.component)
    names, edited = edit_text(case.text_of(design), seed)
    assume(names)
    check_edit(case, edited)


@pytest.mark.parametrize("kind", EDITS)
def test_each_kind_of_edit(kind: str) -> None:
    edits = (EDITS[kind](Module(TEXT), random.Random(seed)) for seed in range(20))
    edited = next(each for each in edits if each not in (None, TEXT))
    assert edited is not None
    check_edit(PLAYER, edited)


@pytest.mark.parametrize("seed", [7146, 9372])
def test_a_state_in_the_place_of_a_deleted_one_is_no_rename(seed: int) -> None:
    check_edit(PLAYER, edit_text(TEXT, seed)[1])


def test_an_import_stays_for_a_method_in_the_patch() -> None:
    assert check_edit(PLAYER, edit_text(TEXT, 9402)[1]) == "partly"


@pytest.mark.parametrize("place", ["        self._set_states(", "        self.kicks += 1\n"])
def test_a_trace_ends_at_an_endless_loop(place: str) -> None:
    trace = trace_program(
        TEXT.replace(place, f"        while True:\n            pass\n{place}"), FORWARD, PLAYER.declarations, seed=0
    )
    assert trace[-1] == "endless loop"


def replaced(*pairs: tuple[str, str]) -> str:
    text = TEXT
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new)
    return text


SEEN = "if decide and self.perception.ball_seen:"
KICKED = """ and not self.kicker.busy:  # after 0.5 s
            self._change_to("WatchBall")
            return
"""
NESTED = """:  # after 0.5 s
            if not self.kicker.busy and self.is_wrong():
                self._change_to("WatchBall")
                return
"""
GET_UP = "    def _in_get_up("
DANCE = """    def _in_dance(self, decide: bool = True) -> None:
        self.dance()

    def dance(self) -> None:
        self._call(self.walk)

"""
MARK = "side, bearing)\n        # </vicode>\n"
CALLS = "        self._call(self.face_ball)\n        self._call(self.kicker"
RETURN = "        if decide and self.state_time > 4:\n            return\n"


def accept_all(_result: str, _written: str) -> bool:
    return True


def explain_half(self: search.EditSearch, start: search.Snapshot, name: str) -> search.Snapshot | None:
    return self._step(start, name, set())


def drop_is(node: ast.Compare) -> ast.expr:
    return node.left if isinstance(node.ops[0], ast.Is) else node


# Faults of the interpretation, and an edit that shows each.
FAULTS: dict[str, tuple[str, Callable[[pytest.MonkeyPatch], object]]] = {
    "statements beside the region of an action are dropped": (
        replaced(("_do_kick_enter", "_do_kick_entry"), (MARK, f'{MARK}        log.info("kicked")\n')),
        lambda patch: [
            patch.setattr(interpretation, "is_same_program", accept_all),
            patch.setattr("vicode.sync.interpret.normal_form._is_action_method", lambda _name, items: len(items) > 1),
        ],
    ),
    "a half of a method is taken": (
        replaced((KICKED, NESTED)),
        lambda patch: [
            patch.setattr(interpretation, "is_same_program", accept_all),
            patch.setattr(search.EditSearch, "_explain", explain_half),
        ],
    ),
    "a helper is taken without its user": (
        replaced((GET_UP, DANCE + GET_UP)),
        lambda patch: patch.setattr(search, "find_dependent", lambda *_values: frozenset()),
    ),
    "a membership is the first comparison": (
        replaced((SEEN, "if decide and self.kick in (Kick.diagonal, Kick.front):")),
        lambda patch: patch.setattr(
            equivalent_expressions,
            "_either",
            lambda left, values, is_in, real=equivalent_expressions._either: real(left, values[:1], is_in=is_in),
        ),
    ),
    "a test of False is one of truth": (
        replaced(("not self.kicker.busy", "self.kicker.busy is False")),
        lambda patch: [
            patch.setattr(f"vicode.sync.interpret.{module}.plain_comparison", drop_is)
            for module in ("equivalent_expressions", "expression_reader")
        ],
    ),
    "a method that returns stands for its call": (
        replaced((CALLS, CALLS.replace("\n", f"\n{RETURN}", 1))),
        lambda patch: [
            patch.setattr("vicode.sync.interpret.action_proposals._is_movable", lambda _context, _added: True),
            patch.setattr("vicode.sync.interpret.verification._may_stand_in", lambda _method, _caller: True),
        ],
    ),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_the_law_finds_a_fault(fault: str, monkeypatch: pytest.MonkeyPatch) -> None:
    edited, plant = FAULTS[fault]
    check_edit(PLAYER, edited)
    plant(monkeypatch)
    with pytest.raises(AssertionError):
        check_edit(PLAYER, edited)
