"""The generated file of the sample player, edited as by a person."""

from pathlib import Path

from vicode.generators import component_generator
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.store import open_project
from vicode.sync.interpret import Interpretation, interpret_edits

ROOT = Path(__file__).parents[2]
FORWARD = open_project(ROOT / "designs" / "forward").project
Replacement = tuple[str, str]


def text_of(project: Project, design: Design) -> str:
    code = component_generator(project, "python", {"Player": "player.yaml"})(design)
    assert code is not None
    return code.file.text


def player() -> Design:
    design = FORWARD.design("Player")
    assert design is not None
    return design


PLAYER = text_of(FORWARD, player())


def edited_player(*replacements: Replacement) -> str:
    text = PLAYER
    for old, new in replacements:
        assert old in text, old
        text = text.replace(old, new, 1)
    return text


def interpret(edited: str) -> Interpretation:
    return interpret_edits(FORWARD, "Player", generated=PLAYER, edited=edited)
