"""Rules about what XABSL can say, for designs of projects with XABSL among their languages."""

import re
from collections import Counter
from collections.abc import Iterator
from functools import partial

from vicode.check.context import RuleContext
from vicode.check.keywords import KEYWORDS
from vicode.check.typed_expressions import ExpressionSite, TypedExpression
from vicode.findings import DesignPath, Finding
from vicode.model.constant_folding import evaluate_constants
from vicode.model.design import COMMON
from vicode.model.disabled import is_enabled
from vicode.model.names import is_valid_state_name
from vicode.model.traversal import is_exhaustive
from vicode.model.xabsl.expressible import ExpressibilityChecker, expanded_depth
from vicode.model.xabsl.names import component_name, symbol_name, unqualified_name
from vicode.model.xabsl.unsupported import find_unsupported_in_design, find_unsupported_in_root, is_done_expressible
from vicode.xabsl.embedded_code import parse_embedded_actions, parse_embedded_expression

LANGUAGE = "xabsl"
MAX_DEPTH = 100
"""So deep, decisions and what they ask are nested together in what XABSL's parsers read without complaint."""

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_.]*\Z", re.ASCII)
_MAX_NAME_LENGTH = 99


def find_unsupported_features(context: RuleContext) -> Iterator[Finding]:
    """L701: what an option has no place for."""
    if not _is_xabsl_project(context):
        return
    for limit in (
        *find_unsupported_in_design(context.project, context.design),
        *find_unsupported_in_root(context.project, context.design),
    ):
        yield context.make_finding(
            "L701", limit.path, limit.message, limit.fix, is_key=limit.is_key, languages=(LANGUAGE,)
        )


def find_unsupported_expressions(context: RuleContext) -> Iterator[Finding]:
    """L701, L702: expressions that cannot be said, or would give another result."""
    if not _is_xabsl_project(context):
        return
    constants, is_xabsl = evaluate_constants(context.project), context.design.arithmetic == LANGUAGE
    asking = partial(is_done_expressible, context.project, context.design)
    for expression, state in _generated_expressions(context):
        if expression.tree is None or not expression.is_sound:
            continue
        asks_done = partial(asking, state) if state else _never
        sayer = ExpressibilityChecker(has_xabsl_arithmetic=is_xabsl, constants=constants, is_done_expressible=asks_done)
        for each in sayer.check(expression.tree):
            span = each.node.span
            yield context.make_finding(
                each.code, expression.path, each.message, each.fix, span=span, languages=(LANGUAGE,)
            )


def find_too_deep_decisions(context: RuleContext) -> Iterator[Finding]:
    """L701: more decisions, one in the `else` of the other, than XABSL's parsers go down."""
    if not _is_xabsl_project(context):
        return
    counts = Counter(located.source for located in context.decisions)
    guards = {
        expression.path[:-1]: expanded_depth(expression.tree)
        for expression, _state in _generated_expressions(context)
        if expression.site == ExpressionSite.GUARD and expression.tree is not None
    }
    depths: Counter[str] = Counter()
    for located in context.decisions:
        around = zip(_enclosing_group_paths(located.path, len(located.groups)), located.groups, strict=True)
        # What does not end in a group is asked for together with what the group asks.
        open_ = (path for path, (group, _is_then) in around if not any(map(is_exhaustive, group.then)))
        depth = sum(guards.get(path, 0) for path in (located.path, *open_))
        depths[located.source] = max(depths[located.source], depth)
    for source, count in counts.items():
        whole = count + (counts[COMMON] if source != COMMON else 0) + max(depths[source], depths[COMMON])
        if whole > MAX_DEPTH:
            path: DesignPath = ("common", "transitions") if source == COMMON else ("states", source, "transitions")
            message = "in XABSL each decision stands in the else of the one before it, and these are too deep"
            mend = "put part of them into a state, or a design, of their own"
            yield context.make_finding("L701", path, message, mend, languages=(LANGUAGE,))


