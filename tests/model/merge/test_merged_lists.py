"""Lists of three versions: moves, additions and removals of each side meet in one order."""

from dataclasses import replace
from typing import Any

import pytest

from vicode.model.design import (
    Assign,
    Call,
    Code,
    DecisionGroup,
    Declaration,
    Design,
    DiagramFrame,
    DiagramNote,
    Guard,
    RunCode,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.model.merge import find_renamed_states, find_renamed_uses, match_items, merge_designs, merge_projects
from vicode.model.project import Enumeration, Profile, ProfileClass, Project, RemoteReference


def names(result: Design) -> str:
    return "".join(state.name for state in result.states)


def design(order: str) -> Design:
    """States in an order, each with its content."""
    return Design(component="P", initial="A", states=tuple(State(name=name, doc=f"is {name}") for name in order))


@pytest.mark.parametrize(
    ("base", "ours", "theirs", "expected"),
    [
        ("ABC", "ABC", "CAB", "CAB"),
        ("ABC", "CAB", "ABC", "CAB"),
        ("ABC", "CAB", "BCA", "CAB"),  # Both moved: our order, without a conflict, as names identify the states.
        ("ABC", "ABCX", "ABCY", "ABCXY"),
        ("ABC", "XABC", "YABC", "XYABC"),
        ("ABC", "AXBC", "AYBC", "AXYBC"),
        ("ABC", "AXBC", "ABYC", "AXBYC"),
        ("ABC", "ABXC", "AYBC", "AYBXC"),
        ("ABC", "AXYBC", "AZBC", "AXYZBC"),
        ("ABC", "AXBC", "AYZBC", "AXYZBC"),
        ("ABC", "AB", "XABC", "XAB"),
        ("ABC", "BC", "ABCX", "BCX"),
        ("ABC", "BXC", "CAB", "CBX"),
        ("ABC", "AC", "AC", "AC"),
        ("ABC", "A", "ABX", "AX"),
        ("ABCD", "DABC", "ABXCD", "DABXC"),
        ("ABCD", "ABXCD", "DABC", "DABXC"),
        ("ABC", "ABCX", "CABX", "CABX"),
        ("AB", "ABX", "ABX", "ABX"),
        ("ABC", "CAXB", "AYBC", "CAXYB"),
        ("ABC", "CABX", "ABYC", "CABXY"),
    ],
)
def test_states_of_both_sides_have_one_order(base: str, ours: str, theirs: str, expected: str) -> None:
    result = merge_designs(design(base), design(ours), design(theirs))
    assert result.conflicts == ()
    assert names(result.design) == expected
    assert result.design == design(expected)


def assigns(text: str) -> tuple[Any, ...]:
    return tuple(Assign(values=((name, name),)) for name in text)


def with_actions(text: str) -> Design:
    return Design(component="P", initial="A", states=(State(name="A", actions=assigns(text)),))


@pytest.mark.parametrize(
    ("base", "ours", "theirs", "expected"),
    [
        ("abc", "abcx", "yabc", "yabcx"),
        ("abc", "abcx", "abcx", "abcx"),
        ("abc", "abcx", "abcxx", "abcxx"),
        ("abc", "ab", "bc", "b"),
        ("aab", "ab", "aabx", "abx"),
        ("abc", "cab", "abcx", "cxab"),
        ("abc", "cabx", "abcx", "cabx"),
        ("abc", "abcx", "cabx", "cabx"),
    ],
)
def test_actions_of_both_sides_have_one_order(base: str, ours: str, theirs: str, expected: str) -> None:
    result = merge_designs(with_actions(base), with_actions(ours), with_actions(theirs))
    assert result.conflicts == ()
    assert result.design == with_actions(expected)


def test_two_orders_of_actions_are_a_conflict() -> None:
    sides = with_actions("abc"), with_actions("cab"), with_actions("bca")
    result = merge_designs(*sides)
    (conflict,) = result.conflicts
    path = ("states", "A", "actions")
    assert (conflict.path, conflict.base, conflict.ours, conflict.theirs) == (
        path,
        *map(assigns, ("abc", "cab", "bca")),
    )
    assert result.design == sides[1]
    assert merge_designs(*sides, theirs_at=[path]).design == sides[2]


def test_different_calls_of_one_component_are_both_added() -> None:
    def calling(*arguments: str) -> Design:
        calls = tuple(Call(alias="arm", arguments=(("x", text),)) for text in arguments)
        return Design(component="P", initial="A", states=(State(name="A", actions=calls),))

    result = merge_designs(calling(), calling("1", "2"), calling("2", "3"))
    assert (result.conflicts, result.design) == ((), calling("1", "2", "3"))


# Decisions


def decisions(*items: Any) -> Design:
    states = (State(name="A", transitions=items), State(name="B"), State(name="C"))
    return Design(component="P", initial="A", states=states)


def test_a_conflict_in_else_has_the_path_of_the_file() -> None:
    def group(doc: str, other: str = "C") -> DecisionGroup:
        inner = DecisionGroup(
            guard=Guard(when="y"), then=(Transition(to="B"),), otherwise=(Transition(to=other, doc=doc, id="t"),)
        )
        return DecisionGroup(guard=Guard(when="x"), then=(Transition(to="B"),), otherwise=(Stay(doc="s"), inner))

    path = ("states", "A", "transitions", 0, "else", 1, "else", 0, "doc")
    sides = decisions(group("")), decisions(group("ours")), decisions(group("theirs", "B"))
    result = merge_designs(*sides)
    assert [(each.path, each.base, each.ours, each.theirs) for each in result.conflicts] == [
        (path, "", "ours", "theirs")
    ]
    assert result.design == decisions(group("ours", "B"))
    assert merge_designs(*sides, theirs_at=[path]).design == sides[2]


@pytest.mark.parametrize(
    ("first", "second", "third", "path"),
    [
        (Guard(when="a"), Guard(when="b"), Guard(when="c"), ("when",)),
        (Guard(after="1"), Guard(after="2"), Guard(after="3"), ("after",)),
        (*(Guard(code=Code(texts=(("cpp", text),))) for text in "abc"), ("code", "cpp")),
    ],
)
def test_conflicts_in_guards_have_the_path_of_the_file(first: Guard, second: Guard, third: Guard, path: Any) -> None:
    sides = [decisions(Transition(to="B", guard=guard, id="t")) for guard in (first, second, third)]
    result = merge_designs(sides[0], sides[1], sides[2])
    assert [each.path for each in result.conflicts] == [("states", "A", "transitions", 0, *path)]
    assert result.design == sides[1]


FULL = Design(
    component="P",
    initial="A",
    frequency_hz=1.0,
    uses=(Use(alias="arm", component="Arm"),),
    parameters=(Declaration(name="p", initial="1"),),
    outputs=(Declaration(name="o", initial="1", arguments=(Declaration(name="q", initial="1"),)),),
    states=(
        State(
            name="A",
            actions=(Call(alias="arm", arguments=(("x", "1"),)), Assign(values=(("n", "1"),))),
            modulates=(Call(alias="arm", arguments=(("x", "1"),)),),
        ),
    ),
    notes=(DiagramNote(name="note", text="1"),),
    frames=(DiagramFrame(name="frame", color="1"),),
)


def changed(path: tuple[str, ...], text: str) -> Design:
    """The design with another text in one place."""
    (state,) = FULL.states
    call, assign = state.actions
    match path:
        case ("frequency",):
            return replace(FULL, frequency_hz=float(text))
        case ("parameters", *_):
            return replace(FULL, parameters=(Declaration(name="p", initial=text),))
        case ("outputs", "o", "arguments", *_):
            arguments = (Declaration(name="q", initial=text),)
            return replace(FULL, outputs=(replace(FULL.outputs[0], arguments=arguments),))
        case ("outputs", *_):
            return replace(FULL, outputs=(replace(FULL.outputs[0], initial=text),))
        case (*_, "modulates", _alias, _name):
            state = replace(state, modulates=(Call(alias="arm", arguments=(("x", text),)),))
        case (*_, "set", _name):
            state = replace(state, actions=(call, Assign(values=(("n", text),))))
        case (*_, "with", _name):
            state = replace(state, actions=(Call(alias="arm", arguments=(("x", text),)), assign))
        case ("notes", *_):
            return replace(FULL, notes=(DiagramNote(name="note", text=text),))
        case ("frames", *_):
            return replace(FULL, frames=(DiagramFrame(name="frame", color=text),))
    return replace(FULL, states=(state,))


@pytest.mark.parametrize(
    "path",
    [
        ("frequency",),
        ("parameters", "p", "default"),
        ("outputs", "o", "initial"),
        ("outputs", "o", "arguments", "q", "default"),
        ("states", "A", "actions", 0, "with", "x"),
        ("states", "A", "actions", 1, "set", "n"),
        ("states", "A", "modulates", "arm", "x"),
        ("notes", "note", "text"),
        ("frames", "frame", "color"),
    ],
)
def test_conflicts_have_the_paths_of_the_file(path: tuple[str, ...]) -> None:
    ours, theirs = changed(path, "2"), changed(path, "3")
    result = merge_designs(FULL, ours, theirs)
    assert [each.path for each in result.conflicts] == [path]
    assert result.design == ours
    assert merge_designs(FULL, ours, theirs, theirs_at=[path]).design == theirs


def test_positions_are_no_conflict() -> None:
    def placed(x: float) -> Design:
        transition = Transition(to="A", label_at=(x, x))
        return Design(component="P", initial="A", states=(State(name="A", at=(x, 0.0), transitions=(transition,)),))

    result = merge_designs(placed(0.0), placed(1.0), placed(2.0))
    assert (result.conflicts, result.design) == ((), placed(1.0))


def test_a_different_item_of_the_same_name_can_be_chosen() -> None:
    base = Design(component="P", initial="A", states=(State(name="A"),))
    ours, theirs = (replace(base, variables=(Declaration(name="n", type=kind),)) for kind in ("int", "bool"))
    result = merge_designs(base, ours, theirs)
    (conflict,) = result.conflicts
    assert (conflict.path, conflict.base) == (("variables", "n"), None)
    assert (conflict.ours, conflict.theirs) == (ours.variables[0], theirs.variables[0])
    assert result.design == ours
    assert merge_designs(base, ours, theirs, theirs_at=[conflict.path]).design == theirs


def test_a_different_item_of_the_same_name_in_another_place_stays_with_ours() -> None:
    first = Declaration(name="a")
    base = Design(component="P", initial="A", states=(State(name="A"),), variables=(first,))
    mine, yours = Declaration(name="n", type="int"), Declaration(name="n", type="bool")
    result = merge_designs(base, replace(base, variables=(first, mine)), replace(base, variables=(yours, first)))
    assert [(each.ours, each.theirs) for each in result.conflicts] == [(mine, yours)]
    assert result.design.variables == (mine, first)


@pytest.mark.parametrize("section", ["actions", "requires"])
def test_a_removed_use_that_the_other_side_calls_is_a_conflict(section: str) -> None:
    arm = Use(alias="arm", component="Arm")
    base = Design(component="P", initial="A", uses=(arm,), states=(State(name="A"),))
    link = {"actions": (Call(alias="arm"),)} if section == "actions" else {"requires": ("arm",)}
    ours, theirs = replace(base, uses=()), replace(base, states=(State(name="A", **link),))  # type: ignore[arg-type]
    result = merge_designs(base, ours, theirs)
    (conflict,) = result.conflicts
    assert (conflict.path, conflict.base, conflict.ours, conflict.theirs) == (("uses", "arm"), arm, None, arm)
    assert result.design == replace(theirs, uses=())
    assert merge_designs(base, ours, theirs, theirs_at=[conflict.path]).design == theirs
    assert merge_designs(base, theirs, ours).design == theirs


def test_projects_are_merged_with_our_designs() -> None:
    base = Project(name="p", doc="a", enumerations=(Enumeration(name="Side", elements=(("left", ""),)),))
    ours = replace(base, doc="ours", designs=(FULL,))
    both = (Enumeration(name="Side", elements=(("left", ""), ("right", ""))),)
    theirs = replace(base, doc="theirs", world="w", enumerations=both, designs=(design("AB"),))
    result = merge_projects(base, ours, theirs)
    assert [each.path for each in result.conflicts] == [("doc",)]
    assert result.project == replace(theirs, doc="ours", designs=(FULL,))
    assert merge_projects(base, ours, theirs, theirs_at=[("doc",)]).project == replace(theirs, designs=(FULL,))


def test_the_nth_items_of_a_name_match() -> None:
    one, two, three = (Declaration(name="n", doc=doc) for doc in "123")
    other = Declaration(name="m")
    assert match_items((one, two), (other, three, two), is_keyed=True) == {0: 1, 1: 2}


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (State(name="A"), State(name="A", doc="x")),
        (Use(alias="a", component="A"), Use(alias="a", component="B")),
        (Call(alias="a"), Call(alias="a", arguments=(("x", "1"),))),
        (DiagramNote(name="n"), DiagramNote(name="n", text="x")),
        (DiagramFrame(name="f"), DiagramFrame(name="f", color="red")),
        (Enumeration(name="E", elements=()), Enumeration(name="E", elements=(("a", ""),))),
        (Profile(name="P"), Profile(name="P", world="w")),
        (ProfileClass(component="C", implementation="a"), RemoteReference(component="C", remote="r/C")),
        (("a", "1"), ("a", "2")),
        ("a", "a"),
    ],
)
def test_items_with_names_match_by_name_only(old: Any, new: Any) -> None:
    others = {
        str: "b",
        tuple: ("b", old[1] if isinstance(old, tuple) else ""),
        ProfileClass: ProfileClass(component="D", implementation="a"),
    }
    field = "alias" if hasattr(old, "alias") else "name"
    other = others.get(type(old)) or replace(old, **{field: "zz"})
    assert match_items((old,), (other, new), is_keyed=True) == {0: 1}


