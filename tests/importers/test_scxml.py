"""SCXML becomes designs; what cannot be expressed is refused with its line."""

from dataclasses import replace
from pathlib import Path

import pytest

from vicode.cli.entry_point import main
from vicode.diagram.scxml import write_scxml
from vicode.importers.scxml import ScxmlError, import_scxml
from vicode.model.design import Assign, Stay, Transition
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
    said = capsys.readouterr().out
    assert "1 design, 3 states, 1 hand-written component, 0 agents, 0 comments\n4 transitions: 4 exact\n" in said
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
        ("<parallel id='p'/>", "S803", 2, "without a region"),
        ("<state id='a'>\n<history id='h'/></state>", "S802", 3, "<history>"),
        ("<state id='a'>\n<onentry><raise event='e'/></onentry></state>", "S802", 3, "no queue of events"),
        ("<state id='a'>\n<onexit><cancel sendid='x'/></onexit></state>", "S802", 3, "<cancel>"),
        (
            (
                "<state id='a'><onentry><send event='e.x' delay='1s'/></onentry>"
                "<transition event='e' target='b'/></state>"
                "<state id='b'>\n<transition event='*' target='a'/></state>"
            ),
            "S802",
            2,
            "used outside of 'a'",
        ),
        ("<state id='a'>\n<transition event='a&quot;b' target='a'/></state>", "S803", 3, "not the name of an event"),
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
    assert "two.scxml:2:1: error S803 bad-scxml: <parallel> without a region" in said
    assert not (tmp_path / "out").exists()


def test_an_exported_design_imports_as_the_same_design(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "lamp.scxml").write_text(LAMP, encoding="utf-8")
    assert main(["import", str(tmp_path / "lamp.scxml"), "--out", str(tmp_path / "lamp")]) == 0
    (design,) = open_project(tmp_path / "lamp").project.designs
    lit = design.states[1]
    single = replace(design, states=(replace(design.states[0], transitions=design.states[0].transitions[:1]), lit))
    again = import_scxml(write_scxml(single).encode(), "Lamp", "lamp").project.designs[0]
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


def _report(body: str, *, has_queue: bool = False) -> tuple[list[tuple[int, str, str]], list[str]]:
    """The reports on transitions as line, exactness and reason, and the notes."""
    document = f'<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0">\n{body}\n</scxml>'
    imported = import_scxml(document.encode(), "Machine", "test", has_queue=has_queue)
    reports = [(each.line, each.exactness.value, each.reason) for each in imported.transitions]
    return reports, [text for _line, text in imported.notes]


LOSSY = "may lose events"
ON_THE_WAY = """<state id="a"><transition event="go" target="b"/></state>
<state id="b"><transition target="c"/></state>
<state id="c"><transition event="e.f g" target="d"><assign location="n" expr="n + 1"/></transition></state>
<state id="d"><transition event="*" target="a"/></state>
<datamodel><data id="n" expr="0"/></datamodel>"""


def test_an_event_that_arrives_on_the_way_is_lost() -> None:
    reports, notes = _report(ON_THE_WAY)
    assert reports == [
        (2, "exact", ""),
        (3, LOSSY, "it takes an iteration of its own; e.f, g are lost if arriving in this iteration"),
        (
            4,
            "may lose events",
            "'d' is entered one iteration later; other events are lost if arriving in this iteration",
        ),
        (5, "exact", ""),
    ]
    assert notes == ["of events that arrive before the same iteration, only one is taken"]


def test_no_event_is_lost_with_a_queue() -> None:
    reports, notes = _report(ON_THE_WAY, has_queue=True)
    assert [exactness for _line, exactness, _reason in reports] == ["exact", "later", "later", "exact"]
    assert not [text for text in (*notes, *(reason for _line, _exactness, reason in reports)) if "lost" in text]


