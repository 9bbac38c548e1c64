"""One component, with those that use it to its left and those that it uses to its right, as a figure to draw."""

from collections.abc import Callable, Iterator, Mapping, Sequence

from vicode.diagram.boxes import Size, size_of_use
from vicode.diagram.figure import Arrow, Figure, Node
from vicode.diagram.lettering import NAME, shorten
from vicode.diagram.usage import Uses, arrows_of, uses_of
from vicode.model.design import Point
from vicode.model.project import Project

USERS, USED = "more:users", "more:used"
"""The keys of the boxes that stand for all that is left out on one side."""

_BETWEEN, _ROW, _HEIGHT = 150.0, 52.0, 40.0
_MOST_ROWS = 12
_NAME_ROOM = 230.0


def around_figure(project: Project, name: str, has_design: Callable[[str], bool]) -> Figure:
    """The figure of a design and its neighbors; hand-written ones that are only asked are left out."""
    uses = _uses_around(project, name, has_design)
    users = _shown(sorted(uses.keys() - {name}, key=str.casefold), USERS)
    used = _shown(sorted(uses.get(name, {}).keys() - uses.keys(), key=str.casefold), USED)
    labels = {name: name} | users | used
    places = {name: (0.0, 0.0), **dict(_column(name, users, -1)), **dict(_column(name, used, 1))}
    nodes = tuple(
        Node(
            key=key,
            of="state" if key == name or key in (USERS, USED) or has_design(key) else "component",
            at=places[key],
            size=_size(label),
            label=shorten(label, NAME, _NAME_ROOM),
            title=_title(project, label),
        )
        for key, label in labels.items()
    )
    return Figure(nodes=nodes, arrows=(*arrows_of(_among(uses, labels), labels), *_rest(name, labels)))


def _uses_around(project: Project, name: str, has_design: Callable[[str], bool]) -> Uses:
    uses: dict[str, dict[str, frozenset[str]]] = {}
    for design in project.designs:
        found = {
            used: kinds
            for used, kinds in uses_of(design).items()
            if (kinds or has_design(used)) and name in (used, design.component)
        }
        if found:
            uses[design.component] = found
    return uses


def _shown(names: Sequence[str], rest: str) -> dict[str, str]:
    """Labels by key: all names, or the first of them and how many more there are."""
    if len(names) <= _MOST_ROWS:
        return {name: name for name in names}
    kept = names[: _MOST_ROWS - 1]
    return {name: name for name in kept} | {rest: f"{len(names) - len(kept)} more"}


def _among(uses: Uses, labels: Mapping[str, str]) -> Uses:
    return {user: used for user, used in uses.items() if user in labels}


def _rest(name: str, labels: Mapping[str, str]) -> Iterator[Arrow]:
    for key, ends in ((USERS, (USERS, name)), (USED, (name, USED))):
        if key in labels:
            yield Arrow(key=key, of="transition", source=ends[0], target=ends[1], title=labels[key])


def _column(name: str, others: Mapping[str, str], side: int) -> Iterator[tuple[str, Point]]:
    """Boxes above each other that begin, seen from the middle, at one line."""
    edge = _size(name).width / 2 + _BETWEEN
    for row, (key, label) in enumerate(others.items()):
        yield key, (side * (edge + _size(label).width / 2), (row - (len(others) - 1) / 2) * _ROW)


def _size(label: str) -> Size:
    return Size(width=size_of_use(label, "").width, height=_HEIGHT)


def _title(project: Project, name: str) -> str:
    interface = project.interface(name)
    doc = " ".join(interface.doc.split()) if interface else ""
    return "\n".join(part for part in (name, doc) if part)
