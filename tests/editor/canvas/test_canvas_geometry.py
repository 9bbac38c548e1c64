"""Arithmetic of the canvas without a browser: aligning, distributing, and label positions on a curve."""

from typing import Any

import pytest

from tests.editor.canvas.run_js import run_js

NODES = [
    {"key": "start", "x": 120, "y": 100, "w": 120, "h": 60},
    {"key": "go", "x": 440, "y": 140, "w": 160, "h": 60},
    {"key": "stop", "x": 400, "y": 320, "w": 120, "h": 60},
]
# A straight curve from (0, 0) to (300, 0).
CURVE = [0, 0, 100, 0, 200, 0, 300, 0]


def arrange(function: str, command: str) -> dict[str, tuple[int, int]]:
    centers: dict[str, Any] = run_js(
        "alignment.js", function, f"Object.fromEntries({function}(...args))", NODES, command
    )
    return {key: (center["x"], center["y"]) for key, center in centers.items()}


@pytest.mark.parametrize(
    ("command", "centers"),
    [
        ("align-left", {"start": (120, 100), "go": (140, 140), "stop": (120, 320)}),
        ("align-center", {"start": (290, 100), "go": (290, 140), "stop": (290, 320)}),
        ("align-right", {"start": (460, 100), "go": (440, 140), "stop": (460, 320)}),
        ("align-top", {"start": (120, 100), "go": (440, 100), "stop": (400, 100)}),
        ("align-middle", {"start": (120, 210), "go": (440, 210), "stop": (400, 210)}),
        ("align-bottom", {"start": (120, 320), "go": (440, 320), "stop": (400, 320)}),
    ],
)
def test_nodes_are_aligned_at_one_side_of_their_bounds(command: str, centers: dict[str, tuple[int, int]]) -> None:
    assert arrange("align", command) == centers


@pytest.mark.parametrize(
    ("command", "centers"), [("distribute-across", {"stop": (270, 320)}), ("distribute-down", {"go": (440, 210)})]
)
def test_nodes_are_distributed_between_the_outer_ones(command: str, centers: dict[str, tuple[int, int]]) -> None:
    assert arrange("distribute", command) == centers


@pytest.mark.parametrize(
    ("offset", "position"),
    [((0.5, 0), (150, 0)), ((0.5, 40), (150, 40)), ((-0.5, 0), (0, 0)), ((1.5, 0), (300, 0)), ((2, -10), (300, -10))],
)
def test_label_positions_are_clamped_to_the_curve(offset: tuple[float, int], position: tuple[int, int]) -> None:
    point = run_js("edge_labels.js", "labelPosition", "labelPosition(...args)", CURVE, offset)
    assert (point["x"], point["y"]) == pytest.approx(position)


@pytest.mark.parametrize(("point", "offset"), [((150, 40), [0.5, 40]), ((-80, 0), [0, 0]), ((400, -20), [1, -20])])
def test_label_offsets_refer_to_the_nearest_point_of_the_curve(point: tuple[int, int], offset: list[float]) -> None:
    assert (
        run_js("edge_labels.js", "labelOffset", "labelOffset(args[0], {x: args[1], y: args[2]})", CURVE, *point)
        == offset
    )
