"""Quick fixes: for a finding whose mend is certain, the edits that make it vanish, each with a label."""

from collections import Counter
from collections.abc import Callable, Mapping

from vicode.check import check_design
from vicode.editor.session.fixes import code, decisions, declarations, expressions, names, states, uses
from vicode.editor.session.fixes.context import Fix, FixContext
from vicode.findings import RULES, Finding, Severity
from vicode.model.design import Design
from vicode.model.project import Project

__all__ = ["FIXERS", "UNFIXABLE", "Fix", "find_fixes", "is_fixable"]

FIXERS: Mapping[str, Callable[[FixContext], list[Fix]]] = {
    **code.FIXERS,
    **decisions.FIXERS,
    **declarations.FIXERS,
    **expressions.FIXERS,
    **names.FIXERS,
    **states.FIXERS,
    **uses.FIXERS,
}

_IN_THE_FILE = "the mistake is in the text of the file, which is mended there"
_IN_THE_PROJECT = "the mistake is in project.yaml, which no fix writes"
_ONLY_A_PERSON = "only a person knows what was meant"

UNFIXABLE: Mapping[str, str] = {
    **dict.fromkeys(("Y101", "Y102", "Y103", "Y104", "Y105", "Y106", "Y107", "Y108", "Y109", "Y110"), _IN_THE_FILE),
    **dict.fromkeys(("Y111", "Y112"), _IN_THE_FILE),
    **dict.fromkeys(("P203", "P207", "P208"), _IN_THE_PROJECT),
    "P201": "renaming a component is a change of other designs, too",
    **dict.fromkeys(("E301", "E302", "E304", "E305", "E308", "E309"), _ONLY_A_PERSON),
    "D407": "which of two things a name was meant for, only a person knows",
    "D408": "which component can do without the next, only a person knows",
    "D412": _ONLY_A_PERSON,
    "D414": "code is not translated by itself",
    **dict.fromkeys(("L701", "L702"), "how else it could be said for one language, only a person knows"),
    "L703": "a name in XABSL is what a robot's program has, too",
    "L704": _ONLY_A_PERSON,
    "D425": "where to step a component once, only a person knows",
    **dict.fromkeys(("G501", "G502", "G503"), "generated files are shown, and written, by Generate"),
}
"""Why there is no fix, for every rule without one."""


def is_fixable(finding: Finding) -> bool:
    """Whether it is worth asking for fixes; asking is what takes time."""
    return finding.rule.code in FIXERS and finding.subject is not None


def find_fixes(project: Project, design: Design, finding: Finding) -> tuple[Fix, ...]:
    """The certain mends of a finding about a design, the likeliest first; none where only a person can tell.

    Each was tried: the finding vanishes, and no error comes in its place.
    """
    fixer = FIXERS.get(finding.rule.code)
    thing = finding.subject
    if fixer is None or thing is None or thing.component != design.component:
        return ()
    proposed = fixer(FixContext(project=project, design=design, finding=finding, path=thing.path))
    before = _counted(project, design)
    key = _key(finding)
    return tuple(fix for fix in proposed if _resolves(key, before, _counted(project, fix.edit(design))))


Key = tuple[str, str]


def _key(finding: Finding) -> Key:
    # Without its place: a fix may move what stands behind it.
    return (finding.rule.code, finding.message)


def _counted(project: Project, design: Design) -> Counter[Key]:
    return Counter(map(_key, check_design(project, design)))


def _resolves(key: Key, before: Counter[Key], after: Counter[Key]) -> bool:
    new = after - before
    return after[key] < before[key] and not any(RULES[code].severity is Severity.ERROR for code, _message in new)
