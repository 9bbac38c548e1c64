"""Decision trees contain every decision, nothing overlaps, and no edge crosses a box."""

from itertools import combinations, pairwise

from hypothesis import given
from hypothesis import strategies as st

from vicode.diagram.decision_tree import MAX_NODES, TreeLinks, render_decision_tree
from vicode.diagram.palettes import LIGHT
from vicode.diagram.primitives import PathShape, VectorImage
from vicode.diagram.primitives import ShapeGroup as Shapes
from vicode.findings import DesignPath
from vicode.model.design import Decision, DecisionGroup, Guard, Stay, Transition

Rect = tuple[float, float, float, float]
LINKS = TreeLinks(condition_href=lambda path: "#" + "-".join(map(str, path)), target_href=lambda name: f"#{name}")
PATH: DesignPath = ("states", "A", "transitions")

guards = st.sampled_from(["", "ball.seen", "ball.distance < 300 and not walk.busy"]).map(lambda when: Guard(when=when))
leaves = st.one_of(
    st.builds(Transition, to=st.sampled_from(["B", "LookForBall"]), guard=guards, disabled=st.booleans()),
    st.builds(Stay, guard=guards),
)
decisions = st.recursive(
    leaves,
    lambda inner: st.builds(
        DecisionGroup,
        guard=guards,
        then=st.lists(inner, min_size=1, max_size=3).map(tuple),
        otherwise=st.lists(inner, max_size=3).map(tuple),
    ),
    max_leaves=12,
)


def draw(items: tuple[Decision, ...], most: int = MAX_NODES) -> VectorImage | None:
    return render_decision_tree(items, PATH, title="t", links=LINKS, palette=LIGHT, max_nodes=most)


def boxes_in(drawing: VectorImage) -> list[Shapes]:
    return [group for group in drawing.groups if group.css_class != "way"]


def points_of(group: Shapes) -> list[tuple[float, float]]:
    steps = [numbers[-2:] for shape in group.shapes[:1] for _letter, numbers in shape.commands if numbers]  # type: ignore[union-attr]
    return [(x, y) for x, y in steps]


def rect_of(group: Shapes) -> Rect:
    points = points_of(group)
    return (min(x for x, _ in points), min(y for _, y in points), max(x for x, _ in points), max(y for _, y in points))


def test_tree_contents() -> None:
    near = Guard(when="near")
    items = (
        DecisionGroup(
            guard=Guard(when="seen"),
            then=(Transition(to="Kick", guard=near, doc="it is near"),),
            otherwise=(Transition(to="Look"),),
        ),
        Transition(to="Walk", guard=Guard(after="2")),
    )
    drawing = draw(items)
    assert drawing is not None
    found = [(group.css_class, group.title, group.href) for group in drawing.groups if group.css_class != "way"]
    assert found == [
        ("condition", "seen", "#states-A-transitions-0"),
        ("condition", "near\nit is near", "#states-A-transitions-0-then-0"),
        ("target", "go to Kick", "#Kick"),
        ("target", "go to Look", "#Look"),
        ("condition", "after 2 s", "#states-A-transitions-1"),
        ("target", "go to Walk", "#Walk"),
        ("stay", "stay", ""),
    ]


@given(st.lists(decisions, min_size=1, max_size=4).map(tuple))
def test_nothing_overlaps(items: tuple[Decision, ...]) -> None:
    drawing = draw(items)
    assert drawing is not None
    nothing_overlaps(drawing)


def nothing_overlaps(drawing: VectorImage) -> None:
    boxes = [rect_of(group) for group in drawing.groups if group.css_class != "way"]
    for one, other in combinations(boxes, 2):
        assert one[2] < other[0] or other[2] < one[0] or one[3] < other[1] or other[3] < one[1]
    for group in drawing.groups:
        if group.css_class == "way":
            for start, end in pairwise(points_of(group)):
                assert not [box for box in boxes if runs_through(start, end, box)]
    right, bottom = drawing.left + drawing.width, drawing.top + drawing.height
    assert all(drawing.left < box[0] and box[2] < right and drawing.top < box[1] and box[3] < bottom for box in boxes)


