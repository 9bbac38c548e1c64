"""Messages, fixes and exact positions of findings."""

from dataclasses import replace
from pathlib import Path

from vicode.check import check_design, check_project
from vicode.check.code import validate_python
from vicode.findings import Finding, FindingSubject, Severity
from vicode.model.design import Code, Declaration, Design, Guard, RunCode, State, Transition, Use
from vicode.model.project import Enumeration, Interface, Profile, Project, RemoteReference, select_profile


def _design(**changes: object) -> Design:
    values: dict[str, object] = {"component": "Player", "initial": "Wait", "states": (State(name="Wait"),), **changes}
    return Design(**values)  # type: ignore[arg-type]


def _only(findings: tuple[Finding, ...]) -> Finding:
    (finding,) = findings
    return finding


def test_unknown_state_suggests_the_nearest_name() -> None:
    states = (State(name="Wait", transitions=(Transition(to="Kik"), Transition(to="Kick", guard=Guard(after="1")))),)
    design = _design(states=(*states, State(name="Kick", final=True)))
    finding = next(finding for finding in check_design(Project(name="p"), design) if finding.rule.code == "D402")
    assert (finding.message, finding.fix) == ("unknown state 'Kik'", "did you mean 'Kick'?")
    assert finding.subject == FindingSubject(component="Player", path=("states", "Wait", "transitions", 0, "to"))


def test_cycle_message_lists_all_components() -> None:
    names = ("Hen", "Egg", "Chick")
    designs = tuple(
        _design(component=name, uses=(Use(alias="next", component=names[(index + 1) % 3]),))
        for index, name in enumerate(names)
    )
    findings = check_project(Project(name="p", designs=designs), {"Egg"})
    cycle = next(finding for finding in findings if finding.rule.code == "D408")
    assert cycle.message == "components use each other in a cycle: Egg → Chick → Hen → Egg"
    assert {finding.subject.component for finding in findings if finding.subject} == {"Egg"}


def test_span_covers_the_invalid_name_in_an_expression() -> None:
    guard = Guard(when="tries > 2 and tires < 3")
    transitions = (Transition(to="Rest", guard=guard),)
    design = _design(
        states=(State(name="Wait", transitions=transitions), State(name="Rest", final=True)),
        parameters=(Declaration(name="tries", initial="0"),),
    )
    finding = _only(check_design(Project(name="p"), design))
    assert finding.fix == "did you mean 'tries'?"
    assert finding.subject is not None
    assert finding.subject.span is not None
    assert guard.when[slice(*finding.subject.span)] == "tires"


def test_span_covers_the_python_syntax_error() -> None:
    text = "    if True:\n        é = 1\n\n    x = = 2\n"
    problem = validate_python(text, "action")
    assert problem is not None
    assert text[slice(*problem[1])] == "="
    assert text[: problem[1][0]].count("\n") == 3


def test_code_is_validated_in_its_role() -> None:
    assert validate_python("return 1", "action") is None
    assert validate_python("return 1", "module") is not None
    assert validate_python("def f(self):\n    return 1", "members") is None
    assert validate_python("pass\rimport os", "action") is not None
    assert validate_python("# <vicode Wait.enter 00000000>\n# </vicode>", "action") is not None
    assert validate_python("from __future__ import division", "module") is not None
    assert validate_python("# a remark", "action") is None
    assert validate_python("break", "action") is not None
    assert validate_python("'''\n", "predicate") is not None


def test_no_code_is_run(tmp_path: Path) -> None:
    mark = tmp_path / "mark"
    run = f"open({str(mark)!r}, 'w').close()"
    code = Code(texts=(("python", run),))
    state = State(
        name="Wait", actions=(RunCode(code=code),), transitions=(Transition(to="Wait", guard=Guard(code=code)),)
    )
    check_design(Project(name="p"), _design(module=code, members=code, states=(state,)))
    assert not mark.exists()


def test_check_design_replaces_the_design_in_the_project() -> None:
    old = _design(outputs=(Declaration(name="kicks"),))
    project = Project(name="p", designs=(old,))
    assert [finding.rule.code for finding in check_project(project)] == ["D424"]
    assert check_design(project, _design()) == ()


def test_changed_interface_invalidates_the_cache() -> None:
    head = Interface(component="Head", implementation="field:Head", parameters=(Declaration(name="pan"),))
    guard = Guard(when="head.seen")
    states = (State(name="Wait", requires=("head",), transitions=(Transition(to="Rest", guard=guard),)),)
    design = _design(uses=(Use(alias="head", component="Head"),), states=(*states, State(name="Rest", final=True)))
    before = Project(name="p", components=(head,), designs=(design,))
    assert _only(check_project(before)).rule.code == "E303"
    seeing = Interface(component="Head", implementation="field:Head", outputs=(Declaration(name="seen", type="bool"),))
    assert check_project(Project(name="p", components=(seeing,), designs=(design,))) == ()


def test_unknown_element_of_an_empty_enumeration() -> None:
    project = Project(name="p", enumerations=(Enumeration(name="Foot", elements=()),))
    design = _design(
        states=(State(name="Wait", transitions=(Transition(to="Wait", guard=Guard(when="Foot.a == 1")),)),)
    )
    finding = next(finding for finding in check_design(project, design) if finding.rule.code == "E306")
    assert (finding.message, finding.fix) == ("'Foot' has no element 'a'", "add elements to the enumeration")


def _project_with_remote(remote: str = "striker/Eyes", component: str = "Eyes", **changes: float) -> Project:
    outputs = (Declaration(name="seen", type="bool"),)
    choice = RemoteReference(component=component, remote=remote, **changes)  # type: ignore[arg-type]
    return Project(
        name="p",
        components=(Interface(component="Eyes", implementation="a:Eyes", outputs=outputs),),
        profiles=(Profile(name="robot", components=(choice,)),),
        designs=(_design(),),
    )


def _profile_messages(project: Project) -> list[str]:
    return [finding.message for finding in check_project(project) if finding.rule.code == "P213"]


def test_remote_components_have_a_robot_and_values_that_can_be_sent() -> None:
    assert _profile_messages(_project_with_remote()) == []
    assert _profile_messages(_project_with_remote(component="Player")) == []
    assert _profile_messages(_project_with_remote(component="Eye")) == ["unknown component 'Eye'"]
    for remote in ("striker", "striker/", "/Eyes", "a/b/Eyes", "*/Eyes", "striker/Ey es", "-x/Eyes"):
        messages = _profile_messages(_project_with_remote(remote))
        assert messages == [f"'{remote}' is not of the form robot/component"]
    assert _profile_messages(_project_with_remote(max_age=0)) == ["0 s is not a valid age"]
    functions = (Declaration(name="nearer", type="bool", arguments=(Declaration(name="limit", type="float"),)),)
    project = replace(
        _project_with_remote(),
        components=(
            Interface(
                component="Eyes",
                implementation="a:Eyes",
                outputs=functions,
                variables=(Declaration(name="count", initial="0"),),
            ),
        ),
    )
    assert _profile_messages(project) == [
        "'nearer' of 'Eyes' is an output with arguments, which another robot does not share",
        "'count' of 'Eyes' is a variable, which another robot does not share",
    ]


def test_a_remote_design_becomes_a_component_with_its_interface() -> None:
    project = select_profile(_project_with_remote(component="Player"), "robot")
    assert project.designs == ()
    player = project.interface("Player")
    assert player is not None
    assert player.is_generated
    assert [finding for finding in check_project(project) if finding.severity is Severity.ERROR] == []
