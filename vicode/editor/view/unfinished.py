"""What is being drawn: states that were added since the design was opened and have no transition yet.

Warnings about them are expected, and are shown in gray.
"""

from collections.abc import Collection

from vicode.findings import Finding, Severity
from vicode.model.design import Design


def unfinished_states(opened: Design, design: Design) -> frozenset[str]:
    known = {state.name for state in opened.states}
    return frozenset(state.name for state in design.states if state.name not in known and not state.transitions)


def is_unfinished(finding: Finding, states: Collection[str]) -> bool:
    """Whether a finding is only about what is not drawn yet; an error never is."""
    path = finding.subject.path if finding.subject is not None else ()
    return finding.severity is not Severity.ERROR and path[:1] == ("states",) and path[1:2] != () and path[1] in states
