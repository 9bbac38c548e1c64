"""What `vicode.analysis` proves about random guards, compared with the solver z3 and with the reference interpreter.

`python -m benchmarks.analysis_z3 [--cases N] [--seed N] [--reduce N]` needs the package `z3-solver`.

A case is a state with one or two transitions. Each verdict is the claim that a formula never holds, such as "the second
guard and not the first". z3 decides the formula over exact real numbers without nan and with no division by zero; the
reference interpreter evaluates it with doubles. So

- a claim is wrong if the interpreter finds values for which the formula holds: the solution of z3, its neighbors, and
  values near the constants of the guards, nan and infinity included;
- a proof of z3 is not valid for doubles if the interpreter finds such values;
- all other proofs of z3 that the analysis does not find are missed. With `--reduce N`, so many of them are reduced to
  their smallest part that is still missed, and counted by its operations.
"""

import argparse
import ast
import math
import random
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise

from benchmarks.random_guards import DECLARATIONS, ENUMERATION, FLOATS, RANGES, RandomGuards, draw_values
from vicode.analysis.conditions import Conditions
from vicode.analysis.guards import GuardAnalysis, ProvedDecision, Verdict
from vicode.analysis.quantities import build_quantities
from vicode.model.design import Design, Guard, State, Transition
from vicode.model.expressions import (
    BOOL,
    FLOAT,
    INT,
    Binary,
    Comparison,
    Expr,
    Number,
    Variable,
    parse_expression,
    walk,
)
from vicode.model.project import Project
from vicode.semantics import evaluate
from vicode.semantics.values import Value

try:
    import z3

    from benchmarks.z3_encoding import Encoder
except ImportError:
    z3 = None

