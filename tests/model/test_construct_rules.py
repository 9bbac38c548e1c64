"""Limits of constructs: times, ends and names. The expected states are those of docs/architectures.md."""

from pathlib import Path

import pytest

from tests.model.test_lowering import project_of
from vicode.check import check_project
from vicode.findings import Severity
from vicode.model.edits import rename_state
from vicode.model.rename import SymbolRef
from vicode.semantics import Interpreter
from vicode.services.rename.files import plan_rename
from vicode.services.rename.project_files import FilesOnDisk
from vicode.store import open_project, read_design, save_design

TICK_NS = 100_000_000
SUB = "vicode: 1\ncomponent: Sub\ninitial: Go\nstates: {Go: {transitions: [{to: End, after: 1}]}, End: {final: true}}\n"


def interrupted(interrupt: str, *, states: str, uses: str = "eyes: Eyes") -> str:
    return f"vicode: 1\ncomponent: Player\nuses: {{{uses}}}\ninitial: Go\ninterrupts: [{interrupt}]\nstates:\n{states}"


def states_of(text: str, *persons: bool) -> list[str]:
    design, sub = read_design(text).design, read_design(SUB).design
    assert design is not None
    assert sub is not None
    interpreter = Interpreter(project_of(design, sub), "Player")
    states = []
    for step, person in enumerate(persons):
        interpreter.set_input("Eyes", "person", value=person)
        states.append(interpreter.step(step * TICK_NS)["tree"][0]["state"])
    return states


def errors_of(text: str) -> list[tuple[str, tuple[str | int, ...]]]:
    design, sub = read_design(text).design, read_design(SUB).design
    assert design is not None
    assert sub is not None
    found = check_project(project_of(design, sub))
    return [(each.rule.code, each.subject.path) for each in found if each.subject and each.severity is Severity.ERROR]


@pytest.mark.parametrize("every", ["0.3", "0.4", "0.7"])
def test_every_counts_from_the_end_of_an_interruption(every: str) -> None:
    text = interrupted(
        f"{{do: Wait, when: eyes.person, until: state_time >= 0.15, every: {every}}}", states="  Go: {}\n  Wait: {}\n"
    )
    cycle = ["Wait"] * 2 + ["Go"] * round(float(every) * 10)
    assert states_of(text, *[True] * 20) == (cycle * 4)[:20]


def test_a_step_without_tries_is_not_begun() -> None:
    steps = "{A: {when: eyes.person, retries: 0}, B: {when: eyes.person, retries: 1}}"
    text = f"vicode: 1\ncomponent: Player\nuses: {{eyes: Eyes}}\ncompetence: {{goal: 'false', steps: {steps}}}\n"
    assert states_of(text, True, True, False, True) == ["B", "B", "Choose", "Failed"]


@pytest.mark.parametrize(
    ("transitions", "following"),
    [
        ("[{to: A, when: not done(sub) and eyes.person}, {to: B, when: done(sub)}]", "B"),
        ("[{to: A, when: eyes.person and done(sub)}, {to: B, when: done(sub)}]", "B"),
        ("[{to: A, when: done(sub), disabled: true}, {to: B, when: done(sub)}]", "B"),
        ("[{to: Off, when: done(sub)}, {to: B, when: eyes.person}]", "B"),
        ("[{to: A, after: 5}, {to: B, when: eyes.person, disabled: true}]", "A"),
        ("[{to: A, when: done(sub)}, {to: B, when: action_done}]", ""),
        ("[{to: A, when: not done(sub)}, {to: B, when: eyes.person}]", ""),
        ("[{when: eyes.person, then: [{to: A, when: done(sub)}]}, {to: B, when: eyes.person}]", ""),
    ],
)
def test_what_follows_a_skipped_state_is_certain(transitions: str, following: str) -> None:
    states = f"  Go: {{modulates: [sub], transitions: {transitions}}}\n  A: {{}}\n  B: {{}}\n"
    interrupt = "{do: Wait, while: [Go], when: eyes.person, until: not eyes.person, then: skip}"
    text = interrupted(
        interrupt, states=f"{states}  Off: {{disabled: true}}\n  Wait: {{}}\n", uses="eyes: Eyes, sub: Sub"
    )
    if following:
        assert errors_of(text) == []
        assert states_of(text, True, False, False)[:2] == ["Wait", following]
    else:
        assert errors_of(text) == [("D447", ("interrupts", 0, "then"))]


@pytest.mark.parametrize("section", ["competence: {goal: 'false', steps: {A: {}}}", "layers: {A: {}}"])
@pytest.mark.parametrize("initial", ["A", "Choose", "B"])
def test_a_written_initial_state_is_reported_and_kept(section: str, initial: str) -> None:
    text = f"vicode: 1\ncomponent: Player\ninitial: {initial}  # important\n{section}\n"
    assert ("D448", ("initial",)) in errors_of(text)
    design = read_design(text).design
    assert design is not None
    assert save_design(design, text) == text


