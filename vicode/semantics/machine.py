"""The components of a root and what is constant about them: declarations, periods, parsed expressions."""

from collections.abc import Mapping
from dataclasses import dataclass

from vicode.model.design import Action, Call, Code, Decision, DecisionGroup, Declaration, Design, State, Transition
from vicode.model.expressions import Expr, Scope, build_scope, is_type_only, parse_expression
from vicode.model.portable_code import NotPortable, PortableStatement, Role, parse_portable
from vicode.model.project import INTERNAL, MISSING, REMOTE, Interface, Project
from vicode.semantics.evaluation import evaluate
from vicode.semantics.values import Value, stored, zero

_NS_PER_UNIT = {"": 1e9, "s": 1e9, "ms": 1e6}


class NotInterpretableError(ValueError):
    """A design has errors, or a part without a meaning in the semantics, such as hand-written code."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Machine:
    """One component; `design` is None if it only provides values.

    Attributes:
        uses: The used components by alias.
        types: The types of the values that it holds: outputs, variables and parameters. A component that is written by
            hand, or provided by the world, holds no parameters, which may be named like its outputs.
        initial: These values when the component is created, and the constants of the project.
        parameter_types: The types of its parameters.
        defaults: The values of parameters that a call omits.
        functions: The values of outputs with arguments as long as nothing else provides them.
        period_ns: The period, 0 without `frequency`.
    """

    interface: Interface
    design: Design | None
    scope: Scope
    uses: Mapping[str, str]
    types: Mapping[str, str]
    initial: Mapping[str, Value]
    parameter_types: Mapping[str, str]
    defaults: Mapping[str, Value]
    functions: Mapping[str, Value]
    period_ns: int

    @property
    def has_xabsl_rules(self) -> bool:
        return self.design is not None and self.design.arithmetic == "xabsl"

    @property
    def ns_per_unit(self) -> float:
        """Nanoseconds of the unit in which expressions and timers give times."""
        return _NS_PER_UNIT[self.design.time_unit if self.design else ""]

    @property
    def holds_parameters(self) -> bool:
        return _holds_parameters(self.interface, self.design)

    @property
    def is_shared_memory(self) -> bool:
        return self.interface.implementation == INTERNAL

    def state(self, name: str) -> State:
        state = self.design.state(name) if self.design else None
        if state is None:
            raise NotInterpretableError(f"{self.interface.component} has no state '{name}'")
        return state

    def argument_types(self, output: str) -> Mapping[str, str]:
        """The types of the arguments of an output."""
        declared = self.interface.output(output)
        return {each.name: self.scope.type_of(each) for each in (declared.arguments if declared else None) or ()}

    def tree(self, text: str, expected: str | None) -> Expr:
        parsed = parse_expression(text, self.scope, expected)
        if parsed.tree is None or parsed.diagnostics:
            raise NotInterpretableError(f"{self.interface.component}: '{text}' is no valid expression")
        return parsed.tree

    def statements(self, code: Code, role: Role) -> tuple[PortableStatement, ...]:
        """Return hand-written Python as statements."""
        text = code.in_language("python")
        if text is None:
            raise NotInterpretableError(f"{self.interface.component}: hand-written code is not in Python")
        found = parse_portable(text, role, self.scope)
        if isinstance(found, NotPortable):
            raise NotInterpretableError(f"{self.interface.component}: {found.reason}")
        return found

    def called_designs(self, state: State, machines: Mapping[str, "Machine"]) -> tuple[str, ...]:
        """The designs that a state calls, in its own or in common actions."""
        common: tuple[Action, ...] = self.design.common.actions if self.design else ()
        called = (self.uses[each.alias] for each in (*common, *state.all_actions) if isinstance(each, Call))
        return tuple(name for name in dict.fromkeys(called) if machines[name].design is not None)

    def is_enabled(self, item: Decision) -> bool:
        """Whether a decision has an effect: it and its target are not disabled, and a group is not empty."""
        match item:
            case _ if item.disabled:
                return False
            case Transition(to=to):
                return not self.state(to).disabled
            case DecisionGroup(then=then, otherwise=otherwise):
                return any(map(self.is_enabled, (*then, *otherwise)))
            case _:
                return True


def build_machines(project: Project, root: str) -> dict[str, Machine]:
    """Build the machines of a component and of all that it uses, by name.

    Raises:
        NotInterpretableError: A component is unknown, has errors, or belongs to another robot.
    """
    constants = _evaluate_constants(project)
    machines: dict[str, Machine] = {}
    waiting = [root]
    while waiting:
        name = waiting.pop()
        if name not in machines:
            machines[name] = _build_machine(project, name, constants)
            waiting += machines[name].uses.values()
    return machines


def _build_machine(project: Project, name: str, constants: Mapping[str, Value]) -> Machine:
    interface, design = project.interface(name), project.design(name)
    if interface is None or interface.implementation == REMOTE or interface.remote is not None:
        raise NotInterpretableError(f"the component '{name}' is not part of this robot")
    scope = build_scope(project, design)
    variables = design.variables if design else interface.variables
    parameters = interface.parameters if _holds_parameters(interface, design) else ()
    held = (*parameters, *interface.outputs, *variables)
    declared = [each for each in held if each.arguments is None]
    hertz = design.frequency_hz if design else None if interface.is_generated else interface.frequency_hz
    initial = design.state(design.initial) if design else None
    if design is not None and (initial is None or initial.disabled):
        raise NotInterpretableError(f"{name} has no initial state")
    return Machine(
        interface=interface,
        design=design,
        scope=scope,
        uses={use.alias: use.component for use in design.uses} if design else {},
        types={each.name: scope.type_of(each) for each in declared},
        initial={**constants, **{each.name: _initial(each, scope, constants) for each in declared}},
        parameter_types={each.name: scope.type_of(each) for each in interface.parameters},
        defaults={each.name: _initial(each, scope, constants) for each in interface.parameters},
        functions={each.name: _initial(each, scope, constants) for each in interface.outputs if each.arguments},
        period_ns=round(1e9 / hertz) if hertz else 0,
    )


def _evaluate_constants(project: Project) -> dict[str, Value]:
    """Constants in their order; each may use those before it."""
    values: dict[str, Value] = {}
    scope = build_scope(project, None)
    for constant in project.constants:
        values[constant.name] = _initial(constant, scope, values)
    return values


def _initial(declaration: Declaration, scope: Scope, constants: Mapping[str, Value]) -> Value:
    type_ = scope.type_of(declaration)
    if not declaration.initial or is_type_only(declaration, scope):
        return zero(type_, tuple(scope.enumerations.get(type_, ())))
    parsed = parse_expression(declaration.initial, scope, type_)
    if parsed.tree is None or parsed.diagnostics:
        raise NotInterpretableError(f"'{declaration.name}' has an invalid value")
    return stored(evaluate(parsed.tree, type_, constants), type_)


def _holds_parameters(interface: Interface, design: Design | None) -> bool:
    return design is not None or interface.implementation in (INTERNAL, MISSING)
