"""Random edits of generated C++: what is read back behaves as the person wrote it, and nothing is lost.

The edits are made in the text; both versions are compiled together and run on the same random inputs.
"""

import os
import random
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from unittest.mock import patch

import pytest

from tests.conformance.random_designs import draw_projects
from tests.sync.cpp_law import Trial, changed_behavior, count_kinds, lost_text, source_of, try_edit, try_text
from tests.sync.cpp_player_edits import PLAYER_EDITS, edit_player
from tests.sync.player_edits import FORWARD
from vicode.conformance.cpp import COMPILER_MISSING
from vicode.generators.cpp.compiler import find_compiler
from vicode.model.expressions import FLOAT
from vicode.model.project import Project

TRIALS = 24
_INTERPRET = "vicode.sync.interpret"


def make_trials(count: int, seed: int, folder: Path) -> list[Trial]:
    """Edit random designs, and the sample player at times."""
    drawn = draw_projects(count, seed=seed)
    projects: list[Project] = [FORWARD if number % 8 == 0 else project for number, project in enumerate(drawn)]
    tried = (
        try_edit(f"law{number}", project, "Player", seed * 1000 + number, folder / "patch")
        for number, project in enumerate(projects)
    )
    return [trial for trial in tried if trial is not None]


@dataclass(frozen=True)
class Fault:
    """A check that is removed, and an edit for which it is needed."""

    targets: tuple[str, ...]
    instead: object
    old: str
    new: str


_SEEN = "if (perception.ball_seen) {\n                change_to(State::FollowBall);"
_DIVIDED = "if (1 / 2 > 0) {\n                change_to(State::FollowBall);"
FAULTS = {
    "types of numbers": Fault(
        (f"{_INTERPRET}.cpp_plain_forms._number",), lambda text: (FLOAT, ("#.", repr(float(text)))), _SEEN, _DIVIDED
    ),
    "comparison with the file": Fault(
        (f"{_INTERPRET}.cpp_comparison.CppComparison.is_same",), lambda *_arguments: True, _SEEN, _DIVIDED
    ),
    "return in code": Fault(
        (f"{_INTERPRET}.cpp_action_reader._LEAVING",),
        frozenset[str](),
        "            call(search_ball,",
        "            if (kicks < 100) {\n                return;\n            }\n            call(search_ball,",
    ),
    "names of variables": Fault(
        (f"{_INTERPRET}.cpp_action_reader._declared",),
        lambda _tokens: set(),
        "        case State::CircleBall:\n            side =",
        "        case State::FollowBall:\n            static std::int64_t kicks = 40;\n            kicks += 1;\n"
        "            break;\n        case State::CircleBall:\n            side =",
    ),
    "comments": Fault(
        (f"{_INTERPRET}.cpp_plain_forms.comment_words", f"{_INTERPRET}.cpp_comparison.comment_words"),
        lambda _tokens: (),
        "            // ball seen",
        "            // the ball is seen at last",
    ),
    "branches that do not end": Fault(
        (f"{_INTERPRET}.cpp_plain_forms.always_ends", f"{_INTERPRET}.cpp_decision_reader.always_ends"),
        lambda _statements: True,
        _SEEN,
        "if (perception.ball_x > 0) {\n                if (perception.ball_y > 9000) {\n"
        "                    change_to(State::GetUp);\n                    return;\n                }\n"
        f"            }} else {_SEEN}",
    ),
}


def plant(name: str, fault: Fault, folder: Path) -> Trial:
    """Read an edit back without a check."""
    project = replace(FORWARD, name=name, languages=("cpp",))
    text = source_of(project, "Player")
    assert text.count(fault.old) == 1
    edited = text.replace(fault.old, fault.new)
    with ExitStack() as stack:
        for target in fault.targets:
            stack.enter_context(patch(target, fault.instead))
        return try_text(name, project, "Player", (name,), edited, folder)


@dataclass(frozen=True)
class Session:
    """The trials, those with a fault, and how behavior changed by the name of the trial."""

    trials: list[Trial]
    faulty: dict[str, Trial]
    changed: dict[str, str]


@pytest.fixture(scope="module")
def session(tmp_path_factory: pytest.TempPathFactory) -> Session:
    compiler = find_compiler()
    if compiler is None:
        pytest.fail(f"C++ cannot be tested: {COMPILER_MISSING}", pytrace=False)
    folder = tmp_path_factory.mktemp("law")
    trials = make_trials(TRIALS, 1, folder)
    faulty = {
        name: plant(f"fault{number}", fault, folder / "patch") for number, (name, fault) in enumerate(FAULTS.items())
    }
    return Session(trials, faulty, changed_behavior([*trials, *faulty.values()], folder, compiler))


def test_no_edit_changes_the_behavior(session: Session) -> None:
    names = {trial.name for trial in session.trials}
    assert {name: text for name, text in session.changed.items() if name in names} == {}


def test_no_text_is_lost_or_invented(session: Session) -> None:
    found = {(trial.name, trial.edits): lost for trial in session.trials if (lost := lost_text(trial))}
    assert found == {}


def test_edits_are_taken_and_left(session: Session) -> None:
    kinds = [trial.kind for trial in session.trials]
    assert kinds.count("taken") >= TRIALS // 5, count_kinds(session.trials)
    assert kinds.count("left") >= TRIALS // 10, count_kinds(session.trials)


def test_each_edit_that_is_left_has_a_reason(session: Session) -> None:
    left = [trial for trial in session.trials if trial.read.leftover]
    assert [trial.edits for trial in left if not trial.read.reasons] == []


@pytest.mark.parametrize("name", FAULTS)
def test_the_law_finds_a_removed_check(session: Session, name: str) -> None:
    trial = session.faulty[name]
    assert trial.name in session.changed or lost_text(trial)


@pytest.mark.nightly
@pytest.mark.parametrize("batch", range(10))
def test_many_edits_change_no_behavior(batch: int, tmp_path: Path) -> None:
    seed = random.SystemRandom().randrange(10**6) if "VICODE_HYPOTHESIS" in os.environ else batch
    compiler = find_compiler()
    assert compiler is not None, COMPILER_MISSING
    trials = make_trials(60, seed, tmp_path)
    assert [lost for trial in trials for lost in lost_text(trial)] == [], f"seed {seed}"
    assert changed_behavior(trials, tmp_path, compiler) == {}, f"seed {seed}"


@pytest.mark.nightly
def test_edits_of_the_sample_change_no_behavior(tmp_path: Path) -> None:
    compiler = find_compiler()
    assert compiler is not None, COMPILER_MISSING
    project = replace(FORWARD, languages=("cpp",))
    trials = []
    for number, edit in enumerate(PLAYER_EDITS):
        named = replace(project, name=f"edit{number}")
        edited = edit_player(source_of(named, "Player"), edit)
        trials.append(try_text(named.name, named, "Player", (edit,), edited, tmp_path / "patch"))
    assert [lost for trial in trials for lost in lost_text(trial)] == []
    assert changed_behavior(trials, tmp_path, compiler) == {}