def test_a_renamed_declaration_matches_between_its_neighbors() -> None:
    a, b, c = (Declaration(name=name, type="int") for name in "abc")
    renamed, other = replace(b, name="z"), Declaration(name="z", type="bool")
    assert match_items((a, b, c), (a, renamed, c), is_keyed=True) == {0: 0, 1: 1, 2: 2}
    assert match_items((a, b, c), (a, other, c), is_keyed=True) == {0: 0, 2: 2}
    assert match_items((b,), (renamed,), is_keyed=True) == {0: 0}
    assert match_items((b, c), (other, renamed, c), is_keyed=True) == {0: 1, 1: 2}
    states = State(name="A"), State(name="B")
    assert match_items(states[:1], states[1:], is_keyed=True) == {}


@pytest.mark.parametrize(
    ("old", "new", "is_match"),
    [
        (Transition(to="A", guard=Guard(when="x")), Transition(to="A", guard=Guard(when="y")), True),
        (Transition(to="A", guard=Guard(when="x")), Transition(to="B", guard=Guard(when="x")), True),
        (Transition(to="A", guard=Guard(when="x")), Transition(to="B", guard=Guard(when="y")), False),
        (Transition(to="A"), Transition(to="B"), False),
        (Transition(to="A"), Stay(), False),
        (Stay(doc="a"), Stay(doc="b"), True),
        (Call(alias="a", arguments=(("x", "1"),)), Call(alias="a"), True),
        (Call(alias="a"), Call(alias="b"), False),
        (Assign(values=(("n", "1"),)), Assign(values=(("m", "2"),)), True),
        (Assign(values=(("n", "1"),)), RunCode(code=Code()), False),
    ],
)
def test_neighbors_match_if_they_are_similar(old: Any, new: Any, is_match: bool) -> None:
    assert match_items((old,), (new,), is_keyed=False) == ({0: 0} if is_match else {})
    first = RunCode(code=Code(texts=(("python", "first"),)))
    assert match_items((first, old), (first, new), is_keyed=False) == ({0: 0, 1: 1} if is_match else {0: 0})
    assert match_items((old, first), (new, first), is_keyed=False) == ({0: 0, 1: 1} if is_match else {1: 1})


