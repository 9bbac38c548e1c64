"""Imported machines enter the states that the compiled sources enter, for random machines and inputs."""

import random
import re
from pathlib import Path

from tests.cpp_tools import find_gpp
from tests.importers import cpp_oracle
from vicode.importers.cpp import CppImport, import_cpp
from vicode.semantics import Interpreter
from vicode.services.imported_behavior.cpp_sources import without_code

FRAMES = 150


def test_options_reach_the_same_states_as_the_compiled_program(tmp_path: Path) -> None:
    numbers = range(12)
    writer, chooser = cpp_oracle.CabslWriter(seed=7), random.Random(3)
    behaviors = [writer.behavior(number) for number in numbers]
    frames, time = [], 0
    for _ in range(FRAMES):
        time += chooser.choice([10, 20, 30])
        flags = [chooser.randrange(2) for _ in range(4)]
        frames.append(
            (*flags, chooser.choice([-1, 0.5, 1, 2, 3]), chooser.choice([0, 1, 2.5]), chooser.randrange(3), time)
        )
    source = cpp_oracle.CABSL + "".join(behaviors) + cpp_oracle.cabsl_main(numbers)
    printed = cpp_oracle.run_program(source, [" ".join(map(str, frame)) for frame in frames], tmp_path, find_gpp())
    visited = set()
    for number, behavior in zip(numbers, behaviors, strict=True):
        imported = import_cpp({Path("behavior.cpp"): behavior}, "behavior")
        robot = _interpreter(imported, f"Main{number}")
        for frame, line in zip(frames, printed, strict=True):
            for machine in imported.machines.values():
                interface = machine.conditions.interface()
                for output in interface.outputs if interface else ():
                    value = _field_value(output.doc, frame)
                    is_mode = output.type not in ("bool", "float")
                    shown = f"{output.type}.{value}" if is_mode and _has_element(imported, value) else value
                    shown = f"{output.type}.other_value" if is_mode and shown == value else shown
                    robot.set_input(machine.conditions.component, output.name, shown)
            robot.step(frame[-1] * 1_000_000)
            states = [robot.memory.components[f"{name}{number}"].state for name in ("Main", "Part")]
            assert "/".join(states) == line.split()[number], (behavior, frame)
            visited |= {(number, state) for state in states}
    assert len(visited) > 30


def _interpreter(imported: CppImport, root: str) -> Interpreter:
    return Interpreter(without_code(imported.result.project), root)


def _has_element(imported: CppImport, value: object) -> bool:
    return any(value in each.element_names for each in imported.result.project.enumerations)


def _field_value(text: str, frame: tuple[float, ...]) -> object:
    """The value of a C++ text that the generator writes."""
    if text == "theField.mode":
        return cpp_oracle.MODES[int(frame[6])]
    if text == "theField.x(0) < theField.x(1)":
        return frame[4] < frame[5]
    if text == "theField.x(1) < theField.x(0)":
        return frame[5] < frame[4]
    if text == "theField.x(0) == theField.x(1)":
        return frame[4] == frame[5]
    found = re.fullmatch(r"theField\.(seen|x)\((\d)\)", text)
    assert found, text
    return bool(frame[int(found[2])]) if found[1] == "seen" else float(frame[4 + int(found[2])])


def test_tables_reach_the_same_states_as_the_compiled_program(tmp_path: Path) -> None:
    machines = list(cpp_oracle.sml_machines(seed=5, count=12))
    source = cpp_oracle.SML + "".join(machines) + cpp_oracle.sml_main(len(machines))
    chooser = random.Random(9)
    frames = [tuple(chooser.randrange(2) for _ in range(3)) for _ in range(FRAMES)]
    printed = cpp_oracle.run_program(source, [" ".join(map(str, each)) for each in frames], tmp_path, find_gpp())
    visited = set()
    for number, text in enumerate(machines):
        imported = import_cpp({Path("machine.cpp"): text}, "machine")
        name = f"M{number}"
        robot = Interpreter(imported.result.project, name)
        interface = imported.machines[name].conditions.interface()
        assert interface is not None
        for time, (frame, line) in enumerate(zip(frames, printed, strict=True)):
            _event, first, second = frame
            # The second iteration takes the row without event.
            for event in ("go" if frame[0] else "halt", "other_value"):
                for output in interface.outputs:
                    happens = {"go": event == "go", "halt": event == "halt", "first": first, "second": second}
                    value = bool(happens[output.doc]) if output.type == "bool" else f"{output.type}.{event}"
                    robot.set_input(interface.component, output.name, value)
                robot.step(2 * time + (event == "other_value"))
            assert robot.memory.components[name].state == line.split()[number], (text, time)
            visited.add((number, line.split()[number]))
    assert len(visited) > 20
