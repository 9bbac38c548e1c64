"""Merges by git with the installed drivers and hooks, of random edits and of generated files."""

import random
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from tests.cli.command_runner import vicode
from tests.cli.git_folder import ENVIRONMENT, commit, git
from vicode.model.design import Assign, Design, Guard, State, Stay, Transition
from vicode.model.edits import add_state, remove_states, rename_state, unique_name, update_state
from vicode.store import find_conflicts, read_design, resolve_conflicts, save_design

DESIGNS = Path(__file__).parents[2] / "designs" / "forward"
MERGES = 20

StateEdit = Callable[[Design, str, random.Random], Design]


def _edit(change: Callable[[State, random.Random, Design], State]) -> StateEdit:
    return lambda design, name, chance: update_state(design, name, lambda state: change(state, chance, design))


def _add_transition(state: State, chance: random.Random, design: Design) -> State:
    new = Transition(to=chance.choice(design.states).name, guard=Guard(when=f"state_time > {chance.randrange(99)}"))
    at = chance.randint(0, len(state.transitions))
    return replace(state, transitions=(*state.transitions[:at], new, *state.transitions[at:]))


def _change_guard(state: State, chance: random.Random, design: Design) -> State:
    if not state.transitions:
        return state
    at = chance.randrange(len(state.transitions))
    changed = replace(state.transitions[at], guard=Guard(after=str(chance.randrange(99))))
    return replace(state, transitions=(*state.transitions[:at], changed, *state.transitions[at + 1 :]))


INNER_EDITS: tuple[StateEdit, ...] = (
    _edit(_add_transition),
    _edit(_change_guard),
    _edit(lambda state, chance, _: replace(state, doc=f"Number {chance.random()}.\n\nMore.")),
    _edit(lambda state, chance, _: replace(state, at=(chance.randrange(999), chance.randrange(999)))),
    _edit(lambda state, chance, _: replace(state, transitions=state.transitions[1:])),
    _edit(lambda state, chance, _: replace(state, transitions=state.transitions[::-1])),
    _edit(lambda state, chance, _: replace(state, transitions=(*state.transitions, Stay(doc=str(chance.random()))))),
    _edit(
        lambda state, chance, _: replace(state, actions=(*state.actions, Assign(values=(("x", str(chance.random())),))))
    ),
    _edit(lambda state, chance, _: replace(state, requires=state.requires[1:], disabled=not state.disabled)),
)
OUTER_EDITS: tuple[StateEdit, ...] = (
    lambda design, name, chance: rename_state(design, name, _unused_name(design, f"{name}{chance.randrange(9)}")),
    lambda design, name, chance: remove_states(design, [name]) if len(design.states) > 2 else design,
    lambda design, name, chance: add_state(
        design, State(name=_unused_name(design, f"Added{chance.randrange(9)}"), doc=name)
    ),
)


def _unused_name(design: Design, wanted: str) -> str:
    return unique_name(wanted, {state.name for state in design.states})


