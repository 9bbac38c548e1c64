"""State machines in C++ sources become designs that behave alike; what is not understood is listed with its place."""

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vicode.importers.cpp import CppImport, import_cpp
from vicode.model.design import Call, Design, RunCode, Stay, Transition
from vicode.model.traversal import iter_decisions
from vicode.services.imported_behavior.cpp_sources import find_in_cpp
from vicode.services.imported_behavior.design_files import format_files


def read(text: str, file: str = "behavior.cpp") -> CppImport:
    return import_cpp({Path(file): text}, "behavior")


def design_of(text: str) -> Design:
    imported = read(text)
    assert not imported.errors
    (design,) = imported.result.project.designs
    return design


def notes_of(text: str) -> list[tuple[int, str]]:
    return [(note.line, note.text) for note in read(text).result.notes]


def transitions_of(text: str) -> list[tuple[str, str]]:
    """The guards and targets of the transitions of the first state of an option with this block."""
    design = design_of(f"option(Walk) {{ initial_state(a) {{ transition {{ {text} }} }} state(b) {{}} state(c) {{}} }}")
    found = []
    for each in iter_decisions(design):
        guards = [group.guard.when if is_then else f"not {group.guard.when}" for group, is_then in each.groups]
        if isinstance(each.decision, Transition | Stay):
            to = each.decision.to if isinstance(each.decision, Transition) else "stay"
            found.append((" & ".join([*guards, each.decision.guard.when]), to))
    return found


# Conditions


@pytest.mark.parametrize(
    ("condition", "guard"),
    [
        ("theBall.seen(300)", "robot.theBall_seen_300"),
        ("!seen && (near || !far)", "not robot.seen and (robot.near or not robot.far)"),
        ("not seen or near and far", "not robot.seen or (robot.near and robot.far)"),
        ("distance < 1'000.f && distance >= .5", "robot.distance < 1000.0 and robot.distance >= 0.5"),
        ("300 >= distance", "robot.distance <= 300"),
        ("state_time > 2000", "state_time > 2000"),
        ("option_time > limit", "component_time > robot.limit"),
        ("state_time > 20_ms && state_time < 2_s", "state_time > 20 and robot.state_time_ < 2"),
        (
            "mode == Game::State::ready || mode != Game::State::set",
            "robot.mode == State.ready or robot.mode != State.set",
        ),
        ("mode == STATE_SET", "robot.mode == Walk_mode.STATE_SET"),
        ("pointer != nullptr and ok == false", "robot.pointer and (not robot.ok)"),
        ("a > b || a <= b", "robot.b_below_a or not robot.b_below_a"),
        (
            "between<float>(x, 1.f, 2.f) && static_cast<int>(x) > 5",
            "robot.between_float_x_1_f_2_f and robot.static_cast_int_x > 5",
        ),
        ("flags & bit(3)", "robot.flags_bit_3"),
        ("a ? b : c", "robot.a_b_c"),
        ("x > 0x10", "robot.x_0x10_below_x"),
        ("angle < 10_deg", "robot.angle < 10"),
        ("action_aborted", "robot.action_aborted"),
    ],
)
def test_conditions_are_translated(condition: str, guard: str) -> None:
    ((found, _target),) = transitions_of(f"if({condition}) goto b;")
    assert re.sub(r"\s+", " ", found) == guard


def test_inputs_have_the_texts_and_units_of_the_source() -> None:
    imported = read(
        "option(Walk) { initial_state(a) { transition {\n"
        "if(theBall . seen( 300 ) && angle > 10_deg) goto b; } } state(b) {} }"
    )
    (interface,) = imported.result.project.components
    assert [(each.doc, each.type, each.unit) for each in interface.outputs] == [
        ("theBall.seen(300)", "bool", ""),
        ("angle", "float", "deg"),
    ]


def test_equal_texts_with_a_change_in_between_are_different_inputs() -> None:
    first, second = transitions_of("if(near) goto b; near = measure(); if(near) goto c;")
    assert first[0] != second[0]
    same, again = transitions_of("if(near) goto b; other = measure(); if(near) goto c;")
    assert same[0] == again[0]
    once, twice = transitions_of("if(count++ > 3) goto b; if(count++ > 3) goto c;")
    assert once[0] != twice[0]


# Statements


def test_if_and_switch_keep_the_order_of_tests() -> None:
    assert transitions_of("if(x) { if(y) goto b; else goto c; } else if(z) goto c; goto b;") == [
        ("robot.x & robot.y", "b"),
        ("robot.x & ", "c"),
        ("robot.z", "c"),
        ("", "b"),
    ]
    cases = "switch(m) { case M::p: case M::q: if(x) break; goto b; case M::r: goto c; default: return; }"
    assert transitions_of(cases) == [
        ("robot.m == M.p or robot.m == M.q & not robot.x", "b"),
        ("robot.m == M.r", "c"),
        ("not (robot.m == M.p or robot.m == M.q or robot.m == M.r)", "stay"),
    ]


