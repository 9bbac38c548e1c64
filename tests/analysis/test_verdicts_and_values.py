"""Verdicts against all values of small domains, evaluated by the reference interpreter."""

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from itertools import product

from hypothesis import given, settings
from hypothesis import strategies as st

from vicode.analysis.guards import Verdict, analyze_guards
from vicode.model.design import Declaration, Design, Guard, State, Transition
from vicode.model.expressions import BOOL, Expr, Scope, Variable, build_scope, parse_expression, walk
from vicode.model.project import Enumeration, Project
from vicode.semantics import evaluate
from vicode.semantics.values import Value

Texts = st.SearchStrategy[str]

_RANGES = {"m": (0, 4), "n": (0, 4), "f": (0, 2), "g": (0, 2)}
_DOMAINS: Mapping[str, Sequence[Value]] = {
    **dict.fromkeys("mn", tuple(range(5))),
    # The constants are multiples of 0.5.
    **dict.fromkeys("fg", tuple(step / 4 for step in range(9))),
    **dict.fromkeys("pq", (False, True)),
    "e": ("E.one", "E.two", "E.three"),
}
_BEYOND: Mapping[str, Sequence[Value]] = {
    **dict.fromkeys("mn", (*range(-6, 7), 99)),
    **dict.fromkeys("fg", (-99.0, -2.0, -1.75, -1.5, -1.0, -0.5, -0.25, *_DOMAINS["f"], 99.0, math.nan)),
}
"""Values that a declared range excludes, too."""
_TYPES = {**dict.fromkeys("mn", "int"), **dict.fromkeys("fg", "float"), **dict.fromkeys("pq", "bool"), "e": "E"}
_ORDERS = st.sampled_from(("<", "<=", ">", ">=", "==", "!="))
_PROJECT = Project(
    name="p", enumerations=(Enumeration(name="E", elements=tuple((name, "") for name in ("one", "two", "three"))),)
)


def constants(number: str) -> Texts:
    return st.sampled_from([str(each) for each in range(-1, 6)] if number in "mn" else ["-0.5", "0", "0.5", "1.5", "2"])


def single_numbers(names: Sequence[str]) -> Texts:
    """Values that depend on one input, without arithmetic."""

    def of_name(name: str) -> Texts:
        bounds = ("1, 3", "0, 2")
        return st.sampled_from((name, name, f"-{name}", f"abs({name})", *(f"clamp({name}, {each})" for each in bounds)))

    return st.sampled_from(names).flatmap(of_name)


def comparisons(names: Sequence[str], numbers: Texts) -> Texts:
    """Comparisons of numbers with constants, and of two inputs of one type, which has only these two."""
    limits = constants(names[0])
    with_constant = st.builds("{} {} {}".format, numbers, _ORDERS, limits)
    chain = st.builds("{} <= {} < {}".format, limits, numbers, limits)
    if len(names) == 1:
        return with_constant | chain
    choice = st.builds(
        "{}({}, {}) {} {}".format, st.sampled_from(("min", "max")), *map(st.just, names), _ORDERS, limits
    )
    return with_constant | chain | choice | st.builds("{} {} {}".format, st.just(names[0]), _ORDERS, st.just(names[1]))


def atoms(names: Sequence[str], numbers_of: Callable[[Sequence[str]], Texts]) -> Texts:
    """Conditions that read one or two of the inputs."""
    by_type = ([name for name in names if name in type_] for type_ in ("mn", "fg"))
    found = [comparisons(inputs, numbers_of(inputs)) for inputs in by_type if inputs]
    if bools := [name for name in names if name in "pq"]:
        found.append(st.sampled_from(bools))
    if len(bools) == 2:
        found.append(st.sampled_from(("p == q", "p != q")))
    if "e" in names:
        found.append(st.builds("e {} E.{}".format, st.sampled_from(("==", "!=")), st.sampled_from(("one", "two"))))
    return st.one_of(found)


def conditions(names: Sequence[str], numbers_of: Callable[[Sequence[str]], Texts]) -> Texts:
    return st.recursive(
        atoms(names, numbers_of),
        lambda inner: (
            st.builds("({} and {})".format, inner, inner)
            | st.builds("({} or {})".format, inner, inner)
            | st.builds("not ({})".format, inner)
            | st.builds("({} if {} else {})".format, inner, inner, inner)
        ),
        max_leaves=5,
    )


@st.composite
def guards(draw: st.DrawFn, numbers_of: Callable[[Sequence[str]], Texts], most: int = 3) -> list[str]:
    """The guards of a state, which read few inputs."""
    names = sorted(draw(st.lists(st.sampled_from(sorted(_DOMAINS)), min_size=1, max_size=most, unique=True)))
    return draw(st.lists(conditions(names, numbers_of), min_size=3, max_size=4))


