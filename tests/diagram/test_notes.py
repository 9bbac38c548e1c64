"""Notes in scenes and exported diagrams."""

from pathlib import Path

import pytest
from pypdf import PdfReader

from vicode.diagram.export_formats import EXPORT_FORMATS, ExportOptions
from vicode.diagram.node_geometry import note_lines, note_size
from vicode.editor.view import diff_scenes, make_scene
from vicode.model.design import Design, DiagramNote, State
from vicode.model.diagram_edits import move_notes, remove_notes
from vicode.model.project import Project

NOTE = DiagramNote(name="why", text="The robot <waits>\nfor the referee.", at=(300, 40))
DESIGN = Design(component="Robot", initial="A", states=(State(name="A", at=(0, 0)),), notes=(NOTE,))


def test_exported_diagrams_show_notes() -> None:
    drawn = EXPORT_FORMATS["svg"].write(DESIGN, ExportOptions()).decode()
    assert "The robot &lt;waits&gt;" in drawn
    assert "for the referee." in drawn


def test_pdf_contains_the_text_of_notes(tmp_path: Path) -> None:
    file = tmp_path / "robot.pdf"
    file.write_bytes(EXPORT_FORMATS["pdf"].write(DESIGN, ExportOptions()))
    assert "for the referee." in PdfReader(file).pages[0].extract_text()


@pytest.mark.parametrize("form", sorted(EXPORT_FORMATS))
def test_every_format_accepts_notes(form: str) -> None:
    assert EXPORT_FORMATS[form].write(DESIGN, ExportOptions())


def test_long_lines_are_wrapped_within_the_box() -> None:
    lines = note_lines("one two three " * 10)
    assert len(lines) > 2
    assert note_size("one two three " * 10).width <= 240
    assert note_size("short").height < note_size("short\nand long").height


def test_scenes_contain_notes_and_their_changes() -> None:
    project = Project(name="p", designs=(DESIGN,))
    before = make_scene(project, DESIGN, (), 1)
    assert [(note["id"], note["lines"]) for note in before["notes"]] == [
        ("why", ["The robot <waits>", "for the referee."])
    ]
    moved = make_scene(project, move_notes(DESIGN, {"why": (1, 2)}), (), 2)
    (changed,) = diff_scenes(before, moved)["upsert"]["notes"]
    assert (changed["x"], changed["y"]) == (1, 2)
    gone = make_scene(project, remove_notes(DESIGN, ["why"]), (), 3)
    assert diff_scenes(before, gone)["remove"]["notes"] == ["why"]
