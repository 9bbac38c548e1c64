"""Checking a project again finds what checking every design by itself finds, whatever was edited."""

import random
from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st

from tests.docsite.editing import EDITS, FORWARD, Edit
from vicode.check import PROJECT_RULES, check_design, check_project
from vicode.model.project import LANGUAGES

STEPS = st.lists(st.tuples(st.sampled_from(EDITS), st.integers(0, 99)), min_size=1, max_size=8)


@settings(max_examples=40, deadline=None)
@given(steps=STEPS, has_all_languages=st.booleans())
def test_what_was_found_before_is_what_is_found_now(steps: list[tuple[Edit, int]], has_all_languages: bool) -> None:
    project = FORWARD
    for edit, seed in steps:
        project = edit(project, random.Random(seed))
        if has_all_languages:
            project = replace(project, languages=LANGUAGES)
        expected = [finding for rule in PROJECT_RULES for finding in rule(project)]
        for design in project.designs:
            expected += check_design(project, design)
        assert check_project(project) == tuple(dict.fromkeys(expected))
