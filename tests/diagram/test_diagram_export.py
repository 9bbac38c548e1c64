"""Exported diagrams are well formed, show the design in every format, and contain no markup from it."""

import re
from io import BytesIO
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree

import pytest
from pypdf import PdfReader

from tests.diagram.diagram_designs import HOSTILE_NAMES, ring_design, shipped_designs
from vicode.diagram.diagram_model import build_diagram
from vicode.diagram.edge_routing import route_edges
from vicode.diagram.export_formats import EXPORT_FORMATS, ExportOptions, NotExportableError
from vicode.diagram.palettes import DARK, LIGHT, ColorPalette
from vicode.diagram.pdf import write_pdf
from vicode.diagram.primitives import PathShape, ShapeGroup, TextShape, VectorImage
from vicode.diagram.spatial_index import Rect
from vicode.diagram.svg import write_svg
from vicode.diagram.text_metrics import Font, text_width
from vicode.model.design import STATE_COLORS, Code, CommonSection, DecisionGroup, Design, Guard, State, Transition, Use

CANVAS_SHEET = Path(__file__).parents[2] / "vicode" / "editor" / "canvas" / "js" / "canvas.css"
SVG = "{http://www.w3.org/2000/svg}"
DESIGNS = {design.component: design for design in shipped_designs()}


def everything() -> Design:
    """A small design with every kind of element."""
    look = State(
        name="Look",
        requires=("eyes",),
        enter=(),
        transitions=(
            Transition(to="end", guard=Guard(when="eyes.seen and x > 3")),
            DecisionGroup(guard=Guard(when="eyes.far"), then=(Transition(to="Look", guard=Guard(after="2.5")),)),
            Transition(to="end", guard=Guard(code=Code(texts=(("python", "return True"),)))),
        ),
    )
    return Design(
        component="Everything",
        doc="Look & see.",
        initial="Look",
        uses=(Use(alias="eyes", component="Eyes"),),
        common=CommonSection(transitions=(Transition(to="Look", guard=Guard(when="fallen")),)),
        states=(look, State(name="end", final=True), State(name="2nd")),
    )


# SCXML and Promela are read by programs, and refuse what they cannot express.
DIAGRAMS = [form for form in EXPORT_FORMATS if form not in ("scxml", "promela")]


def export_design(design: Design, form: str, wish: ExportOptions | None = None) -> bytes:
    return EXPORT_FORMATS[form].write(design, wish or ExportOptions())


def svg_of(design: Design, wish: ExportOptions | None = None) -> ElementTree.Element:
    return ElementTree.fromstring(export_design(design, "svg", wish))


def texts_of(root: ElementTree.Element) -> list[str]:
    return [element.text or "" for element in root.iter(f"{SVG}text")]


@pytest.mark.parametrize("component", sorted(DESIGNS))
def test_svg_shows_every_state(component: str) -> None:
    design = DESIGNS[component]
    texts = texts_of(svg_of(design))
    assert {state.name for state in design.states} <= set(texts)
    assert {use.alias for use in design.uses} <= set(texts)


def test_svg_shows_the_selected_states() -> None:
    player = DESIGNS["Player"]
    without_links = texts_of(svg_of(player, ExportOptions(links=False)))
    assert "Kick" in without_links
    assert "perception" not in without_links
    part = texts_of(svg_of(player, ExportOptions(only=frozenset({"Kick", "WatchBall"}))))
    assert {"Kick", "WatchBall", "kicker", "kicked"} <= set(part)
    assert not {"LookForBall", "search_ball", "every state"} & set(part)


def test_svg_bounds_contain_all_shapes() -> None:
    root = svg_of(DESIGNS["Player"])
    left, top, width, height = map(float, root.attrib["viewBox"].split())
    for element in root.iter(f"{SVG}text"):
        assert left < float(element.attrib["x"]) < left + width
        assert top < float(element.attrib["y"]) < top + height


@pytest.mark.parametrize("form", DIAGRAMS)
def test_hostile_texts_are_escaped(form: str) -> None:
    states = tuple(
        State(name=name, doc=name, transitions=(Transition(to=name, doc=name, guard=Guard(when=name)),))
        for name in HOSTILE_NAMES
    )
    uses = tuple(Use(alias=name, component=name) for name in HOSTILE_NAMES)
    design = Design(component='</title><script>"', doc="]]>", initial=HOSTILE_NAMES[0], states=states, uses=uses)
    content = export_design(design, form, ExportOptions(scale=0.5))
    assert content
    if form == "svg":
        root = ElementTree.fromstring(content)
        known = {"svg", "title", "desc", "rect", "g", "path", "text"}
        assert {element.tag.removeprefix(SVG) for element in root.iter()} <= known
    if form in ("mermaid", "plantuml"):
        lines = content.decode().splitlines()
        assert not [line for line in lines if "<script" in line or "<b>" in line]


