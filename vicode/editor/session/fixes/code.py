"""Fixes of hand-written code: unknown languages, empty predicates."""

from dataclasses import replace

from vicode.editor.session.fixes.context import Fix, FixContext
from vicode.findings import DesignPath
from vicode.model.design import Code, Design, RunCode
from vicode.model.edits import remove_decisions, replace_action, replace_decision
from vicode.model.traversal import find_decision, iter_actions, iter_code


def fix_unknown_language(case: FixContext) -> list[Fix]:
    """P204 in code; a project file is fixed by hand."""
    meant, wrong = case.finding.suggestion, str(case.path[-1])
    located = next((located for located in iter_code(case.design) if located.path == case.path[:-1]), None)
    if located is None or not meant or located.code.in_language(meant) is not None:
        return []
    texts = tuple((meant if language == wrong else language, text) for language, text in located.code.texts)
    code = Code(texts=texts)
    return [Fix(label=f"Change the language to {meant}", edit=lambda old: _with_code(old, located.path, code))]


def fix_empty_predicate(case: FixContext) -> list[Fix]:
    located = case.decision()
    if located is None:
        return []
    path, old = located.path, located.decision
    without = replace(old, guard=replace(old.guard, code=None))
    return [
        Fix(label="Remove the transition", edit=lambda design: remove_decisions(design, [path])),
        Fix(label="Remove the empty code", edit=lambda design: replace_decision(design, path, without)),
    ]


def _with_code(design: Design, path: DesignPath, code: Code) -> Design:
    if path == ("module",):
        return replace(design, module=code)
    if path == ("members",):
        return replace(design, members=code)
    where = path[:-1]
    located = find_decision(design, where)
    if located is not None:
        guard = replace(located.decision.guard, code=code)
        return replace_decision(design, where, replace(located.decision, guard=guard))
    action = next((located.action for located in iter_actions(design) if located.path == where), None)
    return replace_action(design, where, replace(action, code=code)) if isinstance(action, RunCode) else design


FIXERS = {"P204": fix_unknown_language, "D415": fix_empty_predicate}
