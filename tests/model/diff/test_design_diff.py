"""The differences of designs in words: one line per change, moved and renamed items recognized."""

from dataclasses import replace

import pytest

from vicode.model.design import (
    Assign,
    Call,
    Code,
    Competence,
    CompetenceStep,
    DecisionGroup,
    Declaration,
    Design,
    DiagramFrame,
    Guard,
    Layer,
    RunCode,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.model.diff import ChangeKind, describe_change, describe_changes, diff_designs, diff_projects
from vicode.model.edits import add_state, remove_states, rename_state, rename_use, update_state
from vicode.model.project import BridgeSettings, Enumeration, Interface, Profile, ProfileClass, Project, RemoteReference

BASE = Design(
    component="Player",
    initial="Search",
    frequency_hz=10.0,
    uses=(Use(alias="ball", component="BallFinder", at=(0, 0)),),
    variables=(Declaration(name="tries", type="int", initial="0"),),
    states=(
        State(
            name="Search",
            at=(0, 0),
            doc="turns",
            transitions=(
                Transition(to="Follow", guard=Guard(when="ball.seen")),
                Transition(to="Wait", guard=Guard(after="5")),
                Stay(guard=Guard(when="tries > 3")),
            ),
        ),
        State(name="Follow", at=(100, 0), requires=("ball",), actions=(Assign(values=(("tries", "1"),)),)),
        State(name="Wait", at=(0, 100), transitions=(Transition(to="Search"),)),
    ),
)


def words(new: Design, old: Design = BASE) -> list[str]:
    return [describe_change(change) for change in diff_designs(old, new)]


def with_search(**changes: object) -> Design:
    return update_state(BASE, "Search", lambda state: replace(state, **changes))  # type: ignore[arg-type]


def transitions(*items: object) -> Design:
    return with_search(transitions=items)


FIRST, SECOND, THIRD = BASE.states[0].transitions
assert isinstance(FIRST, Transition)


@pytest.mark.parametrize(
    ("new", "expected"),
    [
        (BASE, []),
        (add_state(BASE, State(name="Kick")), ["+ state Kick"]),
        (replace(BASE, states=BASE.states[:2]), ["- state Wait: 1 transition"]),
        (with_search(at=(5, 5.5)), ["> moved state Search: 0, 0 → 5, 5.5"]),
        (with_search(at=None), ["> moved state Search: 0, 0 → (automatic)"]),
        (with_search(doc="looks"), ["~ description of state Search: turns → looks"]),
        (with_search(doc="a\nb"), ["~ description of state Search: 1 line → 2 lines (+2 -1)"]),
        (with_search(final=True), ["~ final of state Search: (none) → yes"]),
        (replace(BASE, frequency_hz=20.0), ["~ frequency: 10 → 20"]),
        (replace(BASE, initial="Wait"), ["~ initial state: Search → Wait"]),
        (replace(BASE, component="Goalie"), ["= renamed component Player → Goalie"]),
        (transitions(FIRST, THIRD), ["- transition Search → Wait: after 5"]),
        (
            transitions(FIRST, SECOND, THIRD, Transition(to="Follow", guard=Guard(when="x", after="1"))),
            ["+ transition Search → Follow: when x, after 1"],
        ),
        (
            transitions(replace(FIRST, guard=Guard(when="ball.near")), SECOND, THIRD),
            ["~ guard Search → Follow: ball.seen → ball.near"],
        ),
        (transitions(replace(FIRST, to="Wait"), SECOND, THIRD), ["~ target Search → Wait: Follow → Wait"]),
        (transitions(THIRD, FIRST, SECOND), ["> moved stay in Search: place 3 of 3 → place 1 of 3"]),
        (
            transitions(FIRST, SECOND, replace(THIRD, guard=Guard(code=Code(texts=(("python", "return x\n"),))))),
            ["~ guard of stay in Search: tries > 3 → (none)", "~ guard code of stay in Search: (none) → return x"],
        ),
        (
            transitions(
                FIRST, SECOND, THIRD, DecisionGroup(guard=Guard(when="x"), then=(SECOND,), otherwise=(Stay(),))
            ),
            ["+ decision of Search: when x: → Wait, stay"],
        ),
        (
            update_state(BASE, "Follow", lambda state: replace(state, requires=(), actions=(Call(alias="ball"),))),
            [
                "- requirement ball of state Follow",
                "- action of state Follow: set tries: 1",
                "+ action of state Follow: call ball",
            ],
        ),
        (
            update_state(BASE, "Follow", lambda state: replace(state, actions=(Assign(values=(("tries", "2"),)),))),
            ["~ action of state Follow: set tries: 1 → set tries: 2"],
        ),
        (
            replace(BASE, variables=(replace(BASE.variables[0], initial="7", unit="s"),)),
            ["~ value of variable tries: 0 → 7", "~ unit of variable tries: (none) → s"],
        ),
        (replace(BASE, variables=(replace(BASE.variables[0], name="n"),)), ["= renamed variable tries → n"]),
    ],
)
def test_a_change_is_one_line(new: Design, expected: list[str]) -> None:
    assert words(new) == expected


def test_references_to_renamed_states_and_uses_are_no_changes() -> None:
    assert words(rename_state(BASE, "Search", "Look")) == ["= renamed state Search → Look"]
    assert words(rename_use(BASE, "ball", "finder")) == ["= renamed use ball → finder"]


def test_a_renamed_state_is_compared_with_its_old_version() -> None:
    renamed = update_state(rename_state(BASE, "Search", "Look"), "Look", lambda state: replace(state, doc="looks"))
    assert words(renamed) == ["= renamed state Search → Look", "~ description of state Look: turns → looks"]


def test_other_states_are_removed_and_added() -> None:
    other = State(name="Kick", doc="kicks", at=(7, 7), final=True)
    new = add_state(remove_states(BASE, ["Wait"]), other)
    assert "+ state Kick" in words(new)
    assert any(line.startswith("- state Wait") for line in words(new))


def test_paths_lead_to_the_item() -> None:
    (change,) = diff_designs(BASE, transitions(FIRST, replace(SECOND, doc="!"), THIRD))
    assert (change.kind, change.path) == (ChangeKind.CHANGED, ("states", "Search", "transitions", 1, "doc"))


def test_declarations_of_a_project() -> None:
    side = Enumeration(name="Side", elements=(("left", ""), ("right", "")))
    head = Interface(component="Head", implementation="field:Head", outputs=(Declaration(name="angle"),))
    old = Project(name="P", enumerations=(side,), components=(head,))
    new = replace(
        old,
        enumerations=(replace(side, elements=(("left", "the left"), ("none", ""), ("right", ""))),),
        constants=(Declaration(name="speed", initial="3", unit="m/s"),),
        components=(replace(head, outputs=(Declaration(name="angle", unit="rad"),)),),
    )
    assert [describe_change(change) for change in diff_projects(old, new)] == [
        "+ element Side.none",
        "~ description of element Side.left: (none) → the left",
        "+ constant speed: 3 m/s",
        "~ unit of output angle of Head: (none) → rad",
    ]


def test_profiles_and_the_bridge_are_compared() -> None:
    camera = ProfileClass(component="Camera", implementation="sim:Camera")
    sim = Profile(name="sim", world="field:Field", components=(camera,))
    old = Project(name="p", profiles=(sim, Profile(name="lab")))
    remote = RemoteReference(component="Camera", remote="head/Camera")
    slow = replace(remote, reliable=True, max_age=0.5)
    new = replace(old, profiles=(replace(sim, world="", components=(remote,)),), bridge=BridgeSettings(port=7001))
    assert [describe_change(change) for change in diff_projects(old, new)] == [
        "- profile lab",
        "~ world of profile sim: field:Field → (none)",
        "~ profile sim, component Camera: sim:Camera → head/Camera",
        "~ port of bridge: (none) → 7001",
    ]
    slower = replace(new, profiles=(replace(sim, world="", components=(slow,)),))
    assert [describe_change(change) for change in diff_projects(new, slower)] == [
        "~ reliable of profile sim, component Camera: (none) → yes",
        "~ longest age of profile sim, component Camera: (none) → 0.5",
    ]


def test_frames_are_compared() -> None:
    old = Design(component="A", frames=(DiagramFrame(name="Near", states=("S",)), DiagramFrame(name="Far")))
    new = Design(
        component="A",
        frames=(DiagramFrame(name="Close", states=("S",)), DiagramFrame(name="Far", color="red", states=("S", "T"))),
    )
    renamed, colored, filled = diff_designs(old, new)
    assert (renamed.kind, renamed.subject, renamed.old) == (ChangeKind.RENAMED, "frame Close", "Near")
    assert (colored.attribute, colored.new) == ("color", "red")
    assert (filled.path, filled.new) == (("frames", "Far", "states"), "S, T")


def test_one_changed_line_is_shown() -> None:
    changes = words(with_search(doc="a\nc\nd"), with_search(doc="a\nb\nd"))
    assert changes == ["~ description of state Search: b → c"]


def test_a_decision_that_leaves_its_group_is_one_change() -> None:
    group = DecisionGroup(guard=Guard(when="near"), then=(FIRST, SECOND), otherwise=(THIRD,))
    smaller = replace(group, then=(SECOND,))
    assert words(transitions(smaller, FIRST), transitions(group)) == [
        "> moved transition Search → Follow: place 1 of 2 in 'then' of decision 1 (when near) → place 2 of 2"
    ]
    assert words(transitions(replace(group, otherwise=()), replace(THIRD, doc="!")), transitions(group)) == [
        "> moved stay in Search: place 1 of 1 in 'else' of decision 1 (when near) → place 2 of 2",
        "~ description of stay in Search: (none) → !",
    ]


def test_what_a_moved_group_loses_is_found_in_the_old_version() -> None:
    group = DecisionGroup(guard=Guard(when="near"), then=(FIRST, SECOND), id="g")
    old, new = transitions(THIRD, group), transitions(replace(group, then=(FIRST,)), THIRD)
    (lost,) = [change for change in diff_designs(old, new) if change.kind is ChangeKind.REMOVED]
    assert lost.path == ("states", "Search", "transitions", 1, "then", 1)


def test_a_reversed_list_shows_its_order() -> None:
    names = [Declaration(name=name, initial=name) for name in ("a", "b", "c")]
    old, new = (replace(BASE, variables=tuple(order)) for order in (names, names[::-1]))
    assert words(new, old) == ["~ order of variables: a, b, c → c, b, a"]
    assert words(transitions(THIRD, SECOND, FIRST)) == ["~ order of transitions of state Search: 1, 2, 3 → 3, 2, 1"]


def test_the_lines_of_code_that_changed_are_shown() -> None:
    old, new = (
        with_search(enter=(RunCode(code=Code(texts=(("python", text),))),)) for text in ("a\nb\nc\n", "a\nx\ny\nc\n")
    )
    (change,) = diff_designs(old, new)
    assert describe_changes([change]) == (
        "~ enter action of state Search: 3 lines → 4 lines (+2 -1)",
        "    - b",
        "    + x",
        "    + y",
    )
    one = with_search(enter=(RunCode(code=Code(texts=(("python", "a\nb\nd\n"),))),))
    assert words(one, old) == ["~ enter action of state Search: c → d"]


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        (with_search(doc="a  b"), with_search(doc="a b"), '"a  b" → "a b"'),
        (with_search(doc="x" * 120 + "a"), with_search(doc="x" * 120 + "b"), f'…"{"x" * 30}a" → …"{"x" * 30}b"'),
        (with_search(doc="a\n"), with_search(doc="a"), '"a\\n" → "a"'),
        (with_search(at=(0.1, 1234567.25)), with_search(at=(0.1, 1234567.5)), "0.1, 1234567.25 → 0.1, 1234567.5"),
        (replace(BASE, frequency_hz=10.0000001), BASE, "10.0000001 → 10"),
        (
            with_search(enter=(RunCode(code=Code(), id="a"),)),
            with_search(enter=(RunCode(code=Code(), id="b"),)),
            "a → b",
        ),
    ],
)
def test_texts_that_look_the_same_show_how_they_differ(old: Design, new: Design, expected: str) -> None:
    (line,) = words(new, old)
    assert line.endswith(f": {expected}")