def edited(text: str, names: list[str], edits: tuple[StateEdit, ...], chance: random.Random) -> str:
    """The text after two to five edits of states with these names."""
    design = read_design(text).design
    assert design is not None
    for _ in range(chance.randint(2, 5)):
        left = [state.name for state in design.states if state.name in names]
        if left:
            design = chance.choice(edits)(design, chance.choice(left), chance)
    return save_design(design, text)


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The forward player in a repository with the drivers and hooks."""
    for name, value in ENVIRONMENT.items():
        monkeypatch.setenv(name, value)
    shutil.copytree(DESIGNS, tmp_path / "designs" / "forward")
    git(tmp_path, "init", "-q", "-b", "main")
    monkeypatch.chdir(tmp_path)
    assert vicode("hook", "install") == 0
    assert vicode("gen", "designs/forward") == 0
    git(tmp_path, "add", "--all")
    git(tmp_path, "commit", "-q", "--no-verify", "-m", "begin")
    return tmp_path


@pytest.mark.parametrize("merges", [MERGES, pytest.param(10 * MERGES, marks=pytest.mark.nightly)])
def test_random_edits(repository: Path, merges: int) -> None:
    """In `player.yaml`, both sides edit different states; in `follow_ball.yaml`, the same one."""
    player, other = (repository / "designs" / "forward" / name for name in ("player.yaml", "follow_ball.yaml"))
    texts = {file: file.read_text(encoding="utf-8") for file in (player, other)}
    player_names, other_names = ([state.name for state in _design(text).states] for text in texts.values())
    conflicts = 0
    for seed in range(merges):
        chance = random.Random(seed)
        names, same = chance.sample(player_names, len(player_names)), [chance.choice(other_names)]
        cut = chance.randint(1, len(names) - 1)
        expected: dict[str, State | None] = {}
        for branch, mine in (("theirs", names[cut:]), ("ours", names[:cut])):
            git(repository, "checkout", "-q", "-B", branch, "main")
            text = edited(texts[player], mine, INNER_EDITS, chance)
            player.write_text(text, encoding="utf-8")
            other.write_text(edited(texts[other], same, (*INNER_EDITS, *OUTER_EDITS), chance), encoding="utf-8")
            expected.update({name: _design(text).state(name) for name in mine})
            git(repository, "commit", "-q", "--no-verify", "--allow-empty", "-am", branch)
        output = git(repository, "merge", "--no-verify", "--no-edit", "theirs", check=False)
        merged = _design(player.read_text(encoding="utf-8"))
        assert {state.name: state for state in merged.states} == expected, f"seed {seed}: {output}"
        conflicts += _check_readable(other.read_text(encoding="utf-8"), seed)
        git(repository, "reset", "-q", "--hard")
    assert conflicts > merges // 4


def _design(text: str) -> Design:
    read = read_design(text)
    assert read.design is not None, read.findings
    return read.design


def _check_readable(text: str, seed: int) -> int:
    """Check that each conflict is one finding and that both sides are designs; return their number."""
    conflicts = find_conflicts(text)
    assert len([each for each in read_design(text).findings if each.rule.code == "Y113"]) == len(conflicts), seed
    assert len(read_design(text).findings) == len(conflicts), seed
    for takes_theirs in (False, True):
        resolved = resolve_conflicts(text, conflicts, takes_theirs=takes_theirs)
        assert "<<<<<<<" not in resolved
        assert not read_design(resolved).findings, seed
    return len(conflicts)


def test_generated_files_of_a_merge_are_generated_anew(repository: Path) -> None:
    file = repository / "designs" / "forward" / "player.yaml"
    text = file.read_text(encoding="utf-8")
    for branch, index in (("ours", 0), ("theirs", -1)):
        git(repository, "checkout", "-q", "-b", branch, "main")
        design = _design(text)
        name = design.states[index].name
        changed = update_state(design, name, lambda state, doc=f"By {branch}.": replace(state, doc=doc))
        file.write_text(save_design(changed, text), encoding="utf-8")
        assert vicode("gen", "designs/forward") == 0
        commit(repository, branch)
    git(repository, "checkout", "-q", "ours")
    git(repository, "merge", "-q", "--no-edit", "theirs")
    generated = git(repository, "show", "HEAD:generated/python/forward/player.py")
    assert "By ours." in generated
    assert "By theirs." in generated
    assert git(repository, "status", "--porcelain") == ""
    assert git(repository, "show", "--no-patch", "--format=%P %s").count(" ") > 2
    assert not git(repository, "ls-files", "generated/.vicode/python")
    assert vicode("gen", "--check", "designs/forward") == 0


def test_what_a_user_staged_is_not_added_to_a_merge_of_others(repository: Path) -> None:
    git(repository, "checkout", "-q", "-b", "topic")
    for branch in ("topic", "main"):
        git(repository, "checkout", "-q", branch)
        (repository / f"{branch}.txt").write_text(branch, encoding="utf-8")
        git(repository, "add", "--all")
        git(repository, "commit", "-q", "--no-verify", "-m", branch)
    git(repository, "branch", "before")
    git(repository, "merge", "-q", "--no-edit", "topic")
    merged = git(repository, "rev-parse", "HEAD")
    git(repository, "checkout", "-q", "before")
    (repository / "mine.txt").write_text("mine", encoding="utf-8")
    git(repository, "add", "mine.txt")
    git(repository, "merge", "-q", "--ff-only", "main")
    assert git(repository, "rev-parse", "HEAD") == merged
    assert git(repository, "status", "--porcelain") == "A  mine.txt\n"


def test_a_commit_with_errors_is_stopped(repository: Path) -> None:
    file = repository / "designs" / "forward" / "player.yaml"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("initial: ", "initial: No"), encoding="utf-8")
    git(repository, "add", "--all")
    before = git(repository, "rev-parse", "HEAD")
    git(repository, "commit", "-q", "-m", "broken", check=False)
    assert git(repository, "rev-parse", "HEAD") == before
    (repository / "notes.txt").write_text("unrelated", encoding="utf-8")
    git(repository, "reset", "-q", "--hard")
    git(repository, "add", "notes.txt")
    git(repository, "commit", "-q", "-m", "notes")
    assert git(repository, "rev-parse", "HEAD") != before


def test_outdated_generated_files_stop_a_commit(repository: Path) -> None:
    file = repository / "designs" / "forward" / "player.yaml"
    file.write_text(file.read_text(encoding="utf-8").replace("doc: ", "doc: New ", 1), encoding="utf-8")
    git(repository, "add", "--all")
    before = git(repository, "rev-parse", "HEAD")
    git(repository, "commit", "-q", "-m", "outdated", check=False)
    assert git(repository, "rev-parse", "HEAD") == before


def test_git_diff_shows_words(repository: Path) -> None:
    file = repository / "designs" / "forward" / "player.yaml"
    design = _design(file.read_text(encoding="utf-8"))
    file.write_text(
        save_design(add_state(design, State(name="Extra")), file.read_text(encoding="utf-8")), encoding="utf-8"
    )
    assert git(repository, "diff") == "designs/forward/player.yaml:\n  + state Extra\n"
    assert "+  Extra" in git(repository, "diff", "--no-ext-diff")
