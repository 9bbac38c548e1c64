"""Incremental checks report the same findings as checking each design separately."""

import random
from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st

from tests.docsite.random_edits import EDITS, FORWARD, Edit
from vicode.check import check_design, check_file, check_project
from vicode.languages import GENERATED_LANGUAGES
from vicode.model.design import Design, State, Use
from vicode.model.project import Project

STEPS = st.lists(st.tuples(st.sampled_from(EDITS), st.integers(0, 99)), min_size=1, max_size=8)


@given(steps=STEPS, has_all_languages=st.booleans())
def test_incremental_findings_equal_separate_findings(steps: list[tuple[Edit, int]], has_all_languages: bool) -> None:
    project = FORWARD
    for edit, seed in steps:
        project = edit(project, random.Random(seed))
        if has_all_languages:
            project = replace(project, languages=GENERATED_LANGUAGES)
        expected = list(check_file(project))
        for design in project.designs:
            expected += check_design(project, design)
        assert check_project(project) == tuple(dict.fromkeys(expected))


def design_of(name: str, *used: str) -> Design:
    state = State(name="Only", requires=used)
    return Design(
        component=name, initial="Only", uses=tuple(Use(alias=each, component=each) for each in used), states=(state,)
    )


def test_steps_of_another_design_invalidate_the_cache() -> None:
    ends = (design_of("top", "left", "right"), design_of("left", "low"), design_of("low"))
    twice = Project(name="Steps", designs=(*ends, design_of("right", "low")))
    once = replace(twice, designs=(*ends, design_of("right")))
    found = ["D425" in [each.rule.code for each in check_project(project)] for project in (once, twice, once)]
    assert found == [False, True, False]
