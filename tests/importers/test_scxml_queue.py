"""With an event queue, an imported document passes the states that SCXML interpreters pass, in Python and C++.

The comment at the start of each document in `scxml_queue/` has the events, all posted at once except after a pause such
as `+100ms`, and the states without children that SCION 4.3 enters. python-statemachine 3.2 enters the same, except
in `delayed_events`, where it takes another transition.
"""

import re
import subprocess
import sys
from itertools import groupby
from pathlib import Path

import pytest

from tests.cpp_tools import STANDARD, WARNINGS, find_gpp, outputs, start, write_project
from vicode.cli.entry_point import main
from vicode.importers.scxml import Exactness, import_scxml

DOCUMENTS = sorted((Path(__file__).parent / "scxml_queue").glob("*.scxml"))
TICK_MS = 10
# Long enough for each document to take all of its transitions.
LAST_ITERATIONS = 100

PYTHON = """
import importlib, sys
from vicode.bica import Root, SimulatedClock
package = sys.argv[1]
module = importlib.import_module(f"{package}.machine")
clock = SimulatedClock()
root = Root(module.Machine, clock=clock, on_error="stop")
events = root.component(importlib.import_module("events").Events)
for command in sys.stdin.read().split():
    if command == "step":
        root.step()
        print(root.main.state)
        clock.advance(10_000_000)
    else:
        events.post(command)
"""

CPP = """
#include <cstring>
#include <iostream>
#include <string>
{% includes %}

template <class Components, class Queue>
int run() {
    bica::Root root;
    Queue events(root);
    Components components(root, events);
    bica::Nanoseconds now = 0;
    for (std::string command; std::cin >> command;) {
        if (command == "step") {
            root.step(components.machine, now);
            std::cout << components.machine.state_name() << "\\n";
            now += 10'000'000;
        } else {
            events.post(command);
        }
    }
    return 0;
}

int main(int, char** arguments) {
    const std::string name = arguments[1];
{% cases %}
    return 2;
}
"""


def _header(document: Path, name: str) -> list[str]:
    found = re.search(rf"^{name}: (.*)$", document.read_text(encoding="utf-8"), re.MULTILINE)
    assert found is not None
    return found[1].split()


def _commands(document: Path) -> str:
    commands = list[str]()
    for given in _header(document, "events"):
        pause = re.fullmatch(r"\+(\d+)ms", given)
        commands += ["step"] * (int(pause[1]) // TICK_MS) if pause else [given]
    return "\n".join([*commands, *["step"] * LAST_ITERATIONS])


def _entered(document: Path, initial: str, printed: str) -> list[str]:
    """The states of the document that a run enters, without those in between."""
    known = dict.fromkeys(re.findall(r'<(?:state|final) id="(\w+)"', document.read_text(encoding="utf-8")))
    # A name that is a keyword has a trailing `_`.
    states = [state.removesuffix("_") for state, _repeated in groupby([initial, *printed.split()])]
    return [state for state in states if state in known]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The imported documents, each in a folder with its generated Python."""
    folder = tmp_path_factory.mktemp("queue")
    for document in DOCUMENTS:
        machine = folder / "machine.scxml"
        machine.write_text(document.read_text(encoding="utf-8"), encoding="utf-8")
        project = folder / document.stem
        assert main(["import", str(machine), "--out", str(project), "--event-queue"]) == 0
        assert main(["gen", str(project), "--out", str(project)]) == 0
    return folder


@pytest.fixture(scope="module")
def program(folder: Path) -> Path:
    """One program with all imported documents."""
    gpp = find_gpp()
    names = [document.stem for document in DOCUMENTS]
    units = [write_project(folder / name, folder / "code" / name) for name in names]
    includes = [f'#include "{folder}/{name}/events.hpp"\n#include "{name}/components.hpp"' for name in names]
    cases = [f'    if (name == "{name}") return run<{name}::Components, {name}::EventQueue>();' for name in names]
    source = CPP.replace("{% includes %}", "\n".join(includes)).replace("{% cases %}", "\n".join(cases))
    (folder / "main.cpp").write_text(source, encoding="utf-8")
    paths = [f"-I{folder / 'code' / name / 'cpp'}" for name in names]
    sources = [f"{folder}/code/{name}/cpp/{unit}_unit.cpp" for name, unit in zip(names, units, strict=True)]
    outputs([start([gpp, *STANDARD, *WARNINGS, *paths, "main.cpp", *sources, "-o", "machines"], folder)])
    return folder / "machines"


def _initial(document: Path) -> str:
    imported = import_scxml(document.read_bytes(), "Machine", document.stem, has_queue=True)
    return imported.project.designs[0].initial


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda document: document.stem)
def test_python_passes_the_states_of_the_document(folder: Path, document: Path) -> None:
    project = folder / document.stem
    run = subprocess.run(
        [sys.executable, "-c", PYTHON, document.stem],
        env={"PYTHONPATH": f"{project / 'python'}:{project}:{Path(__file__).parents[2]}"},
        input=_commands(document),
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    assert _entered(document, _initial(document), run.stdout) == _header(document, "states")


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda document: document.stem)
def test_cpp_passes_the_states_of_the_document(program: Path, document: Path) -> None:
    run = subprocess.run(
        [program, document.stem], input=_commands(document), capture_output=True, text=True, timeout=60, check=True
    )
    assert _entered(document, _initial(document), run.stdout) == _header(document, "states")


def test_imported_projects_have_no_errors(folder: Path) -> None:
    assert main(["check", *(str(folder / document.stem) for document in DOCUMENTS)]) == 0


def test_languages_agree_on_a_design_with_a_queue(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    find_gpp()
    assert main(["conform", str(folder / "internal_before_external" / "machine.yaml"), "--iterations", "60"]) == 0
    printed = capsys.readouterr().out
    assert re.search(r"Machine: reference, Python, C\+\+(, JavaScript)? and simulator agree in 60 iterations", printed)


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda document: document.stem)
def test_no_transition_loses_events(document: Path) -> None:
    imported = import_scxml(document.read_bytes(), "Machine", document.stem, has_queue=True)
    assert {each.exactness for each in imported.transitions} <= {Exactness.EXACT, Exactness.LATER}
