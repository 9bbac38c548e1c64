"""The code preview: files, the lines of each item, and regions edited on disk."""

from dataclasses import replace
from pathlib import Path

from vicode.editor.session.code.code_preview import preview_code
from vicode.editor.view import ItemRef
from vicode.generators import generate
from vicode.model.design import Design, Guard, State, Transition
from vicode.model.project import Project
from vicode.store import open_project

ROOT = Path(__file__).parents[3]
PROJECT = open_project(ROOT / "designs" / "forward").project
PLAYER = next(design for design in PROJECT.designs if design.component == "Player")


def test_component_files_precede_shared_files() -> None:
    shown = preview_code(PROJECT, PLAYER, {})
    assert [file.path for file in shown.files] == [
        "python/forward/player.py",
        "python/forward/__init__.py",
        "python/forward/__main__.py",
        "python/forward/declarations.py",
    ]
    assert shown.files[0].text == next(file.text for file in generate(PROJECT) if file.path.endswith("player.py"))
    assert shown.files[1].origins == ()


def test_lines_and_items_map_to_each_other() -> None:
    file = preview_code(PROJECT, PLAYER, {}).files[0]
    for item in (
        ItemRef(kind="states", id="Kick"),
        ItemRef(kind="transitions", id="Kick/0"),
        ItemRef(kind="transitions", id="@common/0"),
    ):
        first, last = file.item_lines(item)
        assert 0 < first <= last
    first, _last = file.item_lines(ItemRef(kind="transitions", id="Kick/0"))
    assert file.item_at(first) == ItemRef(kind="transitions", id="Kick/0")
    assert file.item_at(1) is None
    assert file.item_lines(ItemRef(kind="states", id="Nobody")) == (0, 0)


def test_each_language_has_files_or_a_note() -> None:
    states = (State(name="A", transitions=(Transition(to="B", guard=Guard(after="1")),)), State(name="B", final=True))
    design = Design(component="One", initial="A", states=states)
    project = Project(name="Both", languages=("python", "xabsl"), designs=(design,))
    shown = preview_code(project, design, {})
    option = next(file for file in shown.files if file.path == "xabsl/both/Options/One.xabsl")
    first, last = option.item_lines(ItemRef(kind="transitions", id="A/0"))
    assert "goto B;" in "\n".join(option.text.split("\n")[first - 1 : last])
    assert option.item_at(last) == ItemRef(kind="transitions", id="A/0")
    shown = preview_code(project, replace(design, resume=True), {})
    assert {file.language for file in shown.files} == {"python"}
    assert shown.note.startswith("No code for xabsl yet: ")


def test_a_design_with_errors_or_without_a_language_has_a_note() -> None:
    assert preview_code(PROJECT, replace(PLAYER, initial="Nowhere"), {}).note.startswith("No code yet")
    assert "klingon" in preview_code(replace(PROJECT, languages=("klingon",)), PLAYER, {}).note


def test_the_lines_of_regions_are_found() -> None:
    shown = preview_code(PROJECT, PLAYER, {}).files[0]
    lines = shown.text.split("\n")
    assert {lines[at - 1] for at in shown.region_lines({"module"})} >= {"import logging"}
    assert shown.region_lines(()) == ()
