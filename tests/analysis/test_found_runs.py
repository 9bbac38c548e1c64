"""Runs that findings report happen in the generated code, too: `vicode replay` runs it with the same inputs."""

from pathlib import Path

import pytest

from vicode.check.behavior import find_deep
from vicode.cli import main
from vicode.runs.found_runs import write_found_run
from vicode.store import open_project

PLAYER = """\
vicode: 1
component: Player
uses: {eyes: Eyes}
frequency: 10
parameters: {near: false}
variables: {tries: 0}
initial: Search
states:
  Search: {requires: [eyes], enter: [{set: {tries: 0}}], transitions: [{to: Go, when: eyes.seen}]}
  Go:
    requires: [eyes]
    transitions:
      - {to: Align, when: near and abs(eyes.angle) < 20}
      - {to: Search, when: not eyes.seen, after: 1}
      - {to: Turn, when: abs(eyes.angle) > 40}
  Turn: {requires: [eyes], transitions: [{to: Go, when: eyes.angle < 30}]}
  Align:
    requires: [eyes]
    transitions:
      - {to: Kick, after: 0.5, when: tries < 3}
      - {to: Search, after: 0.5}
  Kick:
    enter: [{set: {tries: tries + 1}}]
    requires: [eyes]
    transitions:
      - {to: Align, after: 2, when: near}
      - {to: Search, after: 2}
properties:
  - {after: Kick, reach: Search, within: 5}
  - {never: Kick, before: Turn}
  - {after: Kick, never: Kick, before: Search}
  - {holds: tries <= 2}
  - {never: Turn}
"""
PROJECT = """\
vicode: 1
project: game
components:
  Eyes: {outputs: {seen: {type: bool}, angle: {type: float, range: [-180, 180]}}}
agents: {player: Player}
"""


def test_the_generated_code_does_what_findings_report(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "project.yaml").write_text(PROJECT, encoding="utf-8")
    (tmp_path / "player.yaml").write_text(PLAYER, encoding="utf-8")
    project = open_project(tmp_path).project
    found = find_deep(project, "Player")
    assert [each.rule.code for each in found] == ["D441"] * 5 + ["D435"]
    for number, finding in enumerate(found):
        assert finding.run is not None
        trace = tmp_path / f"{number}.jsonl"
        trace.write_text(write_found_run(project, finding.run), encoding="utf-8")
        assert main(["replay", str(trace), "--design", str(tmp_path)]) == 0, (finding.message, capsys.readouterr().out)
        if finding.rule.code == "D441":
            capsys.readouterr()
            assert main(["trace", "check", str(trace), "--design", str(tmp_path)]) == 1
            assert f"BROKEN      1 ×  Player: {finding.message.split(chr(39))[1]}" in capsys.readouterr().out