AVOID = Layer(name="Avoid", when="s.x < 4", hold="0.3", modulates=(Call(alias="legs", arguments=(("speed", "-1"),)),))


def test_a_changed_layer_and_step_show_what_they_modulate() -> None:
    layers = Design(component="Player", layers=(Layer(name="Go"), AVOID))
    faster = replace(AVOID, modulates=(Call(alias="legs", arguments=(("speed", "-2"),)),))
    assert words(replace(layers, layers=(Layer(name="Go"), faster)), layers) == [
        "~ modulates of layer Avoid: legs(speed: -1) → legs(speed: -2)"
    ]
    assert words(layers, replace(layers, layers=(Layer(name="Go"),))) == [
        "+ layer Avoid: when s.x < 4; for 0.3; modulates legs(speed: -1)"
    ]
    grab = CompetenceStep(name="Grab", modulates=AVOID.modulates)
    empty = replace(layers, layers=(), competence=Competence(goal="s.b"))
    steps = replace(empty, competence=Competence(goal="s.b", steps=(grab,)))
    assert words(steps, empty) == ["+ step Grab: modulates legs(speed: -1)"]
    more = replace(empty, competence=Competence(goal="s.b", steps=(replace(grab, retries=3),)))
    assert words(more, steps) == ["~ retries of step Grab: (none) → 3"]
