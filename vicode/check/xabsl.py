"""Rules about what XABSL can say, for designs of projects with XABSL among their languages."""

import re
from collections import Counter
from collections.abc import Iterator
from functools import partial

from vicode.check.context import Context
from vicode.check.keywords import KEYWORDS
from vicode.check.readings import Expression, Place
from vicode.findings import Finding, Path
from vicode.model.constants import constant_values
from vicode.model.design import COMMON
from vicode.model.enabling import is_working
from vicode.model.names import is_state_name
from vicode.model.walks import always_holds
from vicode.model.xabsl.limits import can_ask_done, find_limits, find_root_limits
from vicode.model.xabsl.names import component_name, plain_name, symbol_name
from vicode.model.xabsl.sayable import Sayer, written_depth
from vicode.xabsl.pieces import read_actions, read_expression

LANGUAGE = "xabsl"
DEEPEST = 100
"""So deep, decisions and what they ask are nested together in what XABSL's parsers read without complaint."""

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_.]*\Z", re.ASCII)
_LONGEST = 99


def find_unsayable_things(context: Context) -> Iterator[Finding]:
    """L701: what an option has no place for."""
    if not _is_wanted(context):
        return
    for limit in (*find_limits(context.project, context.design), *find_root_limits(context.project, context.design)):
        yield context.find("L701", limit.path, limit.message, limit.mend, of_key=limit.of_key, languages=(LANGUAGE,))


def find_unsayable_expressions(context: Context) -> Iterator[Finding]:
    """L701, L702: expressions that cannot be said, or would give another result."""
    if not _is_wanted(context):
        return
    constants, is_xabsl = constant_values(context.project), context.design.arithmetic == LANGUAGE
    asking = partial(can_ask_done, context.project, context.design)
    for expression, state in _said_expressions(context):
        if expression.tree is None or not expression.is_sound:
            continue
        asks_done = partial(asking, state) if state else _never
        sayer = Sayer(is_xabsl=is_xabsl, constants=constants, asks_done=asks_done)
        for each in sayer.find(expression.tree):
            span = each.node.span
            yield context.find(each.code, expression.path, each.message, each.mend, span=span, languages=(LANGUAGE,))


def find_deep_decisions(context: Context) -> Iterator[Finding]:
    """L701: more decisions, one in the `else` of the other, than XABSL's parsers go down."""
    if not _is_wanted(context):
        return
    counts = Counter(located.source for located in context.decisions)
    guards = {
        expression.path[:-1]: written_depth(expression.tree)
        for expression, _state in _said_expressions(context)
        if expression.place == Place.GUARD and expression.tree is not None
    }
    depths: Counter[str] = Counter()
    for located in context.decisions:
        around = zip(_paths_around(located.path, len(located.groups)), located.groups, strict=True)
        # What does not end in a group is asked for together with what the group asks.
        open_ = (path for path, (group, _is_then) in around if not any(map(always_holds, group.then)))
        depth = sum(guards.get(path, 0) for path in (located.path, *open_))
        depths[located.source] = max(depths[located.source], depth)
    for source, count in counts.items():
        whole = count + (counts[COMMON] if source != COMMON else 0) + max(depths[source], depths[COMMON])
        if whole > DEEPEST:
            path: Path = ("common", "transitions") if source == COMMON else ("states", source, "transitions")
            message = "in XABSL each decision stands in the else of the one before it, and these are too deep"
            mend = "put part of them into a state, or a design, of their own"
            yield context.find("L701", path, message, mend, languages=(LANGUAGE,))


def _paths_around(path: Path, count: int) -> Iterator[Path]:
    """The paths of the groups around a decision, the outermost first."""
    return (path[: len(path) - 2 * level] for level in range(count, 0, -1))


def find_bad_names(context: Context) -> Iterator[Finding]:
    """L703: names that XABSL cannot have, and names of states or parameters that two would have."""
    if not _is_wanted(context):
        return
    known: dict[tuple[str, str], Path] = {}
    for kind, name, path, is_given in _names_of(context):
        if path and not is_given and not is_state_name(str(path[-1])):
            # The name itself is wrong in every language.
            continue
        problem, mend = name_problem(name, is_given=is_given), f"give it another: xabsl_name: my_{name}"
        if not problem and kind and known.setdefault((kind, name), path) is not path:
            problem = f"two {kind} would be called '{name}' in XABSL"
        if problem:
            where = (*path, "xabsl_name") if is_given else path
            yield context.find("L703", where, problem, mend, of_key=not is_given, languages=(LANGUAGE,))


def find_unreadable_code(context: Context) -> Iterator[Finding]:
    """L704: code that is not XABSL."""
    if not _is_wanted(context):
        return
    for placed in context.codes:
        text = placed.code.in_language(LANGUAGE)
        if text is None or placed.role not in ("action", "predicate"):
            continue
        piece = read_actions(text) if placed.role == "action" else read_expression(text)
        for mistake in piece.mistakes:
            path = (*placed.path, LANGUAGE)
            yield context.find("L704", path, mistake.message, mistake.mend, span=mistake.span, languages=(LANGUAGE,))


def name_problem(name: str, *, is_given: bool) -> str:
    """Why XABSL cannot have a name, empty when it can; words of the language were found if nobody gave it one."""
    if not _NAME.match(name):
        return f"'{name}' cannot be a name in XABSL: letters, digits, '_' and '.', a letter or '_' first"
    if len(name) > _LONGEST:
        return f"XABSL's engines cut names after {_LONGEST} characters"
    return f"'{name}' is a word of XABSL" if is_given and name in KEYWORDS[LANGUAGE] else ""


def _is_wanted(context: Context) -> bool:
    return LANGUAGE in context.project.languages


def _never(_alias: str) -> bool:
    return False


def _said_expressions(context: Context) -> Iterator[tuple[Expression, str]]:
    """What is said in XABSL: not first values, nor what is disabled. With the state (or COMMON) that decides by it."""
    silent = [each.path for each in context.decisions if not is_working(each, context.off)]
    for expression in context.expressions:
        path = expression.path
        if expression.place == Place.FIRST or (path[0] == "states" and path[1] in context.off):
            continue
        if any(path[: len(each)] == each for each in silent):
            continue
        is_guard = expression.place in (Place.GUARD, Place.TIME)
        yield expression, (COMMON if path[0] == "common" else str(path[1])) if is_guard else ""


def _names_of(context: Context) -> Iterator[tuple[str, str, Path, bool]]:
    """Names with what they must not share them with (empty: the project looks at that), and whether they were given."""
    design = context.design
    yield "", component_name(design), (), bool(design.xabsl_name)
    for section, declared in design.declarations():
        path: Path = (section, declared.name)
        if section == "parameters":
            yield "parameters", plain_name(declared), path, bool(declared.xabsl_name)
        elif declared.arguments is None:
            yield "", symbol_name(design.component, declared), path, bool(declared.xabsl_name)
    for state in design.states:
        if state.name not in context.off:
            yield "states", plain_name(state), ("states", state.name), bool(state.xabsl_name)


RULES = (
    find_unsayable_things,
    find_unsayable_expressions,
    find_deep_decisions,
    find_bad_names,
    find_unreadable_code,
)
