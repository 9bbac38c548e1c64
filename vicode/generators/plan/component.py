"""Plan the component of a design."""

from collections.abc import Mapping
from dataclasses import replace

from vicode.findings import DesignPath
from vicode.generators.plan.code import CodePlanner
from vicode.generators.plan.int_growth import plan_int_ranges
from vicode.generators.plan.plan_types import (
    ActionStep,
    AssignStep,
    Branch,
    CallStep,
    CodeCondition,
    CodeStep,
    ComponentPlan,
    Condition,
    DecisionPlan,
    ExpressionCondition,
    FunctionPlan,
    NoChange,
    StateChange,
    StatePlan,
    TimerCondition,
    UsedComponent,
    ValuePlan,
)
from vicode.generators.plan.typed_expressions import (
    UnsoundDesignError,
    initial_value,
    literal_nanoseconds,
    typed_tree,
)
from vicode.generators.plan.unique_identifiers import NameAllocator
from vicode.model.design import (
    COMMON,
    Action,
    Assign,
    Call,
    Decision,
    DecisionGroup,
    Declaration,
    Design,
    RunCode,
    State,
    Stay,
    Transition,
)
from vicode.model.disabled import strip_disabled
from vicode.model.expressions import BOOL, FLOAT, Expr, Scope, build_scope
from vicode.model.names import identifier_stem
from vicode.model.project import WORLD, Project
from vicode.model.traversal import is_exhaustive, iter_expressions


def plan_component(project: Project, design: Design, modules: Mapping[str, str], source: str) -> ComponentPlan:
    """Plan everything about a component that does not depend on the language.

    Args:
        project: The project of the design.
        design: A design without errors.
        modules: The module name of every design, by component.
        source: The design file as shown in generated headers; may be empty.

    Raises:
        UnsoundDesignError: The design has errors.
    """
    design = strip_disabled(design)
    initial = design.state(design.initial)
    if initial is None:
        raise UnsoundDesignError(f"{design.component} has no initial state")
    planner = _ComponentPlanner(project, design)
    stems = NameAllocator()
    states = [initial, *(state for state in design.states if state is not initial)]
    plan = ComponentPlan(
        project=project,
        design=design,
        component=design.component,
        module=modules[design.component],
        source=source,
        doc=design.doc,
        frequency_hz=design.frequency_hz,
        resume=design.resume,
        time_unit=design.time_unit or "s",
        arithmetic=design.arithmetic,
        uses_action_done=planner.uses_action_done(),
        uses=tuple(_plan_use(project, modules, use.alias, use.component) for use in design.uses),
        parameters=plan_values(design.parameters, planner.scope),
        outputs=plan_values(design.outputs, planner.scope),
        variables=plan_values(design.variables, planner.scope),
        module_code=planner.code.plan_section("module", design.module),
        members=planner.code.plan_section("members", design.members),
        common_decisions=planner.plan_decisions(design.common.transitions, COMMON, ("common", "transitions")),
        common_actions=planner.plan_steps(design.common.actions, COMMON, "actions"),
        states=tuple(planner.plan_state(state, stems.allocate(identifier_stem(state.name))) for state in states),
    )
    return replace(plan, ranges=plan_int_ranges(plan, planner.scope))


def plan_values(declarations: tuple[Declaration, ...], scope: Scope) -> tuple[ValuePlan, ...]:
    """Plan the declarations that take no arguments."""
    return tuple(
        ValuePlan(
            name=declaration.name,
            type=scope.type_of(declaration),
            initial=initial_value(declaration, scope),
            unit=declaration.unit,
            range=declaration.range,
            doc=declaration.doc,
            xabsl_name=declaration.xabsl_name,
        )
        for declaration in declarations
        if declaration.arguments is None
    )


