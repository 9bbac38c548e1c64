"""From the plan of a design to its option, with what the language has no place for as comments beside it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

from vicode.findings import Path
from vicode.generators.plan import (
    Alternative,
    CallComponent,
    ComponentPlan,
    Keep,
    Run,
    Set,
    StatePlan,
    Step,
    UnsoundDesignError,
)
from vicode.generators.xabsl.decisions import DecisionWriter, is_open
from vicode.generators.xabsl.expressions import Speller
from vicode.generators.xabsl.printing import Remark, remark, said
from vicode.generators.xabsl.symbols import range_text
from vicode.generators.xabsl.vocabulary import Vocabulary
from vicode.model.design import COMMON
from vicode.model.xabsl.limits import can_ask_done, find_limits
from vicode.model.xabsl.names import component_name, plain_name
from vicode.xabsl import tree
from vicode.xabsl.pieces import Piece, read_actions

_STAYS = (Alternative(conditions=(), outcome=Keep()),)


@dataclass(frozen=True, slots=True)
class OptionText:
    """An option; `remarks` are comments beside its nodes, `places` tell which nodes come from which thing."""

    option: tree.Option
    remarks: tuple[Remark, ...]
    places: tuple[tuple[tree.Node, Path], ...]


def write_option(plan: ComponentPlan, vocabulary: Vocabulary | None = None) -> OptionText:
    """The option of a design; who writes several hands on the project's vocabulary.

    Raises:
        UnsoundDesignError: XABSL cannot say something in it.
    """
    limit = next(find_limits(plan.project, plan.design), None)
    if limit is not None:
        raise UnsoundDesignError(limit.message)
    return _OptionWriter(plan, vocabulary or Vocabulary(plan.project)).write()


class _OptionWriter:
    """Builds the parts of one option, which share names."""

    def __init__(self, plan: ComponentPlan, vocabulary: Vocabulary) -> None:
        self.plan, self.design, self.vocabulary = plan, plan.design, vocabulary
        self.components = {"": plan.component, **{use.alias: use.component for use in plan.uses}}
        self.names = {state.name: plain_name(state) for state in self.design.states}
        self.speller = Speller(
            vocabulary=self.vocabulary,
            components=self.components,
            time_unit=plan.time_unit,
            is_xabsl=plan.arithmetic == "xabsl",
            asks_done=partial(can_ask_done, plan.project, self.design),
        )
        self.decisions = DecisionWriter(self.speller, self.names.__getitem__)
        self.remarks: list[Remark] = []
        self.places: list[tuple[tree.Node, Path]] = []

    def write(self) -> OptionText:
        plan = self.plan
        common: tree.Tree | None = None
        actions: tree.Actions | None = None
        if is_open(plan.decide_first):
            common = self.decisions.open(plan.decide_first, COMMON)
            self.places.append((common, ("common", "transitions")))
        if plan.act_first:
            actions = self._actions(plan.act_first, ("common", "actions"))
        planned = {state.name: state for state in plan.states}
        states = [self._state(planned[state.name], has_common=common is not None) for state in self.design.states]
        option = tree.Option(
            tree.Name(component_name(self.design)),
            [self._parameter(index) for index in range(len(self.design.parameters))],
            states,
            common,
            actions,
            said(self.design.doc, 0),
        )
        self._note(common or actions or states[0], self.design.common.doc)
        remarks = [*self.remarks, *(found for node, words in self.decisions.words for found in remark(node, words))]
        return OptionText(option, tuple(remarks), (*self.places, *self.decisions.places))

    def _parameter(self, index: int) -> tree.Parameter:
        declared = self.design.parameters[index]
        type_ = self.vocabulary.type_of(declared)
        is_number = type_.text == "float"
        return tree.Parameter(
            tree.Name(f"@{plain_name(declared)}"),
            type_,
            range_text(declared) if is_number else "",
            said(declared.unit, 1).replace('"', "'") if is_number else "",
            said(declared.doc, 1),
        )

    def _state(self, plan: StatePlan, *, has_common: bool) -> tree.State:
        design = self.design.state(plan.name)
        assert design is not None
        state = tree.State(
            tree.Name(self.names[plan.name]),
            tree.Actions([]),
            self._decision(plan, has_common=has_common),
            is_initial=plan.name == self.design.initial,
            is_target=plan.final,
        )
        if plan.capacity is not None:
            state.cooperation, state.robots = "capacity", str(plan.capacity)
        elif plan.synchronized is not None:
            state.cooperation, state.robots = "synchronized", str(plan.synchronized or "")
        self.places.append((state, ("states", plan.name)))
        state.actions = self._actions(plan.act, ("states", plan.name, "actions"))
        self._note(state, plan.doc)
        return state

    def _decision(self, plan: StatePlan, *, has_common: bool) -> tree.Decision | None:
        own = () if plan.decisions == _STAYS else plan.decisions
        before: Sequence[Alternative] = () if has_common else self.plan.decide_first
        if not own and not before:
            return None
        found = self.decisions.complete([*((COMMON, each) for each in before), *((plan.name, each) for each in own)])
        if not has_common:
            return tree.Decision(found)
        return tree.Decision(found, begins_with_else=True, else_doc=self.decisions.take_else_doc(found))

    def _actions(self, steps: Sequence[Step], path: Path) -> tree.Actions:
        actions = tree.Actions([action for step in steps for action in self._step(step)])
        if steps:
            self.places.append((actions, path))
        return actions

    def _step(self, step: Step) -> Iterator[tree.Action]:
        match step:
            case Set(name=name, value=value, alias=alias):
                symbol = self.vocabulary.symbol(self.components[alias], name)
                yield tree.Assignment(tree.Name(symbol), self.speller.spell(value))
            case CallComponent():
                yield self._call(step)
            case Run(body=body):
                text = body.code.in_language("xabsl")
                piece = read_actions(text or "")
                if text is None or piece.node is None or piece.mistakes:
                    raise UnsoundDesignError(f"the code '{body.region}' is not written in XABSL")
                self._keep_comments(piece, piece.node.actions)
                yield from piece.node.actions

    def _call(self, call: CallComponent) -> tree.Call:
        name, kind, interface = self.vocabulary.callee(self.components[call.alias])
        names = {each.name: plain_name(each) for each in interface.parameters}
        given = [tree.Argument(tree.Name(names[each]), self.speller.spell(value)) for each, value in call.arguments]
        given += self.vocabulary.left_out(interface.parameters, [each for each, _value in call.arguments])
        return tree.Call(tree.Name(name), tree.Arguments(given), kind)

    def _note(self, node: tree.Node, words: str) -> None:
        self.remarks += remark(node, words)

    def _keep_comments(self, piece: Piece[tree.Actions], actions: Sequence[tree.Action]) -> None:
        """Comments of hand-written code stay at the actions that they stand before, or behind."""
        for token, comments in piece.comments.items():
            following = next((each for each in actions if each.at >= token), None)
            for comment in comments:
                is_behind = bool(actions) and (following is None or not comment.own_line)
                before = [each for each in actions if each.to < token]
                node = before[-1] if is_behind and before else following
                if node is not None:
                    self.remarks.append(Remark(node, comment, is_behind=is_behind and bool(before)))
