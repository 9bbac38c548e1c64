"""What is known of hand-written components, symbols, types and constants: all of it, with who reads and who sets it."""

import re
from pathlib import Path

import pytest

from tests.docsite.link_checker import find_broken_links, read_page
from vicode.docsite import SiteInput, build_site
from vicode.docsite.references import READ, SET, find_symbol_references
from vicode.model.design import Assign, Call, Code, Declaration, Design, Guard, RunCode, State, Transition, Use
from vicode.model.project import INTERNAL, WORLD, Enumeration, Interface, Project
from vicode.output import OutputFile
from vicode.store import open_project

FORWARD = Path(__file__).parents[2] / "designs" / "forward"


def small_project() -> Project:
    """One design that asks, sets, calls and says code."""
    design = Design(
        component="Chase",
        uses=(Use(alias="eyes", component="Eyes"), Use(alias="legs", component="Legs")),
        variables=(Declaration(name="tries", type="int", initial="0"),),
        initial="Go",
        states=(
            State(
                name="Go",
                actions=(
                    Assign(values=(("tries", "tries + 1"), ("eyes.mode", "Mode.wide"))),
                    RunCode(code=Code(texts=(("python", "x = self.eyes.size\nself.eyes.lamp = 1"),))),
                    RunCode(code=Code(texts=(("xabsl", "eyes.lamp = far;"),))),
                ),
                modulates=(Call(alias="legs", arguments=(("speed", "fastest"),)),),
                transitions=(Transition(to="Go", guard=Guard(when="eyes.distance < far and tries > 2")),),
            ),
        ),
    )
    eyes = Interface(
        component="Eyes",
        implementation=WORLD,
        outputs=(
            Declaration(name="distance", type="float", unit="mm", range=(0, 9000), doc="How *far*."),
            Declaration(name="size", type="float"),
            Declaration(name="unseen", type="bool"),
        ),
        variables=(Declaration(name="mode", type="Mode"), Declaration(name="lamp", type="float")),
    )
    legs = Interface(component="Legs", implementation=WORLD, parameters=(Declaration(name="speed", type="float"),))
    kept = Interface(component="Kept", implementation=INTERNAL, variables=(Declaration(name="score", type="float"),))
    return Project(
        name="Chasing",
        languages=(),
        enumerations=(Enumeration(name="Mode", elements=(("wide", ""), ("narrow", ""))),),
        constants=(Declaration(name="far", initial="3"), Declaration(name="fastest", initial="4")),
        components=(eyes, legs, kept),
        designs=(design,),
    )


@pytest.fixture(scope="module")
def files() -> tuple[OutputFile, ...]:
    return build_site(SiteInput(project=small_project()))


def row_of(files: tuple[OutputFile, ...], path: str, name: str) -> list[str]:
    """The words of a row of a table, cell by cell."""
    text = next(file.text for file in files if file.path == path)
    rows = re.findall(r"<tr.*?</tr>", text, re.DOTALL)
    found = [re.findall(r"<t[hd].*?</t[hd]>", row, re.DOTALL) for row in rows]
    cells = [[" ".join(read_page(cell).text.split()) for cell in row] for row in found]
    return next(row for row in cells if row[0] == name)


@pytest.mark.parametrize(
    ("how", "component", "name"),
    [
        (READ, "Eyes", "distance"),
        (READ, "Eyes", "size"),
        (SET, "Eyes", "mode"),
        (SET, "Eyes", "lamp"),
        (SET, "Legs", "speed()"),
        (SET, "Chase", "tries"),
        (READ, "Chase", "tries"),
        (READ, "", "far"),
        (READ, "", "fastest"),
        (READ, "", "Mode"),
    ],
)
def test_who_reads_and_who_sets(how: str, component: str, name: str) -> None:
    assert find_symbol_references(small_project()).users(how, component, name) == {"Chase": ("Go",)}


@pytest.mark.parametrize(
    ("how", "component", "name"),
    [(SET, "Eyes", "distance"), (READ, "Eyes", "unseen"), (SET, "Eyes", "size"), (READ, "Kept", "score")],
)
def test_what_nobody_says(how: str, component: str, name: str) -> None:
    assert find_symbol_references(small_project()).users(how, component, name) == {}


def test_symbols_are_listed_with_all_that_is_known(files: tuple[OutputFile, ...]) -> None:
    assert row_of(files, "symbols.html", "distance") == [
        *("distance", "input", "float", "mm", "0 … 9000", "How far.", "Chase", "–")
    ]
    assert row_of(files, "symbols.html", "mode")[:3] == ["mode", "output", "Mode"]
    assert row_of(files, "symbols.html", "mode")[-1] == "Chase"
    assert row_of(files, "symbols.html", "score")[:2] == ["score", "internal"]
    assert row_of(files, "symbols.html", "tries")[:2] == ["tries", "internal"]


def test_a_basic_behavior_has_a_page(files: tuple[OutputFile, ...]) -> None:
    text = next(file.text for file in files if file.path == "interface-Legs.html")
    assert "basic behavior" in read_page(text).text
    assert row_of(files, "interface-Legs.html", "speed") == ["speed", "float"]
    assert "Set in 1 place Chase › Go = fastest" in " ".join(read_page(text).text.split())
    assert row_of(files, "interface-Legs.html", "Chase") == ["Chase", "legs", "–", "Go"]
    assert row_of(files, "interfaces.html", "Legs") == ["Legs", "speed", "–", "1", ""]


def test_types_and_constants_say_who_uses_them(files: tuple[OutputFile, ...]) -> None:
    text = next(file.text for file in files if file.path == "types.html")
    assert "component-Chase.html#state-Go" in read_page(text).links
    assert "interface-Eyes.html#variable-mode" in read_page(text).links
    assert "Read in 1 place Chase › Go" in " ".join(read_page(text).text.split())
    assert not find_broken_links(files)


def test_everything_of_a_project_is_a_symbol_or_a_parameter() -> None:
    project = open_project(FORWARD).project
    files = build_site(SiteInput(project=project))
    symbols = read_page(next(file.text for file in files if file.path == "symbols.html"))
    for each in project.components:
        for declaration in each.readable:
            section = "output" if declaration in each.outputs else "variable"
            assert f"interface-{each.component}.html#{section}-{declaration.name}" in symbols.links
        page = read_page(next(file.text for file in files if file.path == f"interface-{each.component}.html"))
        assert {f"parameter-{parameter.name}" for parameter in each.parameters} <= set(page.ids)
