"""Designs with the expressions of XABSL: for a behavior that was written in XABSL, pages show what its team wrote."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from vicode.docsite.build_cache import BuildCache, compute_digest
from vicode.docsite.page_inputs import strip_to_interfaces
from vicode.generators.plan import UnsoundDesignError
from vicode.generators.plan.typed_expressions import typed_tree
from vicode.generators.xabsl.expression_builder import XabslExpressionBuilder
from vicode.generators.xabsl.name_map import XabslNameMap
from vicode.model.design import (
    COMMON,
    Action,
    Assign,
    Call,
    CommonSection,
    Decision,
    DecisionGroup,
    Declaration,
    Design,
    Guard,
    State,
)
from vicode.model.expressions import BOOL, FLOAT, build_scope
from vicode.model.project import Project
from vicode.model.xabsl.names import symbol_name
from vicode.model.xabsl.unsupported import is_done_expressible
from vicode.xabsl.printer import print_node
from vicode.xabsl.tree import BinaryNode


def with_xabsl_expressions(project: Project, memory: BuildCache) -> Project:
    """The project with the expressions of XABSL in all designs.

    An expression that XABSL cannot express stays as it is. Names of components, states and calls do not change.
    """
    name_map, shared = XabslNameMap(project), compute_digest(strip_to_interfaces(project))
    designs = (
        memory.get_or_create("wording", (design, shared), partial(_translate_design, project, design, name_map))
        for design in project.designs
    )
    return replace(project, designs=tuple(designs))


def _translate_design(project: Project, design: Design, name_map: XabslNameMap) -> Design:
    return _ExpressionTranslator(project, design, name_map).design()


class _ExpressionTranslator:
    """Translates the expressions of one design."""

    def __init__(self, project: Project, design: Design, name_map: XabslNameMap) -> None:
        self._design, self._scope = design, build_scope(project, design)
        self._components = {"": design.component, **{use.alias: use.component for use in design.uses}}
        self._builder = XabslExpressionBuilder(
            name_map=name_map,
            components=self._components,
            time_unit=design.time_unit or "s",
            uses_xabsl_arithmetic=design.arithmetic == "xabsl",
            can_use_action_done=partial(is_done_expressible, project, design),
        )

    def design(self) -> Design:
        design, common = self._design, self._design.common
        return replace(
            design,
            parameters=self._declarations(design.parameters),
            outputs=self._declarations(design.outputs),
            variables=self._declarations(design.variables),
            common=CommonSection(
                doc=common.doc,
                at=common.at,
                actions=self._actions(common.actions),
                transitions=self._decisions(common.transitions, COMMON),
            ),
            states=tuple(map(self._state, design.states)),
        )

    def _state(self, state: State) -> State:
        return replace(
            state,
            enter=self._actions(state.enter),
            actions=self._actions(state.actions),
            leave=self._actions(state.leave),
            modulates=tuple(map(self._call, state.modulates)),
            transitions=self._decisions(state.transitions, state.name),
        )

    def _declarations(self, declarations: Sequence[Declaration]) -> tuple[Declaration, ...]:
        return tuple(
            replace(each, initial=self._text(each.initial, self._scope.type_of(each))) if each.initial else each
            for each in declarations
        )

    def _decisions(self, decisions: Sequence[Decision], state: str) -> tuple[Decision, ...]:
        return tuple(self._decision(each, state) for each in decisions)

    def _decision(self, decision: Decision, state: str) -> Decision:
        guard = self._guard(decision.guard, state)
        if isinstance(decision, DecisionGroup):
            then, otherwise = (self._decisions(each, state) for each in (decision.then, decision.otherwise))
            return replace(decision, guard=guard, then=then, otherwise=otherwise)
        return replace(decision, guard=guard)

    def _guard(self, guard: Guard, state: str) -> Guard:
        when = self._text(guard.when, BOOL, state, is_operand=bool(guard.after)) if guard.when else ""
        return replace(guard, when=when, after=self._text(guard.after, FLOAT) if guard.after else "")

    def _actions(self, actions: Sequence[Action]) -> tuple[Action, ...]:
        return tuple(map(self._action, actions))

    def _action(self, action: Action) -> Action:
        match action:
            case Assign(values=values):
                return Assign(values=tuple(self._assignment(name, text) for name, text in values))
            case Call():
                return self._call(action)
            case _:
                return action

    def _assignment(self, name: str, text: str) -> tuple[str, str]:
        declaration = self._scope.find_assignable(name)
        if declaration is None:
            return name, text
        component = self._components.get(name.rpartition(".")[0], "")
        return symbol_name(component, declaration), self._text(text, self._scope.type_of(declaration))

    def _call(self, call: Call) -> Call:
        interface = self._scope.uses.get(call.alias)
        declared = {each.name: each for each in interface.parameters} if interface else {}
        return replace(
            call,
            arguments=tuple(
                (name, self._text(text, self._scope.type_of(declared[name])) if name in declared else text)
                for name, text in call.arguments
            ),
        )

    def _text(self, text: str, expected: str, state: str = "", *, is_operand: bool = False) -> str:
        """The expression in XABSL; an operand of && with a lower precedence gets parentheses."""
        try:
            node = self._builder.build(typed_tree(text, self._scope, expected), state)
        except (UnsoundDesignError, KeyError, StopIteration):
            return text
        printed = " ".join(print_node(node).split())
        return f"({printed})" if is_operand and isinstance(node, BinaryNode) and node.operator == "||" else printed