@pytest.mark.parametrize("form", DIAGRAMS)
def test_a_design_without_states_can_be_exported(form: str) -> None:
    assert export_design(Design(component="Nothing"), form)


def test_png_has_the_requested_size() -> None:
    root = svg_of(DESIGNS["Player"])
    content = export_design(DESIGNS["Player"], "png", ExportOptions(scale=1.5))
    assert content[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = int.from_bytes(content[16:20]), int.from_bytes(content[20:24])
    assert width == pytest.approx(float(root.attrib["width"]) * 1.5, abs=2)
    assert height == pytest.approx(float(root.attrib["height"]) * 1.5, abs=2)


def test_pdf_can_be_read_and_searched() -> None:
    content = export_design(DESIGNS["Player"], "pdf")
    reader = PdfReader(BytesIO(content))
    (page,) = reader.pages
    text = page.extract_text()
    assert "LookForBall" in text
    assert "ball lost" in text
    assert reader.metadata is not None
    assert reader.metadata.title == "Player"
    assert export_design(DESIGNS["Player"], "pdf") == content


def test_pdf_shows_characters_missing_in_helvetica() -> None:
    state = State(name="A", transitions=(Transition(to="B", doc="α → β", guard=Guard(when="x" * 40)),))
    design = Design(component="Greek", initial="A", states=(state, State(name="B")))
    text = PdfReader(BytesIO(export_design(design, "pdf"))).pages[0].extract_text()
    assert "α" in text


@pytest.mark.parametrize(("bold", "font"), [(False, "Helvetica"), (True, "Helvetica-Bold")])
def test_widths_of_texts_are_those_of_helvetica(bold: bool, font: str) -> None:
    from reportlab.pdfbase.pdfmetrics import stringWidth

    wrong = [
        letter
        for letter in map(chr, range(32, 127))
        if text_width(letter, Font(size=10, bold=bold)) != pytest.approx(stringWidth(letter, font, 10))
    ]
    assert not wrong


def test_pdf_draws_a_path_with_its_pen_at_its_place() -> None:
    path = PathShape(commands=(("M", (10, 20)), ("L", (30, 50))), stroke="#ff0000", width=2.5, dash=(1, 4))
    group = ShapeGroup(title="", css_class="", shapes=(path,))
    image = VectorImage(title="", doc="", left=5, top=10, width=100, height=80, background="#ffffff", groups=(group,))
    page = PdfReader(BytesIO(write_pdf(image))).pages[0]
    assert (page.mediabox.width, page.mediabox.height) == (75, 60)
    *_before, color, width, join, cap, dash, _new, start, end, stroke = page.get_contents().operations
    assert color == ([1, 0, 0], b"RG")
    assert (width, join, cap, dash) == (([2.5], b"w"), ([1], b"j"), ([1], b"J"), ([[1, 4], 0], b"d"))
    assert (start, end, stroke) == (([5, 70], b"m"), ([25, 40], b"l"), ([], b"S"))


def test_pdf_centers_a_text_and_strikes_it_through() -> None:
    text = TextShape(
        x=40, y=30, text="off", fill="#0000ff", font=Font(size=10), is_centered=True, is_struck_through=True
    )
    group = ShapeGroup(title="", css_class="", shapes=(text,))
    image = VectorImage(title="", doc="", left=0, top=0, width=80, height=60, background="#ffffff", groups=(group,))
    operations = PdfReader(BytesIO(write_pdf(image))).pages[0].get_contents().operations
    (position,) = (numbers for numbers, name in operations if name == b"Tm")
    (start,), (end,) = ([numbers for numbers, name in operations if name == kind] for kind in (b"m", b"l"))
    assert (start[0] + end[0]) / 2 == pytest.approx(40, abs=0.01)
    assert start[0] == pytest.approx(position[4], abs=0.01)
    assert 60 - 30 - 5 < position[5] < start[1] == end[1] < 60 - 30 + 5
    assert ([0, 0, 1], b"rg") in operations


@pytest.mark.nightly
def test_large_designs_respect_the_limits_of_the_formats() -> None:
    design = ring_design(400)
    page = PdfReader(BytesIO(export_design(design, "pdf"))).pages[0]
    assert max(page.mediabox.width, page.mediabox.height) <= 14_400
    assert export_design(design, "svg").count(b'class="state"') == 400


def test_mermaid() -> None:
    assert export_design(everything(), "mermaid").decode() == (
        "---\n"
        'title: "Everything"\n'
        "---\n"
        "stateDiagram-v2\n"
        "    direction LR\n"
        "    Look\n"
        '    state "end" as s_end\n'
        '    state "2nd" as s_2nd\n'
        '    state "every state" as s_2\n'
        "    [*] --> Look\n"
        "    s_2 --> Look : fallen\n"
        "    Look --> s_end : 1. eyes.seen and x #62; 3\n"
        "    Look --> Look : 2. eyes.far #8250; after 2.5 s\n"
        "    Look --> s_end : 3. #123; code #125;\n"
        "    s_end --> [*]\n"
    )


@pytest.mark.parametrize("component", sorted(DESIGNS))
def test_mermaid_follows_its_grammar(component: str) -> None:
    lines = export_design(DESIGNS[component], "mermaid").decode().splitlines()
    name = r"(\[\*\]|[A-Za-z]\w*)"
    # The lexer of stateDiagram-v2 allows no colon, semicolon, quote or bracket inside a text.
    form = re.compile(
        rf'    ({name} --> {name}( : [^:;"<>{{}}\[\]%#]*(#\d+;[^:;"<>{{}}\[\]%#]*)*)?|state "[^"]+" as \w+|\w+)'
    )
    assert lines[:5] == ["---", f'title: "{component}"', "---", "stateDiagram-v2", "    direction LR"]
    assert [line for line in lines[5:] if not form.fullmatch(line)] == []


def test_disabled_elements_are_muted_in_pictures_and_omitted_in_text() -> None:
    away = Transition(to="Off", guard=Guard(when="x"))
    design = Design(
        component="Half", initial="On", states=(State(name="On", transitions=(away,)), State(name="Off", disabled=True))
    )
    struck = [each.text for each in svg_of(design).iter(f"{SVG}text") if "text-decoration" in each.attrib]
    assert sorted(struck, key=str) == ["Off", "x"]
    assert "Off" not in export_design(design, "mermaid").decode()


def test_a_label_keeps_its_manual_position() -> None:
    def at(label_at: tuple[float, float] | None) -> tuple[float, float]:
        away = Transition(to="B", guard=Guard(when="x"), label_at=label_at)
        states = (State(name="A", at=(0, 0), transitions=(away,)), State(name="B", at=(400, 0)))
        (route,) = route_edges(build_diagram(Design(component="D", initial="A", states=states)))
        return route.label_position

    assert at(None) == pytest.approx((200, 0))
    # A quarter along the edge, and 20 pixels to the right of its direction from A to B.
    x, y = at((0.25, 20))
    assert x < 150
    assert y == pytest.approx(20)


def test_plantuml() -> None:
    text = export_design(everything(), "plantuml").decode()
    lines = text.splitlines()
    assert (lines[0], lines[-1]) == ("@startuml", "@enduml")
    assert 'state "end" as s_end' in lines
    assert "[*] --> Look" in lines
    assert "Look --> s_end : 1. eyes.seen and x <U+003E> 3" in lines
    assert "Look --> Look : 2. eyes.far <U+203A> after 2.5 s" in lines
    assert "s_2 -[dashed]-> Look : fallen" in lines
    assert "s_end --> [*]" in lines


def test_dot_is_drawn_by_graphviz() -> None:
    import pygraphviz

    graph = pygraphviz.AGraph(string=export_design(DESIGNS["Player"], "dot").decode())
    labels = {node.attr["label"] for node in graph.nodes()}
    assert {"LookForBall", "perception", "every state"} <= labels
    # A used component is linked, and every transition has an edge.
    assert len(graph.edges()) == len(re.findall("->", export_design(DESIGNS["Player"], "dot").decode()))
    styles = {(edge.attr["style"], edge.attr["arrowhead"]) for edge in graph.edges() if not edge.attr["label"]}
    assert {("dashed", "empty"), ("dotted", "")} <= styles
    plain = pygraphviz.AGraph(string=export_design(DESIGNS["Player"], "dot", ExportOptions(links=False)).decode())
    assert "perception" not in {node.attr["label"] for node in plain.nodes()}


@pytest.mark.parametrize(("palette", "selector"), [(LIGHT, ".stage {"), (DARK, '.stage[data-theme="dark"] {')])
def test_colors_are_those_of_the_canvas(palette: ColorPalette, selector: str) -> None:
    sheet = CANVAS_SHEET.read_text(encoding="utf-8")
    rules = sheet.split(selector, 1)[1].split("}", 1)[0]
    shown = dict(re.findall(r"--([\w-]+):\s*(#[0-9a-f]{6})", rules))
    names = [name for name in ColorPalette.__dataclass_fields__ if name.replace("_", "-") in shown]
    assert len(names) > 10
    for name in names:
        assert getattr(palette, name) == shown[name.replace("_", "-")], name


@pytest.mark.parametrize(("dark", "palette"), [(False, LIGHT), (True, DARK)])
@pytest.mark.parametrize("color", STATE_COLORS)
def test_states_have_their_color_and_stay_legible(color: str, dark: bool, palette: ColorPalette) -> None:
    design = Design(component="Robot", states=(State(name="Plain"), State(name="Colored", color=color)))
    svg = export_design(design, "svg", ExportOptions(dark=dark)).decode()
    fill = getattr(palette, f"color_{color}")
    assert svg.count(f'fill="{fill}"') == 1
    for drawn in (palette.text, palette.muted):
        assert _contrast(drawn, fill) >= 4.5
    assert _contrast(palette.modulates, fill) >= 4


def _contrast(one: str, other: str) -> float:
    light, dark = sorted((_luminance(one), _luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def _luminance(color: str) -> float:
    """The relative luminance as defined by WCAG 2."""
    parts = [int(color[index : index + 2], 16) / 255 for index in (1, 3, 5)]
    red, green, blue = (part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


@pytest.mark.parametrize(("form", "mark"), [("mermaid", "%% "), ("plantuml", "' "), ("dot", "// ")])
def test_text_formats_mention_transitions_to_missing_states(form: str, mark: str) -> None:
    gone = Transition(to="Gone\nend")
    lost = Design(
        component="Lost",
        initial="A",
        common=CommonSection(transitions=(Transition(to="Nowhere"),)),
        states=(State(name="A", transitions=(gone, Transition(to="B"))), State(name="B")),
    )
    lines = [line.strip() for line in export_design(lost, form).decode().splitlines()]
    said = [line for line in lines if "not drawn" in line]
    assert said == [
        f"{mark}not drawn: every state to Nowhere, because there is no such state",
        f"{mark}not drawn: A to Gone end, because there is no such state",
    ]
    # Transitions omitted because only some states are exported are not mentioned.
    some = export_design(lost, form, ExportOptions(only=frozenset({"B"}))).decode()
    assert "A to" not in some


def test_labels_do_not_overlap_in_dense_diagrams() -> None:
    guard = Guard(when="state_time > 0 and (motion.head_target_reached or motion.head_got_stuck)")
    names = ("A", "B", "C", "D", "E", "F")
    states = tuple(
        State(
            name=name,
            at=(220 * (index % 3), 100 * (index // 3)),
            transitions=tuple(Transition(to=to, guard=guard) for to in names if (index + names.index(to)) % 3),
        )
        for index, name in enumerate(names)
    )
    routes = route_edges(build_diagram(Design(component="D", initial="A", states=states)))
    labels = [Rect.from_center(route.label_position, route.label.size) for route in routes if route.label]
    assert len(labels) == 24
    assert not [(one, other) for one, other in combinations(labels, 2) if one.overlaps(other)]


def test_svg_fixes_the_width_of_texts_with_known_glyphs() -> None:
    texts = [
        TextShape(x=0, y=0, text=text, fill="#000000", font=Font(size=10, bold=bold))
        for text, bold in (("lamp", False), ("lamp", True), ("Läuft", False), ("Лампа", False))
    ]
    group = ShapeGroup(title="", css_class="state", shapes=tuple(texts))
    image = VectorImage(title="", doc="", left=0, top=0, width=9, height=9, background="#ffffff", groups=(group,))
    lengths = [text.get("textLength") for text in ElementTree.fromstring(write_svg(image)).iter(f"{SVG}text")]
    assert lengths == ["21.7", "23.3", "22.2", None]


@pytest.mark.parametrize(
    ("states", "only", "words"),
    [((), None, "has a state"), ((State(name="a"), State(name="b")), frozenset({"a"}), "whole design")],
)
def test_scxml_contains_a_whole_design(states: tuple[State, ...], only: frozenset[str] | None, words: str) -> None:
    with pytest.raises(NotExportableError, match=words):
        export_design(Design(component="Part", initial="a", states=states), "scxml", ExportOptions(only=only))
