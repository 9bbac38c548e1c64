"""Regions of <parallel> are designs that are called; with idle iterations between events, they pass the same states."""

import random
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.importers.scxml_oracle import NotStableError, Oracle, RandomDocument
from vicode.cli.entry_point import main
from vicode.importers.scxml import Exactness, ScxmlError, ScxmlImport, import_scxml
from vicode.semantics.interpreter import Interpreter

# Each microstep takes at most two iterations.
IDLE = 16


class _Run:
    """The imported designs; each event lasts one iteration."""

    def __init__(self, imported: ScxmlImport) -> None:
        self.imported = imported
        self.interpreter = Interpreter(imported.project, "Machine")
        self.now = 0
        self.records: list[dict[str, Any]] = []

    def step(self, event: str = "") -> None:
        events = self.imported.events
        given = events.inputs.of_event(event) if event else None
        for name in events.inputs.names.values():
            self.interpreter.set_input(events.name, name, name == given)
        self.records = self.interpreter.step(self.now)["tree"]
        self.now += 100_000_000

    def configuration(self) -> set[str]:
        """The active states without children or regions."""
        designs = {design.component: design for design in self.imported.project.designs}
        states = [
            next(state for state in designs[each["component"]].states if state.name == each["state"])
            for each in self.records
            if each["component"] in designs
        ]
        return {each.name for each in states if not each.modulates}

    def data(self, names: set[str]) -> dict[str, float]:
        return {
            name: value
            for component in self.interpreter.memory.components.values()
            for name, value in component.values.items()
            if name in names
        }


def compare(text: str, imported: ScxmlImport, events: list[str], idle: int) -> None:
    """Compare a document with its designs after each event.

    Raises:
        NotStableError: The document takes transitions for ever.
    """
    oracle, run = Oracle(text), _Run(imported)
    for event in ["", *events]:
        if event:
            oracle.send(event)
        run.step(event)
        for _iteration in range(idle if event else IDLE):
            run.step()
        assert run.configuration() == oracle.configuration(), (text, events, event)
        data = {name: float(value) for name, value in oracle.data.items()}
        assert run.data(set(data)) == data, (text, events, event)
        if not oracle.is_running:
            return


HEAD = '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0">'


@settings(max_examples=settings().max_examples * 2)
@given(st.integers(0, 100_000))
def test_random_documents_pass_the_states_of_the_algorithm(seed: int) -> None:
    document = RandomDocument(seed)
    text = document.write()
    try:
        imported = import_scxml(text.replace('<scxml version="1.0">', HEAD).encode(), "Machine", "test")
    except ScxmlError:
        return
    choose = random.Random(seed)
    events = [choose.choice(sorted(document.events) or ["none"]) for _ in range(25)]
    try:
        compare(text, imported, events, IDLE)
        if all(each.exactness is Exactness.EXACT for each in imported.transitions):
            compare(text, imported, events, 0)
    except NotStableError:
        return


REGIONS = """
<datamodel><data id="n" expr="0"/></datamodel>
<state id="idle"><transition event="go" target="p"/></state>
<parallel id="p"><transition event="stop" target="idle"/><transition event="done.state.p" cond="n == 1" target="end"/>
<state id="arm"><state id="up"><transition event="go" target="down"/></state>
<state id="down"><onentry><assign location="n" expr="n + 1"/></onentry><transition event="e" target="armed"/></state>
<final id="armed"/></state>
<state id="leg"><state id="still">
<transition event="walk" target="gone"/></state><final id="gone"/></state>
</parallel>
<final id="end"/>
"""


def test_regions_are_designs_that_the_parallel_state_calls(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "robot.scxml").write_text(f"{HEAD}{REGIONS}</scxml>", encoding="utf-8")
    assert main(["import", str(tmp_path / "robot.scxml"), "--out", str(tmp_path / "out")]) == 0
    assert "3 designs" in capsys.readouterr().out
    assert {path.name for path in (tmp_path / "out").glob("*.yaml")} == {
        *("project.yaml", "robot.yaml", "arm.yaml", "leg.yaml"),
    }
    assert main(["check", str(tmp_path / "out")]) == 0
    imported = import_scxml(f"{HEAD}{REGIONS}</scxml>".encode(), "Machine", "test")
    compare(f'<scxml version="1.0">{REGIONS}</scxml>', imported, ["go", "go", "stop", "go", "walk", "go", "e"], IDLE)


@pytest.mark.parametrize(
    ("old", "new", "line", "words"),
    [
        ('event="walk"', 'event="stop"', 9, "takes an event that leaves 'p'"),
        ('event="walk" target="gone"', 'event="walk" target="idle"', 9, "leaves the region 'leg'"),
        ('event="go" target="p"', 'event="go" target="down"', 3, "enters the region 'arm' alone"),
        ('event="walk"', 'event="walk" cond="In(\'down\')"', 9, "In\\('down'\\) is in another region"),
        ('event="walk"', 'event="done.state.arm"', 9, "'done.state.arm' is raised in another region"),
        ('event="walk"', 'event="walk" cond="n == 1"', 9, "'n' is assigned, and used in other regions"),
        ('<final id="gone"/>', '<onexit><assign location="n" expr="1"/></onexit>', 9, "<onexit> of 'leg'"),
    ],
)
def test_what_regions_cannot_share_is_refused(old: str, new: str, line: int, words: str) -> None:
    document = f"{HEAD}{REGIONS}</scxml>"
    assert document.count(old) == 1
    with pytest.raises(ScxmlError, match=words) as error:
        import_scxml(document.replace(old, new).encode(), "Machine", "test")
    assert (error.value.code, error.value.line) == ("S802", line)


def test_parallel_is_refused_with_an_event_queue() -> None:
    with pytest.raises(ScxmlError, match="with an event queue"):
        import_scxml(f"{HEAD}{REGIONS}</scxml>".encode(), "Machine", "test", has_queue=True)


def test_a_region_that_is_left_on_its_way_is_reported() -> None:
    later = REGIONS.replace('event="walk" target="gone"/>', 'event="walk" target="gone"><log/></transition>')
    eventless = later.replace('<final id="gone"/>', '<state id="gone"><transition target="still"/></state>')
    imported = import_scxml(f"{HEAD}{eventless}</scxml>".encode(), "Machine", "test")
    reasons = [each.reason for each in imported.transitions if each.exactness is Exactness.DIFFERENT]
    assert reasons == ["'still' is not entered if 'p' is left in this iteration"]


def test_regions_need_no_ids() -> None:
    region = '<state><state><transition event="e" target="a"/></state></state>'
    body = f'<state id="a"><transition event="go" target="p"/></state><parallel id="p">{region}{region}</parallel>'
    body = body.replace('target="a"', "")
    assert len(import_scxml(f"{HEAD}{body}</scxml>".encode(), "Machine", "test").project.designs) == 3
