"""Edits outside regions: each file is read with its edits, its conflicts, and what no design can express."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

from vicode.generators import generate
from vicode.model.design import Declaration, Design, Guard, Interrupt, State, Transition, Use
from vicode.model.lowering import lower_design
from vicode.model.project import WORLD, Interface, Project
from vicode.output import OutputFile, compare_files
from vicode.sync import Choices, FileEdits, OutsideReader, find_file_edits
from vicode.sync.interpret import interpret_edits

EYES = Interface(
    component="Eyes",
    implementation=WORLD,
    outputs=(
        Declaration(name="distance"),
        Declaration(name="width", xabsl_name="ball.width"),
        Declaration(name="depth", xabsl_name="ball.range"),
    ),
)


def lamp(first: str = "eyes.distance > 1", second: str = "eyes.width > 1", name: str = "Lamp") -> Design:
    return Design(
        component=name,
        initial="A",
        uses=(Use(alias="eyes", component="Eyes"),),
        states=(
            State(name="A", transitions=(Transition(to="B", guard=Guard(when=first)),)),
            State(name="B", transitions=(Transition(to="A", guard=Guard(when=second)),)),
        ),
    )


def project(design: Design, *languages: str) -> Project:
    designs = (design, lamp(name="Other"))
    return Project(name="p", world="w:World", languages=languages or ("python",), designs=designs, components=(EYES,))


def read(
    now: Project,
    folder: Path,
    *edits: tuple[str, str],
    before: Project | None = None,
    edited: tuple[str, ...] = ("Lamp",),
    **options: object,
) -> tuple[OutsideReader, tuple[FileEdits, ...]]:
    """A reader, and the files after edits of those of some components.

    `before` is the project that the files were generated from.
    """
    old, files = generate(before or now), generate(now)
    for file in old:
        text = file.text
        for was, is_ in edits if file.component in edited else ():
            text = re.sub(was, is_, text)
        (folder / file.path).parent.mkdir(parents=True, exist_ok=True)
        (folder / file.path).write_text(text, encoding="utf-8")

    def history(path: str) -> list[str]:
        return [file.text for file in old if file.path == path]

    reader = OutsideReader(texts=texts(files), history=history, **options)  # type: ignore[arg-type]
    return reader, find_file_edits(compare_files(files, folder), files, history)


def texts(files: tuple[OutputFile, ...]) -> dict[str, str]:
    return {file.path: file.text for file in files}


def guards(design: Design) -> list[str]:
    return [decision.guard.when for state in design.states for decision in state.transitions]


def test_an_edit_is_read_and_reported(tmp_path: Path) -> None:
    now = project(lamp())
    reader, files = read(now, tmp_path, (r"distance(\)?) > 1", r"distance\1 > 2"))
    designs, (reading,) = reader.read_all(now, files)
    assert [(edit.words, edit.path) for edit in reading.edits] == [
        ("guard of A → B: eyes.distance > 2", ("states", "A", "transitions", 0, "when"))
    ]
    assert {name: guards(design) for name, design in designs.items()} == {
        "Lamp": ["eyes.distance > 2", "eyes.width > 1"]
    }
    assert (reading.file, reading.is_read, reading.is_empty) == (files[0], True, False)
    assert (reading.leftover, reading.reasons, reading.conflicts, reading.settled) == ("", (), (), ())


def test_an_edit_of_something_derived_is_left_as_a_patch(tmp_path: Path) -> None:
    interrupted = replace(lamp(), interrupts=(Interrupt(do="B", when="eyes.width > 9", then="restart"),))
    now = project(lower_design(interrupted))
    reader, files = read(now, tmp_path, (r"width(\)?) > 9", r"width\1 > 8"), (r"distance(\)?) > 1", r"distance\1 > 2"))
    designs, (reading,) = reader.read_all(now, files)
    assert (designs, reading.edits) == ({}, ())
    assert reading.reasons == (
        "it changes a part that is derived from 'interrupts' (number 1); change that in the design",
    )
    assert len(re.findall(r"^\+.*> [28]", reading.leftover, re.MULTILINE)) == 3


def test_what_no_design_expresses_is_left_as_a_patch(tmp_path: Path) -> None:
    now = project(lamp())
    reader, files = read(now, tmp_path, (r"decide: bool = True", "decide: bool = False"), prefix="out/gen")
    designs, (reading,) = reader.read_all(now, files)
    assert designs == {}
    assert re.search(r"^\+.*decide: bool = False", reading.leftover, re.MULTILINE)
    assert f"out/gen/{files[0].path}" in reading.leftover
    assert len(reading.reasons) == 2
    assert (reading.edits, reading.is_read, reading.is_empty) == ((), True, False)
    reader, files = read(now, tmp_path, (r"decide: bool = True", "decide: bool = False"))
    assert re.search(rf"[ /]{files[0].path}\n", reader.read_all(now, files)[1][0].leftover)


def test_the_second_language_is_read_with_the_edits_of_the_first(tmp_path: Path) -> None:
    now = project(lamp(), "python", "cpp")
    edits = (r"distance(\)?) > 1(?!\d)(?=[^;]*:)", r"distance\1 > 2")
    reader, files = read(now, tmp_path, edits)
    python = [file for file in files if file.language == "python"]
    _reader, others = read(now, tmp_path, (r"width(\(\))?(\)?) > 1", r"width\1\2 > 3"))
    cpp = [file for file in others if file.language == "cpp"]
    designs, readings = reader.read_all(now, (*python, *cpp))
    assert len(readings) == 2
    assert guards(designs["Lamp"]) == ["eyes.distance > 2", "eyes.width > 3"]
    assert all(reading.edits for reading in readings)


def test_each_component_is_read_with_its_own_design(tmp_path: Path) -> None:
    now = project(lamp())
    edits = (r"distance(\)?) > 1", r"distance\1 > 2")
    reader, files = read(now, tmp_path, edits, edited=("Lamp", "Other"))
    for order in (files, tuple(reversed(files))):
        designs, readings = reader.read_all(now, order)
        assert {name: (design.component, guards(design)) for name, design in designs.items()} == {
            name: (name, ["eyes.distance > 2", "eyes.width > 1"]) for name in ("Lamp", "Other")
        }
        assert [bool(reading.edits) for reading in readings] == [True, True]


def test_the_texts_of_the_reader_count(tmp_path: Path) -> None:
    """They may be newer than those that the file was compared with."""
    now = project(lamp())
    reader, files = read(now, tmp_path, (r"distance(\)?) > 1", r"distance\1 > 2"))
    design, reading = reader.read(now, replace(files[0], new=None))
    assert design is not None
    assert (guards(design)[0], reading.is_read) == ("eyes.distance > 2", True)


def test_files_without_such_edits_are_left_out(tmp_path: Path) -> None:
    now = project(lamp())
    reader, files = read(now, tmp_path, (r"distance(\)?) > 1", r"distance\1 > 2"))
    for skipped in (replace(files[0], is_edited_outside=False), replace(files[0], path="python/p/gone.py")):
        assert reader.read_all(now, [skipped]) == ({}, ())
        designs, readings = reader.read_all(now, [skipped, files[0]])
        assert ([*designs], [reading.file for reading in readings]) == (["Lamp"], [files[0]])


@pytest.mark.parametrize("change", [{"component": ""}, {"path": "xabsl/lamp.xabsl"}])
def test_a_file_without_interpreter_is_reported_unread(tmp_path: Path, change: dict[str, str]) -> None:
    now = project(lamp())
    reader, files = read(now, tmp_path, (r"distance(\)?) > 1", r"distance\1 > 2"))
    file = replace(files[0], **change)  # type: ignore[arg-type]
    reader = replace(reader, texts={**reader.texts, "xabsl/lamp.xabsl": "x"})
    designs, (reading,) = reader.read_all(now, [file])
    assert designs == {}
    assert (reading.file, reading.edits, reading.is_read, reading.is_empty) == (file, (), False, False)


@pytest.mark.parametrize(
    ("side", "kept"), [(None, "eyes.distance > 3"), ("design", "eyes.distance > 3"), ("file", "eyes.distance > 2")]
)
@pytest.mark.parametrize("is_named", [False, True])
def test_a_conflict_takes_the_chosen_side(tmp_path: Path, side: str | None, kept: str, is_named: bool) -> None:
    now = project(lamp("eyes.distance > 3"))
    edits = (r"distance(\)?) > 1", r"distance\1 > 2"), (r"width(\)?) > 1", r"width\1 > 7")
    reader, files = read(now, tmp_path, *edits, before=project(lamp()))
    file = files[0]
    line = next(number for number, text in enumerate(file.old.splitlines(), 1) if "distance" in text and "> 2" in text)
    name = f"{file.path}:{line}"
    if side is not None:
        choices = Choices(items=((name, side),)) if is_named else Choices(default=side)  # type: ignore[arg-type]
        reader = replace(reader, choices=choices)
    designs, (reading,) = reader.read_all(now, files)
    assert guards(designs["Lamp"]) == [kept, "eyes.width > 7"]
    assert not reading.is_empty
    if side is None:
        (conflict,) = reading.conflicts
        assert (conflict.line, reading.settled) == (line, ())
        for text, number in ((conflict.base, 1), (conflict.file_text, 2), (conflict.design_text, 3)):
            assert f"> {number}" in (text or "")
    else:
        (settled,) = reading.settled
        assert (settled.path, settled.names, settled.side, reading.conflicts) == (file.path, (name,), side, ())
        assert ("> 3" if side == "file" else "> 2") in settled.dropped


# World outputs


@pytest.mark.parametrize(
    ("attribute", "output"), [("distance", "distance"), ("ball_width", "width"), ("ball_range", "depth")]
)
def test_an_output_of_the_world_is_read_by_its_name(attribute: str, output: str) -> None:
    """Without a name in XABSL, its name in the world is its own."""
    now = project(lamp("team_size > 4"))
    (text,) = (file.text for file in generate(now) if file.component == "Lamp")
    assert "self.root.team.size > 4" in text
    readings = (
        (f"self.world.{attribute}", f"eyes.{output}"),
        (f"abs(self.world.{attribute})", f"abs(eyes.{output})"),
        ("self.world.other", None),
    )
    for call, words in readings:
        edited = text.replace("self.root.team.size > 4", f"{call} > 9")
        result = interpret_edits(now, "Lamp", generated=text, edited=edited)
        assert guards(result.design)[0] == ("team_size > 4" if words is None else f"{words} > 9")
        assert bool(result.leftover) == (words is None)
