"""Renames change all references to a symbol and nothing else."""

from collections import Counter
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.generators.portable_designs import portable_projects
from tests.generators.sound_designs import project_of, sound_designs
from vicode.check import check_project
from vicode.model.design import (
    Assign,
    Call,
    Code,
    CommonSection,
    Declaration,
    Design,
    Guard,
    RunCode,
    State,
    Transition,
    Use,
)
from vicode.model.project import Interface, Profile, ProfileClass, Project, TopicReference
from vicode.model.rename import ReferenceKind, ReferenceRename, SymbolRef, is_declared, rename_symbol, sibling_names
from vicode.model.rename.cpp import rename_in_cpp
from vicode.model.rename.designs import rename_in_design
from vicode.model.rename.expressions import rename_in_expression
from vicode.model.rename.python import rename_in_python

projects = portable_projects() | sound_designs().map(project_of)


def things_of(project: Project) -> list[SymbolRef]:
    """Everything in a project that can have another name."""
    kinds = [SymbolRef(section=section, name="") for section in ("constants", "enumerations", "components", "agents")]
    kinds += [SymbolRef(section="elements", owner=each.name, name="") for each in project.enumerations]
    for name, interface in project.interfaces().items():
        sections = ("uses", "parameters", "outputs", "variables")
        kinds += [SymbolRef(component=name, section=section, name="") for section in sections]
        for output in interface.outputs:
            kinds.append(SymbolRef(component=name, section="arguments", owner=output.name, name=""))
    return [replace(kind, name=name) for kind in kinds for name in sibling_names(project, kind)]


@settings(max_examples=max(60, settings.default.max_examples))
@given(projects, st.data())
def test_a_rename_adds_no_findings_and_is_reversible(project: Project, data: st.DataObject) -> None:
    thing = data.draw(st.sampled_from(things_of(project)))
    renamed = rename_symbol(project, thing, "another_name")
    assert not is_declared(renamed, thing)
    before, after = (Counter(each.rule.code for each in check_project(every)) for every in (project, renamed))
    assert after == before
    assert rename_symbol(renamed, replace(thing, name="another_name"), thing.name) == project


@pytest.mark.parametrize(
    ("said", "text", "wanted"),
    [
        (ReferenceRename(kind=ReferenceKind.OWN, old="a", new="b"), "a + eyes.a + A.a > a", "b + eyes.a + A.a > b"),
        (ReferenceRename(kind=ReferenceKind.OWN, old="e5", new="x"), "1e5 < e5 and 2.e5", "1e5 < x and 2.e5"),
        (ReferenceRename(kind=ReferenceKind.OWN, old="min", new="low"), "min(min, 2)", "min(low, 2)"),
        (
            ReferenceRename(kind=ReferenceKind.OWN, old="x", new="z"),
            "eyes.far(x=x, y=x == x)",
            "eyes.far(x=z, y=z == z)",
        ),
        (ReferenceRename(kind=ReferenceKind.OWN, old="a", new="b"), "a > (", "b > ("),
        (
            ReferenceRename(kind=ReferenceKind.ALIAS, old="head", new="neck"),
            "head . pan > done( head )",
            "neck . pan > done( neck )",
        ),
        (ReferenceRename(kind=ReferenceKind.ALIAS, old="head", new="neck"), "eyes.head.x", "eyes.head.x"),
        (
            ReferenceRename(kind=ReferenceKind.MEMBER, owner="head", old="pan", new="yaw"),
            "head\n.pan + legs.pan",
            "head\n.yaw + legs.pan",
        ),
        (
            ReferenceRename(kind=ReferenceKind.ARGUMENT, owner="eyes.far", old="x", new="z"),
            "eyes.far(x=x) + f(x=1)",
            "eyes.far(z=x) + f(x=1)",
        ),
        (
            ReferenceRename(kind=ReferenceKind.ELEMENT, owner="Side", old="left", new="west"),
            "side == Side.left",
            "side == Side.west",
        ),
        (
            ReferenceRename(kind=ReferenceKind.ENUMERATION, old="Side", new="Half"),
            "side == Side.left",
            "side == Half.left",
        ),
    ],
)
def test_rename_in_expression(said: ReferenceRename, text: str, wanted: str) -> None:
    assert rename_in_expression(text, said) == wanted


OWN = ReferenceRename(kind=ReferenceKind.OWN, old="tries", new="attempts")
SHARED = ReferenceRename(kind=ReferenceKind.ENUMERATION, old="Side", new="Half")