def plan_functions(declarations: tuple[Declaration, ...], scope: Scope) -> tuple[FunctionPlan, ...]:
    """Plan the declarations that take arguments."""
    return tuple(
        FunctionPlan(
            result=plan_values((replace(declaration, arguments=None),), scope)[0],
            arguments=plan_values(declaration.arguments, scope),
        )
        for declaration in declarations
        if declaration.arguments is not None
    )


def _plan_use(project: Project, modules: Mapping[str, str], alias: str, component: str) -> UsedComponent:
    interface = project.interface(component)
    if interface is None:
        raise UnsoundDesignError(f"the component '{component}' is not declared")
    scope = build_scope(project, None)
    functions = plan_functions(interface.readable, scope)
    parameters = plan_values(interface.parameters, scope)
    if component in modules:
        return UsedComponent(
            alias=alias, component=component, module=modules[component], parameters=parameters, functions=functions
        )
    module = INTERFACES_MODULE if interface.is_generated else ""
    return UsedComponent(
        alias=alias,
        component=component,
        module=module,
        implementation="" if module else interface.implementation,
        parameters=parameters,
        functions=functions,
        inputs=plan_values(interface.outputs, scope) if interface.implementation == WORLD else (),
    )


INTERFACES_MODULE = "interfaces"
"""The module of the generated components that have no design."""


