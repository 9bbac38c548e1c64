"""The designs that come along: nothing is wrong with them, and the smallest is really small."""

from pathlib import Path

import pytest

from vicode.check import check_project
from vicode.store import open_project

DESIGNS = Path(__file__).parents[2] / "designs"
PAPER = {"Player", "SearchBall", "FollowBall", "FaceBall", "SearchNet", "Body", "GoStraight", "Turn", "Fixmove"}


@pytest.mark.parametrize("folder", ["forward", "blink", "rescue", "meeting", "soccer2d", "team"])
def test_there_are_no_findings(folder: str) -> None:
    opened = open_project(DESIGNS / folder)
    findings = (*opened.findings, *check_project(opened.project))
    assert not [f"{finding.rule.code} {finding.message} at {finding.subject}" for finding in findings]


def test_the_forward_has_the_components_of_the_paper() -> None:
    project = open_project(DESIGNS / "forward").project
    assert {design.component for design in project.designs} == PAPER


def test_every_state_of_the_forward_has_its_place() -> None:
    designs = open_project(DESIGNS / "forward").project.designs
    lost = [f"{design.component}.{state.name}" for design in designs for state in design.states if state.at is None]
    assert not lost


def test_ten_lines_are_a_design() -> None:
    assert len((DESIGNS / "blink" / "blink.yaml").read_text(encoding="utf-8").splitlines()) == 10
    assert open_project(DESIGNS / "blink").project.name
