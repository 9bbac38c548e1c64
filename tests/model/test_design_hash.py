"""The hash of a design: its content counts, its form and layout do not."""

from dataclasses import replace
from pathlib import Path

from hypothesis import given

from tests.strategies.designs import designs
from vicode.model.design import Declaration, Design, DiagramNote
from vicode.model.design_hash import hash_design
from vicode.model.edits import move_nodes
from vicode.model.project import Project
from vicode.store import open_project, read_design, save_design

FORWARD = open_project(Path(__file__).parents[2] / "designs" / "forward").project


def hash_of(design: Design) -> str:
    return hash_design(Project(name="P", designs=(design,)), design.component)


def with_design(design: Design) -> Project:
    others = tuple(each for each in FORWARD.designs if each.component != design.component)
    return replace(FORWARD, designs=(*others, design))


def test_layout_does_not_count() -> None:
    player = FORWARD.design("Player")
    assert player is not None
    moved = move_nodes(player, {state.name: (1, 1) for state in player.states}, {}, None)
    noted = replace(moved, notes=(DiagramNote(name="n", text="x"),))
    assert noted != player
    assert hash_design(with_design(noted), "Player") == hash_design(FORWARD, "Player")


def test_used_designs_and_declarations_count() -> None:
    before = hash_design(FORWARD, "Player")
    body = FORWARD.design("Body")
    assert body is not None
    assert hash_design(with_design(replace(body, doc="other")), "Player") != before
    assert hash_design(with_design(replace(body, doc="other")), "Turn") == hash_design(FORWARD, "Turn")
    declared = replace(FORWARD, constants=(*FORWARD.constants, Declaration(name="new", initial="1")))
    assert hash_design(declared, "Player") != before


def test_the_hash_of_a_release_stays() -> None:
    design = Design(component="Lamp", initial="Dark")
    assert hash_of(design) == "37c4beb8e0ad"


@given(designs)
def test_the_form_of_the_file_does_not_count(design: Design) -> None:
    read = read_design(f"# A comment.\n{save_design(design)}").design
    assert read is not None
    assert hash_of(read) == hash_of(design)