class _ComponentPlanner:
    """Plans one design; its parts share a scope and a set of names."""

    def __init__(self, project: Project, design: Design) -> None:
        self.design = design
        self.scope, self.project_scope = build_scope(project, design), build_scope(project, None)
        self.code = CodePlanner(design)
        self.design_aliases = {use.alias for use in design.uses if _has_design(project, use.component)}

    def plan_state(self, state: State, stem: str) -> StatePlan:
        return StatePlan(
            name=state.name,
            stem=stem,
            doc=state.doc,
            final=state.final,
            requires=state.requires,
            enter=self.plan_steps(state.enter, state.name, "enter"),
            decisions=self._state_decisions(state),
            actions=self.plan_steps(state.all_actions, state.name, "actions"),
            leave=self.plan_steps(state.leave, state.name, "leave"),
            calls=self._called_designs(state),
            capacity=state.capacity,
            synchronized=state.synchronized,
        )

    def _state_decisions(self, state: State) -> tuple[DecisionPlan, ...]:
        planned = self.plan_decisions(state.transitions, state.name, ("states", state.name, "transitions"))
        is_cooperative = state.capacity is not None or state.synchronized is not None
        if not is_cooperative or any(is_exhaustive(item) for item in state.transitions):
            return planned
        # A robot that stays in a cooperative state must report it, even if the state has no transition.
        return (*planned, DecisionPlan(conditions=(), outcome=NoChange()))

    def uses_action_done(self) -> bool:
        """Whether an expression of the design contains `action_done`."""
        return any("action_done" in each.text for each in iter_expressions(self.design) if each.path[0] != "properties")

    def _called_designs(self, state: State) -> tuple[str, ...]:
        actions = (*self.design.common.actions, *state.all_actions)
        called = (action.alias for action in actions if isinstance(action, Call))
        return tuple(dict.fromkeys(alias for alias in called if alias in self.design_aliases))

    def plan_steps(self, actions: tuple[Action, ...], source: str, phase: str) -> tuple[ActionStep, ...]:
        owner: DesignPath = ("common",) if source == COMMON else ("states", source)
        return tuple(
            step
            for index, action in enumerate(actions)
            for step in self._plan_action(action, (*owner, phase, index), source, phase)
        )

    def _plan_action(self, action: Action, path: DesignPath, source: str, phase: str) -> tuple[ActionStep, ...]:
        match action:
            case Assign(values=values):
                return tuple(self._plan_set(name, text) for name, text in values)
            case Call(alias=alias, arguments=arguments):
                pairs = tuple((name, self._argument(alias, name, text)) for name, text in arguments)
                return (CallStep(alias=alias, arguments=pairs, defaults=self._defaults(alias, dict(pairs))),)
            case RunCode(code=code, id=given_id):
                return (CodeStep(code=self.code.plan_action(path, source, phase, code, given_id=given_id)),)

    def _plan_set(self, name: str, text: str) -> AssignStep:
        declaration = self.scope.find_assignable(name)
        if declaration is None:
            raise UnsoundDesignError(f"'{name}' is not declared")
        alias, _dot, own = name.rpartition(".")
        return AssignStep(name=own, value=typed_tree(text, self.scope, self.scope.type_of(declaration)), alias=alias)

    def _argument(self, alias: str, name: str, text: str) -> Expr:
        interface = self.scope.uses.get(alias)
        parameter = interface.parameter(name) if interface else None
        if parameter is None:
            raise UnsoundDesignError(f"'{alias}' has no parameter '{name}'")
        return typed_tree(text, self.scope, self.scope.type_of(parameter))

    def _defaults(self, alias: str, given: Mapping[str, Expr]) -> tuple[tuple[str, Expr], ...]:
        """Defaults of the omitted parameters of a hand-written component; `modulate` of a design supplies its own."""
        interface = self.scope.uses.get(alias)
        if interface is None or not interface.implementation:
            return ()
        omitted = (parameter for parameter in interface.parameters if parameter.name not in given)
        return tuple((parameter.name, initial_value(parameter, self.project_scope)) for parameter in omitted)

    def plan_decisions(
        self, decisions: tuple[Decision, ...], source: str, path: DesignPath
    ) -> tuple[DecisionPlan, ...]:
        planned: list[DecisionPlan] = []
        for index, decision in enumerate(decisions):
            alternative = self._plan_decision(decision, source, (*path, index))
            if isinstance(alternative.outcome, Branch) and not alternative.conditions:
                planned += alternative.outcome.then
            else:
                planned.append(alternative)
            # Decisions after an exhaustive one are unreachable.
            if is_exhaustive(decision):
                break
        return tuple(planned)

    def _plan_decision(self, decision: Decision, source: str, path: DesignPath) -> DecisionPlan:
        conditions = self._plan_conditions(decision, source, path)
        match decision:
            case DecisionGroup(then=then, otherwise=otherwise):
                outcome: StateChange | NoChange | Branch = Branch(
                    then=self.plan_decisions(then, source, (*path, "then")),
                    otherwise=self.plan_decisions(otherwise, source, (*path, "else")),
                    then_always_ends=any(is_exhaustive(item) for item in then),
                )
            case Transition(to=to, id=given_id) if to != source:
                outcome = StateChange(state=to, transition=given_id)
            case _:
                outcome = NoChange()
        return DecisionPlan(conditions=conditions, outcome=outcome, doc=decision.doc, id=decision.id, path=path)

    def _plan_conditions(self, decision: Decision, source: str, path: DesignPath) -> tuple[Condition, ...]:
        guard = decision.guard
        conditions: list[Condition] = []
        if guard.after:
            seconds = typed_tree(guard.after, self.scope, FLOAT)
            conditions.append(TimerCondition(time=seconds, ns=literal_nanoseconds(seconds, self.design.time_unit)))
        if guard.when:
            conditions.append(ExpressionCondition(expression=typed_tree(guard.when, self.scope, BOOL)))
        if guard.code is not None:
            outcome = _outcome_name(decision)
            body = self.code.plan_guard(path, source, outcome, guard.code, given_id=decision.id, doc=decision.doc)
            conditions.append(CodeCondition(code=body))
        return tuple(conditions)


def _has_design(project: Project, component: str) -> bool:
    """Whether a component has a design, here or in another process."""
    interface = project.interface(component)
    return project.design(component) is not None or (interface is not None and interface.remote is not None)


def _outcome_name(decision: Decision) -> str:
    match decision:
        case Transition(to=to):
            return to
        case Stay():
            return "stay"
        case DecisionGroup():
            return "group"