@pytest.mark.parametrize(
    ("role", "said", "text", "wanted"),
    [
        ("action", OWN, "self.tries += 1  # self.tries", "self.attempts += 1  # self.tries"),
        ("action", OWN, "print('self.tries', self . tries)\n", "print('self.tries', self . attempts)\n"),
        ("action", OWN, 'print(f"é {self.tries} of {tries}")', 'print(f"é {self.attempts} of {tries}")'),
        ("action", OWN, "    a = 1\n\n    self.tries = a\r\n", "    a = 1\n\n    self.attempts = a\r\n"),
        ("action", OWN, "tries = other.tries", "tries = other.tries"),
        ("action", OWN, "self = other\nself.tries = 1", "self = other\nself.tries = 1"),
        ("action", OWN, "self.tries = (", "self.tries = ("),
        ("action", OWN, "f = lambda self: self.tries", "f = lambda self: self.tries"),
        ("action", OWN, "f = lambda x: self.tries", "f = lambda x: self.attempts"),
        ("action", OWN, "self.modulate(tries=1)", "self.modulate(attempts=1)"),
        ("predicate", OWN, "return self.tries > 1", "return self.attempts > 1"),
        ("members", OWN, "def f(me):\n    return me.tries", "def f(me):\n    return me.attempts"),
        (
            "members",
            OWN,
            "@staticmethod\ndef f(me):\n    return me.tries",
            "@staticmethod\ndef f(me):\n    return me.tries",
        ),
        ("module", OWN, "def f(self):\n    return self.tries", "def f(self):\n    return self.tries"),
        ("module", SHARED, "LEFT = Side.left", "LEFT = Half.left"),
        ("action", SHARED, "x = Side.left", "x = Half.left"),
        ("action", SHARED, "for Side in x:\n    print(Side)", "for Side in x:\n    print(Side)"),
        (
            "action",
            replace(OWN, kind=ReferenceKind.MEMBER, owner="eyes"),
            "self.eyes.tries, self.tries",
            "self.eyes.attempts, self.tries",
        ),
        (
            "action",
            replace(OWN, kind=ReferenceKind.PARAMETER, owner="legs"),
            "self.legs.modulate(tries=2); self._call(self.legs, tries=3); self.arms.modulate(tries=5)",
            "self.legs.modulate(attempts=2); self._call(self.legs, attempts=3); self.arms.modulate(tries=5)",
        ),
    ],
)
def test_only_unambiguous_references_are_renamed_in_python(
    role: str, said: ReferenceRename, text: str, wanted: str
) -> None:
    assert rename_in_python(text, role, said) == wanted


ELEMENT = ReferenceRename(kind=ReferenceKind.ELEMENT, owner="Side", old="left", new="west")
EYES = ReferenceRename(kind=ReferenceKind.MEMBER, owner="eyes", old="tries", new="attempts")


@pytest.mark.parametrize(
    ("role", "said", "text", "wanted"),
    [
        ("action", OWN, "this->tries += 1; // this->tries", "this->attempts += 1; // this->tries"),
        ("action", OWN, "/* this->tries */ f(this -> tries);", "/* this->tries */ f(this -> attempts);"),
        (
            "action",
            OWN,
            'log("this->tries", R"x(this->tries)")x"); this->tries = 0;',
            'log("this->tries", R"x(this->tries)")x"); this->attempts = 0;',
        ),
        ("action", OWN, "log('\"', this->tries); // it's", "log('\"', this->attempts); // it's"),
        ("action", OWN, "x = 1'000; this->tries = x;", "x = 1'000; this->attempts = x;"),
        ("action", OWN, "tries = other->tries + that.tries;", "tries = other->tries + that.tries;"),
        (
            "action",
            OWN,
            "struct A { int tries; int f() { return this->tries; } };",
            "struct A { int tries; int f() { return this->tries; } };",
        ),
        ("module", OWN, "int f() { return this->tries; }", "int f() { return this->tries; }"),
        ("predicate", OWN, "return this->triesLeft > this->tries", "return this->triesLeft > this->attempts"),
        (
            "action",
            EYES,
            "this->eyes.tries + this->eyes->tries + eyes.tries + this->tries;",
            "this->eyes.attempts + this->eyes->attempts + eyes.tries + this->tries;",
        ),
        ("action", SHARED, "Side s = Side::left; other::Side::left;", "Side s = Half::left; other::Side::left;"),
        ("action", ELEMENT, "s == Side::left && left && Foot::left", "s == Side::west && left && Foot::left"),
        ("action", ELEMENT, "enum class Side { left }; s = Side::left;", "enum class Side { left }; s = Side::left;"),
        ("action", ELEMENT, "using Side = Foot; s = Side::left;", "using Side = Foot; s = Side::left;"),
        ("action", OWN, "this->tries /* open", "this->attempts /* open"),
        ("action", OWN, 'x = "open; this->tries', 'x = "open; this->tries'),
    ],
)
def test_only_unambiguous_references_are_renamed_in_cpp(
    role: str, said: ReferenceRename, text: str, wanted: str
) -> None:
    assert rename_in_cpp(text, role, said) == wanted


@given(st.text(alphabet="self.this->tries\"'/*() \n\\R:{};", max_size=60))
def test_any_cpp_is_accepted_and_only_names_change(text: str) -> None:
    renamed = rename_in_cpp(text, "action", OWN)
    assert renamed.replace("attempts", "tries") == text


