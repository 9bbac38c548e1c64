"""The primitives of a vector image: paths, texts, and groups."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from vicode.diagram.text_metrics import LABEL_FONT, Font
from vicode.model.design import Point

PathCommand = tuple[str, tuple[float, ...]]
"""M and L with one point, C with three, Z with none; absolute coordinates."""

# A quarter of a circle as a cubic curve.
_CIRCLE_KAPPA = 0.5523


@dataclass(frozen=True, slots=True, kw_only=True)
class PathShape:
    """Lines and curves; an empty color paints nothing."""

    commands: tuple[PathCommand, ...]
    fill: str = ""
    stroke: str = ""
    width: float = 1.5
    dash: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class TextShape:
    """One line of text; `x` is its start or its center, `y` its vertical center."""

    x: float
    y: float
    text: str
    fill: str
    font: Font = LABEL_FONT
    is_centered: bool = False
    is_struck_through: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class ShapeGroup:
    """Shapes that form one element; `title` is its tooltip and accessible name, `href` its link target.

    `key` identifies a node, `end_keys` the two nodes of an edge. An echo repeats another group and is skipped by
    keyboard
    navigation and screen readers.
    """

    title: str
    css_class: str
    shapes: tuple[PathShape | TextShape, ...]
    href: str = ""
    key: str = ""
    end_keys: tuple[str, ...] = ()
    is_decorative: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class VectorImage:
    """Shapes in drawing order, and the size of the image."""

    title: str
    doc: str
    left: float
    top: float
    width: float
    height: float
    background: str
    groups: tuple[ShapeGroup, ...] = field(default=())


def polyline_path(points: Sequence[Point], *, closed: bool = False) -> tuple[PathCommand, ...]:
    steps: list[PathCommand] = [("M", points[0]), *(("L", point) for point in points[1:])]
    return (*steps, ("Z", ())) if closed else tuple(steps)


def polylines_path(*runs: Sequence[Point], at: Point = (0, 0)) -> tuple[PathCommand, ...]:
    """Several lines in one path, translated."""
    return tuple(step for run in runs for step in polyline_path([(x + at[0], y + at[1]) for x, y in run]))


def curve_path(numbers: Sequence[float]) -> tuple[PathCommand, ...]:
    """A cubic curve from eight numbers: start, two control points, end."""
    return (("M", tuple(numbers[:2])), ("C", tuple(numbers[2:])))


def rounded_rect_path(at: Point, width: float, height: float, radius: float) -> tuple[PathCommand, ...]:
    x, y = at
    right, bottom = width / 2, height / 2
    r = min(radius, right, bottom)
    k = r * (1 - _CIRCLE_KAPPA)
    corners: Iterable[tuple[Point, Point, Point, Point]] = (
        ((right - r, -bottom), (right - k, -bottom), (right, -bottom + k), (right, -bottom + r)),
        ((right, bottom - r), (right, bottom - k), (right - k, bottom), (right - r, bottom)),
        ((-right + r, bottom), (-right + k, bottom), (-right, bottom - k), (-right, bottom - r)),
        ((-right, -bottom + r), (-right, -bottom + k), (-right + k, -bottom), (-right + r, -bottom)),
    )
    steps: list[PathCommand] = []
    for start, *rest in corners:
        steps.append(("L" if steps else "M", (x + start[0], y + start[1])))
        steps.append(("C", tuple(value for dx, dy in rest for value in (x + dx, y + dy))))
    return (*steps, ("Z", ()))


def circle_path(at: Point, radius: float) -> tuple[PathCommand, ...]:
    return rounded_rect_path(at, 2 * radius, 2 * radius, radius)
