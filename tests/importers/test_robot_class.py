"""The generated robot class works as the world of generated Python and of the XABSL engine."""

from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

import pytest

from tests.importers.differential_harness import GeneratedPythonRun, import_checked
from tests.importers.test_imported_designs import texts
from tests.xabsl.xabsl_cases import CASES, PROGRAMS, load_texts
from vicode.importers import render_robot_class
from vicode.importers.design_names import to_design_name
from vicode.xabsl.compiler import declared_symbols
from vicode.xabsl.engine import Engine
from vicode.xabsl.source_loader import ProgramSource, load_source


def create_robot(text: str, folder: Path) -> Any:
    path = folder / "robot.py"
    path.write_text(text, encoding="utf-8")
    spec = spec_from_file_location("robot", path)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.Robot()


@pytest.mark.parametrize("program", [*PROGRAMS, "odd names"])
def test_robot_class_works_with_both_programs(program: str, tmp_path: Path) -> None:
    path = CASES / "programs" / program / "agents.xabsl"
    source: ProgramSource = load_source(path) if program in PROGRAMS else load_texts(texts())
    imported, compiled = import_checked(source)
    assert compiled.program is not None
    robot = create_robot(render_robot_class(imported.project), tmp_path)
    symbols = declared_symbols(compiled.table)
    engine = Engine(compiled.program, robot, symbols=symbols, clock=lambda: 5)
    agent = compiled.program.agents[0][0]
    python = GeneratedPythonRun(imported.project, compiled, agent, tmp_path)
    python.root.world = robot
    for component in python.root.components:
        component.world = robot
    for _ in range(5):
        engine.execute()
        python.root.step()
    active = {to_design_name(option.name): to_design_name(option.state) for option in engine.active_options}
    states = {type(component).__name__: component.state for component in python.root.components}
    assert active
    if program in PROGRAMS:
        assert active.items() <= states.items()


def test_texts_stay_inside_comments(tmp_path: Path) -> None:
    files = texts()
    evil = 'x */ """ \n raise SystemExit'
    files["Symbols/ball.xabsl"] = (
        files["Symbols/ball.xabsl"].replace("how far", evil.replace("*/", "")).replace('"The ball"', '"a\nimport os"')
    )
    imported, _compiled = import_checked(load_texts(files))
    text = render_robot_class(imported.project)
    assert "(in mm; 0 to 9000)" in text
    robot = create_robot(text, tmp_path)
    assert robot.ball_distance == 0
    assert robot.class_ is False
    assert robot.angle(to_x=1) == 0
    assert robot._seen == "left"
