"""Strategies for random designs and projects that can be saved: names are unique in their mapping."""

import string
from dataclasses import replace
from typing import Any

from hypothesis import strategies as st

from vicode.model.design import (
    STATE_COLORS,
    Action,
    Assign,
    Call,
    Code,
    CommonSection,
    Competence,
    CompetenceStep,
    Decision,
    DecisionGroup,
    Declaration,
    DerivedPosition,
    Design,
    DiagramFrame,
    DiagramNote,
    Guard,
    Interrupt,
    InvariantProperty,
    Latch,
    Layer,
    NeverProperty,
    Property,
    ReachProperty,
    RecoveryProperty,
    RunCode,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.model.lowering import lower_design
from vicode.model.project import (
    Agent,
    BridgeSettings,
    Enumeration,
    Interface,
    Profile,
    ProfileClass,
    Project,
    RemoteReference,
    TopicReference,
)

AWKWARD_NAMES = ("on", "off", "no", "yes", "null", "true", "1e3", "007", "code", "doc", "elements", "default", "python")
AWKWARD_TEXTS = (
    "a: b", "# no comment", "- item", "", " ", "x ", "'quoted'", 'say "hi"', "{a: b}", "[1]", "*a", "&a", "!x", "%d",
    "@x", "`", "a #b", "key:", "null", "~", "0x10", "é ü 😀", "back\\slash", "---", "...", "? x", "a, b", "=", "<<",
)  # fmt: skip
AWKWARD_CODE = (
    "go()\n", "if x:\n    go()\n", "  indented\n", "a\n\n\nb\n\n", "\n", "\nx\n", "x\n  ", "\ttab\n", "# only\n",
    "a\r\nb\r\n", "no end", "s = '''\n---\n...\n'''\n", "x\u2028y\n", "\x07\n", "x\n\n\n",
)  # fmt: skip

plain_names = st.builds(
    str.__add__, st.sampled_from(string.ascii_letters), st.text(string.ascii_letters + string.digits + "_", max_size=6)
)
names = plain_names | st.sampled_from(AWKWARD_NAMES)
_characters = st.characters(codec="utf-8", exclude_categories=("Cs", "Cn"))
texts = st.sampled_from(AWKWARD_TEXTS) | st.text(_characters, max_size=20) | st.text("ab :#-'\"\n{}[],", max_size=12)
codes = st.sampled_from(AWKWARD_CODE) | st.text("ab#:-| \t\n", max_size=12) | texts
expressions = (
    plain_names
    | st.integers(-999, 999).map(str)
    | st.builds("{} {} {}".format, plain_names, st.sampled_from(["<", "and", "!=", "%"]), plain_names)
    | texts.filter(lambda text: bool(text.strip()))
)
numbers = st.integers(-5000, 5000).map(float) | st.floats(-1e6, 1e6, allow_nan=False).map(lambda number: number + 0.0)
points = st.none() | st.tuples(numbers, numbers)
counts = st.none() | st.integers(0, 9)
frequencies = st.none() | st.integers(1, 100).map(float) | st.floats(1e-3, 1e3)
code = st.builds(
    Code,
    texts=st.dictionaries(st.sampled_from(["python", "cpp", "xabsl"]), codes, max_size=2).map(
        lambda entries: tuple(entries.items())
    ),
)
ids = st.just("") | plain_names


def _unique(
    values: st.SearchStrategy[Any], name: str, largest: int = 4, smallest: int = 0
) -> st.SearchStrategy[tuple[Any, ...]]:
    unique = st.lists(values, min_size=smallest, max_size=largest, unique_by=lambda value: getattr(value, name))
    return unique.map(tuple)


def _tuples(values: st.SearchStrategy[Any], largest: int = 3) -> st.SearchStrategy[tuple[Any, ...]]:
    return st.lists(values, max_size=largest).map(tuple)


def _pairs(largest: int = 3) -> st.SearchStrategy[tuple[tuple[str, str], ...]]:
    return st.dictionaries(names, expressions, max_size=largest).map(lambda entries: tuple(entries.items()))


def declarations(
    arguments: st.SearchStrategy[Any] | None = None, *, is_tunable: bool = False
) -> st.SearchStrategy[Declaration]:
    """Draw declarations; of functions, if `arguments` draws a tuple."""
    return st.builds(
        Declaration,
        name=names,
        type=st.sampled_from(["", "bool", "int", "float", "Side"]),
        initial=st.just("") | expressions,
        unit=st.just("") | texts,
        range=points,
        doc=st.just("") | texts,
        xabsl_name=st.just("") | texts,
        tunable=st.booleans() if is_tunable else st.just(False),
        arguments=st.none() if arguments is None else arguments,
    )


outputs = declarations(st.none() | _unique(declarations(), "name", 2))
calls = st.builds(Call, alias=names, arguments=_pairs())
actions: st.SearchStrategy[Action] = st.builds(Assign, values=_pairs()) | calls | st.builds(RunCode, code=code, id=ids)
guards = st.builds(
    Guard, when=st.just("") | expressions, after=st.just("") | expressions, code=st.none() | st.none() | code
)
transitions = st.builds(
    Transition, to=names, guard=guards, doc=st.just("") | texts, id=ids, disabled=st.booleans(), label_at=points
)
_stays = st.builds(Stay, guard=guards, doc=st.just("") | texts, id=ids, disabled=st.booleans())
decisions: st.SearchStrategy[Decision] = st.recursive(
    transitions | _stays,
    lambda inner: st.builds(
        DecisionGroup,
        guard=guards,
        then=_tuples(inner, 2),
        otherwise=_tuples(inner, 2),
        doc=st.just("") | texts,
        id=ids,
        disabled=st.booleans(),
    ),
    max_leaves=3,
)
states: st.SearchStrategy[State] = st.builds(
    State,
    name=names,
    id=ids,
    xabsl_name=st.just("") | texts,
    doc=st.just("") | texts,
    at=points,
    color=st.sampled_from(("", *STATE_COLORS)),
    final=st.booleans(),
    capacity=counts,
    synchronized=counts,
    disabled=st.booleans(),
    requires=_tuples(names),
    modulates=_unique(calls, "alias", 2),
    enter=_tuples(actions, 2),
    actions=_tuples(actions),
    leave=_tuples(actions, 2),
    transitions=_tuples(decisions),
)
_no_name = st.just("") | names
properties: st.SearchStrategy[Property] = (
    st.builds(ReachProperty, reach=names, after=_no_name, within=st.just("") | expressions)
    | st.builds(NeverProperty, never=names, after=_no_name, before=_no_name)
    | st.builds(RecoveryProperty, can_reach=names)
    | st.builds(InvariantProperty, holds=expressions)
)
_optional = st.just("") | expressions
_doc = st.just("") | texts
latches = st.builds(Latch, name=names, on=expressions, off=_optional, hold=_optional, doc=_doc)
interrupts = st.builds(
    Interrupt,
    do=names,
    during=_tuples(names, 2),
    when=expressions,
    until=_optional,
    then=_no_name,
    every=_optional,
    doc=_doc,
)
_work = {"doc": _doc, "when": _optional, "requires": _tuples(names, 2), "modulates": _unique(calls, "alias", 2)}
competences = st.builds(
    Competence,
    goal=expressions,
    doc=_doc,
    requires=_tuples(names, 2),
    steps=_unique(st.builds(CompetenceStep, name=names, retries=counts, **_work), "name", 2),
)
layers = st.builds(Layer, name=names, hold=_optional, **_work)
uses = st.builds(Use, alias=names, component=names, at=points)
_fields: dict[str, st.SearchStrategy[Any]] = {
    "component": names,
    "xabsl_name": st.just("") | texts,
    "doc": st.just("") | texts,
    "frequency_hz": frequencies,
    "resume": st.booleans(),
    "arithmetic": st.sampled_from(["", "xabsl"]),
    "time_unit": st.sampled_from(["", "s", "ms"]),
    "uses": _unique(uses, "alias"),
    "parameters": _unique(declarations(is_tunable=True), "name", 2),
    "outputs": _unique(outputs, "name", 2),
    "variables": _unique(declarations(), "name", 2),
    "initial": st.just("") | names,
    "properties": _tuples(properties, 2),
    "module": code,
    "members": code,
    "frames": _unique(
        st.builds(DiagramFrame, name=names, color=st.sampled_from(("", *STATE_COLORS)), states=_tuples(names)),
        "name",
        2,
    ),
    "notes": _unique(st.builds(DiagramNote, name=names, text=texts, at=points), "name", 2),
    "common": st.builds(
        CommonSection,
        doc=st.just("") | texts,
        at=points,
        actions=_tuples(actions, 2),
        transitions=_tuples(decisions, 2),
    ),
}
designs = st.builds(Design, **_fields, states=_unique(states, "name", 3))
designs_with_states = st.builds(Design, **_fields, states=_unique(states, "name", 3, smallest=1))
written_designs = st.builds(
    Design,
    **_fields,
    states=_unique(st.builds(replace, states, failed=st.booleans()), "name", 3),
    latches=_unique(latches, "name", 1),
    interrupts=_tuples(interrupts, 1),
    competence=st.none() | st.none() | competences,
    layers=_unique(layers, "name", 1),
    positions=_unique(st.builds(DerivedPosition, name=names, at=points.filter(bool)), "name", 2),
)
"""Designs with all keys, as files say them: without anything derived."""
lowered_designs = written_designs.map(lower_design)
enumerations = st.builds(
    Enumeration,
    name=names,
    doc=st.just("") | texts,
    elements=st.dictionaries(names, st.just("") | texts, min_size=1, max_size=4).map(
        lambda entries: tuple(entries.items())
    ),
    internal=st.booleans(),
    xabsl_name=st.just("") | texts,
    xabsl_elements=st.dictionaries(names, texts, max_size=2).map(lambda entries: tuple(entries.items())),
)
interfaces = st.builds(
    Interface,
    component=names,
    title=st.just("") | texts,
    doc=st.just("") | texts,
    xabsl_name=st.just("") | texts,
    implementation=st.just("") | st.just("field.head:Head") | texts,
    frequency_hz=frequencies,
    parameters=_unique(declarations(is_tunable=True), "name", 2),
    outputs=_unique(outputs, "name", 2),
    variables=_unique(declarations(), "name", 2),
    assume=st.just("") | expressions,
)
agents = st.builds(
    Agent,
    name=names,
    root=names,
    title=st.just("") | texts,
    doc=st.just("") | texts,
    xabsl_name=st.just("") | texts,
)
_field_names = st.dictionaries(names, texts, max_size=2).map(lambda entries: tuple(entries.items()))
profiles = st.builds(
    Profile,
    name=names,
    world=st.just("") | texts,
    clock=st.sampled_from(["", "world"]),
    tune=st.booleans(),
    components=_unique(
        st.builds(ProfileClass, component=names, implementation=texts)
        | st.builds(RemoteReference, component=names, remote=texts, reliable=st.booleans(), max_age=frequencies)
        | st.builds(
            TopicReference,
            component=names,
            topic=texts,
            type=texts,
            outputs=_field_names,
            parameters=_field_names,
            frame=texts,
            max_age=frequencies,
        ),
        "component",
        2,
    ),
)
bridges = st.builds(
    BridgeSettings,
    world=st.just("") | texts,
    tick_ms=st.none() | st.sampled_from([20.0, 12.5]),
    port=st.none() | st.integers(0, 65535),
)
projects = st.builds(
    Project,
    name=names,
    doc=st.just("") | texts,
    languages=_tuples(st.sampled_from(["python", "cpp", "xabsl"]), 2),
    live=st.booleans(),
    world=st.just("") | texts,
    clock=st.sampled_from(["", "world"]),
    generated=st.sampled_from(["generated", "../out", ""]),
    xabsl_encoding=st.sampled_from(["", "gbk", "koi8-r"]),
    enumerations=_unique(enumerations, "name", 2),
    constants=_unique(declarations(is_tunable=True), "name", 2),
    components=_unique(interfaces, "component", 2),
    agents=_unique(agents, "name", 2),
    profiles=_unique(profiles, "name", 2),
    bridge=bridges,
)