@pytest.mark.parametrize(
    ("interrupt", "path"),
    [
        ("{do: Wait, when: eyes.person, while: [Wait]}", "while"),
        ("{do: Wait, when: eyes.person, while: [Off]}", "while"),
        ("{do: Wait, when: eyes.person, then: Wait}", "then"),
        ("{do: Wait, when: eyes.person, then: restart}", "then"),
        ("{do: Wait, when: eyes.person, while: ['[!W]*']}", "while"),
    ],
)
def test_an_interrupt_without_effect_or_end_is_reported(interrupt: str, path: str) -> None:
    states = "  Go: {}\n  Wait: {}\n  restart: {}\n  Off: {disabled: true}\n"
    assert {each[:2] for each in errors_of(interrupted(interrupt, states=states))} >= {
        ("D447", ("interrupts", 0, path, *((0,) if "!" in interrupt else ())))
    }


def test_an_interrupt_beside_layers_is_reported() -> None:
    text = "vicode: 1\ncomponent: Player\nlayers: {A: {}, B: {when: component_time > 1}}\n"
    text += "interrupts: [{do: B, when: component_time > 2}]\n"
    assert ("D447", ("interrupts", 0)) in errors_of(text)


@pytest.mark.parametrize(
    ("patterns", "old", "new", "expected"),
    [
        ("[Work*]", "WorkA", "Foo", ("Work*", "Foo")),
        ("[Work*]", "Rove", "WorkC", ("WorkA", "WorkB")),
        ("[Work*]", "WorkA", "WorkX", ("Work*",)),
        ("[Rov*, WorkB]", "Rove", "Spin", ("WorkB", "Spin")),
        ("[Rove, Work*]", "Rove", "Walk", ("Walk", "Work*")),
        ("[Nothing*]", "Rove", "Nothing1", ("Nothing*",)),
    ],
)
def test_a_renamed_state_is_interrupted_as_before(patterns: str, old: str, new: str, expected: tuple[str, ...]) -> None:
    states = "  WorkA: {}\n  WorkB: {}\n  Rove: {}\n  Wait: {}\n"
    text = interrupted(f"{{do: Wait, while: {patterns}, when: eyes.person}}", states=states)
    design = read_design(text.replace("initial: Go", "initial: Rove")).design
    assert design is not None
    assert rename_state(design, old, new).interrupts[0].during == expected


def plan(folder: Path, section: str, old: str, new: str) -> str:
    symbol = SymbolRef(section=section, component="Player", name=old)
    return plan_rename(FilesOnDisk(opened=open_project(folder)), symbol, new).error


def test_names_that_constructs_need_are_neither_renamed_nor_taken(tmp_path: Path) -> None:
    text = interrupted("{do: Wait, when: state_time > 1, then: Go}, {do: Stop, when: state_time > 2}", states="")
    text += "  Go: {}\n  Wait: {}\n  Stop: {}\n  End: {final: true, failed: true}\noutputs: {mode: 0}\n"
    (tmp_path / "project.yaml").write_text("vicode: 1\nproject: P\ncomponents: {Eyes: {outputs: {person: bool}}}\n")
    (tmp_path / "player.yaml").write_text(text + "latches: {near: {on: state_time > 3}}\n")
    assert plan(tmp_path, "outputs", "mode", "stop_from") == "there is already an output stop_from"
    assert plan(tmp_path, "variables", "stop_from", "x") == (
        "stop_from is derived from 'interrupts' (number 2), which determines its name"
    )
    assert "derived from 'failed' of the state 'End'" in plan(tmp_path, "outputs", "failed", "x")
    assert plan(tmp_path, "states", "Go", "done") == "'done' is a way to continue, but also a state"
    assert plan(tmp_path, "states", "Go", "Walk") == ""
    assert plan(tmp_path, "variables", "near", "nearby") == ""
    (tmp_path / "player.yaml").write_text(text.replace("then: Go", "then: restart"))
    assert plan(tmp_path, "states", "Go", "restart") == "'restart' is a way to continue, but also a state"


def test_states_of_a_competence_keep_their_names(tmp_path: Path) -> None:
    (tmp_path / "player.yaml").write_text("vicode: 1\ncomponent: Player\ncompetence: {goal: 'false', steps: {A: {}}}\n")
    assert plan(tmp_path, "states", "Done", "End").startswith("Done is derived from 'competence'")
    assert plan(tmp_path, "states", "A", "B") == ""


def test_the_way_back_of_an_interrupt_reaches_no_new_state() -> None:
    text = interrupted("{do: Wait, when: eyes.person}", states="  Go: {}\n  Lonely: {}\n  Wait: {}\n")
    design = read_design(text).design
    assert design is not None
    found = check_project(project_of(design))
    assert [each.subject.path for each in found if each.rule.code == "D421" and each.subject] == [("states", "Lonely")]
