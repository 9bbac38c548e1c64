"""Files of VICODE, rqt BICA, FlexBE and YASMIN become designs; what designs cannot say is listed with its place."""

import random
from collections.abc import Generator
from pathlib import Path

import pytest

from vicode.check import check_project
from vicode.cli.entry_point import main
from vicode.findings import Severity
from vicode.importers import ImportResult
from vicode.importers.outcomes import OutcomeMachine, OutcomeState, OutcomeTransition, convert_machines
from vicode.importers.sources import Sources
from vicode.model.design import Design, Transition
from vicode.semantics import Interpreter
from vicode.services.imported_behavior.other_tools import find_other_files, load_other

TICK_NS = 10_000_000
COUNTER_XML = """<component id="Counter">
<conf autorestart="0"/>
\t<dependenceComponent id="Eyes" x="10.0" y="300.0"/>
\t<dependenceComponent id="Head" x="300.0" y="300.0"/>
\t<state id="initial" x="58.0" y="39.0" code="Initial_state_code" >
\t</state>
\t<state id="Look" x="338.0" y="59.0" code="Look_state_code">
\t\t<requirement id="Eyes"/>
\t\t<modulation id="Head"/>
\t</state>
\t<transition id="Initial2Look0" x="1" y="1" source="Initial" target="Look" priority="1" timer="false"/>
\t<transition id="Look2Initial0" x="1" y="1" source="Look" target="Initial" priority="2" timer="true"/>
\t<transition id="Look2Initial1" x="1" y="1" source="Look" target="Initial" priority="1" timer="false"/>
</component>
"""
MARK = "//BUILDER COMMENT. DO NOT REMOVE. "


def region(name: str, code: str) -> str:
    return f"void f()\n{{\n{MARK}begin {name}\n{code}\n{MARK}end {name}\n}}\n"


COUNTER_CPP = (
    f'#include "Counter.h"\n{MARK}auxinclude begin\n#include <cmath>\n{MARK}auxinclude end\n'
    + region("Look_state_code", "\tseen++;")
    + region("Initial2Look0_transition_code", "return true;")
    + region("Look2Initial0_transition_code", "\treturn (getStopWatch() > 2000);")
    + region(
        "Look2Initial1_transition_code", "if(_Eyes->lost())\n{\n\t_Head->stop();\n\treturn true;\n}\nreturn false;"
    )
    + f"{MARK}auxcode begin\nvoid Counter::init() {{ setFreqTime(MEDIUM_RATE); }}\n{MARK}auxcode end\n"
)
FLEXBE = '''#!/usr/bin/env python
from flexbe_core import Behavior, Autonomy, OperatableStateMachine, ConcurrencyContainer
from states.wait_state import WaitState
from other.grip_sm import GripSM


class FetchSM(Behavior):
    """Fetches a cup."""

    def create(self):
        # x:30 y:463, x:130 y:463
        _state_machine = OperatableStateMachine(outcomes=['finished', 'failed'])
        _state_machine.userdata.data = 0

        # x:333 y:240
        _sm_approach_0 = OperatableStateMachine(outcomes=['there', 'lost'])
        with _sm_approach_0:
            # x:10 y:20
            OperatableStateMachine.add('Turn', WaitState(wait_time=1),
                                       transitions={'done': 'there', 'blocked': 'lost'},
                                       autonomy={'done': Autonomy.Off, 'blocked': Autonomy.High})

        _sm_both_1 = ConcurrencyContainer(outcomes=['done'])
        with _sm_both_1:
            OperatableStateMachine.add('A', WaitState(wait_time=2), transitions={'done': 'done'})

        with _state_machine:
            # x:30 y:40
            OperatableStateMachine.add('Approach', _sm_approach_0,
                                       transitions={'there': 'Both', 'lost': 'Approach'},
                                       autonomy={'there': Autonomy.Inherit, 'lost': Autonomy.Inherit})
            # x:230 y:40
            OperatableStateMachine.add('Both', _sm_both_1, transitions={'done': 'Grip it'})
            # x:430 y:40
            OperatableStateMachine.add('Grip it', self.use_behavior(GripSM, 'Grip it'),
                                       transitions={'finished': 'finished', 'failed': target})
        return _state_machine
'''
YASMIN = """<StateMachine name="Patrol" outcomes="end" start_state="Go">
  <Key name="goal" type="in"/>
  <State name="Wait" type="py" module="states" class="Wait" x="10.5" y="20"><Transition from="done" to="Go"/></State>
  <StateMachine name="Go" outcomes="end lost" x="300" y="20">
    <State name="Drive" type="cpp" class="Drive">
      <Transition from="ok" to="end"/><Transition from="bad" to="lost"/>
    </State>
    <Transition from="lost" to="Wait"/>
  </StateMachine>
  <Concurrence name="Both" outcomes="x"><State name="A"/><Transition from="x" to="nowhere"/></Concurrence>
</StateMachine>
"""


