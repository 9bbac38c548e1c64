"""Rules for designs of projects with XABSL as a target language."""

import re
from collections import Counter
from collections.abc import Iterator
from functools import partial

from vicode.check.context import RuleContext
from vicode.check.typed_expressions import ExpressionSite, TypedExpression
from vicode.findings import DesignPath, Finding
from vicode.languages import LANGUAGES
from vicode.model.constant_folding import evaluate_constants
from vicode.model.design import COMMON
from vicode.model.disabled import is_enabled
from vicode.model.names import is_valid_state_name
from vicode.model.traversal import is_exhaustive
from vicode.model.xabsl.expressible import ExpressibilityChecker, expanded_depth
from vicode.model.xabsl.names import component_name, symbol_name, unqualified_name
from vicode.model.xabsl.unsupported import find_unsupported_in_design, find_unsupported_in_root, is_done_expressible

LANGUAGE = "xabsl"
MAX_DEPTH = 1150
"""Maximum nesting of decisions and their guards that XABSL parsers accept."""

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_.]*\Z", re.ASCII)
_MAX_NAME_LENGTH = 99


def find_unsupported_features(context: RuleContext) -> Iterator[Finding]:
    """L701: features of a design that options do not support."""
    for limit in (
        *find_unsupported_in_design(context.project, context.design),
        *find_unsupported_in_root(context.project, context.design),
    ):
        yield context.make_finding(
            "L701", limit.path, limit.message, limit.fix, is_key=limit.is_key, languages=(LANGUAGE,)
        )


def find_unsupported_expressions(context: RuleContext) -> Iterator[Finding]:
    """L701, L702: expressions that XABSL does not support or evaluates differently."""
    constants, is_xabsl = evaluate_constants(context.project), context.design.arithmetic == LANGUAGE
    can_express_done = partial(is_done_expressible, context.project, context.design)
    for expression, state in _generated_expressions(context):
        if expression.tree is None or not expression.is_sound:
            continue
        is_done_allowed = partial(can_express_done, state) if state else _never
        checker = ExpressibilityChecker(
            has_xabsl_arithmetic=is_xabsl, constants=constants, is_done_expressible=is_done_allowed
        )
        for problem in checker.check(expression.tree):
            span = problem.node.span
            yield context.make_finding(
                problem.code, expression.path, problem.message, problem.fix, span=span, languages=(LANGUAGE,)
            )


def find_too_deep_decisions(context: RuleContext) -> Iterator[Finding]:
    """L701: decisions nested too deeply for XABSL parsers, which read each one in the `else` of the previous one."""
    counts = Counter(located.source for located in context.decisions)
    guards = {
        expression.path[:-1]: expanded_depth(expression.tree)
        for expression, _state in _generated_expressions(context)
        if expression.site == ExpressionSite.GUARD and expression.tree is not None
    }
    depths: Counter[str] = Counter()
    for located in context.decisions:
        groups = zip(_enclosing_group_paths(located.path, len(located.groups)), located.groups, strict=True)
        # A group that may fall through is combined with the conditions of its decisions.
        open_ = (path for path, (group, _is_then) in groups if not any(map(is_exhaustive, group.then)))
        depth = sum(guards.get(path, 0) for path in (located.path, *open_))
        depths[located.source] = max(depths[located.source], depth)
    for source, count in counts.items():
        total = count + (counts[COMMON] if source != COMMON else 0) + max(depths[source], depths[COMMON])
        if total > MAX_DEPTH:
            path: DesignPath = ("common", "transitions") if source == COMMON else ("states", source, "transitions")
            message = "XABSL nests each decision in the else of the previous one, and this nesting is too deep"
            fix = "move some decisions to a separate state or design"
            yield context.make_finding("L701", path, message, fix, languages=(LANGUAGE,))


def _enclosing_group_paths(path: DesignPath, count: int) -> Iterator[DesignPath]:
    """Return the paths of the enclosing groups, outermost first."""
    return (path[: len(path) - 2 * level] for level in range(count, 0, -1))


def find_bad_names(context: RuleContext) -> Iterator[Finding]:
    """L703: names that are invalid in XABSL, and duplicate names of states or parameters."""
    known: dict[tuple[str, str], DesignPath] = {}
    for kind, name, path, is_given in _iter_names(context):
        if path and not is_given and not is_valid_state_name(str(path[-1])):
            # The name is invalid in every language; D404 reports it.
            continue
        problem, fix = (
            validate_xabsl_name(name, is_explicit=is_given),
            f"set another name, such as xabsl_name: my_{name}",
        )
        if not problem and kind and known.setdefault((kind, name), path) is not path:
            problem = f"two {kind} would have the name '{name}' in XABSL"
        if problem:
            where = (*path, "xabsl_name") if is_given else path
            yield context.make_finding("L703", where, problem, fix, is_key=not is_given, languages=(LANGUAGE,))


def find_unreadable_code(context: RuleContext) -> Iterator[Finding]:
    """L704: invalid XABSL code."""
    # The XABSL parser is slow to import, and most projects have no XABSL code.
    from vicode.xabsl.embedded_code import parse_embedded_actions, parse_embedded_expression  # noqa: PLC0415

    for placed in context.code_blocks:
        text = placed.code.in_language(LANGUAGE)
        if text is None or placed.role not in ("action", "predicate"):
            continue
        embedded = parse_embedded_actions(text) if placed.role == "action" else parse_embedded_expression(text)
        for diagnostic in embedded.diagnostics:
            path = (*placed.path, LANGUAGE)
            yield context.make_finding(
                "L704", path, diagnostic.message, diagnostic.fix, span=diagnostic.span, languages=(LANGUAGE,)
            )


def validate_xabsl_name(name: str, *, is_explicit: bool) -> str:
    """Return the problem with a name in XABSL, empty if there is none. D406 reports keywords that are not explicit."""
    if not _NAME.match(name):
        return f"'{name}' is not a valid XABSL name: use letters, digits, '_' and '.', starting with a letter or '_'"
    if len(name) > _MAX_NAME_LENGTH:
        return f"XABSL engines truncate names to {_MAX_NAME_LENGTH} characters"
    return f"'{name}' is an XABSL keyword" if is_explicit and name in LANGUAGES[LANGUAGE].keywords else ""


def _never(_alias: str) -> bool:
    return False


def _generated_expressions(context: RuleContext) -> Iterator[tuple[TypedExpression, str]]:
    """Yield the expressions that appear in generated XABSL with the state, or COMMON, whose guard they belong to."""
    disabled = [decision.path for decision in context.decisions if not is_enabled(decision, context.disabled_states)]
    for expression in context.expressions:
        path = expression.path
        if expression.site == ExpressionSite.INITIAL_VALUE or (
            path[0] == "states" and path[1] in context.disabled_states
        ):
            continue
        if any(path[: len(prefix)] == prefix for prefix in disabled):
            continue
        is_guard = expression.site in (ExpressionSite.GUARD, ExpressionSite.AFTER)
        yield expression, (COMMON if path[0] == "common" else str(path[1])) if is_guard else ""


def _iter_names(context: RuleContext) -> Iterator[tuple[str, str, DesignPath, bool]]:
    """Yield namespace (empty: checked with the project), name, path and whether the name is explicit."""
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
