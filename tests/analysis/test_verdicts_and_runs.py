"""Verdicts against runs of the reference interpreter, which shares no code with the analysis."""

import pytest

from tests.conformance.random_designs import draw_projects
from vicode.analysis.guards import ProvedDecision, Verdict, analyze_guards
from vicode.conformance.chosen_inputs import choose_runs
from vicode.conformance.reference import ReferenceRobots
from vicode.findings import DesignPath
from vicode.model.design import Decision
from vicode.model.project import Project
from vicode.model.traversal import iter_decisions
from vicode.semantics import ComponentStep, Outcome

_Seen = set[tuple[str, DesignPath, Outcome]]


def observe(project: Project, seed: int) -> _Seen:
    """What became of the decisions in runs with inputs that are chosen to reach as many as possible."""
    paths = {
        (design.component, id(located.decision)): located.path
        for design in project.designs
        for located in iter_decisions(design)
    }
    seen: _Seen = set()

    def note(step: ComponentStep, item: Decision, outcome: Outcome) -> None:
        seen.add((step.name, paths[step.name, id(item)], outcome))

    root = project.agents[0].root
    for run in choose_runs(project, root, iterations=100, seed=seed):
        robots = ReferenceRobots(
            project, root, run.inputs, robots=run.robots, team_ticks=run.team_ticks, on_decision=note
        )
        for step in run.steps:
            robots.step(step)
    return seen


def contradicts(proved: ProvedDecision, component: str, seen: _Seen) -> bool:
    is_branch = proved.path[-1] == "else"
    outcomes = {
        outcome
        for name, path, outcome in seen
        if name == component and (path == proved.path or (is_branch and path[: len(proved.path)] == proved.path))
    }
    match proved.verdict:
        case Verdict.NEVER_TESTED:
            return bool(outcomes)
        case Verdict.NEVER_HOLDS | Verdict.SHADOWED:
            return "true" in outcomes
        case Verdict.ALWAYS_HOLDS:
            return "false" in outcomes


@pytest.mark.parametrize("seed", range(2))
def test_no_run_contradicts_a_verdict(seed: int) -> None:
    verdicts = 0
    for number, project in enumerate(draw_projects(5, seed)):
        seen = observe(project, number)
        for design in project.designs:
            for proved in analyze_guards(project, design).find_verdicts():
                if not proved.basis.no_nan:
                    verdicts += 1
                    assert not contradicts(proved, design.component, seen), (design, proved)
    assert verdicts > 2