KINDS = ("comparisons with constants", "comparisons of two values", "with arithmetic")
PROVED, MISSED, INVALID, SILENT = "proved by both", "missed", "z3 only, not valid for doubles", "no claim"
UNCONFIRMED, WRONG, UNKNOWN = "proved, not by z3", "wrong", "no claim, z3: unknown"
OUTCOMES = (PROVED, MISSED, INVALID, UNCONFIRMED, WRONG, SILENT, UNKNOWN)
SOLVER_MS = 1000
SAMPLES = 300
BATCH = 20
"""Cases in a design, which share diagrams."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Claim:
    """That a formula never holds, which is what a verdict says about a transition of a case."""

    index: int
    verdict: Verdict
    formula: str


@dataclass(slots=True)
class Result:
    """What became of the claims.

    Attributes:
        counts: How many claims there are by kind of guard and outcome.
        wrong: Verdicts that do not hold, with values.
        unconfirmed: Verdicts that z3 does not prove, for which the interpreter finds no values either.
        missed: Formulas that z3 proves and the analysis does not.
    """

    counts: Counter[tuple[str, str]]
    wrong: list[str]
    unconfirmed: list[str]
    missed: list[str]


class ValueReader:
    """Reads times, for the reference interpreter."""

    has_xabsl_rules = False

    def __init__(self, values: Mapping[str, Value]) -> None:
        self._values = values

    def note_large_int(self) -> None:
        """Results beyond 2**53 are limited as in any design."""

    def read_time(self, kind: str) -> Value:
        return self._values[f"{kind}_time"]


class Oracle:
    """Decides formulas with z3 and with the reference interpreter."""

    def __init__(self, conditions: Conditions, chance: random.Random) -> None:
        self._scope = conditions.table.scope
        self._chance = chance

    def parse(self, formula: str) -> Expr:
        parsed = parse_expression(formula, self._scope, BOOL)
        if parsed.tree is None or parsed.diagnostics:
            raise ValueError(formula)
        return parsed.tree

    def solve(self, formula: str) -> tuple[str, Mapping[str, Value]]:
        """Whether a formula has a solution: "sat", "unsat" or "unknown"; and the solution."""
        encoder, solver = Encoder(), z3.Solver()
        solver.set("timeout", SOLVER_MS)
        solver.add(encoder.encode(self.parse(formula)), *encoder.facts)
        answer = str(solver.check())
        return (answer, encoder.values_of(solver.model()) if answer == "sat" else {})

    def find_values(
        self, formula: str, near: Mapping[str, Value], *, with_nan: bool = True
    ) -> Mapping[str, Value] | None:
        """Values for which a formula holds with doubles; without nan if no part may be nan."""
        tree = self.parse(formula)
        literals = [float(node.value) for node in walk(tree) if isinstance(node, Number)]
        numbers = [*literals, *(-each for each in literals), 0.0, *map(float, filter(_is_number, near.values()))]
        for number, values in enumerate(islice(draw_values(self._chance, numbers), SAMPLES)):
            tried = {**values, **(near if number == 0 else _beside(near, self._chance) if number < 40 else {})}
            if _evaluate(tree, tried) and (with_nan or not _has_nan(tree, tried)):
                return {node.name: tried[node.name] for node in walk(tree) if isinstance(node, Variable)}
        return None


def _evaluate(tree: Expr, values: Mapping[str, Value]) -> Value:
    return evaluate(tree, tree.type, values, ValueReader(values))  # type: ignore[arg-type]


def _has_nan(tree: Expr, values: Mapping[str, Value]) -> bool:
    return any(math.isnan(_evaluate(node, values)) for node in walk(tree) if node.type == FLOAT)  # type: ignore[arg-type]


def _is_number(value: Value) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _beside(values: Mapping[str, Value], chance: random.Random) -> dict[str, Value]:
    """A solution in which inputs are up to 2 doubles away."""
    moved = dict(values)
    for name in {*moved} & {*FLOATS}:
        low, high = RANGES.get(name, (-math.inf, math.inf))
        value = float(values[name])
        moved[name] = min(max(value + chance.randrange(-2, 3) * math.ulp(value), low), high)
    return moved


# Claims


def format_guard(guard: Guard) -> str:
    """A guard as one expression; the durations of the random guards are whole nanoseconds."""
    return " and ".join(f"({part})" for part in (guard.after and f"state_time >= {guard.after}", guard.when) if part)


def list_claims(guards: Sequence[Guard]) -> Iterator[Claim]:
    """The claims that a case may lead to, the strongest first for each transition."""
    earlier = ""
    for index, guard in enumerate(guards):
        own = format_guard(guard)
        formulas = [(Verdict.NEVER_HOLDS, own)]
        if earlier:
            formulas += [(Verdict.NEVER_TESTED, f"not ({earlier})"), (Verdict.SHADOWED, f"({own}) and not ({earlier})")]
        formulas.append((Verdict.ALWAYS_HOLDS, f"not ({own})"))
        for verdict, formula in formulas:
            yield Claim(index=index, verdict=verdict, formula=formula)
        earlier = own


def analyze(cases: Sequence[Sequence[Guard]]) -> tuple[GuardAnalysis, Conditions]:
    """Analyze a design with a state for each case."""
    states = [
        State(name=f"S{number}", transitions=tuple(Transition(to="S0", guard=guard) for guard in guards))
        for number, guards in enumerate(cases)
    ]
    design = Design(component="Tested", parameters=DECLARATIONS, initial="S0", states=tuple(states))
    project = Project(name="bench", enumerations=(ENUMERATION,), designs=(design,))
    conditions = Conditions(build_quantities(project, design))
    analysis = GuardAnalysis(design, conditions)
    assert len(analysis.states) == len(states)
    return analysis, conditions


def kind_of(tree: Expr, conditions: Conditions) -> str:
    """What an analysis must know to decide a formula: one of `KINDS`."""
    nodes = list(walk(tree))
    if any(isinstance(node, Binary) for node in nodes):
        return KINDS[2]
    pairs = [pair for node in nodes if isinstance(node, Comparison) for pair in pairwise(node.operands)]
    numbers = [pair for pair in pairs if pair[0].type in (INT, FLOAT)]
    compares_constants = all(any(conditions.table.value_of(each) is not None for each in pair) for pair in numbers)
    return KINDS[0] if compares_constants else KINDS[1]


def judge_batch(cases: Sequence[Sequence[Guard]], chance: random.Random, result: Result) -> None:
    analysis, conditions = analyze(cases)
    oracle = Oracle(conditions, chance)
    verdicts = {(each.path[1], each.path[3]): each for each in analysis.find_verdicts()}
    for case, guards in enumerate(cases):
        decided: set[int] = set()
        for claim in list_claims(guards):
            kind = kind_of(oracle.parse(claim.formula), conditions)
            verdict = verdicts.get((f"S{case}", claim.index))
            answer, solution = oracle.solve(claim.formula)
            if verdict is not None and verdict.verdict is claim.verdict:
                result.counts[kind, judge_verdict(claim, verdict, answer, solution, oracle, result)] += 1
            elif claim.index not in decided:
                result.counts[kind, judge_silence(claim, answer, oracle, result)] += 1
            if answer == "unsat":
                decided.add(claim.index)


def judge_verdict(
    claim: Claim, verdict: ProvedDecision, answer: str, solution: Mapping[str, Value], oracle: Oracle, result: Result
) -> str:
    """What z3 and the interpreter say about a verdict."""
    values = oracle.find_values(claim.formula, solution, with_nan=not verdict.basis.no_nan)
    if values is not None:
        result.wrong.append(f"{claim.verdict}: {claim.formula}\n    holds for {values}")
        return WRONG
    if answer == "unsat":
        return PROVED
    result.unconfirmed.append(f"{claim.verdict}: {claim.formula}\n    z3: {solution or answer}")
    return UNCONFIRMED


def judge_silence(claim: Claim, answer: str, oracle: Oracle, result: Result) -> str:
    """What z3 and the interpreter say where there is no verdict."""
    if answer != "unsat":
        return SILENT if answer == "sat" else UNKNOWN
    if oracle.find_values(claim.formula, {}) is not None:
        return INVALID
    result.missed.append(claim.formula)
    return MISSED


# Reduction of what is missed


def reduce_formula(formula: str, is_missed: Callable[[str], bool]) -> str:
    """The smallest part of a formula that is still missed."""
    for shorter in sorted(set(_list_shorter(formula)), key=len):
        if len(shorter) < len(formula) and is_missed(shorter):
            return reduce_formula(shorter, is_missed)
    return formula


def _list_shorter(formula: str) -> Iterator[str]:
    tree = ast.parse(formula, mode="eval")
    for node in list(ast.walk(tree)):
        for name, value in ast.iter_fields(node):
            places = value if isinstance(value, list) else [value]
            for number, child in enumerate(places):
                if isinstance(child, ast.expr):
                    yield from _replace(tree, node, name, number if isinstance(value, list) else None)
        if isinstance(node, ast.BoolOp) and len(node.values) > 2:
            for removed in list(node.values):
                kept, node.values = node.values, [each for each in node.values if each is not removed]
                yield ast.unparse(tree)
                node.values = kept
        if isinstance(node, ast.Compare) and len(node.ops) > 1:
            kept, node.ops, node.comparators = (node.ops, node.comparators), node.ops[:-1], node.comparators[:-1]
            yield ast.unparse(tree)
            node.ops, node.comparators = kept


def _replace(tree: ast.AST, node: ast.AST, name: str, number: int | None) -> Iterator[str]:
    """Texts in which a child is replaced by one of its own children or a constant."""
    value = getattr(node, name)
    child = value if number is None else value[number]
    parts = [each for each in ast.iter_child_nodes(child) if isinstance(each, ast.expr)]
    for new in (*parts, ast.Name("seen"), ast.Constant(1), ast.Constant(True)):
        if number is None:
            setattr(node, name, new)
        else:
            value[number] = new
        yield ast.unparse(tree)
    if number is None:
        setattr(node, name, child)
    else:
        value[number] = child


def print_missed(missed: Sequence[str], chance: random.Random) -> None:
    analysis, conditions = analyze([[Guard(when="seen")]])
    oracle = Oracle(conditions, chance)

    def is_missed(formula: str) -> bool:
        try:
            if analysis.prove(conditions.of_text(formula)) is not None or oracle.solve(formula)[0] != "unsat":
                return False
        except ValueError:
            return False
        return oracle.find_values(formula, {}) is None

    reduced = Counter(reduce_formula(formula, is_missed) for formula in missed if is_missed(formula))
    for formula, number in reduced.most_common():
        print(f"{number:5}  {formula}")


def print_counts(counts: Counter[tuple[str, str]]) -> None:
    print(f"| guards | {' | '.join(OUTCOMES)} | share proved |")
    print(f"|---|{'---|' * (len(OUTCOMES) + 1)}")
    for kind in KINDS:
        row = [counts[kind, outcome] for outcome in OUTCOMES]
        share = counts[kind, PROVED] / max(1, counts[kind, PROVED] + counts[kind, MISSED])
        print(f"| {kind} | {' | '.join(map(str, row))} | {share:.1%} |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--reduce", type=int, default=0, help="reduce so many of the formulas that are missed")
    options = parser.parse_args()
    if z3 is None:
        sys.exit("this benchmark needs z3: install the package z3-solver")
    chance, result = random.Random(options.seed), Result(counts=Counter(), wrong=[], unconfirmed=[], missed=[])
    cases = [RandomGuards(chance, has_arithmetic=number % 2 == 1).draw_case() for number in range(options.cases)]
    for start in range(0, options.cases, BATCH):
        judge_batch(cases[start : start + BATCH], chance, result)
    print_counts(result.counts)
    print(f"{len(result.wrong)} wrong verdicts", *result.wrong, sep="\n  ")
    print(f"{len(result.unconfirmed)} verdicts that z3 does not prove", *result.unconfirmed, sep="\n  ")
    print_missed(chance.sample(result.missed, min(options.reduce, len(result.missed))), chance)
    sys.exit(bool(result.wrong))


if __name__ == "__main__":
    main()
