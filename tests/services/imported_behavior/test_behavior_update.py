"""Edits of imported designs are written back to the XABSL files; what was not edited keeps each byte."""

import difflib
import random
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.importers.differential_harness import import_checked
from tests.importers.test_import_roundtrip import ODD, PROBES
from tests.strategies.commented_behaviors import commented_behaviors
from tests.strategies.project_edits import Edited, random_edit
from tests.xabsl.xabsl_cases import CASES, PROGRAMS, load_texts
from vicode.check import check_project
from vicode.findings import Severity
from vicode.model.project import Project
from vicode.services.imported_behavior.behavior_update import (
    EditedProject,
    UpdateProblem,
    generated_version,
    update_behavior,
)
from vicode.xabsl import tree
from vicode.xabsl.patching.program_patch import ProgramVersion, patch_program
from vicode.xabsl.patching.source_edits import SourceEdits
from vicode.xabsl.source_loader import ProgramSource, load_source

ROOT = Path("/behavior")


def update(
    texts: Mapping[str, str], project: Project, folders: Mapping[str, str] | None = None
) -> tuple[dict[str, str | None], tuple[UpdateProblem, ...]]:
    """Update a behavior; returns the changed files by path relative to the main file."""

    def read(path: Path) -> str:
        return texts[path.relative_to(ROOT).as_posix()]

    paths = {name: f"{folder}/{name}.yaml" for name, folder in (folders or {}).items()}
    changed, problems = update_behavior(load_texts(dict(texts)), EditedProject(project=project, paths=paths), read)
    return {path.relative_to(ROOT).as_posix(): text for path, text in changed.items()}, problems


def imported(texts: Mapping[str, str]) -> Project:
    return import_checked(load_texts(dict(texts)))[0].project


def updated(texts: Mapping[str, str], project: Project, folders: Mapping[str, str] | None = None) -> dict[str, str]:
    """The files of the behavior after an update without problems, whose import is the edited project."""
    changed, problems = update(texts, project, folders)
    assert problems == ()
    new = {name: text for name, text in {**texts, **changed}.items() if text is not None}
    assert generated_version(imported(new), {}).compiled.program == generated_version(project, {}).compiled.program
    return new


def changed_lines(old: Mapping[str, str], new: Mapping[str, str]) -> list[str]:
    """The removed and added lines of all files, without indentation."""
    lines = []
    for name in sorted({**old, **new}):
        pair = [texts.get(name, "").splitlines() for texts in (old, new)]
        lines += [line for line in difflib.ndiff(*pair) if line[0] in "+-"]
    return [f"{line[0]} {line[1:].strip()}" for line in lines]


# Laws


def assert_unchanged(source: ProgramSource) -> None:
    imported_project, compiled = import_checked(source)
    version = generated_version(imported_project.project, {})
    assert patch_program(ProgramVersion(source, compiled), version, version) == {}
    assert update_behavior(source, EditedProject(project=imported_project.project), lambda _path: "") == ({}, ())


@pytest.mark.parametrize("name", PROGRAMS)
def test_recorded_programs_without_edits_stay(name: str) -> None:
    assert_unchanged(load_source(CASES / "programs" / name / "agents.xabsl"))


@pytest.mark.parametrize("name", [*PROBES, *ODD])
def test_tiny_programs_without_edits_stay(name: str) -> None:
    assert_unchanged(load_texts({**PROBES, **ODD}[name]))


@given(commented_behaviors())
def test_random_programs_without_edits_stay(texts: dict[str, str]) -> None:
    assert_unchanged(load_texts(texts))


def draw_edit(chance: random.Random, project: Project) -> Edited | None:
    edited = random_edit(chance, project)
    if edited is None:
        return None
    findings = check_project(replace(edited.project, languages=("xabsl",)))
    return None if any(finding.severity is Severity.ERROR for finding in findings) else edited


def assert_only_the_state_changed(texts: Mapping[str, str], new: Mapping[str, str], edited: Edited) -> None:
    """Assert that all characters outside of an edited state are unchanged."""
    source, project = load_texts(dict(texts)), imported(texts)
    design = project.design(edited.component)
    assert design is not None
    state = design.state(edited.state)
    assert state is not None
    names = design.xabsl_name or design.component, state.xabsl_name or state.name
    for path, parsed in source.files.items():
        name, file = path.relative_to(ROOT).as_posix(), SourceEdits(parsed)
        nodes = [
            node
            for item in parsed.file.body
            if isinstance(item, tree.OptionNode) and item.name.text == names[0]
            for node in item.states
            if node.name.text == names[1]
        ]
        if not nodes:
            assert new[name] == texts[name]
            continue
        start, end = file.end(nodes[0].first_token - 1), file.end(nodes[0].last_token)
        assert new[name].startswith(texts[name][:start])
        assert new[name].endswith(texts[name][end:])


@given(commented_behaviors(), st.integers(0, 2**32))
def test_random_edits_change_only_what_was_edited(texts: dict[str, str], seed: int) -> None:
    project = imported(texts)
    edited = draw_edit(random.Random(seed), project)
    if edited is None:
        return
    new = updated(texts, edited.project)
    if edited.state:
        assert_only_the_state_changed(texts, new, edited)


@given(commented_behaviors(), st.integers(0, 2**32))
def test_several_edits_are_written_together_or_refused(texts: dict[str, str], seed: int) -> None:
    chance, project = random.Random(seed), imported(texts)
    for _ in range(10):
        edited = draw_edit(chance, project)
        project = edited.project if edited else project
    changed, problems = update(texts, project)
    if problems:
        assert changed == {}
    else:
        updated(texts, project)


@pytest.mark.parametrize("name", ["p1", "p7", "drive_circle"])
def test_random_edits_of_recorded_programs(name: str) -> None:
    folder = CASES / "programs" / name
    texts = {path.relative_to(folder).as_posix(): path.read_text("utf-8") for path in folder.rglob("*.xabsl")}
    project, chance = imported(texts), random.Random(name)
    for _ in range(12):
        edited = draw_edit(chance, project)
        if edited is not None and edited.state:
            assert_only_the_state_changed(texts, updated(texts, edited.project), edited)
