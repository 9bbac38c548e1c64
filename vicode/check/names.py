"""Rules about names: what they look like, words that are taken, one name or id for two things."""

from collections.abc import Iterable, Iterator

from vicode.check.context import Context
from vicode.check.named import Named, keyword_languages, name_problem, names_for_designs, names_of_design, with_article
from vicode.findings import Finding, Note, Path, Thing
from vicode.model.design import RunCode
from vicode.model.names import is_state_name


def find_bad_names(context: Context) -> Iterator[Finding]:
    """D404 to D407: names that cannot be used, whatever else is declared."""
    for named in names_of_design(context.design):
        problem = name_problem(named, context.project.languages)
        if problem:
            code, message, mend = problem
            languages = keyword_languages(named, context.project.languages) if code == "D406" else ()
            yield context.find(code, named.path, message, mend, of_key=named.of_key, languages=languages)


def find_duplicate_names(context: Context) -> Iterator[Finding]:
    """D407: one name for two things that expressions could confuse, or for two states."""
    shared = [each for each in names_for_designs(context.project) if each.is_shared]
    known = {each.name: (each, "") for each in reversed(shared)}
    own = list(names_of_design(context.design))
    yield from _find_repeated(context, (each for each in own if each.is_shared), known)
    yield from _find_repeated(context, (each for each in own if each.what == "state"), {})


def _find_repeated(context: Context, names: Iterable[Named], known: dict[str, tuple[Named, str]]) -> Iterator[Finding]:
    for named in names:
        first, component = known.setdefault(named.name, (named, context.design.component))
        if first is not named:
            where = "" if component else " in project.yaml"
            message = f"'{named.name}' is already the name of {with_article(first.what)}{where}"
            note = Note(message="first declared here", thing=Thing(component=component, path=first.path, of_key=True))
            yield context.find("D407", named.path, message, "rename one of them", of_key=True, notes=[note])


def find_bad_ids(context: Context) -> Iterator[Finding]:
    """D404, D413: ids that are no names, or given to two things."""
    known: dict[str, Path] = {}
    for id_, path in _ids(context):
        here = (*path, "id")
        if not is_state_name(id_.replace("-", "_")):
            yield context.find("D404", here, f"'{id_}' cannot be an id", "use letters, digits, '_' and '-'")
        elif id_ in known:
            note = Note(message="first given here", thing=context.thing(known[id_]))
            yield context.find("D413", here, f"the id '{id_}' is given twice", "change or delete one", notes=[note])
        known.setdefault(id_, here)


def _ids(context: Context) -> Iterator[tuple[str, Path]]:
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