def test_statements_that_are_not_understood_are_listed_and_may_lead_anywhere() -> None:
    text = """option(Walk) {
  initial_state(a) {
    transition {
      for(auto& each : all)
        if(each.near) goto b;
      timer = now();
      DEBUG_RESPONSE("x") goto c;
    }
  }
  state(b) {} state(c) {}
}"""
    assert notes_of(text) == [
        (4, "not in the design: for(auto & each:all)if(each.near)goto b;"),
        (6, "not in the design: timer = now();"),
        (7, 'not in the design: DEBUG_RESPONSE("x")goto c;'),
    ]
    (first, second) = [each.decision for each in iter_decisions(design_of(text))]
    assert isinstance(first, Transition)
    assert isinstance(second, Transition)
    assert (first.to, second.to) == ("b", "c")
    assert first.guard.when != second.guard.when


# Options


PLAY = """option((Soccer) Play, args((int) speed), vars((bool)(false) left))
{
  common_transition { if(fallen) goto down; }
  initial_state(search)
  {
    transition { if(action_done) goto down; }
    action
    {
      // Look
      if(left)
        LookAround({.speed = speed});
    }
  }
  aborted_state(down) { action { theMotion.LookAround(); select_option({"Kick", Option::LookAround}); } }
}
option(LookAround) { initial_state(turn) { transition { if(state_time > 500) goto done; } } target_state(done) {} }
option(Kick) { initial_state(now) { action { Play(); } } }
option(Unused) { initial_state(only) {} }
int main() { Play(); }
"""


def test_an_option_calls_the_options_of_its_action_blocks() -> None:
    imported = read(PLAY)
    play = imported.result.project.design("Play")
    assert play is not None
    search, down = play.states
    assert [each.alias for each in search.actions if isinstance(each, Call)] == ["LookAround"]
    (code,) = [each for each in search.actions if isinstance(each, RunCode)]
    assert code.code.in_language("cpp") == "if(left)\n  LookAround({.speed = speed});"
    assert [each.alias for each in down.actions if isinstance(each, Call)] == ["Kick", "LookAround"]
    assert [each.decision.guard.when for each in iter_decisions(play)] == ["robot.fallen", "done(LookAround)"]
    assert [state.final for state in imported.result.project.designs[1].states] == [False, True]
    assert [(note.line, note.text) for note in imported.result.notes] == [
        (17, "the use of Play closes a cycle: it is left out")
    ]
    assert imported.unused == ("Unused",)


@pytest.mark.parametrize(
    "state", ["state(b) done = true;", "state(b c) { }", "state() { }", "state b { }", "state(a) {}"]
)
def test_a_state_that_is_not_understood_is_listed(state: str) -> None:
    text = f"option(Walk) {{ initial_state(a) {{}}\n{state} }}"
    assert [line for line, _text in notes_of(text)] == [2]
    assert read(text).machines["Walk"].is_partial
    assert [each.name for each in design_of(text).states] == ["a"]


def test_an_option_that_is_declared_twice_is_read_once() -> None:
    texts = {Path(f"{name}.h"): f"option(Walk) {{ initial_state({name}) {{}} }}" for name in ("one", "two")}
    imported = import_cpp(texts, "behavior")
    assert [design.initial for design in imported.result.project.designs] == ["one"]
    assert [note.text for note in imported.result.notes] == ["two.h declares it, too: not in the design"]


def test_the_first_branch_of_the_preprocessor_is_read() -> None:
    text = """option(Walk) {
  initial_state(a) { transition {
#ifdef FAST
    if(x) {
#else
    if(y) {
#endif
      goto b; } } }
#if 0
  state(c) {
#endif
  state(b) {}
}"""
    assert [state.name for state in design_of(text).states] == ["a", "b"]
    assert notes_of(text) == [(5, "this branch is not read")]


# Tables


TABLE = """
#define DEFINE_SML_STATE(STATE) const auto STATE##_S = boost::sml::state<STATE>;
#define DEFINE_SML_GUARD(FUNCTION)                       \\
    const auto FUNCTION##_G = [this](auto event) { return FUNCTION(event); };
struct Shoot {
  auto operator()() {
    using namespace boost::sml;
    DEFINE_SML_STATE(Aim)
    DEFINE_SML_GUARD(ready)
    auto kick = state<class Kick>;
    return make_transition_table(
      *Aim_S + event<Update>[!ready_G] / (turn, [](auto e) { return e = 1; }),
      Aim_S + sml::event<struct Update>[ready_G && far] = kick,
      sml::state<Walk> <= kick + event<Stop> / brake,
      kick + on_entry<_> / swing,
      state<Walk> = X, X + event<Update> = "Wait"_s,
      *"Wait"_s + unexpected_event<Update> = X,
      process(this));
  }
};
class Walk final : public Base {
  auto operator()() const { return sml::make_transition_table(*"go"_s + event<tick> = X); }
};
"""