def code(text: str) -> Code:
    return Code(texts=(("python", text), ("cpp", text)))


FOLLOW = Design(
    component="Follow",
    doc="speed and done",
    parameters=(Declaration(name="speed", initial="1"),),
    outputs=(Declaration(name="near", type="bool"),),
    initial="Go",
    states=(
        State(
            name="Go",
            doc="speed",
            actions=(Assign(values=(("near", "speed > 2"),)), RunCode(code=code("print(self.speed)"))),
            transitions=(Transition(to="Go", doc="near", guard=Guard(when="near", after="speed")),),
        ),
    ),
)
PLAYER = Design(
    component="Player",
    uses=(Use(alias="follow", component="Follow"), Use(alias="again", component="Follow")),
    variables=(Declaration(name="speed"), Declaration(name="near", type="bool")),
    initial="A",
    common=CommonSection(transitions=(Transition(to="A", guard=Guard(when="follow.near and near")),)),
    states=(
        State(
            name="A",
            modulates=(Call(alias="follow", arguments=(("speed", "speed"),)),),
            actions=(
                Call(alias="again", arguments=(("speed", "2"),)),
                RunCode(code=code("self.follow.speed = self.speed")),
            ),
            transitions=(Transition(to="A", guard=Guard(code=code("return self.again.near"))),),
        ),
    ),
)
TEAM = Project(name="team", designs=(FOLLOW, PLAYER))


def test_a_parameter_is_renamed_where_others_set_it() -> None:
    renamed = rename_symbol(TEAM, SymbolRef(component="Follow", section="parameters", name="speed"), "pace")
    follow, player = renamed.designs
    (go,) = follow.states
    assert follow.parameters[0].name == "pace"
    assert go.actions == (
        Assign(values=(("near", "pace > 2"),)),
        RunCode(code=Code(texts=(("python", "print(self.pace)"), ("cpp", "print(self.speed)")))),
    )
    assert go.transitions == (Transition(to="Go", doc="near", guard=Guard(when="near", after="pace")),)
    assert (follow.doc, go.doc) == ("speed and done", "speed")
    (state,) = player.states
    assert state.modulates == (Call(alias="follow", arguments=(("pace", "speed"),)),)
    assert state.actions[0] == Call(alias="again", arguments=(("pace", "2"),))
    assert isinstance(state.actions[1], RunCode)
    assert state.actions[1].code.in_language("python") == "self.follow.pace = self.speed"
    assert player.variables == PLAYER.variables


def test_an_output_is_renamed_where_others_read_it() -> None:
    renamed = rename_symbol(TEAM, SymbolRef(component="Follow", section="outputs", name="near"), "close")
    follow, player = renamed.designs
    assert follow.states[0].actions[0] == Assign(values=(("close", "speed > 2"),))
    assert player.common.transitions[0].guard.when == "follow.close and near"
    predicate = player.states[0].transitions[0].guard.code
    assert predicate is not None
    assert predicate.in_language("python") == "return self.again.close"


def test_variables_of_a_design_are_private() -> None:
    renamed = rename_symbol(TEAM, SymbolRef(component="Player", section="variables", name="near"), "close")
    assert renamed.designs[0] == FOLLOW
    assert renamed.designs[1].common.transitions[0].guard.when == "follow.near and close"


@pytest.mark.parametrize(("module", "wanted"), [("y = Side.left", "Half.left"), ("class Side: left = 1", "Side.left")])
def test_a_name_that_the_module_redefines_is_kept_in_code(module: str, wanted: str) -> None:
    run = RunCode(code=Code(texts=(("python", "x = Side.left"),)))
    design = Design(component="A", module=Code(texts=(("python", module),)), states=(State(name="S", actions=(run,)),))
    (action,) = rename_in_design(design, SHARED).states[0].actions
    assert action == RunCode(code=Code(texts=(("python", f"x = {wanted}"),)))


def test_profiles_follow_renamed_components_and_values_of_topics() -> None:
    scan = Interface(component="Scan", outputs=(Declaration(name="nearest", initial="9.0"),))
    topic = TopicReference(component="Scan", topic="/scan", outputs=(("nearest", "min(ranges)"),))
    classes = ProfileClass(component="Scan", implementation="sim:Scan")
    profiles = (Profile(name="ros2", components=(topic,)), Profile(name="sim", components=(classes,)))
    project = Project(name="Scouts", components=(scan,), profiles=profiles)
    project = rename_symbol(project, SymbolRef(component="Scan", section="outputs", name="nearest"), "closest")
    project = rename_symbol(project, SymbolRef(section="components", name="Scan"), "Laser")
    (renamed,), (other,) = (each.components for each in project.profiles)
    assert renamed == replace(topic, component="Laser", outputs=(("closest", "min(ranges)"),))
    assert other == replace(classes, component="Laser")
