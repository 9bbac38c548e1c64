"""Properties before, during and after a run: check --deep, run and trace check say the same of the same lines."""

from pathlib import Path

import pytest

from vicode.cli import main

DESIGN = """\
vicode: 1
component: Player
uses: {eyes: Eyes}
frequency: 50
variables: {tries: 0}
initial: Look
states:
  Look: {requires: [eyes], transitions: [{to: Align, when: eyes.seen}]}
  Align: {requires: [eyes], transitions: [{to: Kick, after: 0.5}]}
  Kick:
    enter: [{set: {tries: tries + 1}}]
    requires: [eyes]
    transitions: [{to: Look, after: 1, when: not eyes.seen}]
properties:
"""
PROJECT = """\
vicode: 1
project: game
components:
  Eyes:
    implementation: world
    outputs: {seen: {type: bool}, age: {type: float, range: [0, 10]}}
    assume: not seen or age < 2
agents: {player: Player}
"""
# The ball is seen from 0.5 s to 4 s: Align 0.5 s, Kick 1 s, Look 4 s.
INPUTS = ("--set", "0.5 s: Eyes.seen=true", "--set", "4 s: Eyes.seen=false", "--seconds", "6")


@pytest.mark.parametrize(
    ("promised", "in_check", "in_trace"),
    [
        ("{reach: Kick}", "", "kept      1 ×"),
        ("{after: Align, reach: Kick, within: 0.5}", "", "kept      1 ×"),
        ("{after: Align, reach: Kick, within: 0.4}", "D441", "BROKEN      1 ×; first at 0.92 s"),
        ("{after: Kick, reach: Look, within: 2}", "D441", "BROKEN      1 ×; first at 3.02 s"),
        ("{after: Kick, reach: Look, within: 10}", "D441", "kept      1 ×"),
        ("{after: Kick, reach: Look}", "", "kept      1 ×"),
        ("{never: Kick, before: Align}", "", "kept      1 ×"),
        ("{never: Kick}", "D441", "BROKEN      1 ×; first at 1.00 s"),
        ("{after: Kick, never: Align, before: Look}", "", "kept      1 ×"),
        ("{can_reach: Look}", "", ""),
        ("{holds: tries >= 0}", "", "kept    300 ×"),
        ("{holds: tries < 1}", "D441", "BROKEN      1 ×; first at 1.00 s"),
        ("{holds: tries < 2}", "D441", "kept    300 ×"),
    ],
)
def test_the_same_lines_before_during_and_after_a_run(
    promised: str,
    in_check: str,
    in_trace: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("project.yaml").write_text(PROJECT, encoding="utf-8")
    Path("player.yaml").write_text(f"{DESIGN}  - {promised}\n", encoding="utf-8")
    assert main(["check", "--deep", "."]) == (1 if in_check else 0), capfd.readouterr().out
    assert in_check in capfd.readouterr().out
    is_broken = "BROKEN" in in_trace
    assert main(["run", "player.yaml", *INPUTS, "--plain", "--trace", "t.jsonl", "--values"]) == int(is_broken)
    assert ("broken: " in capfd.readouterr().out) == is_broken
    assert main(["trace", "check", "t.jsonl"]) == int(is_broken)
    count, _, time = in_trace.partition("; ")
    (line,) = [each for each in capfd.readouterr().out.splitlines() if "Player" in each] if in_trace else [""]
    assert count in line
    assert line.endswith(time)


def test_conditions_are_watched_without_a_trace(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("project.yaml").write_text(PROJECT, encoding="utf-8")
    Path("player.yaml").write_text(f"{DESIGN}  - {{holds: tries < 1}}\n", encoding="utf-8")
    assert main(["run", "player.yaml", *INPUTS, "--plain"]) == 1
    assert "1.00 s  Player: broken: tries < 1 always holds\n" in capfd.readouterr().out


def test_assumptions_are_watched(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("project.yaml").write_text(PROJECT, encoding="utf-8")
    Path("player.yaml").write_text(DESIGN.replace("properties:\n", ""), encoding="utf-8")
    inputs = ["--set", "1 s: Eyes.seen=true", "--set", "2 s: Eyes.age=3", "--seconds", "3"]
    assert main(["run", "player.yaml", *inputs, "--plain", "--trace", "t.jsonl", "--values"]) == 1
    assert "2.00 s  Eyes: broken: assumed not seen or age < 2\n" in capfd.readouterr().out
    assert main(["trace", "check", "t.jsonl"]) == 1
    assert "BROKEN     50 ×  Eyes: assumed not seen or age < 2; first at 2.00 s" in capfd.readouterr().out


def test_a_folder_without_properties(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("blink.yaml").write_text(
        "vicode: 1\ncomponent: Blink\ninitial: A\nstates: {A: {transitions: [{to: B, after: 1}]}, B: {final: true}}\n",
        encoding="utf-8",
    )
    assert main(["run", "blink.yaml", "--seconds", "2", "--plain", "--trace", "t.jsonl"]) == 0
    assert main(["trace", "check", "t.jsonl"]) == 2
    assert "no design has properties" in capfd.readouterr().err
