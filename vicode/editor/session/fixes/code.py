"""Mends of hand-written code: languages that do not exist, predicates that hold nothing."""

from dataclasses import replace

from vicode.editor.session.fixes.context import Fix, FixContext
from vicode.findings import DesignPath
from vicode.model.design import Code, Design, RunCode
from vicode.model.edits import remove_decisions, replace_action, replace_decision
from vicode.model.traversal import find_decision, iter_actions, iter_code


def fix_unknown_language(case: FixContext) -> list[Fix]:
    """P204, of code; in a project file it is mended there."""
    meant, wrong = case.suggested_name, str(case.path[-1])
    placed = next((each for each in iter_code(case.design) if each.path == case.path[:-1]), None)
    if placed is None or not meant or placed.code.in_language(meant) is not None:
        return []
    texts = tuple((meant if language == wrong else language, text) for language, text in placed.code.texts)
    code = Code(texts=texts)
    return [Fix(label=f"It is written in {meant}", edit=lambda old: _with_code(old, placed.path, code))]


def fix_empty_predicate(case: FixContext) -> list[Fix]:
    """D415: without its code a decision would always hold, which is said."""
    located = case.decision()
    if located is None:
        return []
    path, old = located.path, located.decision
    without = replace(old, guard=replace(old.guard, code=None))
    return [
        Fix(label="Remove the transition, which never holds", edit=lambda design: remove_decisions(design, [path])),
        Fix(label="Leave it without code", edit=lambda design: replace_decision(design, path, without)),
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
    action = next((each.action for each in iter_actions(design) if each.path == where), None)
    return replace_action(design, where, replace(action, code=code)) if isinstance(action, RunCode) else design


FIXERS = {"P204": fix_unknown_language, "D415": fix_empty_predicate}
