"""Drawings read well: labels hide neither boxes nor each other where there is room, lines go around boxes."""

from collections.abc import Callable, Mapping
from typing import Any

from tests.editor.canvas.conftest import CanvasDriver
from tests.editor.canvas.legibility import forward_scenes, measure_legibility, random_scenes

Show = Callable[[Mapping[str, Any]], CanvasDriver]


def test_nothing_is_hidden_in_the_shipped_designs(show: Show) -> None:
    for name, scene in forward_scenes().items():
        counted = measure_legibility(show(scene).page)
        hidden = (counted.labels_on_boxes, counted.labels_on_labels, counted.labels_off_their_lines)
        assert (name, *hidden, counted.lines_over_boxes) == (name, 0, 0, 0, 0)


def test_little_is_hidden_in_random_designs(show: Show) -> None:
    counts = [measure_legibility(show(scene).page) for scene in random_scenes(8).values()]
    labels = sum(each.labels for each in counts)
    hidden = sum(each.labels_on_boxes + each.labels_on_labels + each.labels_off_their_lines for each in counts)
    assert labels > 400
    assert hidden / labels < 0.015
    assert sum(each.labels_on_labels for each in counts) == 0


def test_lanes_are_read_from_above_in_the_order_of_the_design(show: Show) -> None:
    hand = show(forward_scenes()["SearchNet"])
    (first, second) = (hand.at("transitions", f"OtherSide/{index}") for index in range(2))
    assert first[1] < second[1]
