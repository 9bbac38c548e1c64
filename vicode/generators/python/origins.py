"""Map the lines of a generated module to states, transitions and code.

The plan determines names and order: methods are named after their states, and the outcomes in a method are in the order
of the decisions.
"""

import ast
from collections.abc import Iterable, Iterator, Sequence

from vicode import regions
from vicode.findings import DesignPath
from vicode.generators.origins import Origin, leaf_paths
from vicode.generators.plan import Branch, CodeCondition, ComponentPlan, DecisionPlan
from vicode.model.python_parser import parse_module

_OUTCOMES = ("_change_to", "_stay")
_COMMON: DesignPath = ("common", "transitions")


def find_origins(plan: ComponentPlan, text: str) -> tuple[Origin, ...]:
    """Return the origins, outer before inner; empty if the text is not a module."""
    try:
        tree = parse_module(text)
    except SyntaxError:
        return ()
    lines = text.split("\n")
    classes = [node for node in tree.body if isinstance(node, ast.ClassDef)]
    methods = [node for definition in classes for node in definition.body if isinstance(node, ast.FunctionDef)]
    origins = [*_section_origins(text), *_state_origins(plan, methods, lines), *_method_origins(plan, methods, lines)]
    return tuple(sorted(origins, key=lambda origin: (origin.first, -origin.last)))


def _section_origins(text: str) -> Iterator[Origin]:
    for region in regions.find_regions(text).regions:
        if region.id in ("module", "members"):
            yield Origin(first=region.line, last=region.end_line, path=(region.id,))


def _state_origins(plan: ComponentPlan, methods: Sequence[ast.FunctionDef], lines: Sequence[str]) -> Iterator[Origin]:
    """Yield the lines of each state, from its first method to the last one before the next state."""
    by_name = {f"_in_{state.stem}": state.name for state in plan.states}
    starts = [index for index, method in enumerate(methods) if method.name in by_name]
    for start, end in zip(starts, [*starts[1:], len(methods)], strict=True):
        last = [method for method in methods[start:end] if method.name.startswith("_")][-1]
        path = ("states", by_name[methods[start].name])
        yield Origin(first=methods[start].lineno, last=_last_line(last, lines), path=path)


def _method_origins(plan: ComponentPlan, methods: Sequence[ast.FunctionDef], lines: Sequence[str]) -> Iterator[Origin]:
    """Yield the origins inside the methods of the states and of the common section."""
    by_stem = {state.stem: state for state in plan.states}
    predicates = iter(_predicate_paths(plan.common_decisions))
    owner: DesignPath = ("common",)
    for method in methods:
        kind, stem = _split_method_name(method.name)
        state = by_stem.get(stem)
        if method.name == "_decide_common":
            yield Origin(first=method.lineno, last=_end(method), path=_COMMON)
            yield from _decision_origins(method, plan.common_decisions, lines)
        elif method.name == "_act_common":
            yield Origin(first=method.lineno, last=_end(method), path=("common", "actions"))
        elif kind == "in" and state is not None:
            owner, predicates = ("states", state.name), iter(_predicate_paths(state.decisions))
            yield from _decision_origins(method, state.decisions, lines)
        elif kind in ("enter", "leave") and state is not None:
            yield Origin(first=method.lineno, last=_last_line(method, lines), path=("states", state.name, kind))
        elif kind == "when" and (path := next(predicates, None)):
            yield Origin(first=method.lineno, last=_last_line(method, lines), path=(*path, "code"))
        elif kind == "do":
            yield Origin(first=method.lineno, last=_last_line(method, lines), path=(*owner, "actions"))


def _split_method_name(name: str) -> tuple[str, str]:
    kind, _underscore, stem = name.removeprefix("_").partition("_")
    return (kind, stem)


def _predicate_paths(alternatives: Iterable[DecisionPlan]) -> Iterator[DesignPath]:
    """Yield the paths of the decisions with hand-written guards, in the order of their methods."""
    for alternative in alternatives:
        if any(isinstance(condition, CodeCondition) for condition in alternative.conditions):
            yield alternative.path
        if isinstance(alternative.outcome, Branch):
            yield from _predicate_paths((*alternative.outcome.then, *alternative.outcome.otherwise))


def _decision_origins(
    method: ast.FunctionDef, alternatives: Iterable[DecisionPlan], lines: Sequence[str]
) -> Iterator[Origin]:
    for (first, last), path in zip(_outcomes(method.body, None), leaf_paths(alternatives), strict=False):
        start = first
        # A comment above the test belongs to it.
        while start > 1 and lines[start - 2].strip().startswith("# ") and "vicode>" not in lines[start - 2]:
            start -= 1
        yield Origin(first=start, last=last, path=path)


def _outcomes(body: Sequence[ast.stmt], test: ast.If | None) -> Iterator[tuple[int, int]]:
    """Yield the first and last line of each outcome, including the test that only it depends on."""
    for index, statement in enumerate(body):
        if isinstance(statement, ast.If):
            yield from _outcomes(statement.body, statement)
            yield from _outcomes(statement.orelse, None)
        elif _is_outcome(statement):
            first = test.lineno if test is not None and index == 0 else statement.lineno
            following = body[index + 1 : index + 2]
            yield first, _end(following[0] if following and isinstance(following[0], ast.Return) else statement)


def _is_outcome(statement: ast.stmt) -> bool:
    match statement:
        case ast.Expr(value=ast.Call(func=ast.Attribute(value=ast.Name(id="self"), attr=name))):
            return name in _OUTCOMES
        case _:
            return False


def _last_line(method: ast.FunctionDef, lines: Sequence[str]) -> int:
    """Return the last line of a method, including the end mark of a region."""
    end = _end(method)
    while end < len(lines) and (not lines[end].strip() or lines[end].strip().startswith("# ")):
        end += 1
        if lines[end - 1].strip() == "# </vicode>":
            return end
    return _end(method)


def _end(node: ast.stmt) -> int:
    return node.end_lineno or node.lineno
