"""Quick fixes: edits that resolve a finding, each with a label."""

from collections import Counter
from collections.abc import Callable, Mapping

from vicode.check import check_design, check_file
from vicode.editor.session.fixes import code, decisions, declarations, invalid_names, states, unknown_names, uses
from vicode.editor.session.fixes.context import Fix, FixContext
from vicode.findings import RULES, Finding, Severity
from vicode.model.design import Design
from vicode.model.project import Project

__all__ = ["FIXERS", "UNFIXABLE", "Fix", "find_fixes", "is_fixable"]

FIXERS: Mapping[str, Callable[[FixContext], list[Fix]]] = {
    **code.FIXERS,
    **decisions.FIXERS,
    **declarations.FIXERS,
    **unknown_names.FIXERS,
    **invalid_names.FIXERS,
    **states.FIXERS,
    **uses.FIXERS,
}

_DESIGN_FILE = "the error is in the text of the file"
_PROJECT_FILE = "the error is in project.yaml, which quick fixes do not change"
_AMBIGUOUS = "the intended meaning is not certain"

UNFIXABLE: Mapping[str, str] = {
    **dict.fromkeys(("Y101", "Y102", "Y103", "Y104", "Y105", "Y106", "Y107", "Y108", "Y109", "Y110"), _DESIGN_FILE),
    **dict.fromkeys(("Y111", "Y112", "Y113"), _DESIGN_FILE),
    **dict.fromkeys(("P203", "P207", "P208", "P209", "P210", "P211", "P212", "P213", "P216"), _PROJECT_FILE),
    "P201": "renaming a component also changes other designs",
    **dict.fromkeys(("E301", "E302", "E304", "E305", "E308", "E309"), _AMBIGUOUS),
    "D407": "which of the two declarations to rename is not certain",
    "D408": "which use in the cycle to remove is not certain",
    "D412": _AMBIGUOUS,
    "D414": "code cannot be translated automatically",
    **dict.fromkeys(("L701", "L702", "L705"), "there is no general replacement in the language"),
    "L703": "the robot program also uses the XABSL name",
    "L704": _AMBIGUOUS,
    "D432": "whether to rename the state or the method is not certain",
    "D425": "where to step the component is not certain",
    "D435": "which of the guards to change is not certain",
    **dict.fromkeys(("P214", "D440", "D441", "D442", "D443", "D444", "D445", "D446"), _AMBIGUOUS),
    **dict.fromkeys(("D447", "D448", "D449", "D450", "D451"), _AMBIGUOUS),
    "P215": "there is nothing wrong in the designs",
    **dict.fromkeys(("D436", "D437"), "which robot should act differently is not certain"),
    **dict.fromkeys(("G501", "G502", "G503", "G504", "G505", "G506"), "Generate shows and writes generated files"),
}
"""The reason for every rule without a quick fix."""


def is_fixable(finding: Finding) -> bool:
    """Whether a finding may have fixes; unlike `find_fixes` this is fast."""
    return finding.rule.code in FIXERS and finding.subject is not None


def find_fixes(project: Project, design: Design, finding: Finding) -> tuple[Fix, ...]:
    """The quick fixes of a finding, the most likely first; empty if the intended meaning is not certain.

    Each fix is verified: it resolves the finding and introduces no error.
    """
    fixer = FIXERS.get(finding.rule.code)
    subject = finding.subject
    if fixer is None or subject is None or subject.component != design.component:
        return ()
    proposed = fixer(FixContext(project=project, design=design, finding=finding, path=subject.path))
    before = _count_findings(project, design)
    key = _key(finding)
    return tuple(fix for fix in proposed if _resolves(key, before, _count_findings_after(project, design, fix)))


Key = tuple[str, str]


def _key(finding: Finding) -> Key:
    # Without the path, which a fix may shift for later findings.
    return (finding.rule.code, finding.message)


def _count_findings(project: Project, design: Design) -> Counter[Key]:
    return Counter(map(_key, check_design(project, design)))


def _count_findings_after(project: Project, design: Design, fix: Fix) -> Counter[Key]:
    fixed = fix.edit(design)
    if fix.edit_project is None:
        return _count_findings(project, fixed)
    changed = fix.edit_project(project)
    return (
        _count_findings(changed, fixed)
        + Counter(map(_key, check_file(changed)))
        - Counter(map(_key, check_file(project)))
    )


def _resolves(key: Key, before: Counter[Key], after: Counter[Key]) -> bool:
    new = after - before
    return after[key] < before[key] and not any(RULES[code].severity is Severity.ERROR for code, _message in new)
