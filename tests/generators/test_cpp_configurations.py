"""The macros of bica.hpp: what they leave out, and that files compiled with different ones do not link."""

import re
import shutil
import subprocess
from itertools import permutations
from pathlib import Path

import pytest

from tests.cpp_tools import STANDARD, WARNINGS, find_gpp, outputs, start, write_project
from vicode.semantics import Interpreter
from vicode.store import open_project

PROJECT = """
vicode: 1
project: Door
languages: [cpp]
components:
  Panel: {implementation: world, outputs: {button: bool, position: float, ratio: {type: float, arguments: {x: float}}}}
  Motor: {implementation: world, parameters: {speed: float}}
  Lamp: {implementation: hands:Lamp, parameters: {level: float}}
"""
DOOR = """
vicode: 1
component: Controller
uses: {panel: Panel, motor: Motor, lamp: Lamp}
frequency: 50
outputs: {level: 0.1, n: 0, third: 1 / 3}
initial: Closed
states:
  Closed:
    actions: [{call: motor, with: {speed: 0.0}}, {set: {level: "clamp(level * 2 + 0.1, 0, 1)"}}]
    transitions: [{to: Opening, when: panel.button}]
  Opening:
    actions:
      - {call: motor, with: {speed: 0.5}}
      - {set: {level: "max(sqrt(abs(level)), n, 0.25) % 3", n: "round(level) + n"}}
    transitions:
      - {to: Open, when: panel.position > 0.95, id: arrived}
      - {to: Open, after: 8}
  Open:
    actions: [{call: lamp, with: {level: panel.ratio(x=level) + state_time}}]
    transitions: [{to: Closed, after: 5}]
"""
TEAM = """
vicode: 1
component: Player
initial: Wait
states:
  Wait: {transitions: [{to: Play, when: "true"}]}
  Play: {capacity: 1, transitions: [{to: Rest, after: 1}]}
  Rest: {synchronized: 2}
"""
MAIN = """
#include "door/components.hpp"

struct Robot final : door::World {
    bool button() override { return true; }
    bica::Real position() override { return 1.0F; }
    bica::Real ratio(bica::Real x) override { return x / 2.0F; }
    void motor(bica::Real) override {}
};
struct Lamp final : door::Lamp {
    using door::Lamp::Lamp;
    void work() override { level = static_cast<float>(parameters.level); }
    float level = 0.0F;
};

int main() {
    bica::Root root;
    Robot robot;
    Lamp lamp(root);
    door::Components components(root, robot, lamp);
    for (int tick = 0; tick < 400; ++tick) {
        root.step(components.controller, tick * bica::Nanoseconds{20'000'000});
    }
    return components.controller.state() == door::Controller::State::Open && lamp.level > 0.0F ? 0 : 1;
}
"""
CONFIGURATIONS = [
    "",
    "-DBICA_NO_HOST",
    "-DBICA_NO_NAMES",
    "-DBICA_FLOAT",
    "-fno-exceptions",
    "-DBICA_NO_HOST -DBICA_NO_NAMES -DBICA_FLOAT -fno-exceptions -fno-rtti",
]


