"""Who uses whom, drawn: users stand before what they use, circles end, nothing overlaps."""

from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree

from tests.diagram.drawn_designs import ring_design, shipped_designs
from vicode.diagram.drawing import draw_figure
from vicode.diagram.figure import Figure
from vicode.diagram.svg import write_svg
from vicode.diagram.thumbnail import thumbnail
from vicode.diagram.usage import leaves_out, usage_figure
from vicode.model.design import Call, Design, State, Use
from vicode.model.project import Interface, Project
from vicode.store import open_project

FORWARD = Path(__file__).parents[2] / "designs" / "forward"


def xs_of(figure: Figure) -> dict[str, float]:
    return {node.key: node.at[0] for node in figure.nodes}


def test_users_stand_before_what_they_use() -> None:
    figure = usage_figure(open_project(FORWARD).project)
    xs = xs_of(figure)
    for arrow in figure.arrows:
        user, used = (arrow.target, arrow.source) if arrow.of == "requires" else (arrow.source, arrow.target)
        assert xs[user] < xs[used], arrow
    assert {"Player", "Perception", "Walk"} <= set(xs)


def test_boxes_do_not_overlap() -> None:
    figure = usage_figure(open_project(FORWARD).project)
    for one, other in combinations(figure.nodes, 2):
        apart = abs(one.at[0] - other.at[0]) >= (one.size.width + other.size.width) / 2
        assert apart or abs(one.at[1] - other.at[1]) >= one.size.height


def test_circles_end() -> None:
    names = [f"C{index}" for index in range(30)]
    designs = tuple(
        Design(
            component=name,
            uses=tuple(Use(alias=other.lower(), component=other) for other in names),
            states=(State(name="S", modulates=(Call(alias=names[0].lower()),)),),
        )
        for name in names
    )
    figure = usage_figure(Project(name="all", designs=designs))
    assert len(figure.nodes) == 30


def asking_project(count: int) -> Project:
    """So many designs that call the next one, ask one interface, and require another."""
    designs = tuple(
        Design(
            component=f"D{index}",
            uses=(
                Use(alias="next", component=f"D{index + 1}"),
                Use(alias="asked", component="Asked"),
                Use(alias="required", component="Required"),
            ),
            states=(State(name="S", requires=("required",), modulates=(Call(alias="next"),)),),
        )
        for index in range(count)
    )
    return Project(
        name="p", components=(Interface(component="Asked"), Interface(component="Required")), designs=designs
    )


def test_a_dense_figure_leaves_out_what_is_only_asked() -> None:
    few, many = asking_project(20), asking_project(60)
    assert not leaves_out(few)
    assert usage_figure(few, sparse=True) == usage_figure(few)
    assert leaves_out(many)
    names = {node.key for node in usage_figure(many, sparse=True).nodes}
    assert names == {node.key for node in usage_figure(many).nodes} - {"Asked"}
    assert len(usage_figure(many, sparse=True).arrows) == len(usage_figure(many).arrows) - 60


def test_designs_are_links_and_names_are_only_names() -> None:
    evil = '"><script>alert(1)</script>'
    project = Project(name="p", designs=(Design(component=evil, doc=evil, uses=(Use(alias="a", component="B"),)),))
    figure = usage_figure(project, lambda component: f"/design/p/{component}")
    root = ElementTree.fromstring(write_svg(draw_figure(figure, title=evil)))
    links = [element for element in root.iter() if element.tag.endswith("}a")]
    assert [link.attrib["href"] for link in links] == [f"/design/p/{evil}"]
    assert not [element for element in root.iter() if element.tag.endswith("script")]


def test_thumbnails_are_small_whatever_they_show() -> None:
    for design in (*shipped_designs(), Design(component="Nothing"), ring_design(300)):
        text = thumbnail(design)
        ElementTree.fromstring(text)
        assert len(text) < 200_000
