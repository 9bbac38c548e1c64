"""SCXML becomes designs; what cannot be expressed is refused with its line."""

from dataclasses import replace
from pathlib import Path

import pytest

from vicode.cli.entry_point import main
from vicode.importers.scxml import ScxmlError, import_scxml
from vicode.importers.scxml.writer import write_scxml
from vicode.model.design import Stay, Transition
from vicode.store import open_project

HEAD = '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0">\n'
LAMP = f"""{HEAD}
  <datamodel><data id="count" expr="0"/><data id="on" expr="true"/></datamodel>
  <state id="dark">
    <onentry><send event="late" delay="500ms"/></onentry>
    <transition event="late" cond="on &amp;&amp; !(count &gt;= 3)" target="lit"/>
    <transition event="break.*" target="broken"/>
  </state>
  <state id="lit">
    <onentry><assign location="count" expr="Math.max(count, 0) + 1"/><log expr="count"/></onentry>
    <transition event="press" target="dark"/>
    <transition event="break.now" cond="count != 2"/>
  </state>
  <final id="broken"/>
</scxml>
"""


def test_a_flat_machine_is_a_design_with_the_same_states(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "lamp.scxml").write_text(LAMP, encoding="utf-8")
    assert main(["import", str(tmp_path / "lamp.scxml"), "--out", str(tmp_path / "lamp")]) == 0
    assert capsys.readouterr().out.endswith("1 design, 3 states, 1 hand-written component, 0 agents, 0 comments\n")
    (design,) = open_project(tmp_path / "lamp").project.designs
    dark, lit, broken = design.states
    assert [state.name for state in design.states] == ["dark", "lit", "broken"]
    first, second = dark.transitions
    assert isinstance(first, Transition)
    assert (first.to, first.guard.after, first.guard.when) == ("lit", "0.5", "on and (not (count >= 3))")
    assert isinstance(second, Transition)
    assert second.guard.when == "events.break_ or events.break_now"
    assert isinstance(lit.transitions[1], Stay)
    assert [action.values for action in lit.enter] == [(("count", "max(count, 0) + 1"),)]  # type: ignore[union-attr]
    assert broken.final
    assert main(["check", str(tmp_path / "lamp")]) == 0
    capsys.readouterr()
    assert main(["import", str(tmp_path / "lamp.scxml"), "--out", str(tmp_path / "lamp")]) == 1
    assert "would be overwritten" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("body", "code", "line", "words"),
    [
        ("<parallel id='p'/>", "S802", 2, "one state at a time"),
        ("<state id='a'>\n<history id='h'/></state>", "S802", 3, "<history>"),
        ("<state id='a'>\n<onentry><raise event='e'/></onentry></state>", "S802", 3, "queue of events"),
        ("<state id='a'>\n<onentry><send event='e'/></onentry></state>", "S802", 3, "only a delayed event"),
        ("<state id='a'>\n<onentry><script/></onentry></state>", "S802", 3, "<script>"),
        (
            "<state id='a'>\n<transition event='e'><assign location='x' expr='1'/></transition></state>",
            "S802",
            3,
            "without a target",
        ),
        ("<state id='a'>\n<transition target='b'/></state>", "S803", 3, "unknown state 'b'"),
        ("<state id='a'>\n<transition cond='x &gt; 1' target='a'/></state>", "S803", 3, "unknown name 'x'"),
        ('<state id="a">\n<transition cond="1 == \'a\'" target="a"/></state>', "S803", 3, "no texts"),
        ("<state id='a'/><state id='a'/>", "S803", 2, "two states"),
        ("", "S803", 1, "no states"),
        ("<state id='a'>", "S801", 3, "not well-formed"),
    ],
)
def test_what_designs_cannot_express_is_refused(body: str, code: str, line: int, words: str) -> None:
    with pytest.raises(ScxmlError, match=words) as error:
        import_scxml(f"{HEAD}{body}\n</scxml>".encode(), "Machine", "test")
    assert (error.value.code, error.value.line) == (code, line)


@pytest.mark.parametrize(
    "prolog",
    ['<!DOCTYPE scxml [<!ENTITY a "b">]>', '<!DOCTYPE scxml SYSTEM "file:///etc/passwd">', "<!DOCTYPE scxml>"],
)
def test_entities_are_refused(prolog: str) -> None:
    with pytest.raises(ScxmlError, match="document types and entities are refused"):
        import_scxml(f"{prolog}\n{HEAD}<state id='a'/></scxml>".encode(), "Machine", "test")


def test_the_command_prints_file_line_and_reason(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "two.scxml").write_text(f"{HEAD}<parallel/></scxml>", encoding="utf-8")
    assert main(["import", str(tmp_path / "two.scxml"), "--out", str(tmp_path / "out")]) == 1
    said = capsys.readouterr().err
    assert "two.scxml:2:1: error S802 not-in-designs: <parallel>: a design is in one state at a time" in said
    assert not (tmp_path / "out").exists()


def test_an_exported_design_imports_as_the_same_design(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "lamp.scxml").write_text(LAMP, encoding="utf-8")
    assert main(["import", str(tmp_path / "lamp.scxml"), "--out", str(tmp_path / "lamp")]) == 0
    (design,) = open_project(tmp_path / "lamp").project.designs
    lit = design.states[1]
    single = replace(design, states=(replace(design.states[0], transitions=design.states[0].transitions[:1]), lit))
    again = import_scxml(write_scxml(single).encode(), "Lamp", "lamp").designs[0]
    assert [(each.name, each.enter, each.leave) for each in again.states] == [
        (each.name, each.enter, each.leave) for each in single.states
    ]
    assert [each.guard for each in again.states[0].transitions] == [each.guard for each in single.states[0].transitions]
    assert [type(each) for each in again.states[1].transitions] == [type(each) for each in lit.transitions]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("frequency: 5\ninitial: A\nstates: {A: {}}", "frequency"),
        ("uses: {l: Legs}\ninitial: A\nstates: {A: {modulates: [l]}}", "modulates (state A)"),
        ("variables: {n: 0}\ninitial: A\nstates: {A: {enter: [{set: {n: n // 2}}]}}", "no operator '//'"),
    ],
)
def test_what_scxml_cannot_say_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, words: str
) -> None:
    (tmp_path / "a.yaml").write_text(f"vicode: 1\ncomponent: A1\n{text}\n", encoding="utf-8")
    assert main(["export", str(tmp_path / "a.yaml"), "--format", "scxml"]) == 1
    assert words in capsys.readouterr().err
    assert not (tmp_path / "a.scxml").exists()
