"""Build the option of a component; design elements without XABSL syntax become comments."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

from vicode.findings import DesignPath
from vicode.generators.plan import (
    ActionStep,
    AssignStep,
    CallStep,
    CodeStep,
    ComponentPlan,
    DecisionPlan,
    NoChange,
    StatePlan,
    UnsoundDesignError,
)
from vicode.generators.xabsl.decisions import DecisionTreeBuilder, can_be_common_decision
from vicode.generators.xabsl.expression_builder import XabslExpressionBuilder
from vicode.generators.xabsl.name_map import XabslNameMap
from vicode.generators.xabsl.option_printer import AttachedComment, attach_comment, wrap_description
from vicode.generators.xabsl.symbols import format_range
from vicode.model.design import COMMON, Declaration
from vicode.model.xabsl.names import component_name, unqualified_name
from vicode.model.xabsl.unsupported import find_unsupported_in_design, is_done_expressible
from vicode.xabsl import tree
from vicode.xabsl.embedded_code import EmbeddedCode, parse_embedded_actions

_STAY_ONLY = (DecisionPlan(conditions=(), outcome=NoChange()),)


@dataclass(frozen=True, slots=True)
class GeneratedOption:
    """An option with comments at its nodes and the design paths of its nodes."""

    option: tree.OptionNode
    comments: tuple[AttachedComment, ...]
    node_paths: tuple[tuple[tree.SyntaxNode, DesignPath], ...]


def build_option(plan: ComponentPlan, name_map: XabslNameMap | None = None) -> GeneratedOption:
    """Build the option of a component.

    Args:
        plan: The plan of the component.
        name_map: The names of the project, to share them between options.

    Raises:
        UnsoundDesignError: XABSL cannot express the design.
    """
    unsupported = next(find_unsupported_in_design(plan.project, plan.design), None)
    if unsupported is not None:
        raise UnsoundDesignError(unsupported.message)
    return _OptionBuilder(plan, name_map or XabslNameMap(plan.project)).build()


class _OptionBuilder:
    """Builds one option; its parts share names."""

    def __init__(self, plan: ComponentPlan, name_map: XabslNameMap) -> None:
        self.plan, self.design, self.name_map = plan, plan.design, name_map
        self.components = {"": plan.component, **{use.alias: use.component for use in plan.uses}}
        self.state_names = {state.name: unqualified_name(state) for state in self.design.states}
        self.expressions = XabslExpressionBuilder(
            name_map=self.name_map,
            components=self.components,
            time_unit=plan.time_unit,
            uses_xabsl_arithmetic=plan.arithmetic == "xabsl",
            can_use_action_done=partial(is_done_expressible, plan.project, self.design),
        )
        self.decisions = DecisionTreeBuilder(self.expressions, self.state_names.__getitem__)
        self.comments: list[AttachedComment] = []
        self.node_paths: list[tuple[tree.SyntaxNode, DesignPath]] = []

    def build(self) -> GeneratedOption:
        plan = self.plan
        common: tree.DecisionTreeNode | None = None
        actions: tree.ActionBlockNode | None = None
        if can_be_common_decision(plan.common_decisions):
            common = self.decisions.build_open(plan.common_decisions, COMMON)
            self.node_paths.append((common, ("common", "transitions")))
        if plan.common_actions:
            actions = self._actions(plan.common_actions, ("common", "actions"))
        planned = {state.name: state for state in plan.states}
        states = [self._state(planned[state.name], has_common=common is not None) for state in self.design.states]
        option = tree.OptionNode(
            tree.NameNode(component_name(self.design)),
            [self._parameter(declared) for declared in self.design.parameters],
            states,
            common,
            actions,
            wrap_description(plan.doc, 0),
        )
        self._add_comment(common or actions or states[0], self.design.common.doc)
        comments = [
            *self.comments,
            *(line for node, doc in self.decisions.unplaced_docs for line in attach_comment(node, doc)),
        ]
        return GeneratedOption(option, tuple(comments), (*self.node_paths, *self.decisions.node_paths))

    def _parameter(self, declared: Declaration) -> tree.ParameterNode:
        type_ = self.name_map.type_of(declared)
        is_number = type_.text == "float"
        return tree.ParameterNode(
            tree.NameNode(f"@{unqualified_name(declared)}"),
            type_,
            format_range(declared) if is_number else "",
            wrap_description(declared.unit, 1).replace('"', "'") if is_number else "",
            wrap_description(declared.doc, 1),
        )

    def _state(self, plan: StatePlan, *, has_common: bool) -> tree.StateNode:
        state = tree.StateNode(
            tree.NameNode(self.state_names[plan.name]),
            tree.ActionBlockNode([]),
            self._decision(plan, has_common=has_common),
            is_initial=plan is self.plan.states[0],
            is_target=plan.final,
        )
        if plan.capacity is not None:
            state.cooperation, state.robots = "capacity", str(plan.capacity)
        elif plan.synchronized is not None:
            state.cooperation, state.robots = "synchronized", str(plan.synchronized or "")
        self.node_paths.append((state, ("states", plan.name)))
        state.actions = self._actions(plan.actions, ("states", plan.name, "actions"))
        self._add_comment(state, plan.doc)
        return state

    def _decision(self, plan: StatePlan, *, has_common: bool) -> tree.DecisionNode | None:
        own = () if plan.decisions == _STAY_ONLY else plan.decisions
        common: Sequence[DecisionPlan] = () if has_common else self.plan.common_decisions
        if not own and not common:
            return None
        node = self.decisions.build_complete(
            [*((COMMON, decision) for decision in common), *((plan.name, decision) for decision in own)]
        )
        if not has_common:
            return tree.DecisionNode(node)
        return tree.DecisionNode(node, begins_with_else=True, else_doc=self.decisions.pop_else_doc(node))

    def _actions(self, steps: Sequence[ActionStep], path: DesignPath) -> tree.ActionBlockNode:
        actions = tree.ActionBlockNode([action for step in steps for action in self._step(step)])
        if steps:
            self.node_paths.append((actions, path))
        return actions

    def _step(self, step: ActionStep) -> Iterator[tree.ActionNode]:
        match step:
            case AssignStep(name=name, value=value, alias=alias):
                symbol = self.name_map.symbol_name(self.components[alias], name)
                yield tree.AssignmentNode(tree.NameNode(symbol), self.expressions.build(value))
            case CallStep():
                yield self._call(step)
            case CodeStep(code=body):
                text = body.code.in_language("xabsl")
                embedded = parse_embedded_actions(text or "")
                if text is None or embedded.node is None or embedded.diagnostics:
                    raise UnsoundDesignError(f"the code '{body.region_id}' is not written in XABSL")
                self._keep_comments(embedded, embedded.node.actions)
                yield from embedded.node.actions

    def _call(self, call: CallStep) -> tree.CallNode:
        name, kind, interface = self.name_map.callee(self.components[call.alias])
        names = {parameter.name: unqualified_name(parameter) for parameter in interface.parameters}
        arguments = [
            tree.ArgumentNode(tree.NameNode(names[key]), self.expressions.build(value)) for key, value in call.arguments
        ]
        arguments += self.name_map.missing_arguments(interface.parameters, [key for key, _value in call.arguments])
        return tree.CallNode(tree.NameNode(name), tree.ArgumentListNode(arguments), kind)

    def _add_comment(self, node: tree.SyntaxNode, text: str) -> None:
        self.comments += attach_comment(node, text)

    def _keep_comments(self, embedded: EmbeddedCode[tree.ActionBlockNode], actions: Sequence[tree.ActionNode]) -> None:
        """Attach the comments of hand-written code to the following or preceding action."""
        for token, comments in embedded.comments.items():
            following = next((action for action in actions if action.first_token >= token), None)
            for comment in comments:
                is_behind = bool(actions) and (following is None or not comment.own_line)
                before = [action for action in actions if action.last_token < token]
                node = before[-1] if is_behind and before else following
                if node is not None:
                    self.comments.append(AttachedComment(node, comment, is_behind=is_behind and bool(before)))
