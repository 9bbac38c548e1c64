"""Messages at the fields of a form: findings, lint warnings, and who else types there."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Any

from vicode.editor.session.code_marks import CodeMark, mark_text
from vicode.editor.session.fixes import is_fixable
from vicode.editor.session.forms.nodes import Choice, CodeText, Languages, Node, TextField
from vicode.editor.session.lint import LintWarning
from vicode.findings import DesignPath, Finding

_GUARD_PARTS = ("when", "after", "code")

Lint = Callable[[DesignPath, str], Sequence[LintWarning]]
"""The warnings for the Python code at a path, if they belong to this text."""


def marks_of(
    nodes: Iterable[Node], item: DesignPath, findings: Sequence[Finding], lint: Lint = lambda _path, _text: ()
) -> list[dict[str, Any]]:
    """The messages of a form as {"path", "start", "end", "severity", "message", "line", "fix"}.

    `fix` is the index of a finding with quick fixes, else None.
    """
    own = [each for each in findings if each.subject is not None and each.subject.path[: len(item)] == item]
    return [_mark_json(node.path, mark, findings) for node in _fields(nodes) for mark in _marks(node, item, own, lint)]


def finding_path(item: DesignPath, path: DesignPath) -> DesignPath:
    """The path in the file of a field: the parts of a guard stand among those of its decision."""
    return (*item, *(step for step in path if step != "guard"))


def field_path(item: DesignPath, path: DesignPath) -> DesignPath:
    """The path of a field in the form of an item, from its path in the file."""
    rest = path[len(item) :]
    is_decision = item[-2:-1] != ("states",)
    return ("guard", *rest) if is_decision and rest[0] in _GUARD_PARTS else rest


def note_at(path: DesignPath, text: str) -> dict[str, Any]:
    """A message at a field that is not about its text."""
    mark = CodeMark(start=0, end=0, severity="info", message=text, line=1)
    return _mark_json(path, mark, ())


def _fields(nodes: Iterable[Node]) -> Iterator[TextField | CodeText | Choice]:
    for node in nodes:
        if isinstance(node, TextField | CodeText | Choice):
            yield node
        elif isinstance(node, Languages):
            yield from node.texts


def _marks(
    node: TextField | CodeText | Choice, item: DesignPath, findings: Sequence[Finding], lint: Lint
) -> Iterable[CodeMark]:
    path = finding_path(item, node.path)
    if not isinstance(node, CodeText) or node.language == "expression":
        return mark_text(node.value, path, findings)
    if node.language == "python":
        # Findings about a code that is not named by language are about the Python text.
        return mark_text(node.value, path[:-1] if path[-2:-1] == ("code",) else path, findings, lint(path, node.value))
    missing = [
        replace(each, subject=replace(each.subject, path=path))
        for each in findings
        if each.rule.code == "D414"
        and node.language in each.languages
        and each.subject
        and each.subject.path == path[:-1]
    ]
    return mark_text(node.value, path, (*findings, *missing))


def _mark_json(path: DesignPath, mark: CodeMark, findings: Sequence[Finding]) -> dict[str, Any]:
    fix = (
        findings.index(mark.finding) if mark.finding in findings and mark.finding and is_fixable(mark.finding) else None
    )
    return {
        "path": "/".join(map(str, path)),
        "start": mark.start,
        "end": mark.end,
        "severity": mark.severity,
        "message": mark.message,
        "line": mark.line,
        "fix": fix,
    }