def test_uses_of_one_component_are_renamed() -> None:
    def uses(*pairs: tuple[str, str]) -> Design:
        return Design(component="P", uses=tuple(Use(alias=alias, component=component) for alias, component in pairs))

    assert find_renamed_uses(uses(("a", "A"), ("b", "B")), uses(("b", "B"), ("z", "A"))) == {"a": "z"}
    assert find_renamed_uses(uses(("a", "A")), uses(("a", "B"))) == {}
    assert find_renamed_uses(uses(("a", "A"), ("b", "A")), uses(("y", "A"), ("z", "A"))) == {}
    assert find_renamed_uses(uses(("a", "A")), uses(("y", "A"), ("z", "A"))) == {}
    assert find_renamed_uses(uses(("a", "")), uses(("b", ""))) == {}
    # A use that stays is not renamed.
    assert find_renamed_uses(uses(("a", "A")), uses(("a", "A"), ("z", "A"))) == {}
    assert find_renamed_uses(uses(("a", "A"), ("z", "A")), uses(("a", "A"))) == {}


@pytest.mark.parametrize(
    ("old", "new", "is_same"),
    [
        (State(name="A"), State(name="Z"), True),
        (State(name="A", doc="d"), State(name="Z", doc="e"), False),
        (State(name="A", doc="d", at=(1, 2)), State(name="Z", doc="d", at=(1, 2), final=True), True),
        (State(name="A", doc="d", at=(1, 2)), State(name="Z", doc="d", at=(1, 3), final=True), False),
        (
            State(name="A", doc="d", transitions=(Transition(to="A"),)),
            State(name="Z", doc="d", transitions=(Transition(to="Z"),), final=True),
            True,
        ),
        (
            State(name="A", doc="d", transitions=(Transition(to="A"),)),
            State(name="Z", doc="d", transitions=(Transition(to="B"),), final=True),
            False,
        ),
        (State(name="A", transitions=(Transition(to="A"),)), State(name="Z", transitions=(Transition(to="Z"),)), True),
        (State(name="A", id="i", doc="d"), State(name="Z", id="i", doc="e"), True),
        # Color and final are shared by many states.
        (State(name="A", doc="d", color="red"), State(name="Z", doc="d", color="red", at=(1, 2)), False),
        (State(name="A", doc="d", final=True), State(name="Z", doc="d", final=True, at=(1, 2)), False),
        (State(name="A", id="A", doc="d"), State(name="Z", id="j", doc="e"), False),
    ],
)
def test_a_state_with_most_of_its_content_is_renamed(old: State, new: State, is_same: bool) -> None:
    kept = State(name="K", doc="kept")
    designs = [Design(component="P", initial="K", states=(kept, state)) for state in (old, new)]
    assert find_renamed_states(designs[0], designs[1]) == ({"A": "Z"} if is_same else {})


def test_each_new_state_continues_one_old_state() -> None:
    old, new = design("AB"), Design(component="P", initial="A", states=(State(name="Z", doc="is A"),))
    assert find_renamed_states(replace(old, states=(State(name="A"), State(name="B"))), new) == {}
    copied = replace(old, states=(*old.states, replace(old.states[0], name="Z")))
    assert find_renamed_states(old, copied) == find_renamed_states(copied, old) == {}
    equal = (State(name="A"), State(name="B")), (State(name="Y"), State(name="Z"))
    assert find_renamed_states(replace(old, states=equal[0]), replace(old, states=equal[1])) == {"A": "Y", "B": "Z"}
