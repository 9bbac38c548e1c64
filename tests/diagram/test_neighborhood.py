"""A component and its neighbors: users on the left, used components on the right, many of them collapsed."""

import pytest

from vicode.diagram.neighborhood import MORE_USED, MORE_USERS, neighborhood_diagram
from vicode.model.design import Call, Design, State, Use
from vicode.model.project import Project


def user_of(name: str, *used: str, asked: tuple[str, ...] = ()) -> Design:
    uses = tuple(Use(alias=each.lower(), component=each) for each in (*used, *asked))
    state = State(name="S", actions=tuple(Call(alias=each.lower()) for each in used))
    return Design(component=name, initial="S", states=(state,), uses=uses)


def around(project: Project, name: str) -> dict[str, float]:
    """The horizontal offset of each neighbor."""
    names = {design.component for design in project.designs}
    figure = neighborhood_diagram(project, name, names.__contains__)
    known = {node.key for node in figure.nodes}
    assert all({arrow.source, arrow.target} <= known for arrow in figure.edges)
    assert all(name in (arrow.source, arrow.target) for arrow in figure.edges)
    boxes = [(node.center, node.size) for node in figure.nodes]
    for index, (at, size) in enumerate(boxes):
        for other, its in boxes[:index]:
            beside = abs(at[0] - other[0]) >= (size.width + its.width) / 2
            assert beside or abs(at[1] - other[1]) >= (size.height + its.height) / 2
    return {node.key: node.center[0] for node in figure.nodes}


def test_users_are_on_the_left_and_used_components_on_the_right() -> None:
    designs = (
        user_of("Top", "Middle"),
        user_of("Middle", "Leg", "Other", asked=("World", "Helper")),
        user_of("Other", "Middle"),
        user_of("Helper", "Leg"),
    )
    places = around(Project(name="p", designs=designs), "Middle")
    assert set(places) == {"Middle", "Top", "Other", "Leg", "Helper"}
    assert places["Top"] < 0 == places["Middle"] < places["Leg"]
    # A component that is user and used is among the users; one that is only read from is shown if it is a design.
    assert places["Other"] < 0 < places["Helper"]


def test_an_unused_component_has_no_neighbors() -> None:
    assert around(Project(name="p", designs=(user_of("Alone", asked=("World",)), user_of("Other"))), "Alone") == {
        "Alone": 0
    }


@pytest.mark.parametrize("count", [12, 13, 40])
def test_many_neighbors_are_collapsed_into_a_count(count: int) -> None:
    users = tuple(user_of(f"User{index:02}", "Middle") for index in range(count))
    middle = user_of("Middle", *(f"Leg{index:02}" for index in range(count)))
    project = Project(name="p", designs=(*users, middle))
    names = {design.component for design in project.designs}
    labels = {node.key: node.label for node in neighborhood_diagram(project, "Middle", names.__contains__).nodes}
    assert len(around(project, "Middle")) == 25
    if count == 12:
        assert {MORE_USERS, MORE_USED}.isdisjoint(labels)
    else:
        assert labels[MORE_USERS] == labels[MORE_USED] == f"{count - 11} more"
        assert "User10" in labels
        assert "User11" not in labels
