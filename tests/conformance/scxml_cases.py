"""SCXML documents that show what tests of the W3C suite show (https://www.w3.org/Voice/2013/scxml-irp/), in own words.

The comment at the start of a document has the events of each iteration, and the states that the design passes.
"""

import re
from pathlib import Path

from vicode.conformance.inputs import ConformanceRun, RunStep, list_inputs
from vicode.importers.design_names import to_design_name
from vicode.importers.scxml import import_scxml

DOCUMENTS = sorted((Path(__file__).parent / "scxml").glob("*.scxml"))


def scxml_run(file: Path) -> ConformanceRun:
    """The run of a document; each event lasts one iteration."""
    project = import_scxml(file.read_bytes(), "Machine", "scxml").project
    events = [each.key for each in list_inputs(project, "Machine")]
    steps = []
    for index, given in enumerate(_read(file, "inputs").split()):
        names = {to_design_name(event) for event in given.split("+")}
        steps.append(RunStep(time_ns=index * 100_000_000, inputs=({key: key[1] in names for key in events},)))
    return ConformanceRun(project=project, root="Machine", steps=tuple(steps))


def expected_states(file: Path) -> str:
    return _read(file, "states")


def _read(file: Path, name: str) -> str:
    found = re.search(rf"^{name}: (.*)$", file.read_text(encoding="utf-8"), re.MULTILINE)
    assert found is not None
    return found[1]
