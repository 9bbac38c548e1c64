"""All languages give the same traces: the cases of this folder, and random designs with random inputs.

All C++ code is compiled together, once.
"""

import os
import random
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

import pytest

from tests.conformance.compared_runs import Runs, Traces, add_chosen, compare_all
from tests.conformance.conformance_cases import CASES, LANGUAGES, Case, short_form
from tests.conformance.random_designs import draw_projects
from tests.conformance.scxml_cases import DOCUMENTS, expected_states, scxml_run
from vicode.conformance.comparison import find_absent_languages
from vicode.conformance.cpp import COMPILER_MISSING
from vicode.conformance.javascript import find_node, is_last_bit
from vicode.conformance.report import describe, explain
from vicode.conformance.traces import EXPECTED_DIFFERENCES, first_difference, reduce_for
from vicode.generators.cpp.compiler import find_compiler

FILES = sorted(CASES.glob("*.yaml"))
RANDOM_DESIGNS = 50
ITERATIONS = 40
FEATURES = {
    *("order", "groups", "timers", "common transitions", "requires and modulates", "restart", "resume", "periods"),
    *("nested components", "parameters", "enumerations", "arithmetic", "final states", "outputs and variables"),
    *("code", "arithmetic: xabsl", "time_unit: ms", "teams", "disabled", "names", "times"),
    *("failed states", "latches", "interrupts", "competences", "layers"),
}


@dataclass(frozen=True)
class Session:
    """The traces by language and name of the run."""

    traces: Traces
    runs: Runs


@pytest.fixture(scope="module")
def session(tmp_path_factory: pytest.TempPathFactory) -> Session:
    runs, absent = {}, {}
    for file in FILES:
        case = Case(file, tmp_path_factory.mktemp("case"))
        runs[case.name], absent[case.name] = case.run, case.not_in
    for file in DOCUMENTS:
        runs[f"scxml_{file.stem}"] = scxml_run(file)
        absent[f"scxml_{file.stem}"] = find_absent_languages(scxml_run(file))
    for number, project in enumerate(draw_projects(RANDOM_DESIGNS)):
        add_chosen(runs, absent, f"random_{number}", project, iterations=ITERATIONS, seed=number)
    return Session(compare_all(runs, absent, tmp_path_factory.mktemp("conformance")), runs)


def differences(session: Session, name: str, language: str) -> str:
    expected = reduce_for(language, session.traces["reference"][name])
    got = reduce_for(language, session.traces[language][name])
    found = first_difference(expected, got)
    if found and language == "javascript" and is_last_bit(session.runs[name], found):
        return ""
    return "" if found is None else describe(explain(found, {"reference": expected, language: got}))


def test_there_is_a_compiler() -> None:
    if find_compiler() is None:
        pytest.fail(f"C++ cannot be tested: {COMPILER_MISSING}", pytrace=False)


def test_javascript_runs_the_cases(session: Session) -> None:
    if find_node() is None:
        pytest.skip("Node.js is missing: sudo apt install nodejs")
    assert len(session.traces["javascript"]) > len(FILES)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_case_gives_the_expected_trace_in_each_language(
    session: Session, file: Path, tmp_path: Path, accept: bool
) -> None:
    case = Case(file, tmp_path)
    text = short_form(session.traces["reference"][case.name], case.run.robots)
    if accept:
        case.accept(text)
    else:
        assert text == case.expected
    for language in LANGUAGES:
        if language not in case.not_in and case.name in session.traces[language]:
            assert differences(session, case.name, language) == ""


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_a_language_is_left_out_for_the_reason_that_the_check_reports(file: Path, tmp_path: Path) -> None:
    case = Case(file, tmp_path)
    assert case.header["feature"] in FEATURES
    assert dict(case.not_in) == {**find_absent_languages(case.run), **dict(case.header.get("beyond_check", {}))}


@pytest.mark.parametrize("file", DOCUMENTS, ids=lambda file: file.stem)
def test_imported_scxml_passes_in_each_language(session: Session, file: Path) -> None:
    name = f"scxml_{file.stem}"
    states = [iteration.steps[0].fields["state"] for iteration in session.traces["reference"][name]]
    assert " ".join(state for state, _repeated in groupby(states)) == expected_states(file)
    assert states[-1] == "pass_"
    for language in LANGUAGES:
        if name in session.traces[language]:
            assert differences(session, name, language) == ""


def test_each_feature_has_a_case() -> None:
    features = {Case(file, file.parent).header["feature"] for file in FILES}
    assert features == FEATURES


@pytest.mark.parametrize("number", range(RANDOM_DESIGNS))
def test_languages_agree_on_random_designs(session: Session, number: int) -> None:
    names = [name for name in session.traces["reference"] if name.startswith(f"random_{number}__")]
    assert names
    for language in LANGUAGES:
        for name in names:
            if name in session.traces[language]:
                assert differences(session, name, language) == ""


@pytest.mark.nightly
@pytest.mark.parametrize("batch", range(40))
def test_languages_agree_on_many_random_designs(batch: int, tmp_path: Path) -> None:
    seed = random.SystemRandom().randrange(10**6) if "VICODE_HYPOTHESIS" in os.environ else batch
    runs, absent = {}, {}
    for number, project in enumerate(draw_projects(50, seed=seed)):
        add_chosen(runs, absent, f"random_{number}", project, iterations=80, seed=number)
    found = Session(compare_all(runs, absent, tmp_path), runs)
    assert [text for text in _all_differences(found) if text] == [], f"seed {seed}"


def _all_differences(session: Session) -> Iterator[str]:
    for language in LANGUAGES:
        for name in session.traces[language]:
            text = differences(session, name, language)
            yield text and f"{name}: {text}"


def test_expected_differences_are_documented() -> None:
    page = (Path(__file__).parents[2] / "docs" / "conformance.md").read_text(encoding="utf-8")
    assert [limit.reason for limit in EXPECTED_DIFFERENCES if limit.reason not in page.replace("`", "")] == []
