"""Random edits of imported designs are written to XABSL, or each of them is reported; nothing is lost."""

import random
import tempfile
from collections.abc import Mapping
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.importers.test_import_roundtrip import WRITTEN
from tests.services.imported_behavior.edited_behavior import (
    assert_only_comments_changed,
    assert_runs_agree,
    assert_written_or_reported,
    import_behavior_texts,
)
from tests.services.imported_behavior.test_behavior_update import assert_only_the_state_changed
from tests.strategies.commented_behaviors import commented_behaviors
from tests.xabsl.xabsl_cases import CASES
from vicode.xabsl.source_loader import load_source

PROGRAMS = ("drive_circle", "p2", "p7")


def read_behavior(agents: Path) -> dict[str, str]:
    source = load_source(agents)
    files = source.files.items()
    return {path.relative_to(source.main.parent).as_posix(): parsed.tokens.text for path, parsed in files}


def assert_edits_are_written_or_reported(texts: Mapping[str, str], seed: int, edits: int) -> None:
    chance, edited = random.Random(seed), import_behavior_texts(texts)
    for _ in range(edits):
        edited.edit(chance)
    new, problems = edited.update()
    if any(not problem.component and not problem.line for problem in problems):
        assert new == texts
        return
    assert_written_or_reported(edited, new, problems)
    if all(problem.line for problem in problems):
        with tempfile.TemporaryDirectory() as folder:
            assert_runs_agree(new, edited.project, Path(folder), count=40, seed=seed)


@settings(max_examples=settings().max_examples // 2)
@given(commented_behaviors(), st.integers(0, 2**32), st.integers(1, 5))
def test_edits_of_random_programs(texts: dict[str, str], seed: int, edits: int) -> None:
    assert_edits_are_written_or_reported(texts, seed, edits)


@pytest.mark.parametrize("name", PROGRAMS)
def test_edits_of_recorded_programs(name: str) -> None:
    texts = read_behavior(CASES / "programs" / name / "agents.xabsl")
    for seed in range(4):
        assert_edits_are_written_or_reported(texts, seed, 6)


@pytest.mark.parametrize("path", WRITTEN or [str(CASES / "programs" / "drive_circle" / "agents.xabsl")])
def test_edits_of_team_behaviors(path: str) -> None:
    texts = read_behavior(Path(path))
    for seed in range(10, 14):
        assert_edits_are_written_or_reported(texts, seed, 10)


@settings(max_examples=settings().max_examples // 2)
@given(commented_behaviors(), st.integers(0, 2**32))
def test_one_edit_changes_only_its_lines(texts: dict[str, str], seed: int) -> None:
    edited = import_behavior_texts(texts)
    kind = edited.edit(random.Random(seed))
    new, problems = edited.update()
    if (problems and not all(problem.line for problem in problems)) or not kind:
        assert new == texts
    elif kind.endswith("comment"):
        assert_only_comments_changed(texts, new)
    elif edited.last is not None and edited.last.state:
        assert_only_the_state_changed(texts, new, edited.last)
