"""Checks report findings and never raise, for any design and project."""

from hypothesis import given
from hypothesis import strategies as st

from vicode.check import check_design, check_project
from vicode.check.behavior import find_behavior
from vicode.findings import Finding
from vicode.model.design import (
    Action,
    Assign,
    Call,
    Code,
    CommonSection,
    Decision,
    DecisionGroup,
    Declaration,
    Design,
    Guard,
    RunCode,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.model.project import Agent, Enumeration, Interface, Project

# Few names, so that they meet; some that are taken, some that are none.
names = st.sampled_from(["A", "B", "a", "x", "Side", "state", "self", "min", "class", "1e3", "_", "", "ä b", "x" * 90])
names |= st.text(max_size=5)
expressions = st.sampled_from(
    ["", "x", "a.x", "x > 1", "Side.a", "done(a)", "-3", "1e999", "a.x(1, b=2)", "x if", "é and x", "\n x", "0" * 5000]
)
expressions |= st.text(max_size=12)
pythons = st.sampled_from(
    [
        "",
        "pass",
        "return x",
        "  a\n b",
        "x = (",
        "yield 1",
        "break",
        "\rimport os",
        "'''",
        "é = \\",
        "(" * 300,
        "\0",
        "\ud800",
    ]
)
codes = st.lists(
    st.tuples(st.sampled_from(["python", "cpp", "xabsl", "basic", ""]), pythons | st.text(max_size=20)), max_size=3
).map(lambda texts: Code(texts=tuple(texts)))
guards = st.builds(Guard, when=expressions, after=expressions, code=st.none() | codes)
floats = st.floats()


def _tuples(strategy: "st.SearchStrategy[object]", size: int = 2) -> "st.SearchStrategy[tuple[object, ...]]":
    return st.lists(strategy, max_size=size).map(tuple)


pairs = _tuples(st.tuples(names, expressions))
declarations = st.deferred(
    lambda: st.builds(
        Declaration,
        name=names,
        type=st.sampled_from(["", "int", "bool", "float", "Side", "Sied"]) | names,
        initial=expressions,
        range=st.none() | st.tuples(floats, floats),
        arguments=st.none() | _tuples(declarations, 1),
    )
)
decisions: "st.SearchStrategy[Decision]" = st.recursive(
    st.builds(Transition, to=names, guard=guards, id=names, disabled=st.booleans())
    | st.builds(Stay, guard=guards, id=names, disabled=st.booleans()),
    lambda inner: st.builds(
        DecisionGroup, guard=guards, then=_tuples(inner), otherwise=_tuples(inner), id=names, disabled=st.booleans()
    ),
    max_leaves=4,
)
calls = st.builds(Call, alias=names, arguments=pairs)
actions: "st.SearchStrategy[Action]" = (
    calls | st.builds(Assign, values=pairs) | st.builds(RunCode, code=codes, id=names)
)
states = st.builds(
    State,
    name=names,
    id=names,
    final=st.booleans(),
    capacity=st.none() | st.integers(-1, 2),
    synchronized=st.none() | st.integers(-1, 3),
    disabled=st.booleans(),
    requires=_tuples(names),
    modulates=_tuples(calls),
    enter=_tuples(actions),
    actions=_tuples(actions),
    leave=_tuples(actions),
    transitions=_tuples(decisions),
)
designs = st.builds(
    Design,
    component=names,
    frequency_hz=st.none() | floats,
    uses=_tuples(st.builds(Use, alias=names, component=names)),
    parameters=_tuples(declarations),
    outputs=_tuples(declarations),
    variables=_tuples(declarations),
    initial=names,
    module=codes,
    members=codes,
    common=st.builds(CommonSection, actions=_tuples(actions), transitions=_tuples(decisions)),
    states=_tuples(states),
)
interfaces = st.builds(
    Interface,
    component=names,
    implementation=st.text(max_size=5) | st.just("field.head:Head"),
    frequency_hz=st.none() | floats,
    parameters=_tuples(declarations),
    outputs=_tuples(declarations),
)
projects = st.builds(
    Project,
    name=names,
    languages=_tuples(st.sampled_from(["python", "cpp", "xabsl", "basic"])),
    world=st.text(max_size=5),
    enumerations=_tuples(st.builds(Enumeration, name=names, elements=_tuples(st.tuples(names, st.just(""))))),
    constants=_tuples(declarations),
    components=_tuples(interfaces),
    agents=_tuples(st.builds(Agent, name=names, root=names)),
    designs=_tuples(designs),
)


@given(projects)
def test_no_project_makes_the_checks_raise(project: Project) -> None:
    _assert_well_formed((*check_project(project), *find_behavior(project)))


@given(projects, designs)
def test_no_design_makes_the_checks_raise(project: Project, design: Design) -> None:
    findings = check_design(project, design)
    _assert_well_formed(findings)
    assert all(finding.subject and finding.subject.component == design.component for finding in findings)


def _assert_well_formed(findings: tuple[Finding, ...]) -> None:
    assert len(set(findings)) == len(findings)
    for finding in findings:
        assert finding.message
        assert finding.subject is not None
        span = finding.subject.span
        assert span is None or 0 <= span[0] <= span[1]