def test_rows_become_transitions_of_regions_and_machines_inside() -> None:
    imported = read(TABLE)
    designs = {design.component: design for design in imported.result.project.designs}
    assert list(designs) == ["Shoot", "Shoot_2", "Walk"]
    shown = {
        name: [
            (
                each.source,
                each.decision.to if isinstance(each.decision, Transition) else "stay",
                each.decision.guard.when,
            )
            for each in iter_decisions(design)
        ]
        for name, design in designs.items()
    }
    assert shown["Shoot"] == [
        ("Aim", "stay", "robot.event == ShootEvent.Update and (not robot.ready)"),
        ("Aim", "Kick", "robot.event == ShootEvent.Update and (robot.ready and robot.far)"),
        ("Kick", "Walk", "robot.event == ShootEvent.Stop"),
        ("Walk", "X", "done(Walk)"),
        ("X", "Wait", "robot.event == ShootEvent.Update"),
        ("Wait", "X", "robot.unexpected_event_Update"),
    ]
    kick = designs["Shoot"].state("Kick")
    assert kick is not None
    assert [each.code.in_language("cpp") for each in kick.enter if isinstance(each, RunCode)] == ["swing"]
    assert [state.requires for state in designs["Shoot"].states if state.name == "Walk"] == [("Walk",)]
    assert [state.name for state in designs["Shoot_2"].states] == ["X", "Wait"]
    (stay, *_others) = iter_decisions(designs["Shoot"])
    assert stay.decision.doc == "(turn, [](auto e) { return e = 1; })"
    assert shown["Walk"] == [("go", "X", "robot.tick")]
    assert (18, "not a row that is understood: process(this)") in [(n.line, n.text) for n in imported.result.notes]


# Mistakes


def test_names_of_states_may_have_spaces() -> None:
    design = design_of("""struct Tcp { auto operator()() const { return make_transition_table(
      *"established"_s + event<release> = "fin wait 1"_s,
      "fin wait 1"_s + event<ack> = X); } };""")
    assert [state.name for state in design.states] == ["established", "fin_wait_1", "X"]


def test_regions_use_what_their_own_states_read() -> None:
    imported = read("""struct Sub { auto operator()() const { return make_transition_table(*"a"_s + event<e> = X); } };
    struct Two { auto operator()() const { return make_transition_table(
      *"first"_s = state<Sub>, *"second"_s + event<e> = "third"_s, "third"_s = "second"_s); } };""")
    uses = {each.component: [use.alias for use in each.uses] for each in imported.result.project.designs}
    assert uses == {"Sub": ["robot"], "Two": ["Sub"], "Two_2": ["robot"]}


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        ("option(A) {\n  initial_state(b) { action { f(1]; } }\n}", 2, 34, "']' closes nothing"),
        ("option(A) {\n initial_state(b) {", 2, 19, "'{' is never closed"),
        ("option(A) {" + "(" * 150, 1, 111, "'(' is nested too deeply"),
    ],
)
def test_brackets_that_do_not_match_are_an_error_with_a_place(text: str, line: int, column: int, words: str) -> None:
    (error,) = read(text).errors
    assert error.location is not None
    assert (error.rule.code, error.location.line, error.location.column) == ("S804", line, column)
    assert error.message == words


def test_what_is_nested_too_deeply_is_an_error() -> None:
    (error,) = read("option(Walk) { initial_state(a) { transition { if(" + "!" * 5000 + "x) goto a; } } }").errors
    assert error.message == "'Walk' is nested too deeply"


PIECES = re.findall(r"\w+|\s+|[^\w\s]", PLAY + TABLE)


@given(st.data())
def test_any_text_is_read_or_an_error(data: st.DataObject) -> None:
    pieces = list(PIECES)
    for _ in range(data.draw(st.integers(1, 6))):
        start = data.draw(st.integers(0, len(pieces) - 1))
        end = data.draw(st.integers(start, min(start + 8, len(pieces))))
        pieces[start:end] = data.draw(st.lists(st.sampled_from(PIECES), max_size=4))
    imported = read("".join(pieces))
    assert imported.machines or imported.errors or not imported.result.project.designs
    for finding in find_in_cpp(imported):
        assert finding.location is not None
        assert finding.location.line > 0
    for text in format_files(imported.result).values():
        assert text