@pytest.fixture(scope="module")
def door(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with the generated code of a door, its program, and object files of both in each configuration."""
    folder, compiler = tmp_path_factory.mktemp("door"), find_gpp()
    (folder / "project.yaml").write_text(PROJECT, encoding="utf-8")
    (folder / "door.yaml").write_text(DOOR, encoding="utf-8")
    write_project(folder, folder)
    (folder / "cpp" / "main.cpp").write_text(MAIN, encoding="utf-8")
    for number, flags in enumerate(CONFIGURATIONS):
        command = [compiler, *STANDARD, *WARNINGS, "-O1", *flags.split(), "-I.", "-c"]
        sources = (("main.cpp", "main"), ("door_unit.cpp", "door"))
        outputs([start([*command, source, "-o", f"{name}{number}.o"], folder / "cpp") for source, name in sources])
    return folder / "cpp"


def link(folder: Path, *objects: str) -> str:
    """Link; return the errors."""
    command = [find_gpp(), *objects, "-o", "program"]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False).stderr


@pytest.mark.parametrize("number", range(len(CONFIGURATIONS)), ids=lambda number: CONFIGURATIONS[number] or "default")
def test_a_program_runs_in_each_configuration(door: Path, number: int) -> None:
    assert link(door, f"main{number}.o", f"door{number}.o") == ""
    assert outputs([start(["./program"], door)]) == [""]


def test_files_of_different_configurations_do_not_link(door: Path) -> None:
    for first, second in permutations(range(len(CONFIGURATIONS)), 2):
        for objects in ((f"main{first}.o", f"door{second}.o"), (f"door{second}.o", f"main{first}.o")):
            assert "undefined reference to `door::" in link(door, *objects), (
                CONFIGURATIONS[first],
                CONFIGURATIONS[second],
            )


def test_two_configurations_share_no_symbol_of_the_runtime(door: Path) -> None:
    """Of a function that both define, a linker would keep one of them."""
    defined = []
    for number in range(len(CONFIGURATIONS)):
        text = "".join(outputs(start(["nm", "-C", f"{name}{number}.o"], door) for name in ("main", "door")))
        names = {line[19:] for line in text.splitlines() if line[17:18] in "TWVuBD"}
        defined.append({name for name in names if re.search(r"\b(bica|door)::", name)})
    assert all(len(names) > 20 for names in defined)
    for first, second in permutations(defined, 2):
        assert first & second == set()


def test_nothing_needs_the_heap_and_unused_names_are_left_out(door: Path) -> None:
    flags = ["-Os", *CONFIGURATIONS[-1].split(), "-ffunction-sections", "-fdata-sections"]
    command = [find_gpp(), *STANDARD, *flags, "-I.", "main.cpp", "door_unit.cpp", "-Wl,--gc-sections", "-o", "small"]
    outputs([start(command, door)])
    (symbols,) = outputs([start(["nm", "-C", "small"], door)])
    assert not re.search(r"operator (new|delete)|\bmalloc\b|\bfree\b|state_name|visit", symbols)
    outputs([start(["strip", "small"], door)])
    program = (door / "small").read_bytes()
    assert b"Opening" not in program
    assert b"position" not in program
    assert b"Controller\0" not in program


def test_a_default_build_needs_no_heap_either(door: Path) -> None:
    (symbols,) = outputs([start(["nm", "-C", "-u", "door1.o"], door)])
    assert not re.search(r"operator (new|delete)|\bmalloc\b|\bfree\b", symbols)


def test_states_of_teams_need_names(door: Path, tmp_path: Path) -> None:
    write_team(tmp_path)
    command = [find_gpp(), *STANDARD, "-DBICA_NO_NAMES", "-I.", "-fsyntax-only", "team_unit.cpp"]
    done = subprocess.run(command, cwd=tmp_path / "cpp", capture_output=True, text=True, check=False)
    assert "compile without BICA_NO_NAMES" in done.stderr


def write_team(folder: Path, design: str = TEAM) -> None:
    (folder / "project.yaml").write_text("vicode: 1\nproject: Team\nlanguages: [cpp]\n", encoding="utf-8")
    (folder / "player.yaml").write_text(design, encoding="utf-8")
    write_project(folder, folder)


def test_a_robot_whose_program_exchanges_no_messages_is_alone_in_its_team(tmp_path: Path) -> None:
    write_team(tmp_path, TEAM.replace("synchronized: 2", "synchronized: 1"))
    (tmp_path / "cpp" / "main.cpp").write_text(
        """
#include <cstdio>

#include "team/components.hpp"

int main() {
    bica::Root root;
    team::Components components(root);
    root.team.ticks = 3;
    for (int iteration = 0; iteration < 12; ++iteration) {
        root.step(components.player, iteration * 400'000'000LL);
        std::puts(components.player.state_name());
    }
    return 0;
}
""",
        encoding="utf-8",
    )
    command = [find_gpp(), *STANDARD, *WARNINGS, "-I.", "main.cpp", "team_unit.cpp", "-o", "program"]
    outputs([start(command, tmp_path / "cpp")])
    (printed,) = outputs([start(["./program"], tmp_path / "cpp")])
    robot = Interpreter(open_project(tmp_path).project, "Player", team_ticks=3)
    expected = [robot.step(number * 400_000_000)["tree"][0]["state"] for number in range(12)]
    assert printed.split() == expected
    assert set(expected) == {"Wait", "Play", "Rest"}


def test_components_and_root_may_be_destroyed_in_any_order(tmp_path: Path) -> None:
    """The address sanitizer finds no use after the end of a lifetime; the team hears only of components that exist."""
    write_team(tmp_path)
    (tmp_path / "cpp" / "main.cpp").write_text(
        """
#include <cstdio>
#include <memory>

#include "team/components.hpp"

std::size_t told(bica::Root& root, team::Components& components) {
    root.team.prepare();
    root.step(components.player, 0);
    return root.team.tell().near.size;
}

int main() {
    auto root = std::make_unique<bica::Root>();
    auto first = std::make_unique<team::Components>(*root);
    auto second = std::make_unique<team::Components>(*root);
    auto third = std::make_unique<team::Components>(*root);
    std::printf("%zu", told(*root, *second));
    second.reset();
    std::printf(" %zu", told(*root, *third));
    third.reset();
    std::printf(" %zu", told(*root, *first));
    first.reset();
    root->team.prepare();
    std::printf(" %zu", root->team.tell().near.size);
    first = std::make_unique<team::Components>(*root);
    std::printf(" %zu\\n", told(*root, *first));
    root.reset();
    first.reset();
    return 0;
}
""",
        encoding="utf-8",
    )
    flags = ["-g", "-fsanitize=address,undefined", "-fno-sanitize-recover"]
    command = [find_gpp(), *STANDARD, *WARNINGS, *flags, "-I.", "main.cpp", "team_unit.cpp", "-o", "program"]
    outputs([start(command, tmp_path / "cpp")])
    assert outputs([start(["./program"], tmp_path / "cpp")]) == ["2 2 2 0 2\n"]


@pytest.mark.skipif(shutil.which("clang++") is None, reason="clang is missing: sudo apt install clang")
@pytest.mark.parametrize("flags", CONFIGURATIONS, ids=lambda flags: flags or "default")
def test_clang_compiles_each_configuration_without_warnings(door: Path, flags: str) -> None:
    command = ["clang++", *STANDARD, *WARNINGS, "-Wnon-virtual-dtor", *flags.split(), "-I.", "-fsyntax-only"]
    assert outputs(start([*command, source], door) for source in ("main.cpp", "door_unit.cpp")) == ["", ""]
