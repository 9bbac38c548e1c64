"""Rules for names and ids: form, reserved words, duplicates."""

from collections.abc import Iterable, Iterator

from vicode.check.context import RuleContext
from vicode.check.identifiers import (
    Identifier,
    iter_design_identifiers,
    iter_expression_identifiers,
    keyword_languages,
    validate_identifier,
    with_article,
)
from vicode.findings import DesignPath, Finding, FindingSubject, Note
from vicode.model.design import RunCode
from vicode.model.names import is_valid_state_name


def find_bad_names(context: RuleContext) -> Iterator[Finding]:
    """D404 to D407: names that are invalid regardless of other declarations."""
    for named in iter_design_identifiers(context.design):
        problem = validate_identifier(named, context.project.languages)
        if problem:
            code, message, fix = problem
            languages = keyword_languages(named, context.project.languages) if code == "D406" else ()
            yield context.make_finding(code, named.path, message, fix, is_key=named.is_key, languages=languages)


def find_duplicate_names(context: RuleContext) -> Iterator[Finding]:
    """D407: a name that is ambiguous in expressions, or two states with one name."""
    shared = [each for each in iter_expression_identifiers(context.project) if each.is_expression_name]
    known = {each.name: (each, "") for each in reversed(shared)}
    own = list(iter_design_identifiers(context.design))
    yield from _find_repeated(context, (each for each in own if each.is_expression_name), known)
    yield from _find_repeated(context, (each for each in own if each.kind == "state"), {})


def _find_repeated(
    context: RuleContext, names: Iterable[Identifier], known: dict[str, tuple[Identifier, str]]
) -> Iterator[Finding]:
    for named in names:
        first, component = known.setdefault(named.name, (named, context.design.component))
        if first is not named:
            where = "" if component else " in project.yaml"
            message = f"'{named.name}' is already the name of {with_article(first.kind)}{where}"
            note = Note(
                message="first declared here", subject=FindingSubject(component=component, path=first.path, is_key=True)
            )
            yield context.make_finding("D407", named.path, message, "rename one of them", is_key=True, notes=[note])


def find_bad_ids(context: RuleContext) -> Iterator[Finding]:
    """D404, D413: invalid and duplicate ids."""
    known: dict[str, DesignPath] = {}
    for id_, path in _ids(context):
        here = (*path, "id")
        if not is_valid_state_name(id_.replace("-", "_")):
            yield context.make_finding(
                "D404", here, f"'{id_}' is not a valid id", "use ASCII letters, digits, '_' and '-'"
            )
        elif id_ in known:
            note = Note(message="first used here", subject=context.make_subject(known[id_]))
            yield context.make_finding(
                "D413", here, f"duplicate id '{id_}'", "change or delete one of them", notes=[note]
            )
        known.setdefault(id_, here)


def _ids(context: RuleContext) -> Iterator[tuple[str, DesignPath]]:
    for state in context.design.states:
        if state.id:
            yield state.id, ("states", state.name)
    for located in context.decisions:
        if located.decision.id:
            yield located.decision.id, located.path
    for placed in context.actions:
        if isinstance(placed.action, RunCode) and placed.action.id:
            yield placed.action.id, placed.path


RULES = (find_bad_names, find_duplicate_names, find_bad_ids)