def load(folder: Path, *names: str) -> ImportResult:
    result, errors = load_other([folder / name for name in names], folder, "p")
    assert not errors
    assert not [each for each in check_project(result.project) if each.rule.severity is Severity.ERROR]
    return result


def notes(result: ImportResult) -> list[str]:
    return [f"{each.file.name}:{each.line}: {each.text}" for each in result.notes]


def guards(design: Design) -> dict[str, list[str]]:
    return {
        state.name: [f"{each.to} if {each.guard.when}" for each in state.transitions if isinstance(each, Transition)]
        for state in design.states
    }


def test_vicode_xml_becomes_a_design_with_the_code_of_its_regions(tmp_path: Path) -> None:
    (tmp_path / "Counter.xml").write_text(COUNTER_XML)
    (tmp_path / "Counter.cpp").write_text(COUNTER_CPP)
    result = load(tmp_path, "Counter.xml")
    (design,) = result.project.designs
    assert (design.initial, design.frequency_hz, design.resume, design.time_unit) == ("Initial", 10, True, "ms")
    assert guards(design) == {"Initial": ["Look if "], "Look": ["Initial if ", "Initial if state_time > 2000"]}
    look = design.state("Look")
    assert look is not None
    assert (look.at, look.requires, [each.alias for each in look.modulates]) == ((338, 59), ("eyes",), ["head"])
    by_code, by_time = look.transitions
    assert by_time.guard.code is None
    assert by_code.guard.code is not None
    assert "_Head->stop();" in (by_code.guard.code.in_language("cpp") or "")
    assert design.module.in_language("cpp") == "#include <cmath>"
    assert notes(result) == [
        "Counter.cpp:25: the guard of 'Look2Initial1' stays C++ code",
        "Counter.cpp:34: not in the design: the region auxcode",
        "Counter.xml:1: Counter.h is not found: its code is left out",
    ]


def test_without_a_timer_the_stopwatch_counts_from_an_earlier_state_and_stays_an_input(tmp_path: Path) -> None:
    (tmp_path / "Counter.xml").write_text(COUNTER_XML.replace('timer="true"', 'timer="false"'))
    (tmp_path / "Counter.cpp").write_text(COUNTER_CPP)
    assert "state_time" not in str(guards(load(tmp_path, "Counter.xml").project.designs[0]))


def test_a_bica_file_has_an_input_for_each_transition(tmp_path: Path) -> None:
    (tmp_path / "walk.bica").write_text(
        '<component id="walk"><state initial="false" y="-9" x="-7" id="B"><activation id="legs"/></state>'
        '<state initial="true" y="1" x="2" id="A"/><component y="5" x="5" id="legs"/>'
        '<transition dst="B" src="A"/><transition dst="C" src="A"/></component>'
    )
    (tmp_path / "legs.bica").write_text('<component id="legs"><state id="S" initial="true"/></component>')
    result = load(tmp_path, "walk.bica")
    walk, legs = result.project.designs
    assert (walk.initial, walk.states[0].requires, legs.component) == ("A", ("legs",), "Legs")
    assert guards(walk) == {"B": [], "A": ["B if robot.A_2_B"]}
    assert notes(result) == ["walk.bica:1: 'C' is no state: the transition 'A_2_C' is left out"]


def test_flexbe_outcomes_are_read_from_components_and_machines(tmp_path: Path) -> None:
    (tmp_path / "fetch_sm.py").write_text(FLEXBE)
    result = load(tmp_path, "fetch_sm.py")
    fetch, approach = result.project.designs
    assert (fetch.component, fetch.initial, fetch.states[0].at) == ("Fetch", "Approach", (30, 40))
    assert guards(fetch) == {
        "Approach": [
            "Both if done(approach) and approach.outcome == ThereOrLost.there",
            "Approach_again if done(approach) and approach.outcome == ThereOrLost.lost",
        ],
        "Both": ["Grip_it if both.outcome == Done.done_"],
        "Grip_it": ["finished if grip_it.outcome == Finished.finished"],
        "Approach_again": ["Approach if "],
        "finished": [],
    }
    assert [*(fetch.states[-1].at or ())] == [30, 463]
    assert [each.doc for state in approach.states[:1] for each in state.transitions] == ["", "Autonomy level: High."]
    assert notes(result) == [
        "fetch_sm.py:13: not in the design: _state_machine.userdata.data = 0",
        "fetch_sm.py:33: what 'Both' runs in parallel is left out: it is one component to be written",
        "fetch_sm.py:35: the file of GripSM is not found: 'Grip it' is one component to be written",
        "fetch_sm.py:36: not in the design: target",
    ]
    (tmp_path / "grip_sm.py").write_text(FLEXBE.replace("FetchSM", "GripSM").replace("target", "'failed'"))
    assert len(load(tmp_path, "fetch_sm.py").project.designs) == 4


