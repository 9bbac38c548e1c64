"""The few things a drawing is made of, whatever it is written as: paths, texts, and named groups of them."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from vicode.diagram.lettering import LABEL, Letters
from vicode.model.design import Point

Step = tuple[str, tuple[float, ...]]
"""M and L with a point, C with three, Z with none; all absolute."""

# A quarter of a circle as a cubic curve.
_ROUND = 0.5523


@dataclass(frozen=True, slots=True, kw_only=True)
class Path:
    """Lines and curves; an empty colour paints nothing."""

    steps: tuple[Step, ...]
    fill: str = ""
    stroke: str = ""
    width: float = 1.5
    dash: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Text:
    """One line; `x` is its beginning or its middle, `y` the middle of its height."""

    x: float
    y: float
    text: str
    fill: str
    letters: Letters = LABEL
    is_centred: bool = False
    is_struck: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Group:
    """Shapes that are one thing; `title` is its tip and its name for screen readers, `href` where a click leads.

    `key` names a node, `ends` are the keys of the nodes an arrow joins. An echo says again what another group says:
    keys and screen readers pass it over.
    """

    title: str
    kind: str
    shapes: tuple[Path | Text, ...]
    href: str = ""
    key: str = ""
    ends: tuple[str, ...] = ()
    is_echo: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawing:
    """All of it, drawn in this order, and the room it needs."""

    title: str
    doc: str
    left: float
    top: float
    width: float
    height: float
    paper: str
    groups: tuple[Group, ...] = field(default=())


def line(points: Sequence[Point], *, closed: bool = False) -> tuple[Step, ...]:
    """Straight from point to point."""
    steps: list[Step] = [("M", points[0]), *(("L", point) for point in points[1:])]
    return (*steps, ("Z", ())) if closed else tuple(steps)


def lines(*runs: Sequence[Point], at: Point = (0, 0)) -> tuple[Step, ...]:
    """Several lines in one path, shifted to a place."""
    return tuple(step for run in runs for step in line([(x + at[0], y + at[1]) for x, y in run]))


def curve(numbers: Sequence[float]) -> tuple[Step, ...]:
    """A cubic curve from eight numbers: start, two controls, end."""
    return (("M", tuple(numbers[:2])), ("C", tuple(numbers[2:])))


def box(at: Point, width: float, height: float, radius: float) -> tuple[Step, ...]:
    """A rectangle with round corners around a centre."""
    x, y = at
    right, bottom = width / 2, height / 2
    r = min(radius, right, bottom)
    k = r * (1 - _ROUND)
    corners: Iterable[tuple[Point, Point, Point, Point]] = (
        ((right - r, -bottom), (right - k, -bottom), (right, -bottom + k), (right, -bottom + r)),
        ((right, bottom - r), (right, bottom - k), (right - k, bottom), (right - r, bottom)),
        ((-right + r, bottom), (-right + k, bottom), (-right, bottom - k), (-right, bottom - r)),
        ((-right, -bottom + r), (-right, -bottom + k), (-right + k, -bottom), (-right + r, -bottom)),
    )
    steps: list[Step] = []
    for start, *rest in corners:
        steps.append(("L" if steps else "M", (x + start[0], y + start[1])))
        steps.append(("C", tuple(value for dx, dy in rest for value in (x + dx, y + dy))))
    return (*steps, ("Z", ()))


def disc(at: Point, radius: float) -> tuple[Step, ...]:
    """A circle around a centre."""
    return box(at, 2 * radius, 2 * radius, radius)
