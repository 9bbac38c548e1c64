"""The scene of the canvas, and differences of scenes."""

from vicode.editor.view import ItemRef, diff_scenes, guard_label, item_at_path, make_scene
from vicode.findings import Finding, FindingSubject, get_rule
from vicode.model.decision_keys import parse_transition_key, transition_key
from vicode.model.design import (
    Call,
    Code,
    CommonSection,
    DecisionGroup,
    Design,
    Guard,
    RunCode,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.model.edits import move_nodes, rename_state, set_disabled
from vicode.model.project import Project

DESIGN = Design(
    component="Player",
    initial="A",
    uses=(Use(alias="head", component="Head"),),
    common=CommonSection(transitions=(Transition(to="B", guard=Guard(when="fallen")),)),
    states=(
        State(
            name="A",
            at=(100, 100),
            requires=("head",),
            actions=(RunCode(code=Code(texts=(("python", "pass"),))),),
            transitions=(
                DecisionGroup(
                    guard=Guard(when="seen"),
                    then=(Transition(to="B", guard=Guard(after="5")), Stay()),
                    otherwise=(Transition(to="A"),),
                ),
                Transition(to="B", guard=Guard(when="a\n  and b", code=Code(texts=(("python", "return True"),)))),
            ),
        ),
        State(name="B", final=True),
    ),
)
PROJECT = Project(name="p", designs=(DESIGN,))


def test_transitions_are_numbered_in_the_order_they_are_tested() -> None:
    scene = make_scene(PROJECT, DESIGN, (), 7)
    rows = [
        (item["id"], item["source"], item["target"], item["label"], item["order"], item["of"], item["kind"])
        for item in scene["transitions"]
    ]
    assert rows == [
        ("@common/0", "@common", "B", "fallen", 1, 1, "guard"),
        ("A/0/then/0", "A", "B", "seen › 5 s", 1, 3, "tree"),
        ("A/0/else/0", "A", "A", "else", 2, 3, "tree"),
        ("A/1", "A", "B", "a and b and { code }", 3, 3, "code"),
    ]
    assert scene["rev"] == 7
    assert [item["guard"] for item in scene["transitions"]] == ["fallen", "after 5 s", "", "a and b"]


def test_disabled_items_are_marked() -> None:
    scene = make_scene(PROJECT, set_disabled(DESIGN, ["B"], [("states", "A", "transitions", 0)], disabled=True), (), 0)
    assert [item["disabled"] for item in scene["states"]] == [False, True]
    assert [item["disabled"] for item in scene["transitions"]] == [True, True, True, True]
    scene = make_scene(
        PROJECT, set_disabled(DESIGN, [], [("states", "A", "transitions", 0, "else", 0)], disabled=True), (), 0
    )
    assert [item["disabled"] for item in scene["transitions"]] == [False, False, True, False]


def test_every_item_has_a_position() -> None:
    scene = make_scene(PROJECT, DESIGN, (), 0)
    places = [(item["x"], item["y"]) for item in (*scene["states"], *scene["components"], scene["common"])]
    assert len(set(places)) == len(places) == 4
    assert places[0] == (100, 100)


def test_findings_mark_the_smallest_item() -> None:
    finding = Finding(
        rule=get_rule("E303"),
        message="'sen' is not declared",
        subject=FindingSubject(component="Player", path=("states", "A", "transitions", 0, "then", 0, "when")),
    )
    elsewhere = Finding(
        rule=get_rule("D421"), message="x", subject=FindingSubject(component="Other", path=("states", "A"))
    )
    scene = make_scene(PROJECT, DESIGN, (finding, elsewhere), 0)
    marked = {item["id"]: item["messages"] for item in (*scene["transitions"], *scene["states"]) if item["severity"]}
    assert marked == {"A/0/then/0": ["error: 'sen' is not declared"]}


def test_a_diff_lists_changed_and_removed_items() -> None:
    old = make_scene(PROJECT, DESIGN, (), 0)
    assert diff_scenes(old, old) == {
        "rev": 0,
        "upsert": {"states": [], "transitions": [], "components": [], "links": [], "frames": [], "notes": []},
        "remove": {"states": [], "transitions": [], "components": [], "links": [], "frames": [], "notes": []},
    }
    new = make_scene(PROJECT, move_nodes(rename_state(DESIGN, "B", "C"), {"A": (5, 5)}), (), 1)
    changes = diff_scenes(old, new)
    assert [change["id"] for change in changes["upsert"]["states"]] == ["A", "C"]
    assert changes["remove"]["states"] == ["B"]
    assert {change["target"] for change in changes["upsert"]["transitions"]} == {"C"}


def test_keys_are_converted_back_to_paths() -> None:
    for path in (
        ("states", "A", "transitions", 0, "then", 0),
        ("common", "transitions", 2),
        ("states", "0", "transitions", 1),
    ):
        assert parse_transition_key(transition_key(path)) == path
    assert item_at_path(("states", "A", "actions", 0, "code")) == ItemRef(kind="states", id="A")
    assert item_at_path(("common", "actions", 0)) == ItemRef(kind="common", id="@common")
    assert item_at_path(("uses", "head")) == ItemRef(kind="components", id="head")
    assert item_at_path(("variables", "tries", "initial")) == ItemRef(kind="design")


def test_guards_are_formatted_in_one_line() -> None:
    assert guard_label(Guard()) == ""
    assert guard_label(Guard(when="x", after="2.5")) == "x and 2.5 s"
    assert guard_label(Guard(when="x", after="2.5"), "ms") == "x and 2.5 ms"


def test_calls_are_actions_of_the_common_section() -> None:
    """They have no sign of their own there."""
    common = CommonSection(actions=(Call(alias="drive"),))
    design = Design(
        component="P", uses=(Use(alias="drive", component="Drive"),), common=common, states=(State(name="A"),)
    )
    scene = make_scene(Project(name="P", designs=(design,)), design, (), 1)
    assert scene["common"] is not None
    assert scene["common"]["actions"]
