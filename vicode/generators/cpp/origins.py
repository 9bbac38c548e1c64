"""Map the lines of a header or source to states, transitions and code.

The plan determines names and order: a function has one case per state, and the outcomes in a case are in the order of
the decisions.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from vicode.generators.cpp.names import state_names
from vicode.generators.origins import Origin, leaf_paths
from vicode.generators.plan import ComponentPlan, DecisionPlan
from vicode.regions import find_regions

_FUNCTION = re.compile(r"\S.*::(\w+)\([^;]*\{")
_CASE = re.compile(r"\s+case State::(\w+):")
_CASE_END = re.compile(r"\s+(case State::\w+:|default:)|    \}")
_RETURN = re.compile(r"\s+return\b.*;")
_CHANGE = re.compile(r"\s+(change_to\(.*|stay\(\));")
_PHASES = {"decide": "", "act": "actions", "enter": "enter", "leave": "leave"}


@dataclass(frozen=True, slots=True)
class _Block:
    """Lines of the text, from 1, both inclusive."""

    name: str
    first: int
    last: int


def find_origins(plan: ComponentPlan, text: str) -> tuple[Origin, ...]:
    """Return the origins, outer before inner."""
    lines = text.replace("\r\n", "\n").split("\n")
    functions = list(_functions(lines))
    origins = [*_section_origins(text), *_code_origins(plan, functions), *_common_origins(plan, functions, lines)]
    for function in functions:
        if function.name in _PHASES:
            origins += _state_origins(plan, function, lines)
    return tuple(sorted(origins, key=lambda origin: (origin.first, -origin.last)))


def _functions(lines: Sequence[str]) -> Iterator[_Block]:
    start, name = 0, ""
    for number, line in enumerate(lines, start=1):
        if match := _FUNCTION.fullmatch(line):
            start, name = number, match[1]
        elif line == "}" and name:
            yield _Block(name, start, number)
            name = ""


def _section_origins(text: str) -> Iterator[Origin]:
    for region in find_regions(text, "//").regions:
        if region.id in ("module", "members"):
            yield Origin(first=region.line, last=region.end_line, path=(region.id,))


def _code_origins(plan: ComponentPlan, functions: Iterable[_Block]) -> Iterator[Origin]:
    paths = {f"when_{code.stem}": code.path for code in plan.guard_code}
    paths |= {f"do_{code.stem}": code.path for code in plan.action_code}
    for function in functions:
        if function.name in paths:
            yield Origin(first=function.first, last=function.last, path=paths[function.name])


def _common_origins(plan: ComponentPlan, functions: Iterable[_Block], lines: Sequence[str]) -> Iterator[Origin]:
    for function in functions:
        if function.name == "decide_common":
            yield Origin(first=function.first, last=function.last, path=("common", "transitions"))
            yield from _decision_origins(plan.common_decisions, function, lines)
        elif function.name == "act_common":
            yield Origin(first=function.first, last=function.last, path=("common", "actions"))


def _state_origins(plan: ComponentPlan, function: _Block, lines: Sequence[str]) -> Iterator[Origin]:
    by_name = {name: state for state, name in state_names(plan).items()}
    states = {state.name: state for state in plan.states}
    for block in _cases(function, lines):
        state = states.get(by_name.get(block.name, ""))
        if state is None:
            continue
        phase = _PHASES[function.name]
        yield Origin(first=block.first, last=block.last, path=("states", state.name))
        if phase in ("enter", "leave"):
            yield Origin(first=block.first, last=block.last, path=("states", state.name, phase))
        if not phase:
            yield from _decision_origins(state.decisions, block, lines)


def _cases(function: _Block, lines: Sequence[str]) -> Iterator[_Block]:
    """The cases of a function, from the label to the last line; states with the same code share its lines."""
    labels: list[tuple[str, int]] = []
    for number in range(function.first, function.last):
        match = _CASE.fullmatch(lines[number - 1])
        if match:
            labels.append((match[1], number))
        elif _CASE_END.fullmatch(lines[number - 1]):
            labels = []
        following = lines[number]
        if labels and not match and _CASE_END.fullmatch(following):
            yield from (_Block(name, first, number) for name, first in labels)
            labels = []


def _decision_origins(decisions: Iterable[DecisionPlan], block: _Block, lines: Sequence[str]) -> Iterator[Origin]:
    outcomes = _outcomes(block, lines)
    for (first, last), path in zip(outcomes, leaf_paths(decisions), strict=False):
        yield Origin(first=first, last=last, path=path)


def _outcomes(block: _Block, lines: Sequence[str]) -> Iterator[tuple[int, int]]:
    """The first and last line of each outcome, with the test that only it depends on, and the comment above."""
    returns = [each for each in range(block.first + 1, block.last + 1) if _RETURN.fullmatch(lines[each - 1])]
    for last in returns:
        first = last - 1 if _CHANGE.fullmatch(lines[last - 2]) else last
        if first == last and lines[last - 1].strip() == "return false;":
            continue
        first = _test_of(first, block.first, lines)
        while first > block.first + 1 and lines[first - 2].lstrip().startswith("// "):
            first -= 1
        yield first, last


def _test_of(statement: int, start: int, lines: Sequence[str]) -> int:
    """The first line of the `if` whose first statement is at a line; the line itself if it is no such statement."""
    line = statement - 1
    if not lines[line - 1].endswith("{"):
        return statement
    while line > start and not lines[line - 1].lstrip().startswith(("if (", "}")):
        line -= 1
    return line if lines[line - 1].lstrip().startswith("if (") else statement
