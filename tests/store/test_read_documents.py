"""Reading of valid texts: short forms, names that YAML reads as booleans, locations."""

import pytest

from vicode.findings import SourceLocation
from vicode.model.design import Assign, Call, Code, Declaration, Design, Guard, RunCode, Stay, Transition, Use
from vicode.model.project import Agent, Enumeration
from vicode.store import read_design, read_project_file

HEAD = "vicode: 1\ncomponent: Player\n"


def _read(body: str) -> Design:
    read = read_design(HEAD + body)
    assert read.findings == ()
    assert read.design is not None
    return read.design


def _code(text: str) -> RunCode:
    return RunCode(code=Code(texts=(("python", text),)))


@pytest.mark.parametrize("name", ["on", "off", "no", "yes", "y", "null", "true", "1e3", "007", "0x1F", "1_0", "~"])
def test_names_stay_names(name: str) -> None:
    design = _read(f"initial: {name}\nstates:\n  {name}: {{transitions: [{{to: {name}}}]}}\n")
    assert design.initial == name
    assert design.states[0].name == name
    assert design.states[0].transitions == (Transition(to=name),)


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("3 < x", "3 < x"),
        ("0.5", "0.5"),
        ("true", "true"),
        ("-1", "-1"),
        ('"a: b"', "a: b"),
        ("'it''s'", "it's"),
        ("1e3", "1e3"),
    ],
)
def test_expressions_keep_their_text(text: str, meant: str) -> None:
    design = _read(f"states:\n  A: {{transitions: [{{to: A, when: {text}, after: {text}}}]}}\n")
    assert design.states[0].transitions == (Transition(to="A", guard=Guard(when=meant, after=meant)),)


def test_a_folded_guard_is_one_expression() -> None:
    design = _read("states:\n  A:\n    transitions:\n      - to: A\n        when: a and\n          b\n")
    assert design.states[0].transitions[0].guard.when == "a and b"


def test_short_forms_mean_the_long_ones() -> None:
    short = _read(
        "uses: {head: Head}\nvariables: {tries: 0}\nmodule: import math\n"
        "states:\n  A:\n    enter: |\n      go()\n    code: work()\n    leave: {python: stop(), cpp: stop();}\n"
        "    modulates: [head]\n"
    )
    long = _read(
        "uses: {head: {component: Head}}\nvariables: {tries: {initial: 0}}\nmodule: {python: import math}\n"
        'states:\n  A:\n    enter: [{code: {python: "go()\\n"}}]\n    actions: [{code: {python: work()}}]\n'
        "    leave: [{code: {python: stop(), cpp: stop();}}]\n    modulates: {head: {}}\n"
    )
    assert short == long
    assert short.uses == (Use(alias="head", component="Head"),)
    assert short.variables == (Declaration(name="tries", initial="0"),)
    assert short.states[0].actions == (_code("work()"),)


def test_a_key_without_value_counts_as_missing() -> None:
    design = _read("doc:\nuses:\nstates:\n  A:\n    enter:\n    leave: |\n    at:\n    modulates: {head: }\n  B: ~\n")
    assert [state.name for state in design.states] == ["A", "B"]
    assert design.states[0].modulates == (Call(alias="head"),)
    assert design.states[0].leave == ()


def test_significant_order_is_kept() -> None:
    design = _read(
        "states:\n  A:\n    actions:\n      - set: {b: 1, a: 2}\n      - call: head\n        with: {tilt: 1, pan: 2}\n"
    )
    assert design.states[0].actions == (
        Assign(values=(("b", "1"), ("a", "2"))),
        Call(alias="head", arguments=(("tilt", "1"), ("pan", "2"))),
    )


def test_a_broken_part_does_not_hide_the_rest() -> None:
    read = read_design(
        HEAD + "states:\n  A:\n    at: far\n    final: true\n    transitions: [{when: x}, {stay: true}]\n  B: [1]\n"
    )
    assert {finding.rule.code for finding in read.findings} == {"Y103", "Y104"}
    assert read.design is not None
    assert [state.name for state in read.design.states] == ["A", "B"]
    assert read.design.states[0].final
    assert read.design.states[0].transitions == (Stay(),)


def test_the_file_name_is_the_default_component_name() -> None:
    read = read_design("vicode: 1\nstates: {}\n", "designs/goalie.yaml")
    assert [finding.rule.code for finding in read.findings] == ["Y104"]
    assert read.design == Design(component="goalie")


def test_a_project_reads_all_forms_of_enumerations() -> None:
    read = read_project_file(
        "vicode: 1\nproject: P\nenumerations:\n  A: [x, y]\n  B: {x: first, y: second}\n"
        "  C: {doc: both, elements: {x: first, y: }}\n  D: {elements: [doc]}\nagents: {forward: Player}\n"
    )
    assert read.findings == ()
    assert read.project is not None
    assert read.project.enumerations == (
        Enumeration(name="A", elements=(("x", ""), ("y", ""))),
        Enumeration(name="B", elements=(("x", "first"), ("y", "second"))),
        Enumeration(name="C", elements=(("x", "first"), ("y", "")), doc="both"),
        Enumeration(name="D", elements=(("doc", ""),)),
    )
    assert read.project.agents == (Agent(name="forward", root="Player"),)


def test_the_nearest_known_key_is_named() -> None:
    (finding,) = read_design(HEAD + "states: {A: {on_entr: go()}}\n", "a.yaml").findings
    assert finding.message == "unknown key 'on_entr' in a state"
    assert finding.location == SourceLocation(file="a.yaml", line=3, column=14, length=7)
    (finding,) = read_design(HEAD + "states: {A: {on_enter: go()}}\n").findings
    assert finding.fix == "did you mean 'enter'?"


@pytest.mark.parametrize("mark", ["", "\ufeff"])
@pytest.mark.parametrize("line_end", ["\n", "\r\n"])
def test_locations_are_independent_of_line_ends_and_byte_order_marks(mark: str, line_end: str) -> None:
    text = mark + "vicode: 1\ncomponent: Player\ndoc: ü😀\nstates: {ä😀: {at: no}}\n".replace("\n", line_end)
    (finding,) = read_design(text, "a.yaml").findings
    assert finding.location == SourceLocation(file="a.yaml", line=4, column=19, length=2)


def test_invalid_bytes_are_a_finding() -> None:
    for content in (b"\xff\xfe", "vicode: 1".encode("utf-16"), b"doc: \x00\n", b"doc: \x1b\n"):
        assert [finding.rule.code for finding in read_design(content).findings] == ["Y110"]


def test_another_encoding_is_reported_at_its_first_byte() -> None:
    latin = "vicode: 1\ncomponent: A\ndoc: gr\u00fcn\n".encode("latin-1")
    (finding,) = read_design(latin, "a.yaml").findings
    assert finding.location == SourceLocation(file="a.yaml", line=3, column=8, length=1)
    assert "0xfc" in finding.message
    (finding,) = read_design("vicode: 1\n".encode("utf-16"), "a.yaml").findings
    assert "UTF-16" in finding.message
