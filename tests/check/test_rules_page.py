"""docs/rules.md: each rule has a section; violating examples report only that rule, fixed ones nothing."""

import re
from pathlib import Path

import pytest

from vicode.check import check_project
from vicode.check.behavior import find_behavior
from vicode.findings import RULES, Rule, render_text
from vicode.store import locate_findings, open_project
from vicode.xabsl.compiler import compile_source
from vicode.xabsl.source_loader import load_source

PAGE = Path(__file__).parents[2] / "docs" / "rules.md"
SECTION = re.compile(r"^### ([A-Z]\d{3})\n(.*?)(?=^##)", re.MULTILINE | re.DOTALL)
EXAMPLE = re.compile(r"^```(?:yaml|xabsl) ?(\S*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
TOP_LEVEL_KEY = re.compile(r"^(\w+):.*\n(?:[ \t#-].*\n)*", re.MULTILINE)

# Short texts cannot show these: sizes, bytes, Python files, values that only the editor can create, generated files,
# other languages.
WITHOUT_EXAMPLES = {
    "Y108",
    "Y110",
    "P212",
    "P215",
    "D416",
    "L705",
    "X611",
    "X612",
    "S801",
    "S802",
    "S803",
    "S804",
    "S805",
}
WITHOUT_EXAMPLES |= {f"G50{n}" for n in range(1, 7)}

TEXT = PAGE.read_text(encoding="utf-8")
SECTIONS = dict(SECTION.findall(TEXT + "\n##"))
FRAME = dict(EXAMPLE.findall(TEXT.split("\n## ")[0]))
LANGUAGES_FRAME = FRAME | dict(EXAMPLE.findall(TEXT.split("\n## L:")[1].split("\n### ")[0]))
XABSL_FRAME = dict(EXAMPLE.findall(TEXT.split("\n## X:")[1].split("\n### ")[0]))
# Rules that only `check --deep` runs.
DEEP = {"D435", "D436", "D437", "D441", "D442", "P214", "P215"}
_DEEP_WORDS = ", only with `vicode check --deep`"
# Examples are short: nothing reads, sets or uses some items that they or the frame declare.
ALLOWED_NOTES = {"X642", "X644", "D444", "D445"}
EXAMPLES = {code: EXAMPLE.findall(text) for code, text in SECTIONS.items()}


def test_every_rule_has_a_section_in_order() -> None:
    assert list(SECTIONS) == list(dict.fromkeys(re.findall(r"^### (\S+)$", TEXT, re.MULTILINE)))
    assert set(SECTIONS) == set(RULES)


@pytest.mark.parametrize("rule", RULES.values(), ids=lambda rule: rule.code)
def test_sections_start_with_name_and_severity(rule: Rule) -> None:
    assert SECTIONS[rule.code].startswith(
        f"**{rule.name}**, {rule.severity}{_DEEP_WORDS if rule.code in DEEP else ''}. "
    )


@pytest.mark.parametrize("code", sorted(set(RULES) - WITHOUT_EXAMPLES))
def test_the_first_example_violates_only_this_rule(code: str, tmp_path: Path) -> None:
    assert len(EXAMPLES[code]) == 2
    codes, shown = _check(code, *EXAMPLES[code][0], tmp_path)
    assert codes - (ALLOWED_NOTES - {code}) == {code}, shown


@pytest.mark.parametrize("code", sorted(set(RULES) - WITHOUT_EXAMPLES))
def test_the_fixed_example_has_no_findings(code: str, tmp_path: Path) -> None:
    codes, shown = _check(code, *EXAMPLES[code][1], tmp_path)
    assert not codes - (ALLOWED_NOTES - {code}), shown


@pytest.mark.parametrize("code", sorted(WITHOUT_EXAMPLES))
def test_rules_without_examples_are_listed(code: str) -> None:
    assert EXAMPLES[code] == []


def _check(code: str, file: str, text: str, folder: Path) -> tuple[set[str], str]:
    """Return the codes found in the page's project with an example inserted, and the rendered findings."""
    if file.endswith(".xabsl"):
        return _check_xabsl(file, text, folder)
    for name, frame in (LANGUAGES_FRAME if code.startswith("L") else FRAME).items():
        content = _insert(frame, text) if name == (file or "player.yaml") else frame
        (folder / name).write_text(content, encoding="utf-8")
    opened = open_project(folder)
    deep = find_behavior(opened.project) if code in DEEP else ()
    findings = locate_findings((*opened.findings, *check_project(opened.project), *deep), opened)
    return {finding.rule.code for finding in findings}, render_text(findings)


def _check_xabsl(file: str, text: str, folder: Path) -> tuple[set[str], str]:
    frame = dict(XABSL_FRAME)
    if file not in frame:
        frame["agents.xabsl"] = f'include "{file}";\n' + frame["agents.xabsl"]
    for name, content in {**frame, "notes.txt": "", file: text}.items():
        (folder / name).write_text(content, encoding="utf-8")
    findings = compile_source(load_source(folder / "agents.xabsl")).findings
    return {finding.rule.code for finding in findings}, render_text(findings)


def _insert(frame: str, text: str) -> str:
    """Replace top-level keys of the frame with those of the text."""
    own = set(re.findall(r"^(\w+):", text, re.MULTILINE))
    kept = [match.group() for match in TOP_LEVEL_KEY.finditer(frame) if match.group(1) not in own]
    return "".join(kept) + text
