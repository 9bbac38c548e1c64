"""docs/rules.md keeps its word: a section a rule, bad examples with just that finding, mended ones with none."""

import re
from pathlib import Path

import pytest

from vicode.check import check_project
from vicode.findings import RULES, Rule, render_text
from vicode.store import locate_findings, open_project
from vicode.xabsl.compiler import compile_source
from vicode.xabsl.source_loader import load_source

PAGE = Path(__file__).parents[2] / "docs" / "rules.md"
SECTION = re.compile(r"^### ([A-Z]\d{3})\n(.*?)(?=^##)", re.MULTILINE | re.DOTALL)
EXAMPLE = re.compile(r"^```(?:yaml|xabsl) ?(\S*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
TOP_LEVEL_KEY = re.compile(r"^(\w+):.*\n(?:[ \t#-].*\n)*", re.MULTILINE)

# What no text of a few lines can show: sizes, bytes, values that only an editor can hold, generated files.
WITHOUT_EXAMPLES = {"Y108", "Y110", "D416", "G501", "G502", "G503"}

TEXT = PAGE.read_text(encoding="utf-8")
SECTIONS = dict(SECTION.findall(TEXT + "\n##"))
FRAME = dict(EXAMPLE.findall(TEXT.split("\n## ")[0]))
LANGUAGES_FRAME = FRAME | dict(EXAMPLE.findall(TEXT.split("\n## L:")[1].split("\n### ")[0]))
XABSL_FRAME = dict(EXAMPLE.findall(TEXT.split("\n## X:")[1].split("\n### ")[0]))
# Frames are larger than examples: what they declare and give is not all used where an example replaces a file.
REMARKS = {"X642", "X644"}
EXAMPLES = {code: EXAMPLE.findall(text) for code, text in SECTIONS.items()}


def test_every_rule_has_a_section_in_order() -> None:
    assert list(SECTIONS) == list(dict.fromkeys(re.findall(r"^### (\S+)$", TEXT, re.MULTILINE)))
    assert set(SECTIONS) == set(RULES)


@pytest.mark.parametrize("rule", RULES.values(), ids=lambda rule: rule.code)
def test_a_section_begins_with_name_and_severity(rule: Rule) -> None:
    assert SECTIONS[rule.code].startswith(f"**{rule.name}**, {rule.severity}. ")


@pytest.mark.parametrize("code", sorted(set(RULES) - WITHOUT_EXAMPLES))
def test_the_bad_example_breaks_just_this_rule(code: str, tmp_path: Path) -> None:
    assert len(EXAMPLES[code]) == 2
    codes, shown = _check(code, *EXAMPLES[code][0], tmp_path)
    assert codes - (REMARKS - {code}) == {code}, shown


@pytest.mark.parametrize("code", sorted(set(RULES) - WITHOUT_EXAMPLES))
def test_the_mended_example_is_clean(code: str, tmp_path: Path) -> None:
    codes, shown = _check(code, *EXAMPLES[code][1], tmp_path)
    assert not codes - (REMARKS - {code}), shown


@pytest.mark.parametrize("code", sorted(WITHOUT_EXAMPLES))
def test_what_has_no_example_says_what_to_do(code: str) -> None:
    assert EXAMPLES[code] == []


def _check(code: str, file: str, text: str, folder: Path) -> tuple[set[str], str]:
    """The codes found in the page's project with an example put in, and the findings as text."""
    if file.endswith(".xabsl"):
        return _check_xabsl(file, text, folder)
    for name, frame in (LANGUAGES_FRAME if code.startswith("L") else FRAME).items():
        content = _put_in(frame, text) if name == (file or "player.yaml") else frame
        (folder / name).write_text(content, encoding="utf-8")
    opened = open_project(folder)
    findings = locate_findings((*opened.findings, *check_project(opened.project)), opened)
    return {finding.rule.code for finding in findings}, render_text(findings)


def _check_xabsl(file: str, text: str, folder: Path) -> tuple[set[str], str]:
    frame = dict(XABSL_FRAME)
    if file not in frame:
        frame["agents.xabsl"] = f'include "{file}";\n' + frame["agents.xabsl"]
    for name, content in {**frame, "notes.txt": "", file: text}.items():
        (folder / name).write_text(content, encoding="utf-8")
    findings = compile_source(load_source(folder / "agents.xabsl")).findings
    return {finding.rule.code for finding in findings}, render_text(findings)


def _put_in(frame: str, text: str) -> str:
    """The frame's lines but those of the keys that the text brings itself, then the text."""
    own = set(re.findall(r"^(\w+):", text, re.MULTILINE))
    kept = [match.group() for match in TOP_LEVEL_KEY.finditer(frame) if match.group(1) not in own]
    return "".join(kept) + text
