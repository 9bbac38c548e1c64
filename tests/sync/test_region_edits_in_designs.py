"""Edits of regions reach the design, so that the design generates what stands in the file; also if that is nothing."""

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from vicode.generators import generate
from vicode.model.design import Code, Design, Guard, RunCode, State, Transition
from vicode.model.project import Project
from vicode.output import OutputFile, compare_files
from vicode.sync import AppliedEdits, Choices, FileEdits, apply_regions, find_file_edits

BODIES = {"module": "one = 1", "members": "two = 2", "A.enter": "three = 3", "A.leave": "four = 4"}


def code(python: str, cpp: str) -> Code:
    return Code(texts=(("python", f"{python}\n"), ("cpp", f"{cpp}\n")))


def project(enter: str = "three = 3") -> Project:
    guarded = Transition(to="B", guard=Guard(code=code("return self.state_time > 5", "return state_time() > 5;")))
    states = (
        State(
            name="A",
            enter=(RunCode(code=code(enter, f"int {enter};")),),
            actions=(RunCode(code=code("five = 5", "int five = 5;")), RunCode(code=code("six = 6", "int six = 6;"))),
            leave=(RunCode(code=code("four = 4", "int four = 4;")),),
            transitions=(guarded,),
        ),
        State(name="B"),
    )
    sections = code("one = 1", "int one = 1;"), code("two = 2", "int two = 2;")
    design = Design(component="Lamp", initial="A", states=states, module=sections[0], members=sections[1])
    other = Design(component="Other", initial="A", states=(State(name="A"),))
    return Project(name="lamps", languages=("python", "cpp"), designs=(design, other))


def edits_of(
    folder: Path, now: Project, change: Callable[[str], str], before: Project | None = None
) -> tuple[FileEdits, ...]:
    """The edits after the files generated from a project were changed, if the project is another one now."""
    old, files = generate(before or now), generate(now)
    for file in old:
        (folder / file.path).parent.mkdir(parents=True, exist_ok=True)
        (folder / file.path).write_text(change(file.text), encoding="utf-8")
    return find_file_edits(compare_files(files, folder), files, lambda path: texts_at(old, path))


def texts_at(files: Sequence[OutputFile], path: str) -> list[str]:
    return [file.text for file in files if file.path == path]


def replaced(result: AppliedEdits, before: Project) -> Project:
    designs = tuple(result.designs.get(design.component, design) for design in before.designs)
    return replace(before, designs=designs)


PLACES = ("one = 1", "two = 2", "three = 3", "four = 4", "five = 5", "six = 6")


@pytest.mark.parametrize("language", ["python", "cpp"])
@pytest.mark.parametrize("place", [*PLACES, "> 5"])
def test_an_edited_region_changes_what_the_design_generates(tmp_path: Path, language: str, place: str) -> None:
    def edit(text: str) -> str:
        return text.replace(place, f"{place}7")

    before = project()
    only = Project(name=before.name, languages=(language,), live=True, designs=before.designs)
    # The runtime may contain the text, too.
    found = tuple(file for file in edits_of(tmp_path, only, edit) if file.component)
    assert [len(file.regions) for file in found] == [1]
    result = apply_regions(only, found)
    assert (result.conflicts, [edit.region for edit in result.applied]) == ((), list(found[0].regions))
    assert [edit.file for edit in result.applied] == list(found)
    assert set(result.designs) == {"Lamp"}
    after = generate(replaced(result, only))
    assert [edit(file.text) for file in generate(only)] != [file.text for file in generate(only)]
    left = find_file_edits(
        compare_files(after, tmp_path), after, lambda path: [*texts_at(after, path), *texts_at(generate(only), path)]
    )
    assert [file.path for file in left if file.component] == []
    # The other language is as before, and a text with a line break at its end keeps it.
    other = "cpp" if language == "python" else "python"
    old, new = (design.module.in_language(other) for design in (before.designs[0], result.designs["Lamp"]))
    assert old == new
    assert (result.designs["Lamp"].module.in_language(language) or "").endswith("\n")


@pytest.mark.parametrize("language", ["python", "cpp"])
@pytest.mark.parametrize("place", PLACES)
def test_an_emptied_region_has_no_effect(tmp_path: Path, language: str, place: str) -> None:
    before = project()
    only = Project(name=before.name, languages=(language,), designs=before.designs)
    found = edits_of(tmp_path, only, lambda text: re.sub(f".*{place}.*\n", "", text))
    result = apply_regions(only, found)
    assert (result.conflicts, len(result.applied)) == ((), 1)
    texts = [file.text for file in generate(replaced(result, only))]
    assert not any(place in text for text in texts)
    empty = "pass" if language == "python" else ";"
    assert sum(line.strip() == empty for text in texts for line in text.splitlines()) == 1 + sum(
        line.strip() == empty for file in generate(only) for line in file.text.splitlines()
    )
    for file in generate(replaced(result, only)):
        if file.path.endswith(".py"):
            compile(file.text, file.path, "exec")


@pytest.mark.parametrize("path", ["python/lamps/lamp.py", "other/lamp.py"])
@pytest.mark.parametrize("choices", [Choices(), Choices(default="file"), Choices(default="design")])
def test_an_edit_without_a_design_is_a_conflict(tmp_path: Path, path: str, choices: Choices) -> None:
    now = project()
    found = edits_of(tmp_path, now, lambda text: text.replace("three = 3", "three = 33"))
    stale = replace(found[0], component="", path=path)
    result = apply_regions(now, [stale], choices)
    assert (dict(result.designs), result.applied) == ({}, ())
    is_dropped = choices.default == "design"
    assert result.conflicts == (() if is_dropped else ((stale, stale.regions[0], ()),))
    assert [each.side for each in result.settled] == (["design"] if is_dropped else [])


@pytest.mark.parametrize(("side", "kept"), [("file", "three = 33"), ("design", "three = 333")])
def test_a_conflict_takes_the_chosen_side(tmp_path: Path, side: str, kept: str) -> None:
    now = project("three = 333")
    found = edits_of(tmp_path, now, lambda text: text.replace("three = 3", "three = 33"), project())
    unsettled = apply_regions(now, found)
    assert (dict(unsettled.designs), unsettled.applied, unsettled.settled) == ({}, (), ())
    assert [(file.path, path[-4:]) for file, _region, path in unsettled.conflicts] == [
        (file.path, ("A", "enter", 0, "code")) for file in found
    ]
    # Edits after a conflict are applied.
    more = edits_of(
        tmp_path, now, lambda text: text.replace("three = 3", "three = 33").replace("four = 4", "four = 5"), project()
    )
    assert [edit.region.file_text.strip("int ;") for edit in apply_regions(now, more).applied] == ["four = 5"] * 2
    result = apply_regions(now, found, Choices(default=side))
    assert result.conflicts == ()
    assert {each.side for each in result.settled} == {side}
    lost = {"file": "three = 333", "design": "three = 33"}[side]
    assert all(each.dropped.removeprefix("int ").removesuffix(";") == lost for each in result.settled)
    enter = result.designs.get("Lamp", now.designs[0]).states[0].enter[0]
    assert isinstance(enter, RunCode)
    assert enter.code == code(kept, f"int {kept};")
    assert bool(result.applied) == (side == "file")
