"""Verdicts against all values of small domains, evaluated by the reference interpreter."""

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from itertools import product

from hypothesis import given, settings
from hypothesis import strategies as st

from vicode.analysis.guards import ProvedDecision, Verdict, analyze_guards
from vicode.findings import DesignPath
from vicode.model.design import Decision, DecisionGroup, Declaration, Design, Guard, State, Transition
from vicode.model.expressions import BOOL, Expr, Scope, Variable, build_scope, parse_expression, walk
from vicode.model.project import Enumeration, Project
from vicode.model.traversal import iter_decisions
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
_READ = ("mn", "fg", "mnp", "fge", "mfe", "pqe", "fnq", "enp")
"""The inputs that decisions read together."""
_Seen = set[tuple[DesignPath, bool]]
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
    names = draw(st.sampled_from(_READ))[:most]
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


@st.composite
def nested_decisions(draw: st.DrawFn) -> tuple[Decision, ...]:
    """Transitions in groups."""
    names = draw(st.sampled_from(_READ))[:2]
    guards = st.builds(Guard, when=conditions(names, single_numbers))
    transitions = st.builds(Transition, to=st.just("A"), guard=guards)
    lists = st.recursive(
        st.lists(transitions, max_size=2).map(tuple),
        lambda inner: st.lists(transitions | st.builds(DecisionGroup, guard=guards, then=inner, otherwise=inner)).map(
            tuple
        ),
        max_leaves=3,
    )
    return draw(lists)


class Decisions:
    """The decisions of a state, with the guards and the names of the inputs that they read."""

    def __init__(self, decisions: Sequence[Decision]) -> None:
        parameters = (Declaration(name=name, type=type_, range=_RANGES.get(name)) for name, type_ in _TYPES.items())
        state = State(name="A", transitions=tuple(decisions))
        self._design = Design(component="T", parameters=tuple(parameters), initial="A", states=(state,))
        scope = build_scope(_PROJECT, self._design)
        self.paths = {located.path[3:]: located.decision for located in iter_decisions(self._design)}
        self._trees = {path: _parse(each.guard.when, scope) for path, each in self.paths.items()}
        nodes = [node for tree in self._trees.values() for node in walk(tree)]
        self._names = sorted({node.name for node in nodes if isinstance(node, Variable)})

    def judge(self) -> list[ProvedDecision]:
        return list(analyze_guards(_PROJECT, self._design).find_verdicts())

    def evaluate(self, *, beyond: Collection[str] = ()) -> set[tuple[bool, ...]]:
        """Which guards can hold together, for all values of the inputs; `beyond` their range for some of them."""
        domains = [(_BEYOND if name in beyond else _DOMAINS)[name] for name in self._names]
        named = (dict(zip(self._names, values, strict=True)) for values in product(*domains))
        return {tuple(bool(evaluate(tree, BOOL, each)) for tree in self._trees.values()) for each in named}


def _parse(guard: str, scope: Scope) -> Expr:
    tree = parse_expression(guard, scope, BOOL).tree
    assert tree is not None, guard
    return tree


def transitions(guards: Sequence[str]) -> Decisions:
    return Decisions([Transition(to="A", guard=Guard(when=guard)) for guard in guards])


def number(path: DesignPath) -> int:
    return int(str(path[3]))


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
    decisions = transitions(guards)
    rows = decisions.evaluate()
    expected = {}
    for index in range(len(guards)):
        if true := [each for each in Verdict if is_true(each, index, rows, range(index))]:
            expected[index] = true[0]
    assert {number(each.path): each.verdict for each in decisions.judge()} == expected


@given(guards(computed_numbers))
def test_no_value_contradicts_a_verdict_about_arithmetic(guards: list[str]) -> None:
    decisions = transitions(guards)
    # A quotient of inputs that are 0 is nan.
    verdicts = [each for each in decisions.judge() if not each.basis.no_nan]
    rows = decisions.evaluate() if verdicts else ()
    for each in verdicts:
        index = number(each.path)
        assert is_true(each.verdict, index, rows, range(index)), each


@given(guards(single_numbers, most=2))
def test_the_ranges_and_earlier_decisions_that_a_verdict_names_are_enough_and_needed(guards: list[str]) -> None:
    decisions = transitions(guards)
    for proved in decisions.judge():
        index = number(proved.path)
        named = {fact[0] for fact in proved.basis.facts}
        others = {*_RANGES} - named
        earlier = {*map(number, proved.earlier)}
        assert is_true(proved.verdict, index, decisions.evaluate(beyond=others), earlier), proved
        for name in named:
            assert not is_true(proved.verdict, index, decisions.evaluate(beyond={*others, name}), earlier), proved
        rows = decisions.evaluate() if earlier else ()
        for each in earlier:
            assert not is_true(proved.verdict, index, rows, earlier - {each}), proved


def decide(items: Sequence[Decision], path: DesignPath, held: Mapping[DesignPath, bool], seen: _Seen) -> bool:
    """Note the decisions that are tested, and whether they hold; return whether one is taken."""
    for index, item in enumerate(items):
        here = (*path, index)
        seen.add((here, held[here]))
        if isinstance(item, DecisionGroup):
            name, branch = ("then", item.then) if held[here] else ("else", item.otherwise)
            is_taken = decide(branch, (*here, name), held, seen)
        else:
            is_taken = held[here]
        if is_taken:
            return True
    return False


@given(nested_decisions())
def test_the_decisions_of_groups_that_are_never_taken_are_found(items: tuple[Decision, ...]) -> None:
    decisions = Decisions(items)
    seen: _Seen = set()
    for row in decisions.evaluate():
        decide(items, (), dict(zip(decisions.paths, row, strict=True)), seen)
    verdicts = {each.path[3:]: each.verdict for each in decisions.judge()}
    for path, verdict in verdicts.items():
        outcomes = {holds for tested, holds in seen if tested[: len(path)] == path}
        match verdict:
            case Verdict.NEVER_TESTED:
                assert not outcomes, path
            case Verdict.ALWAYS_HOLDS:
                assert (path, False) not in seen, path
            case _:
                assert (path, True) not in seen, path
    leaves = {path for path, item in decisions.paths.items() if not isinstance(item, DecisionGroup)}
    for path in leaves - {path for path, holds in seen if holds}:
        assert any(covers(verdict, judged, path) for judged, verdict in verdicts.items()), path


def covers(verdict: Verdict, judged: DesignPath, path: DesignPath) -> bool:
    """Whether a decision is never taken because of the verdict about it or about a group."""
    if path[: len(judged)] != judged or verdict is Verdict.ALWAYS_HOLDS:
        return False
    return verdict is Verdict.NEVER_TESTED or path[len(judged) :][:1] in ((), ("then",))
