"""Dependency diagrams: users come before the components they use, cycles terminate, nothing overlaps."""

from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree

from tests.diagram.diagram_designs import ring_design, shipped_designs
from vicode.diagram.dependency_graph import dependency_diagram, has_omitted_uses
from vicode.diagram.diagram_model import Diagram
from vicode.diagram.render import render_diagram
from vicode.diagram.svg import write_svg
from vicode.diagram.thumbnail import render_thumbnail
from vicode.model.design import Call, Design, State, Use
from vicode.model.project import Interface, Project
from vicode.store import open_project

FORWARD = Path(__file__).parents[2] / "designs" / "forward"


def xs_of(figure: Diagram) -> dict[str, float]:
    return {node.key: node.center[0] for node in figure.nodes}


def test_users_come_before_the_components_they_use() -> None:
    figure = dependency_diagram(open_project(FORWARD).project)
    xs = xs_of(figure)
    for arrow in figure.edges:
        user, used = (arrow.target, arrow.source) if arrow.edge_type == "requires" else (arrow.source, arrow.target)
        assert xs[user] < xs[used], arrow
    assert {"Player", "Perception", "Walk"} <= set(xs)


def test_boxes_do_not_overlap() -> None:
    figure = dependency_diagram(open_project(FORWARD).project)
    for one, other in combinations(figure.nodes, 2):
        apart = abs(one.center[0] - other.center[0]) >= (one.size.width + other.size.width) / 2
        assert apart or abs(one.center[1] - other.center[1]) >= one.size.height


def test_cycles_terminate() -> None:
    names = [f"C{index}" for index in range(30)]
    designs = tuple(
        Design(
            component=name,
            uses=tuple(Use(alias=other.lower(), component=other) for other in names),
            states=(State(name="S", modulates=(Call(alias=names[0].lower()),)),),
        )
        for name in names
    )
    figure = dependency_diagram(Project(name="all", designs=designs))
    assert len(figure.nodes) == 30


def asking_project(count: int) -> Project:
    """Designs that call the next one, read from one interface, and require another."""
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


def test_a_dense_diagram_omits_components_only_read_from() -> None:
    few, many = asking_project(20), asking_project(60)
    assert not has_omitted_uses(few)
    assert dependency_diagram(few, sparse=True) == dependency_diagram(few)
    assert has_omitted_uses(many)
    names = {node.key for node in dependency_diagram(many, sparse=True).nodes}
    assert names == {node.key for node in dependency_diagram(many).nodes} - {"Asked"}
    assert len(dependency_diagram(many, sparse=True).edges) == len(dependency_diagram(many).edges) - 60


def test_designs_are_links_and_names_are_escaped() -> None:
    evil = '"><script>alert(1)</script>'
    project = Project(name="p", designs=(Design(component=evil, doc=evil, uses=(Use(alias="a", component="B"),)),))
    figure = dependency_diagram(project, lambda component: f"/design/p/{component}")
    root = ElementTree.fromstring(write_svg(render_diagram(figure, title=evil)))
    links = [element for element in root.iter() if element.tag.endswith("}a")]
    assert [link.attrib["href"] for link in links] == [f"/design/p/{evil}"]
    assert not [element for element in root.iter() if element.tag.endswith("script")]


def test_thumbnails_are_small_for_any_design() -> None:
    for design in (*shipped_designs(), Design(component="Nothing"), ring_design(300)):
        text = render_thumbnail(design)
        ElementTree.fromstring(text)
        assert len(text) < 200_000