def computed_numbers(names: Sequence[str]) -> Texts:
    """Values that may be computed from several inputs."""
    leaves = st.sampled_from(names) | constants(names[0])
    return st.recursive(
        single_numbers(names),
        lambda inner: (
            st.builds("({} {} {})".format, inner, st.sampled_from("+-*/"), inner | leaves)
            | st.builds("abs({})".format, inner)
            | st.builds("{}({}, {})".format, st.sampled_from(("min", "max")), inner, leaves)
        ),
        max_leaves=3,
    )


class Decisions:
    """The transitions of a state, with their verdicts and the names of the inputs that they read."""

    def __init__(self, guards: Sequence[str]) -> None:
        transitions = tuple(Transition(to="A", guard=Guard(when=guard)) for guard in guards)
        parameters = (Declaration(name=name, type=type_, range=_RANGES.get(name)) for name, type_ in _TYPES.items())
        state = State(name="A", transitions=transitions)
        design = Design(component="T", parameters=tuple(parameters), initial="A", states=(state,))
        scope = build_scope(_PROJECT, design)
        self.trees = [_parse(guard, scope) for guard in guards]
        self.names = sorted({node.name for tree in self.trees for node in walk(tree) if isinstance(node, Variable)})
        self.verdicts = {int(str(each.path[3])): each for each in analyze_guards(_PROJECT, design).find_verdicts()}

    def evaluate(self, *, beyond: Collection[str] = ()) -> set[tuple[bool, ...]]:
        """Which guards can hold together, for all values of the inputs; `beyond` their range for some of them."""
        domains = [(_BEYOND if name in beyond else _DOMAINS)[name] for name in self.names]
        named = (dict(zip(self.names, values, strict=True)) for values in product(*domains))
        return {tuple(bool(evaluate(tree, BOOL, each)) for tree in self.trees) for each in named}


def _parse(guard: str, scope: Scope) -> Expr:
    tree = parse_expression(guard, scope, BOOL).tree
    assert tree is not None, guard
    return tree


def agrees(verdict: Verdict, index: int, held: Sequence[bool], earlier: Collection[int]) -> bool:
    """Whether a verdict is true for values for which guards hold or not."""
    is_covered = any(held[each] for each in earlier)
    match verdict:
        case Verdict.NEVER_HOLDS:
            return not held[index]
        case Verdict.NEVER_TESTED:
            return is_covered
        case Verdict.SHADOWED:
            return is_covered or not held[index]
        case Verdict.ALWAYS_HOLDS:
            return held[index]


def is_true(verdict: Verdict, index: int, rows: Iterable[Sequence[bool]], earlier: Collection[int]) -> bool:
    return all(agrees(verdict, index, held, earlier) for held in rows)


@settings(max_examples=settings().max_examples * 3)
@given(guards(single_numbers))
def test_the_verdicts_are_those_of_all_values(guards: list[str]) -> None:
    decisions = Decisions(guards)
    rows = decisions.evaluate()
    expected = {}
    for index in range(len(guards)):
        if true := [each for each in Verdict if is_true(each, index, rows, range(index))]:
            expected[index] = true[0]
    assert {index: each.verdict for index, each in decisions.verdicts.items()} == expected


@given(guards(computed_numbers))
def test_no_value_contradicts_a_verdict_about_arithmetic(guards: list[str]) -> None:
    decisions = Decisions(guards)
    rows = decisions.evaluate() if decisions.verdicts else ()
    for index, proved in decisions.verdicts.items():
        # A quotient of inputs that are 0 is nan.
        assert proved.basis.no_nan or is_true(proved.verdict, index, rows, range(index)), proved


@given(guards(single_numbers, most=2))
def test_the_ranges_and_earlier_decisions_that_a_verdict_names_are_enough_and_needed(guards: list[str]) -> None:
    decisions = Decisions(guards)
    for index, proved in decisions.verdicts.items():
        named = {fact[0] for fact in proved.basis.facts}
        others = {*_RANGES} - named
        earlier = {int(str(path[3])) for path in proved.earlier}
        assert is_true(proved.verdict, index, decisions.evaluate(beyond=others), earlier), proved
        for name in named:
            assert not is_true(proved.verdict, index, decisions.evaluate(beyond={*others, name}), earlier), proved
        rows = decisions.evaluate() if earlier else ()
        for each in earlier:
            assert not is_true(proved.verdict, index, rows, earlier - {each}), proved
