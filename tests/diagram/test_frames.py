"""Frames in scenes, layouts and exported diagrams."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from pypdf import PdfReader

from tests.diagram.layouts import compute_layout
from vicode.diagram.diagram_model import build_diagram
from vicode.diagram.edge_routing import route_edges
from vicode.diagram.export_formats import EXPORT_FORMATS, ExportOptions
from vicode.diagram.frames import drawn_frames, nest_frames
from vicode.diagram.node_geometry import OccupancyGrid, note_size, state_size
from vicode.diagram.palettes import LIGHT
from vicode.diagram.spatial_index import Rect
from vicode.diagram.thumbnail import render_thumbnail
from vicode.model.design import Design, DiagramFrame, DiagramNote, Guard, State, Transition

STATES = tuple(
    State(name=name, at=(index * 240, 0), transitions=(Transition(to=to, guard=Guard(after="1")),))
    for index, (name, to) in enumerate([("Search", "Walk"), ("Walk", "Turn"), ("Turn", "Kick"), ("Kick", "Search")])
)
APPROACH = DiagramFrame(name="Approach <the> ball", color="green", states=("Walk", "Turn"))
DESIGN = Design(component="Robot", initial="Search", states=STATES, frames=(APPROACH,))


def test_a_frame_surrounds_its_states_only() -> None:
    diagram = build_diagram(DESIGN)
    (frame,) = diagram.frames
    inside = {node.label for node in diagram.nodes if Rect.from_center(node.center, node.size).overlaps(frame.rect)}
    assert inside == {"Walk", "Turn"}


def test_an_outer_frame_leaves_room_for_the_inner_one() -> None:
    outer = DiagramFrame(name="All", states=("Search", "Walk", "Turn"))
    around, inside = build_diagram(replace(DESIGN, frames=(APPROACH, outer))).frames
    assert around.title == "All"
    assert around.rect.top + 20 <= inside.rect.top
    assert around.rect.right > inside.rect.right


def test_frames_of_unknown_states_are_not_drawn() -> None:
    lost = DiagramFrame(name="Lost", states=("Nowhere",))
    part = DiagramFrame(name="Part", states=("Nowhere", "Kick"))
    design = replace(DESIGN, frames=(lost, part))
    assert [(frame.name, states) for frame, states, _level in drawn_frames(design)] == [("Part", ("Kick",))]
    assert drawn_frames(design, only=["Walk"]) == []


def test_overlapping_frames_become_a_tree() -> None:
    frames = (
        DiagramFrame(name="Inner", states=("Walk",)),
        DiagramFrame(name="Outer", states=("Walk", "Turn", "Kick")),
        DiagramFrame(name="Across", states=("Search", "Walk")),
    )
    outer, across = nest_frames(replace(DESIGN, frames=frames))
    assert (outer.name, outer.own_states, [group.name for group in outer.groups]) == (
        "Outer",
        {"Turn", "Kick"},
        ["Inner"],
    )
    assert (across.name, across.own_states) == ("Across", {"Search"})


def test_exported_diagrams_show_frames(tmp_path: Path) -> None:
    drawn = EXPORT_FORMATS["svg"].write(DESIGN, ExportOptions()).decode()
    assert "Approach &lt;the&gt; ball" in drawn
    assert drawn.index('class="frame"') < drawn.index('class="state"')
    file = tmp_path / "robot.pdf"
    file.write_bytes(EXPORT_FORMATS["pdf"].write(DESIGN, ExportOptions()))
    assert "ball" in PdfReader(file).pages[0].extract_text()


@pytest.mark.parametrize("count", [0, 12])
def test_thumbnails_contain_frames(count: int) -> None:
    more = tuple(State(name=f"S{index}", at=(index * 240, 200)) for index in range(count))
    design = replace(DESIGN, states=(*STATES, *more))
    assert LIGHT.frame_fill("green") in render_thumbnail(design)
    assert LIGHT.frame_fill("green") not in render_thumbnail(replace(design, frames=()))


@pytest.mark.parametrize("form", sorted(EXPORT_FORMATS))
def test_every_format_accepts_frames(form: str) -> None:
    assert EXPORT_FORMATS[form].write(DESIGN, ExportOptions())


def test_text_formats_group_the_states_of_a_frame() -> None:
    dot = EXPORT_FORMATS["dot"].write(DESIGN, ExportOptions()).decode()
    assert re.search(r'subgraph cluster_0 \{[^}]*label="Approach <the> ball"[^}]*n1\s+n2\s+\}', dot)
    plantuml = EXPORT_FORMATS["plantuml"].write(DESIGN, ExportOptions()).decode()
    title = "Approach <U+003C>the<U+003E> ball"
    assert f'state "{title}" as _frame0 {{\nstate "Walk" as Walk\nstate "Turn" as Turn\n}}\n' in plantuml


def test_text_formats_contain_notes() -> None:
    note = DiagramNote(name="n", text="Two\nlines; end note", at=(480, 120))
    design = replace(DESIGN, notes=(note,))
    mermaid = EXPORT_FORMATS["mermaid"].write(design, ExportOptions()).decode()
    assert "    note right of Turn\n        Two\n        lines#59; end#32;note\n    end note\n" in mermaid
    plantuml = EXPORT_FORMATS["plantuml"].write(design, ExportOptions()).decode()
    assert 'note "Two\\nlines<U+003B> end note" as _note0\n' in plantuml
    assert "shape=note" in EXPORT_FORMATS["dot"].write(design, ExportOptions()).decode()


def test_layout_keeps_other_states_out_of_frames() -> None:
    names = [f"S{index}" for index in range(9)]
    states = tuple(
        State(name=name, transitions=tuple(Transition(to=to) for to in names if to != name)) for name in names
    )
    frame = DiagramFrame(name="Odd", states=tuple(names[1::2]))
    design = Design(component="Robot", initial="S0", states=states, frames=(frame,))
    positions = compute_layout(design).layout.states
    placed = replace(design, states=tuple(replace(state, at=positions[state.name]) for state in states))
    diagram = build_diagram(placed)
    inside = {
        node.label
        for node in diagram.nodes
        if Rect.from_center(node.center, node.size).overlaps(diagram.frames[0].rect)
    }
    assert inside == set(frame.states)


def test_notes_follow_their_states_and_cover_none() -> None:
    notes = (
        DiagramNote(name="near", text="Above Kick", at=(720, -100)),
        DiagramNote(name="covering", text="On Walk", at=(240, 0)),
    )
    layout = compute_layout(replace(DESIGN, notes=notes)).layout
    kick = layout.states["Kick"]
    assert abs(layout.notes["near"][0] - kick[0]) <= 60
    assert abs(layout.notes["near"][1] - kick[1] + 100) <= 60
    boxes = OccupancyGrid()
    for name, at in layout.states.items():
        boxes.occupy(at, state_size(name))
    assert all(boxes.is_free(layout.notes[note.name], note_size(note.text), 0) for note in notes)


def test_labels_avoid_the_titles_of_frames() -> None:
    states = (
        State(name="Low", at=(0, 300), transitions=(Transition(to="High", guard=Guard(when="x < 1")),)),
        State(name="High", at=(0, 0)),
        State(name="Side", at=(300, 400)),
    )
    frame = DiagramFrame(name="A title that is long enough", states=("Low", "Side"))
    design = Design(component="Robot", initial="Low", states=states, frames=(frame,))
    diagram = build_diagram(replace(design, frames=(replace(frame, states=("Low",)),)))
    (route,) = route_edges(diagram)
    assert route.label is not None
    assert not Rect.from_center(route.label_position, route.label.size).overlaps(diagram.frames[0].title_rect)
