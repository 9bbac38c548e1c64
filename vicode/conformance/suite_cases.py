"""Finds the cases of a test suite: the diagrams of the guards say which values to try, a search fills the gaps.

A case goes to a state on a shortest way, tries there what keeps the state, and leaves it. A value that an earlier case
tried is not tried again. What the diagrams do not lead to, such as a counter that must be high, is searched as the
inputs of `vicode conform` are. The expected values are those of the reference interpreter.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace

from vicode.analysis.decision_targets import DecisionTarget, Point, contains, iterate_targets, locate
from vicode.analysis.exploration import Exploration
from vicode.analysis.input_choice import Inputs
from vicode.analysis.interval_diagrams import FALSE, Node, TooLargeError
from vicode.analysis.machines import MachineAnalysis
from vicode.analysis.walk import SavedWalk, Walk
from vicode.conformance.chosen_inputs import choose_missing
from vicode.conformance.coverage import CoverageRecorder, DesignGoals, summarize
from vicode.conformance.inputs import PARAMETERS, ConformanceRun, InputKey, RunStep
from vicode.conformance.reference import run_reference
from vicode.conformance.result import InputCoverage
from vicode.conformance.suite import SuiteCase, make_case, observe
from vicode.findings import DesignPath
from vicode.model.design import Decision
from vicode.model.project import Project
from vicode.semantics import ComponentStep, NotInterpretableError, Outcome, Value, build_machines, evaluate

_SEARCHED = 400


@dataclass(frozen=True, slots=True)
class _Found:
    """A run that tries something; `shows` has words by the index of a step."""

    name: str
    run: ConformanceRun
    shows: dict[int, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundCases:
    """The cases of a design, what they reach of it, and why steps were left out."""

    cases: tuple[SuiteCase, ...]
    coverage: InputCoverage
    left_out: tuple[str, ...]


def find_cases(project: Project, root: str) -> FoundCases:
    """Find the cases of a design.

    Raises:
        NotInterpretableError: The design has errors, or each step runs code that is not portable.
    """
    empty = ConformanceRun(project=project, root=root, steps=())
    goals = DesignGoals(build_machines(project, root), root)
    finder = _CaseFinder(empty)
    found = list(finder.find())
    recorder = CoverageRecorder(goals)
    for each in found:
        robots = recorder.make_robots(empty)
        for step in each.run.steps:
            recorder.follow(robots, step)
    own = tuple(goal for goal in goals.goals if goal.subject[0] == root)
    missing = frozenset(own) - recorder.seen
    if missing:
        searched = choose_missing(recorder, empty, wanted=missing, iterations=_SEARCHED)
        found += [_Found(name="searched", run=run) for run in searched]
    if not found:
        raise NotInterpretableError("; ".join(sorted(finder.left_out)) or "no step of it is possible")
    names = Counter[str]()
    cases = []
    for each in found:
        names[each.name] += 1
        name = f"{each.name} ({names[each.name]})" if names[each.name] > 1 else each.name
        cases.append(make_case(name, each.run, observe(project, run_reference(each.run)), each.shows))
    goals.goals = own
    return FoundCases(
        cases=tuple(cases), coverage=summarize(goals, recorder.seen), left_out=tuple(sorted(finder.left_out))
    )


class _CaseFinder:
    """Finds the cases to which the diagrams lead.

    Args:
        empty: A run of the design without iterations.
    """

    def __init__(self, empty: ConformanceRun) -> None:
        self._empty = empty
        design = empty.project.design(empty.root)
        assert design is not None
        self._machine = MachineAnalysis(empty.project, design)
        self._conditions = self._machine.guards.conditions
        self._inputs = {each.key for each in empty.inputs}
        self._tried: dict[str, list[Point]] = {state.name: [] for state in design.states}
        self._shown = set[tuple[DesignPath, str]]()
        self._decided: tuple[str, Point] | None = None
        self.left_out = set[str]()

    def find(self) -> Iterator[_Found]:
        """Yield the runs; `left_out` has then the reasons why steps were left out."""
        walk = Walk(self._empty.project, self._machine, self._note, may_leave_out=True)
        self.left_out = walk.left_out
        places = Exploration(self._empty.project, self._machine, walk).find()
        for state in self._machine.design.states:
            if state.name in places:
                yield from self._find_in(walk, state.name, places[state.name])

    def _find_in(self, walk: Walk, state: str, places: Sequence[SavedWalk]) -> Iterator[_Found]:
        targets, shows = self._list_targets(state), dict[int, str]()
        walk.restore(places[0])
        for target in targets:
            self._try(walk, target, shows, stays=True)
        end = walk.save()
        for target in targets:
            # What keeps the state is part of the first case that leaves it.
            tries = [
                (end, shows, False),
                *((each, dict[int, str](), kept) for each in places for kept in (False, True)),
            ]
            for place, words, stays in tries:
                walk.restore(place)
                if self._try(walk, target, words, stays=stays):
                    yield self._make(walk, state, words)
                    end, shows = (places[0], {}) if words is shows else (end, shows)
                    break
        if shows:
            walk.restore(end)
            yield self._make(walk, state, shows)

    def _list_targets(self, state: str) -> list[DecisionTarget]:
        self._conditions.diagrams.begin_question()
        targets = list[DecisionTarget]()
        with suppress(TooLargeError, RecursionError):
            targets.extend(iterate_targets(self._machine, state))
        return [each for each in targets if each.values != FALSE]

    def _try(self, walk: Walk, target: DecisionTarget, shows: dict[int, str], *, stays: bool) -> bool:
        """Try a target that was not tried before in the present state, which is kept or left."""
        state = walk.state
        if (target.path, target.words) in self._shown or self._was_tried(target, state):
            return False

        def is_met() -> bool:
            decided = self._take_decided()
            if decided is None or (walk.state == state) is not stays:
                return False
            if not contains(self._conditions.diagrams, target.values, decided[1]):
                return False
            self._tried[state].append(decided[1])
            return True

        self._take_decided()
        values = self._restrict(target, state, stays=stays)
        if values == FALSE or not walk.meet(values, is_met):
            return False
        shows[len(walk.steps) - 1] = target.words
        if target.is_shared:
            self._shown.add((target.path, target.words))
        return True

    def _restrict(self, target: DecisionTarget, state: str, *, stays: bool) -> Node:
        """The values of a target for which a state is kept or left."""
        diagrams = self._conditions.diagrams
        diagrams.begin_question()
        try:
            staying = self._machine.staying(state)
            return diagrams.both(target.values, staying if stays else diagrams.negate(staying))
        except (TooLargeError, RecursionError):
            return FALSE

    def _was_tried(self, target: DecisionTarget, state: str) -> bool:
        return any(contains(self._conditions.diagrams, target.values, point) for point in self._tried[state])

    def _note_way(self, walk: Walk) -> None:
        """Remember what a case tries on its way."""
        again = Walk(self._empty.project, self._machine, self._note)
        self._take_decided()
        for step in walk.steps:
            again.step(step.inputs, step.time_ns)
            if (decided := self._take_decided()) is not None:
                self._tried[decided[0]].append(decided[1])

    def _take_decided(self) -> tuple[str, Point] | None:
        """The state and the values with which the last iteration decided; None if it did not."""
        decided, self._decided = self._decided, None
        return decided

    def _note(self, step: ComponentStep, _item: Decision, _outcome: Outcome) -> None:
        if step.name == self._empty.root and self._decided is None:
            point = locate(self._conditions, lambda tree: evaluate(tree, tree.type, step.memory.values, step))
            self._decided = (step.memory.state, point)

    def _make(self, walk: Walk, state: str, shows: dict[int, str]) -> _Found:
        self._note_way(walk)
        # A walk gives one value for all arguments.
        functions = {each.key: each.initial for each in self._empty.inputs if each.arguments is not None}
        given = [self._known(step.inputs) for step in walk.steps]
        given[0] = {**functions, **given[0]}
        steps = tuple(
            RunStep(
                time_ns=step.time_ns,
                inputs=({key: [[{}, value]] if key in functions else value for key, value in inputs.items()},),
            )
            for step, inputs in zip(walk.steps, given, strict=True)
        )
        name = state if walk.state == state else f"{state} → {walk.state}"
        return _Found(name=name, run=replace(self._empty, steps=steps), shows=dict(shows))

    def _known(self, inputs: Inputs) -> dict[InputKey, Value]:
        keyed = {(PARAMETERS if key[0] == self._empty.root else key[0], key[1]): each for key, each in inputs.items()}
        return {key: value for key, value in keyed.items() if key in self._inputs}