def runs_through(start: tuple[float, float], end: tuple[float, float], box: Rect) -> bool:
    """Whether a horizontal or vertical segment enters a box; touching its border is allowed."""
    left, right = sorted((start[0], end[0]))
    top, bottom = sorted((start[1], end[1]))
    return left < box[2] - 1 and right > box[0] + 1 and top < box[3] - 1 and bottom > box[1] + 1


def test_no_decisions_give_no_tree() -> None:
    assert draw(()) is None


def test_a_disabled_transition_is_dashed() -> None:
    drawing = draw((Transition(to="B", guard=Guard(when="a"), disabled=True), Transition(to="C")))
    assert drawing is not None
    dashes = {
        group.title: group.shapes[0].dash for group in boxes_in(drawing) if isinstance(group.shapes[0], PathShape)
    }
    assert {title for title, dash in dashes.items() if dash} == {"a", "go to B"}


def nested(depth: int, wide: int) -> tuple[Decision, ...]:
    if not depth:
        return (Transition(to="B", guard=Guard(when="last")),)
    return tuple(DecisionGroup(guard=Guard(when=f"a{index}"), then=nested(depth - 1, wide)) for index in range(wide))


def test_many_tests_are_collapsed_into_a_linked_box() -> None:
    drawing = draw(tuple(Transition(to="B", guard=Guard(when=f"a == {number}")) for number in range(MAX_NODES)))
    assert drawing is not None
    boxes = [group for group in drawing.groups if group.css_class != "way"]
    assert len(boxes) <= MAX_NODES
    (folded,) = [group for group in boxes if group.css_class == "folded"]
    drawn = sum(group.css_class == "condition" for group in boxes)
    assert folded.title == f"{MAX_NODES - drawn} more tests, which are not drawn"
    assert folded.href == f"#states-A-transitions-{drawn}"
    assert boxes[-1].title == "stay"


def test_deep_trees_show_their_upper_levels_and_linked_boxes() -> None:
    drawing = draw(nested(5, 3))
    assert drawing is not None
    boxes = [group for group in drawing.groups if group.css_class != "way"]
    folded = [group for group in boxes if group.css_class == "folded"]
    # Levels of 3, 9 and 27 tests fit, one of 81 does not; each of the 27 has 3 children with 3 each and their ends.
    assert sum(group.css_class == "condition" for group in boxes) == 3 + 9 + 27
    assert [group.title for group in folded] == ["21 more tests, which are not drawn"] * 27
    assert folded[0].href == "#states-A-transitions-0-then-0-then-0-then-0"


@given(st.lists(decisions, min_size=1, max_size=4).map(tuple), st.integers(1, 12))
def test_a_collapsed_tree_is_a_tree(items: tuple[Decision, ...], most: int) -> None:
    whole, part = draw(items), draw(items, most)
    assert whole is not None
    assert part is not None
    boxes_of = {"whole": boxes_in(whole), "part": boxes_in(part)}
    assert len(boxes_of["part"]) <= len(boxes_of["whole"]) + 1
    nothing_overlaps(part)
    folded = [group for group in boxes_of["part"] if group.css_class == "folded"]
    assert all(group.href.startswith("#states-A-transitions-") for group in folded)
    shown = [(group.title, group.href) for group in boxes_of["part"] if group.css_class == "condition"]
    assert set(shown) <= {(group.title, group.href) for group in boxes_of["whole"]}
    assert len(shown) == sum(group.css_class == "condition" for group in boxes_of["whole"]) or folded


@given(st.lists(decisions, min_size=1, max_size=4).map(tuple))
def test_every_box_and_edge_has_a_link_and_a_title(items: tuple[Decision, ...]) -> None:
    drawing = draw(items)
    if drawing is None:
        return
    boxes = [group for group in drawing.groups if group.css_class != "way"]
    ways = [group for group in drawing.groups if group.css_class == "way"]
    implied = [group for group in boxes if not group.href]
    assert len(implied) <= 1
    assert all(group.title for group in boxes)
    assert all(group.title.startswith("when ") and group.is_decorative for group in ways[1:])
    assert all(group.href for group in ways[1:] if not implied)