def test_no_event_is_lost_where_none_is_taken() -> None:
    end = '<state id="a"><transition event="go" target="b"/></state>\n<state id="b"><transition target="c"/></state>'
    reports, _notes = _report(f'{end}<final id="c"/>')
    assert reports == [(2, "exact", ""), (3, "later", "it takes an iteration of its own")]


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        (
            (
                '<state id="o"><onentry><send event="t" delay="1s"/></onentry><state id="a"><transition event="t" '
                'target="b"/></state><state id="b"/></state>'
            ),
            "it is taken whenever the time has passed; SCXML takes 't' once, when it arrives",
        ),
        (
            (
                '<state id="a"><onentry><send event="t" delay="1s"/></onentry><transition event="t" target="b"/>'
                '<transition event="e" target="b"/></state><state id="b"><transition event="e" target="a"/></state>'
            ),
            "'t' ends with 'a'; SCXML delivers it unless <cancel> is on exit",
        ),
    ],
)
def test_timers_that_are_not_delayed_events_are_reported(body: str, reason: str) -> None:
    assert ("may differ", reason) in [found[1:] for found in _report(body)[0]]


def test_a_timer_that_is_cancelled_on_exit_is_exact() -> None:
    reports, _notes = _report(
        '<state id="a"><onentry><send event="t" id="i" delay="1s"/></onentry><onexit><cancel sendid="i"/></onexit>'
        '<transition event="t" target="b"/><transition event="e" target="b"/></state>'
        '<state id="b"><transition event="e" target="a"/></state>'
    )
    assert {exactness for _line, exactness, _reason in reports} == {"exact"}


def test_the_command_reports_what_is_not_exact(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "way.scxml"
    file.write_text(f"{HEAD}{ON_THE_WAY}\n</scxml>", encoding="utf-8")
    assert main(["import", str(file), "--out", str(tmp_path / "way")]) == 0
    said = capsys.readouterr().out.splitlines()
    assert said[1] == "4 transitions: 2 exact, 2 may lose events"
    assert said[3].startswith(f"  {file.as_posix()}:3: b to c: may lose events: ")
    assert said[-1] == "with --event-queue, no event is lost"
    assert main(["import", str(file), "--out", str(tmp_path / "queue"), "--event-queue"]) == 0
    assert capsys.readouterr().out.splitlines()[1] == "4 transitions: 2 exact, 2 later"


def test_an_event_queue_is_for_scxml(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", str(tmp_path / "a.xabsl"), "--out", str(tmp_path / "a"), "--event-queue"]) == 2
    assert "--event-queue is an option of SCXML files" in capsys.readouterr().err


@pytest.mark.parametrize("has_queue", [False, True])
def test_names_that_are_keywords_pass_the_check(tmp_path: Path, has_queue: bool) -> None:
    body = (
        '<datamodel><data id="new" expr="0"/></datamodel><state id="delete"><transition event="switch post" '
        'cond="new == 0" target="default"><assign location="new" expr="1"/></transition></state>'
        '<state id="default"><transition event="events.hold send namespace" target="delete"/></state>'
    )
    (tmp_path / "events.scxml").write_text(f"{HEAD}{body}</scxml>", encoding="utf-8")
    options = ["--event-queue"] if has_queue else []
    assert main(["import", str(tmp_path / "events.scxml"), "--out", str(tmp_path / "out"), *options]) == 0
    assert main(["check", str(tmp_path / "out")]) == 0


def test_the_first_state_runs_the_actions_of_the_states_around_it() -> None:
    body = """<datamodel><data id="n" expr="0"/></datamodel>
<state id="outer"><onentry><assign location="n" expr="n + 1"/></onentry><state id="in"/></state>
<state id="b"><transition event="e" target="outer"/></state>"""
    imported = import_scxml(f"{HEAD}{body}</scxml>".encode(), "Machine", "test").project.designs[0]
    first = next(state for state in imported.states if state.name == imported.initial)
    # The initial state decides before it acts, but runs its actions on entry.
    assert [action.values for action in first.enter if isinstance(action, Assign)] == [(("n", "n + 1"),)]
