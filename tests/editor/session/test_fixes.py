"""Every quick fix resolves its finding without a new error; every rule has fixes or a reason for none."""

import re
import shutil
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given

from tests.strategies.designs import designs
from vicode.check import check_design, check_project
from vicode.editor.session.fixes import FIXERS, UNFIXABLE, find_fixes
from vicode.findings import RULES, Finding, Severity
from vicode.model.design import Design
from vicode.model.project import Interface, Project
from vicode.store import open_project

ROOT = Path(__file__).parents[3]
CASES = sorted((ROOT / "tests" / "check" / "cases").iterdir())
PAGE = (ROOT / "docs" / "rules.md").read_text(encoding="utf-8")
SECTION = re.compile(r"^### ([A-Z]\d{3})\n(.*?)(?=^##)", re.MULTILINE | re.DOTALL)
EXAMPLE = re.compile(r"^```yaml ?(\S*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
TOP_LEVEL_KEY = re.compile(r"^(\w+):.*\n(?:[ \t#-].*\n)*", re.MULTILINE)
FRAME = dict(EXAMPLE.findall(PAGE.split("\n## ")[0]))
BAD = {code: found[0] for code, text in SECTION.findall(PAGE + "\n##") if (found := EXAMPLE.findall(text))}

# The rules page has no example with a quick fix for these.
MENDED_ELSEWHERE = {"P204", "P205", "P206", "D404", "D405", "D406", "D416", "E306", "E307"}


def test_every_rule_has_fixes_or_a_reason() -> None:
    of_designs = {code for code in RULES if not code.startswith(("S", "X"))}
    assert set(FIXERS) | set(UNFIXABLE) == of_designs
    assert not set(FIXERS) & set(UNFIXABLE)


@pytest.mark.parametrize("code", sorted(BAD))
def test_fixes_resolve_the_examples_of_the_rules(code: str, tmp_path: Path) -> None:
    file, text = BAD[code]
    for name, frame in FRAME.items():
        (tmp_path / name).write_text(_put_in(frame, text) if name == (file or "player.yaml") else frame)
    fixes = _try_all(open_project(tmp_path).project)
    assert bool(fixes[code]) == (code in FIXERS) or code in MENDED_ELSEWHERE


@pytest.mark.parametrize("case", CASES, ids=lambda path: path.stem)
def test_fixes_resolve_the_check_cases(case: Path, tmp_path: Path) -> None:
    if case.is_dir():
        shutil.copytree(case, tmp_path, dirs_exist_ok=True)
    else:
        shutil.copy(case, tmp_path)
    _try_all(open_project(tmp_path).project)


@given(designs)
def test_fixes_resolve_findings_of_random_designs(design: Design) -> None:
    _try_all(Project(name="p", designs=(design,), components=(Interface(component="Walk", implementation="a:B"),)))


def test_declarations_used_by_another_design_are_kept(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text("vicode: 1\ncomponent: A\ninitial: S\noutputs: {x: 0}\nstates: {S: {}}\n")
    opened = open_project(tmp_path).project
    assert _labels(opened, "D424") == ["Remove the output x"]
    (tmp_path / "b.yaml").write_text(
        "vicode: 1\ncomponent: B\ninitial: S\nuses: {a: A}\nstates: {S: {requires: [a]}}\n"
    )
    assert _labels(open_project(tmp_path).project, "D424") == []


STEPPING = """uses: {eye: Perception}
initial: S
%s
states:
  S: {requires: [eye], transitions: [{to: T, after: 1}]}
  T: {%s}
"""
STAY = "initial: S\nstates: {S: {final: true, transitions: [{stay: true, when: %s}]}}"


@pytest.mark.parametrize(
    ("text", "code", "label"),
    [
        (
            "initial: A\nstates: {A: {transitions: [{to: Kik, after: 1}]}, Kick: {}}",
            "D402",
            "Change the target to Kick",
        ),
        ("initial: S\nstates: {S: {transitions: [{to: T, after: 1}]}}", "D402", "Create the state T"),
        (STAY % "n > 3", "E303", "Declare the variable n: 0.0"),
        (STAY % "seen", "E303", "Declare the variable seen: False"),
        (STAY % "order_given", "E303", "Create input order_given (bool)"),
        (STAY % "unknown and order_given", "E303", "Create input order_given (bool)"),
        (STAY % "battery < 3 or battery > 9", "E303", "Create input battery (float)"),
        ("uses: {eye: Perception}\n" + STAY % "not ball", "E303", "Use eye.ball"),
        ("variables: {seen: false}\n" + STAY % "sen", "E303", "Replace with seen"),
        ("uses: {eye: Perception}\n" + STAY % "eye.bal", "E303", "Replace with eye.ball"),
        ("initial: S\nstates: {S: {actions: [{set: {n: 1 + 1}}]}}", "E303", "Declare the variable n: 0"),
        (STAY % "perception.ball", "E303", "Use the component Perception as perception"),
        ("initial: S\nstates: {S: {requires: [perception]}}", "D403", "Use the component Perception as perception"),
        (
            "uses: {eye: Perception}\ninitial: S\nstates: {S: {enter: [{code: pass}, {call: eye}]}}",
            "D410",
            "Call eye in the actions of S",
        ),
        (
            "initial: S\nstates: {S: {transitions: [{to: T}, {to: T, after: 1}]}, T: {final: true}}",
            "D423",
            "Remove the transition",
        ),
        ("initial: S\nstates: {S: {transitions: [{to: S, after: 1}]}}", "D430", "Replace it with a stay"),
        (
            STEPPING % ("common: {transitions: [{to: S, when: eye.ball}]}", ""),
            "D426",
            "Require eye in all states",
        ),
        (
            STEPPING % ("", "transitions: [{to: S, when: eye.ball}]"),
            "D426",
            "Require eye in T",
        ),
    ],
)
def test_the_expected_fix_is_offered(text: str, code: str, label: str, tmp_path: Path) -> None:
    (tmp_path / "project.yaml").write_text(
        "vicode: 1\nproject: P\ncomponents:\n  Perception: {implementation: 'a:B', outputs: {ball: {type: bool}}}\n"
    )
    (tmp_path / "player.yaml").write_text(f"vicode: 1\ncomponent: Player\n{text}\n")
    assert label in _labels(open_project(tmp_path).project, code)


def _labels(project: Project, code: str) -> list[str]:
    return [
        fix.label
        for design in project.designs
        for finding in check_design(project, design)
        if finding.rule.code == code
        for fix in find_fixes(project, design, finding)
    ]


def _try_all(project: Project) -> Counter[str]:
    """Apply each fix of each finding separately; returns the number of fixes by rule."""
    count: Counter[str] = Counter()
    for design in project.designs:
        for finding in check_project(project):
            for fix in find_fixes(project, design, finding):
                count[finding.rule.code] += 1
                changed = fix.edit_project(project) if fix.edit_project else project
                _assert_resolves(project, changed, finding, fix.label, fix.edit(design))
    return count


def _assert_resolves(project: Project, changed: Project, finding: Finding, label: str, fixed: Design) -> None:
    subject = finding.subject
    designs = tuple(fixed if subject and other.component == subject.component else other for other in changed.designs)
    before, after = _counted(project), _counted(replace(changed, designs=designs))
    key = (finding.rule.code, finding.message)
    assert after[key] < before[key], f"{label} leaves {key}"
    errors = {key for key in after - before if RULES[key[0]].severity is Severity.ERROR}
    assert not errors, f"{label} for {key} brings {errors}"


def _counted(project: Project) -> Counter[tuple[str, str]]:
    return Counter((finding.rule.code, finding.message) for finding in check_project(project))


def _put_in(frame: str, text: str) -> str:
    own = set(re.findall(r"^(\w+):", text, re.MULTILINE))
    return "".join(match.group() for match in TOP_LEVEL_KEY.finditer(frame) if match.group(1) not in own) + text
