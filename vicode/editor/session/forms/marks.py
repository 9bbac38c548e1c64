"""Messages at the fields of a form: findings, lint warnings, and who else types there."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from vicode.editor.session.code.code_marks import CodeMark, mark_assignments, mark_text
from vicode.editor.session.fixes import is_fixable
from vicode.editor.session.forms.construct_form import construct_parts
from vicode.editor.session.forms.form_data import item_form
from vicode.editor.session.forms.form_paths import file_path, item_path, resolve
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.session.forms.nodes import CodeText, Field, ItemName, MultiChoice, Node, iter_fields
from vicode.editor.session.forms.project_places import project_fields
from vicode.editor.view import ItemRef
from vicode.findings import DesignPath, Finding
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.services.lint import LintWarning

_CODES: tuple[DesignPath, ...] = (("code",), ("module",), ("members",))
Lint = Callable[[DesignPath, str], Sequence[LintWarning]]
"""The warnings for the Python code at a path, if they belong to this text."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ItemFields:
    """The fields of an item's form, and the paths in the file by their paths in the browser."""

    item: DesignPath
    nodes: tuple[Node, ...]
    paths: Mapping[DesignPath, DesignPath]

    @classmethod
    def of(cls, project: Project, design: Design, item: ItemRef, ids: ListIds) -> "ItemFields":
        nodes, path = item_form(project, design, item, ids), item_path(item) or ()
        if not path:
            nodes += tuple(node for part in construct_parts(project, design, ids).values() for node in part)
        own = [node for node in iter_fields(nodes) if node.path[:1] != ("project",)]
        # Parts that several forms show have the paths of the design's form.
        steps = {node.path: node.path[1:] if node.path[:1] == ("design",) else node.path for node in own}
        found = {known: resolve(design, ids, path, inner) for known, inner in steps.items()}
        paths = {known: file_path(design, path, steps) for known, steps in found.items() if steps is not None}
        return cls(item=path, nodes=nodes, paths=paths)


def marks_of(
    fields: ItemFields, findings: Sequence[Finding], lint: Lint = lambda _path, _text: ()
) -> list[dict[str, Any]]:
    """The messages of a form as {"path", "start", "end", "severity", "message", "line", "fix"}.

    `fix` is the index of a finding with quick fixes, else None.
    """
    item = fields.item
    own = [each for each in findings if each.subject is not None and each.subject.path[: len(item)] == item]
    return [
        _mark_json(node.path, mark, findings)
        for node in iter_fields(fields.nodes)
        if node.path in fields.paths
        for mark in _marks(node, fields.paths[node.path], own, lint)
    ]


def project_marks(project: Project, ids: ListIds, findings: Sequence[Finding]) -> list[dict[str, Any]]:
    """The messages of the forms of project.yaml."""
    if not findings:
        return []
    return [
        _mark_json(node.path, mark, ())
        for node, path in project_fields(project, ids)
        for mark in mark_text("", path, findings)
    ]


def note_at(path: DesignPath, text: str) -> dict[str, Any]:
    """A message at a field that is not about its text."""
    mark = CodeMark(start=0, end=0, severity="info", message=text, line=1)
    return _mark_json(path, mark, ())


def _marks(node: Field, path: DesignPath, findings: Sequence[Finding], lint: Lint) -> Iterable[CodeMark]:
    if isinstance(node, ItemName) and node.path[:1] == ("design",):
        # Conditions of constructs have fields of their own.
        findings = [each for each in findings if each.subject is not None and each.subject.path == path]
    if isinstance(node, MultiChoice):
        return mark_text(", ".join(node.value), path, findings)
    if isinstance(node, CodeText) and node.language == "pairs":
        # Findings about the call itself have no field of their own.
        owners = (path, (*path[:-1], "call"))
        calls = [each for each in findings if each.subject is not None and each.subject.path in owners]
        marks = [mark for owner in owners for mark in mark_text(node.value, owner, calls)]
        return (*marks, *mark_assignments(node.value, path, findings))
    if not isinstance(node, CodeText) or node.language == "expression":
        return mark_text(node.value, path, findings)
    if node.language == "python":
        # Findings about a code that is not named by language are about the Python text.
        return mark_text(node.value, path[:-1] if path[-2:-1] in _CODES else path, findings, lint(path, node.value))
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