def _enclosing_group_paths(path: DesignPath, count: int) -> Iterator[DesignPath]:
    """The paths of the groups around a decision, the outermost first."""
    return (path[: len(path) - 2 * level] for level in range(count, 0, -1))


def find_bad_names(context: RuleContext) -> Iterator[Finding]:
    """L703: names that XABSL cannot have, and names of states or parameters that two would have."""
    if not _is_xabsl_project(context):
        return
    known: dict[tuple[str, str], DesignPath] = {}
    for kind, name, path, is_given in _iter_names(context):
        if path and not is_given and not is_valid_state_name(str(path[-1])):
            # The name itself is wrong in every language.
            continue
        problem, mend = validate_xabsl_name(name, is_explicit=is_given), f"give it another: xabsl_name: my_{name}"
        if not problem and kind and known.setdefault((kind, name), path) is not path:
            problem = f"two {kind} would be called '{name}' in XABSL"
        if problem:
            where = (*path, "xabsl_name") if is_given else path
            yield context.make_finding("L703", where, problem, mend, is_key=not is_given, languages=(LANGUAGE,))


def find_unreadable_code(context: RuleContext) -> Iterator[Finding]:
    """L704: code that is not XABSL."""
    if not _is_xabsl_project(context):
        return
    for placed in context.code_blocks:
        text = placed.code.in_language(LANGUAGE)
        if text is None or placed.role not in ("action", "predicate"):
            continue
        piece = parse_embedded_actions(text) if placed.role == "action" else parse_embedded_expression(text)
        for mistake in piece.diagnostics:
            path = (*placed.path, LANGUAGE)
            yield context.make_finding(
                "L704", path, mistake.message, mistake.fix, span=mistake.span, languages=(LANGUAGE,)
            )


def validate_xabsl_name(name: str, *, is_explicit: bool) -> str:
    """Why XABSL cannot have a name, empty when it can; words of the language were found if nobody gave it one."""
    if not _NAME.match(name):
        return f"'{name}' cannot be a name in XABSL: letters, digits, '_' and '.', a letter or '_' first"
    if len(name) > _MAX_NAME_LENGTH:
        return f"XABSL's engines cut names after {_MAX_NAME_LENGTH} characters"
    return f"'{name}' is a word of XABSL" if is_explicit and name in KEYWORDS[LANGUAGE] else ""


def _is_xabsl_project(context: RuleContext) -> bool:
    return LANGUAGE in context.project.languages


def _never(_alias: str) -> bool:
    return False


def _generated_expressions(context: RuleContext) -> Iterator[tuple[TypedExpression, str]]:
    """What is said in XABSL: not first values, nor what is disabled. With the state (or COMMON) that decides by it."""
    silent = [each.path for each in context.decisions if not is_enabled(each, context.disabled_states)]
    for expression in context.expressions:
        path = expression.path
        if expression.site == ExpressionSite.INITIAL_VALUE or (
            path[0] == "states" and path[1] in context.disabled_states
        ):
            continue
        if any(path[: len(each)] == each for each in silent):
            continue
        is_guard = expression.site in (ExpressionSite.GUARD, ExpressionSite.AFTER)
        yield expression, (COMMON if path[0] == "common" else str(path[1])) if is_guard else ""


def _iter_names(context: RuleContext) -> Iterator[tuple[str, str, DesignPath, bool]]:
    """Names with what they must not share them with (empty: the project looks at that), and whether they were given."""
    design = context.design
    yield "", component_name(design), (), bool(design.xabsl_name)
    for section, declared in design.declarations():
        path: DesignPath = (section, declared.name)
        if section == "parameters":
            yield "parameters", unqualified_name(declared), path, bool(declared.xabsl_name)
        elif declared.arguments is None:
            yield "", symbol_name(design.component, declared), path, bool(declared.xabsl_name)
    for state in design.states:
        if state.name not in context.disabled_states:
            yield "states", unqualified_name(state), ("states", state.name), bool(state.xabsl_name)


RULES = (
    find_unsupported_features,
    find_unsupported_expressions,
    find_too_deep_decisions,
    find_bad_names,
    find_unreadable_code,
)