def test_yasmin_follows_outcomes_of_machines_without_transition_by_name(tmp_path: Path) -> None:
    (tmp_path / "patrol.xml").write_text(YASMIN)
    result = load(tmp_path, "patrol.xml")
    designs = {each.component: each for each in result.project.designs}
    assert designs["Patrol"].initial == "Go"
    assert guards(designs["Patrol"])["Go"] == [
        "Wait if done(go) and go.outcome == EndOrLost.lost",
        "end if done(go) and go.outcome == EndOrLost.end",
    ]
    assert notes(result) == [
        "patrol.xml:2: keys, parameters and remappings of 'Patrol' are left out",
        "patrol.xml:10: 'nowhere' is neither a state nor an outcome: the transition is left out",
        "patrol.xml:10: what 'Both' runs in parallel is left out: it is one component to be written",
    ]


def test_files_that_include_each_other_end_in_a_component(tmp_path: Path) -> None:
    inner = '<StateMachine name="S" file_path="{}"><Transition from="o" to="o"/></StateMachine>'
    body = f'<StateMachine outcomes="o">{inner}</StateMachine>'
    (tmp_path / "a.xml").write_text(body.format("b.xml"))
    (tmp_path / "b.xml").write_text(body.format("a.xml"))
    result = load(tmp_path, "a.xml")
    assert [each.component for each in result.project.components] == ["S", "S_2"]
    assert "contains it" in notes(result)[0]


@pytest.mark.parametrize("name", ["[", "**.xml", "x" * 5000, "/", ".", "..", "sub/../none.xml"])
def test_a_name_that_is_no_file_is_a_component(tmp_path: Path, name: str) -> None:
    inner = f'<StateMachine name="S" file_path="{name}"><Transition from="o" to="o"/></StateMachine>'
    (tmp_path / "a.xml").write_text(f'<StateMachine outcomes="o">{inner}</StateMachine>')
    assert "is not found: 'S' is one component to be written" in notes(load(tmp_path, "a.xml"))[0]


def run_outcomes(machines: dict[str, OutcomeMachine], key: str, choose: random.Random) -> Generator[str, None, str]:
    """An independent interpreter: the paths of the leaves as they run; returns the outcome."""
    machine = machines[key]
    states = {state.name: state for state in machine.states}
    name = machine.start
    while name not in machine.outcomes:
        state = states[name]
        if state.machine:
            outcome = yield from run_outcomes(machines, state.machine, choose)
        else:
            yield f"{machine.name}.{name}"
            outcome = choose.choice([each.outcome for each in state.transitions])
        name = next(each.to for each in state.transitions if each.outcome == outcome)
    return name


def random_machines(chance: random.Random) -> dict[str, OutcomeMachine]:
    machines: dict[str, OutcomeMachine] = {}
    for number in range(chance.randint(1, 4)):
        place, outcomes = (Path("f"), number), tuple(f"o{each}" for each in range(chance.randint(1, 3)))
        names = [f"M{number}S{each}" for each in range(chance.randint(1, 4))]
        states = []
        for name in names:
            inner = chance.choice([*machines, "", ""])
            ends = machines[inner].outcomes if inner else tuple(f"r{each}" for each in range(chance.randint(1, 3)))
            targets = [chance.choice([*names, *outcomes, *outcomes]) for _each in ends]
            transitions = (
                OutcomeTransition(outcome=outcome, to=to, place=place)
                for outcome, to in zip(ends, targets, strict=True)
            )
            states.append(OutcomeState(name=name, place=place, transitions=tuple(transitions), machine=inner))
        machines[f"M{number}"] = OutcomeMachine(
            name=f"M{number}", place=place, outcomes=outcomes, start=names[0], states=tuple(states)
        )
    return machines


