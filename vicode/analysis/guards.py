"""Which decisions of a state can be taken, and why the others cannot.

The decisions of a state are a list: one is taken if its guard and those of its groups hold and no earlier one is taken.
So a decision is dead if its own condition is impossible, and shadowed if it is impossible without those before it. Each
verdict names what it rests on: the declared ranges without which it could not be proved, and the values of constants.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property
from itertools import chain

from vicode.analysis.conditions import Conditions
from vicode.analysis.interval_diagrams import FALSE, TRUE, Node, TooLargeError
from vicode.analysis.quantities import build_quantities
from vicode.findings import DesignPath
from vicode.model.design import Decision, DecisionGroup, Design, Guard, Stay, Transition
from vicode.model.disabled import disabled_states, strip_disabled_decision
from vicode.model.project import Interface, Project


class Verdict(StrEnum):
    """What is proved about a decision, or about the `else` of a group."""

    NEVER_HOLDS = "never holds"
    NEVER_TESTED = "never tested"
    SHADOWED = "shadowed"
    ALWAYS_HOLDS = "always holds"


@dataclass(frozen=True, slots=True, kw_only=True)
class Basis:
    """What a proof rests on: declared ranges and values of constants, as text; `no_nan` if a value must not be nan."""

    facts: tuple[str, ...] = ()
    no_nan: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class ProvedDecision:
    """A decision with a verdict. `earlier` are the decisions that together shadow it."""

    path: DesignPath
    verdict: Verdict
    basis: Basis
    earlier: tuple[DesignPath, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class TestedDecision:
    """A decision with the conditions under which it is tested and taken.

    Attributes:
        path: Its path in the design.
        decision: The transition, stay or group.
        within: The guards of its groups hold, or do not hold for decisions in `else`.
        own: `within`, and its guard holds.
        reached: No earlier decision is taken.
    """

    path: DesignPath
    decision: Decision
    within: Node
    own: Node
    reached: Node


class GuardAnalysis:
    """The decisions of a design, state by state.

    A guard with errors can be anything, and so can all guards of a state of which the diagrams are too large.

    Args:
        design: The design.
        conditions: Its guards as diagrams.
        may_give_up: Whether too large diagrams give unknown guards.

    Raises:
        TooLargeError: A diagram has too many nodes, and it may not give up.
    """

    def __init__(self, design: Design, conditions: Conditions, *, may_give_up: bool = True) -> None:
        self.design = design
        self._may_give_up = may_give_up
        self.conditions = conditions
        self._diagrams = conditions.diagrams
        self._disabled = disabled_states(design)
        self.common = self._list_decisions(design.common.transitions, ("common", "transitions"), TRUE)
        reached = self._reached_after(self.common)
        self.states: Mapping[str, tuple[TestedDecision, ...]] = {
            state.name: self._list_decisions(state.transitions, ("states", state.name, "transitions"), reached)
            for state in design.states
            if not state.disabled
        }

    @property
    def listed(self) -> Iterator[TestedDecision]:
        """All decisions, common ones first."""
        return chain(self.common, *self.states.values())

    def taken(self, each: TestedDecision) -> Node:
        """The values for which a transition or stay ends the decision."""
        return self._diagrams.both(each.own, each.reached)

    def is_possible(self, node: Node) -> bool:
        """Whether a case is not proved to be impossible."""
        return not self._is_impossible(node, no_nan=True)

    def prove(self, node: Node, *, may_assume_no_nan: bool = True) -> Basis | None:
        """Prove that a case is impossible; None if it may be possible."""
        if node == FALSE:
            return Basis()
        try:
            if self.conditions.has_plain_case(node) or not self._is_excluded(node, set(), with_nan=False):
                return None
            with_nan = self._is_excluded(node, set(), with_nan=True)
            return self._minimal_basis(node, with_nan=with_nan) if with_nan or may_assume_no_nan else None
        except (TooLargeError, RecursionError):
            return None

    def find_verdicts(self) -> Iterator[ProvedDecision]:
        """Yield what is proved about the decisions, in the order of the design."""
        yield from self._judge_all(self.common, ())
        for state in self.states:
            yield from self.judge_state(state)

    def judge_state(self, state: str) -> Iterator[ProvedDecision]:
        """Yield what is proved about the decisions of a state, in their order."""
        return self._judge_all(self.states[state], self.common)

    @cached_property
    def _proved_without_constants(self) -> frozenset[tuple[DesignPath, Verdict]]:
        table = replace(self.conditions.table, constants={})
        verdicts = GuardAnalysis(self.design, Conditions(table)).find_verdicts()
        return frozenset((each.path, each.verdict) for each in verdicts)

    # The list of decisions

    def _list_decisions(self, items: Sequence[Decision], path: DesignPath, reached: Node) -> tuple[TestedDecision, ...]:
        self._diagrams.begin_question()
        listed: list[TestedDecision] = []
        try:
            self._append(listed, items, path, (TRUE, reached))
        except (TooLargeError, RecursionError) as error:
            if not self._may_give_up:
                raise TooLargeError from error
            unknown = self.conditions.unknown
            return tuple(
                TestedDecision(path=where, decision=item, within=TRUE, own=unknown, reached=TRUE)
                for where, item in self._iterate_enabled(items, path)
            )
        return tuple(listed)

    def _iterate_enabled(
        self, items: Sequence[Decision], path: DesignPath
    ) -> Iterator[tuple[DesignPath, Transition | Stay]]:
        for index, item in enumerate(items):
            if strip_disabled_decision(item, self._disabled) is None:
                continue
            if isinstance(item, DecisionGroup):
                yield from self._iterate_enabled(item.then, (*path, index, "then"))
                yield from self._iterate_enabled(item.otherwise, (*path, index, "else"))
            else:
                yield (*path, index), item

    def _append(
        self, listed: list[TestedDecision], items: Sequence[Decision], path: DesignPath, conditions: tuple[Node, Node]
    ) -> Node:
        """Append decisions that are tested if both conditions hold; return the condition that none was taken."""
        within, reached = conditions
        for index, item in enumerate(items):
            if strip_disabled_decision(item, self._disabled) is None:
                continue
            guard = self.conditions.of_guard(item.guard)
            own, here = self._diagrams.both(within, guard), (*path, index)
            listed.append(TestedDecision(path=here, decision=item, within=within, own=own, reached=reached))
            if isinstance(item, DecisionGroup):
                reached = self._append(listed, item.then, (*here, "then"), (own, reached))
                otherwise = self._diagrams.without(within, guard)
                reached = self._append(listed, item.otherwise, (*here, "else"), (otherwise, reached))
            else:
                reached = self._diagrams.without(reached, own)
        return reached

    def _reached_after(self, listed: Sequence[TestedDecision]) -> Node:
        """No decision of a list is taken, nor of those before it."""
        leaves = [each for each in listed if not isinstance(each.decision, DecisionGroup)]
        return self._diagrams.without(leaves[-1].reached, leaves[-1].own) if leaves else TRUE

    # Proofs

    def _is_excluded(self, node: Node, ignored: set[int], *, with_nan: bool) -> bool:
        possible = self.conditions.possible((node,), with_nan=with_nan, ignored=ignored)
        return self._diagrams.both(node, possible) == FALSE

    def _minimal_basis(self, node: Node, *, with_nan: bool) -> Basis:
        ignored: set[int] = set()
        ranges = self.conditions.ignorable_facts(node)
        for level in ranges:
            if self._is_excluded(node, ignored | {level}, with_nan=with_nan):
                ignored.add(level)
        facts = tuple(self.conditions.describe_fact(level) for level in ranges if level not in ignored)
        return Basis(facts=facts, no_nan=not with_nan)

    def _judge_all(
        self, listed: Sequence[TestedDecision], before: Sequence[TestedDecision]
    ) -> Iterator[ProvedDecision]:
        closed: list[DesignPath] = []
        for index, each in enumerate(listed):
            if any(each.path[: len(path)] == path for path in closed):
                continue
            earlier = (*before, *listed[:index])
            self._diagrams.begin_question()
            try:
                verdicts = tuple(self._judge(each, earlier))
            except (TooLargeError, RecursionError):
                continue
            for verdict in verdicts:
                yield self._with_constants(verdict, (*earlier, each))
                is_group = isinstance(each.decision, DecisionGroup) and verdict.path == each.path
                if is_group and verdict.verdict in (Verdict.NEVER_HOLDS, Verdict.SHADOWED):
                    # Its `else` can be tested.
                    closed.append((*verdict.path, "then"))
                elif verdict.verdict is not Verdict.ALWAYS_HOLDS:
                    closed.append(verdict.path)

    def _judge(self, each: TestedDecision, earlier: Sequence[TestedDecision]) -> Iterator[ProvedDecision]:
        if not self.is_possible(self.taken(each)):
            proved = self._judge_dead(each, earlier)
            if proved is not None:
                yield proved
                return
        basis = None if each.decision.guard.is_empty else self.prove(self._diagrams.without(each.within, each.own))
        if basis is None and not (isinstance(each.decision, DecisionGroup) and each.decision.guard.is_empty):
            return
        yield ProvedDecision(path=each.path, verdict=Verdict.ALWAYS_HOLDS, basis=basis or Basis())
        if isinstance(each.decision, DecisionGroup) and each.decision.otherwise:
            yield ProvedDecision(
                path=(*each.path, "else"), verdict=Verdict.NEVER_TESTED, basis=basis or Basis(), earlier=(each.path,)
            )

    def _judge_dead(self, each: TestedDecision, earlier: Sequence[TestedDecision]) -> ProvedDecision | None:
        """Why a decision is never taken; None if it may be taken for nan, for which its guard may test."""
        basis = self.prove(each.own, may_assume_no_nan=False)
        if basis is not None:
            return ProvedDecision(path=each.path, verdict=Verdict.NEVER_HOLDS, basis=basis)
        tests_nan = not self.is_possible(each.own)
        for verdict, condition in ((Verdict.NEVER_TESTED, each.within), (Verdict.SHADOWED, each.own)):
            rest = self._diagrams.both(condition, each.reached)
            basis = self.prove(rest, may_assume_no_nan=not tests_nan)
            if basis is not None:
                culprits, rest = self._find_culprits(condition, earlier, no_nan=basis.no_nan)
                # Fewer decisions may rest on more ranges.
                basis = self.prove(rest, may_assume_no_nan=basis.no_nan) or basis
                return ProvedDecision(path=each.path, verdict=verdict, basis=basis, earlier=culprits)
        return None

    def _with_constants(self, proved: ProvedDecision, listed: Sequence[TestedDecision]) -> ProvedDecision:
        """Add the constants and unset variables in the guards on which a proof rests."""
        paths = (proved.path, *proved.earlier)
        concerned = (
            each.decision.guard for each in listed if any(path[: len(each.path)] == each.path for path in paths)
        )
        facts = self.conditions.table.describe_constants(concerned)
        if not facts or (proved.path, proved.verdict) in self._proved_without_constants:
            return proved
        return replace(proved, basis=replace(proved.basis, facts=(*proved.basis.facts, *facts)))

    def _find_culprits(
        self, condition: Node, earlier: Sequence[TestedDecision], *, no_nan: bool
    ) -> tuple[tuple[DesignPath, ...], Node]:
        """A smallest set of earlier decisions, one of which is taken whenever the condition holds.

        The second value is the case that remains, which is impossible.
        """
        meeting = [
            each
            for each in earlier
            if not isinstance(each.decision, DecisionGroup) and self._diagrams.both(each.own, condition) != FALSE
        ]
        needed: list[TestedDecision] = []
        while meeting and not self._is_impossible(condition, no_nan=no_nan):
            # The decisions up to one of them are enough, and without that one they are not.
            least, most = 1, len(meeting)
            while least < most:
                middle = (least + most) // 2
                is_enough = self._is_impossible(self._without_all(condition, meeting[:middle]), no_nan=no_nan)
                least, most = (least, middle) if is_enough else (middle + 1, most)
            needed.append(meeting[least - 1])
            condition = self._diagrams.without(condition, needed[-1].own)
            del meeting[least - 1 :]
        return tuple(each.path for each in reversed(needed)), condition

    def _without_all(self, condition: Node, decisions: Sequence[TestedDecision]) -> Node:
        for each in decisions:
            condition = self._diagrams.without(condition, each.own)
        return condition

    def _is_impossible(self, node: Node, *, no_nan: bool) -> bool:
        try:
            return not self.conditions.has_plain_case(node) and self._is_excluded(node, set(), with_nan=not no_nan)
        except (TooLargeError, RecursionError):
            return False


def disprove_assumption(project: Project, interface: Interface) -> Basis | None:
    """Prove that the assumption about a component never holds; None if it may hold."""
    outputs = (*interface.readable, *interface.parameters)
    analysis = analyze_guards(project, Design(component=interface.component, outputs=outputs))
    return analysis.prove(analysis.conditions.of_guard(Guard(when=interface.assume)))


def analyze_guards(project: Project, design: Design) -> GuardAnalysis:
    """Analyze the decisions of a design of a project."""
    return GuardAnalysis(design, Conditions(build_quantities(project, design)))
