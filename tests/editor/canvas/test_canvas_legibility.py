"""Legibility of diagrams: labels overlap neither nodes nor each other, edges avoid nodes."""

from collections.abc import Callable, Mapping
from typing import Any

from playwright.sync_api import expect

from tests.editor.canvas.conftest import CanvasDriver
from tests.editor.canvas.legibility import forward_scenes, measure_legibility, random_scenes

Show = Callable[[Mapping[str, Any]], CanvasDriver]


def test_shipped_designs_have_no_overlaps(show: Show) -> None:
    for name, scene in forward_scenes().items():
        counted = measure_legibility(show(scene).page)
        hidden = (counted.labels_on_boxes, counted.labels_on_labels, counted.labels_off_their_lines)
        assert (name, *hidden, counted.lines_over_boxes) == (name, 0, 0, 0, 0)


def test_random_designs_have_few_overlaps(show: Show) -> None:
    counts = [measure_legibility(show(scene).page) for scene in random_scenes(8).values()]
    labels = sum(count.labels for count in counts)
    hidden = sum(count.labels_on_boxes + count.labels_on_labels + count.labels_off_their_lines for count in counts)
    assert labels > 400
    assert hidden / labels < 0.015
    assert sum(count.labels_on_labels for count in counts) == 0


def test_all_names_are_enlarged_at_small_zooms(show: Show) -> None:
    canvas = show(forward_scenes()["Player"])
    canvas.page.evaluate("document.querySelector('.vicode-canvas').vicode.setView({ k: 0.4 })")
    badge = canvas.page.locator("g.common")
    expect(badge.locator(".large").first).to_be_visible()
    expect(badge.locator(".name")).to_be_hidden()


def test_parallel_edges_are_ordered_by_priority_from_top_to_bottom(show: Show) -> None:
    canvas = show(forward_scenes()["SearchNet"])
    (first, second) = (canvas.at("transitions", f"OtherSide/{index}") for index in range(2))
    assert first[1] < second[1]