@pytest.mark.parametrize("seed", range(100))
def test_designs_run_the_leaves_in_the_order_of_the_machines(seed: int) -> None:
    machines = random_machines(random.Random(seed))
    root = list(machines)[-1]
    walk, expected, end = run_outcomes(machines, root, random.Random(seed)), list[str](), ""
    try:
        while len(expected) < 40:
            expected.append(next(walk))
    except StopIteration as stop:
        end = stop.value
    project = convert_machines(machines, "p", Sources(folder=Path()))
    leaves = {each.component: each.outputs[0] for each in project.components if each.outputs}
    interpreter, choose, seen, before = Interpreter(project, root), random.Random(seed), list[str](), frozenset[str]()
    for tick in range(600):
        record = interpreter.step(tick * TICK_NS)
        active = frozenset(leaves.keys() & {each["component"] for each in record["tree"]})
        for leaf in active - before:
            seen.append(leaf)
            elements = project.enumeration(leaves[leaf].type)
            assert elements is not None
            interpreter.set_input(leaf, "outcome", f"{elements.name}.{choose.choice(elements.element_names[1:])}")
        before = active
        if len(seen) >= 40 or interpreter.is_done(root):
            break
    assert seen == [each.partition(".")[2] for each in expected]
    assert interpreter.is_done(root) == bool(end)


@pytest.mark.parametrize("seed", range(20))
def test_designs_of_vicode_take_the_transitions_that_its_step_function_takes(tmp_path: Path, seed: int) -> None:
    chance = random.Random(seed)
    names = ["Initial", *(f"S{number}" for number in range(3))]
    rows = [(source, chance.choice(names), chance.randrange(4)) for source in names for _each in range(3)]
    priorities = {source: chance.sample([1, 2, 3], 3) for source in names}
    states = "".join(f'<state id="{name.replace("Initial", "initial")}"/>' for name in names)
    shown, code, order = list[str](), list[str](), list[tuple[str, int, str, int]]()
    for number, (source, target, flag) in enumerate(rows):
        place = priorities[source][number % 3]
        shown.append(
            f'<transition id="T{number}" source="{source}" target="{target}" priority="{place}" timer="false"/>'
        )
        code.append(region(f"T{number}_transition_code", f"return _World->flag{flag}();"))
        order.append((source, place, target, flag))
    (tmp_path / "M.xml").write_text(f'<component id="M">{states}{"".join(shown)}</component>')
    (tmp_path / "M.cpp").write_text("".join(code))
    project = load(tmp_path, "M.xml").project
    (inputs,) = (each for each in project.components if each.outputs)
    numbers = {each.name: int(each.doc[-3]) for each in inputs.outputs}
    interpreter, state = Interpreter(project, "M"), "Initial"
    for tick in range(60):
        flags = [chance.random() < 0.3 for _flag in range(4)]
        for name, number in numbers.items():
            interpreter.set_input(inputs.component, name, flags[number])
        # The generated `step`: if / else if, by priority.
        taken = [target for source, _place, target, flag in sorted(order) if source == state and flags[flag]]
        state = next(iter(taken), state)
        (record,) = interpreter.step(tick * TICK_NS)["tree"]
        assert record["state"] == state


@pytest.mark.parametrize("name", ["fetch_sm.py", "patrol.xml", "Counter.xml", "Counter.cpp", "walk.bica"])
def test_damaged_files_give_errors_with_places(tmp_path: Path, name: str) -> None:
    (tmp_path / "Counter.xml").write_text(COUNTER_XML)
    bica = '<component id="walk">\n<state initial="true" id="A"/><transition dst="A" src="A"/></component>'
    whole = {"fetch_sm.py": FLEXBE, "patrol.xml": YASMIN, "Counter.xml": COUNTER_XML, "walk.bica": bica}
    text, chance = whole.get(name, COUNTER_CPP), random.Random(name)
    for _number in range(120):
        start = chance.randrange(len(text))
        piece = chance.choice(["", "<", '"', "'", "(", "\n", "}", "\0", "é", text[start : start + 30] * 2])
        (tmp_path / name).write_text(text[:start] + piece + text[start + chance.randint(0, 20) :], encoding="utf-8")
        read = tmp_path / ("Counter.xml" if name == "Counter.cpp" else name)
        if find_other_files(read):
            result, errors = load_other([read], tmp_path, "p")
            assert all(each.location and each.location.line >= 1 for each in errors)
            assert result.designs or errors


def test_the_command_writes_designs_that_keep_positions(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "patrol.xml").write_text(YASMIN)
    assert main(["import", str(tmp_path / "in"), "--out", str(tmp_path / "out")]) == 0
    assert "the designs cannot express 3 details of the files" in capsys.readouterr().out
    assert "at: [300, 20]" in (tmp_path / "out" / "Patrol.yaml").read_text()
    assert main(["check", str(tmp_path / "out")]) == 0
    (tmp_path / "in" / "patrol.xml").write_text('<!DOCTYPE x [<!ENTITY a "b">]>\n<StateMachine outcomes="&a;"/>')
    assert main(["import", str(tmp_path / "in"), "--out", str(tmp_path / "none")]) == 1
    assert "patrol.xml:1:1: error S805" in capsys.readouterr().err
    assert not (tmp_path / "none").exists()
