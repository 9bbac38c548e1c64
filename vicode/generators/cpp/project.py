"""Writes the files that the components of a project share."""

from collections.abc import Iterable, Iterator

from vicode.generators.cpp.component import break_list, declare_value, visits
from vicode.generators.cpp.expression_printer import ExpressionPrinter, format_number
from vicode.generators.cpp.names import (
    GlobalNames,
    element_name,
    escape,
    integer_type,
    library,
    member_name,
    world_name,
)
from vicode.generators.cpp.text import describe, doc_comment, quoted
from vicode.generators.cpp.views import CppEnumerationView, CppInterfaceView, ProjectView
from vicode.generators.plan import (
    INTERFACES_MODULE,
    FunctionPlan,
    InterfacePlan,
    ProjectPlan,
    ValuePlan,
    plan_interface,
)
from vicode.model.expressions import INT, FunctionCall, Variable, walk
from vicode.model.names import python_attribute_name, snake_case
from vicode.model.project import WORLD, Enumeration, Interface

_STRUCT_MEMBERS = frozenset({"add_inputs_to", "root", "world"})
"""Names in the struct of all components that no component has."""


def build_declarations(plan: ProjectPlan, names: GlobalNames) -> ProjectView:
    printer = ExpressionPrinter(names=names, ranges=plan.ranges, nonzero_constants=plan.nonzero_constants)
    return ProjectView(
        package=plan.package.name,
        namespace=names.namespace,
        title=f"Enumerations and constants of the project {plan.name}.",
        doc=(),
        enumerations=tuple(_enumeration(item, names) for item in plan.enumerations),
        constants=tuple(_constants(plan, printer)),
    )


def build_interfaces(plan: ProjectPlan, names: GlobalNames) -> ProjectView:
    """The components without a design: abstract classes of hand-written ones, and what the world provides."""
    interfaces = [plan_interface(plan.project, item) for item in list_interfaces(plan)]
    uses_world = any(item.implementation == WORLD for item in interfaces)
    return ProjectView(
        package=plan.package.name,
        namespace=names.namespace,
        title=f"Components of the project {plan.name} that have no design.",
        doc=(),
        has_declarations=plan.package.has_declarations,
        world=tuple(_world(interfaces, names)) if uses_world else (),
        interfaces=tuple(_interface(plan, item, names) for item in interfaces),
    )


def build_components(plan: ProjectPlan, names: GlobalNames) -> ProjectView:
    """The struct with one instance of each component; it takes hand-written ones as references."""
    interfaces = {item.component: item for item in list_interfaces(plan)}
    abstract = [item.component for item in interfaces.values() if not item.is_generated]
    needs_world = any(item.implementation == WORLD for item in interfaces.values())
    own = [item.component for item in interfaces.values() if item.is_generated]
    members = component_members(plan)
    inner = names.inside({*members.values(), *(f"{members[each]}_" for each in abstract), *_STRUCT_MEMBERS})
    uses = {item.component: [use.component for use in item.uses] for item in plan.components}
    ordered = [*own, *_in_order_of_use(uses)]
    parameters = ["bica::Root& root", *(["World& world"] if needs_world else [])]
    parameters += [f"{inner.class_name(component)}& {members[component]}_" for component in abstract]
    initializers = []
    for component in ordered:
        arguments = ["root"]
        if component in interfaces:
            arguments += ["world"] if interfaces[component].implementation == WORLD else []
        else:
            arguments += [f"{members[use]}_" if use in abstract else members[use] for use in uses[component]]
        initializers.append(f"{members[component]}({', '.join(arguments)})")
    return ProjectView(
        package=plan.package.name,
        namespace=names.namespace,
        title=f"The components of the project {plan.name}.",
        doc=tuple(doc_comment(plan.doc)),
        includes=tuple(_component_headers(plan)),
        components=tuple(f"    {inner.class_name(each)} {members[each]};" for each in ordered),
        constructor=tuple(break_list("    ", "Components(", parameters, ")")),
        initializers=tuple(initializers),
        is_live=plan.project.live,
        sources=tuple(f"{item.module}.cpp" for item in plan.components),
        library=library(plan.package),
        inputs=tuple(members[component] for component in own if interfaces[component].readable),
    )


def _component_headers(plan: ProjectPlan) -> Iterator[str]:
    # No design may use a hand-written component.
    if list_interfaces(plan):
        yield f"{plan.package.name}/{INTERFACES_MODULE}.hpp"
    yield from (f"{plan.package.name}/{item.module}.hpp" for item in plan.components)


def component_members(plan: ProjectPlan) -> dict[str, str]:
    """The members of the struct of all components; `_` behind one is its argument, which no other member hides."""
    interfaces = list_interfaces(plan)
    abstract = [item.component for item in interfaces if not item.is_generated]
    own = [item.component for item in interfaces if item.is_generated]
    taken = set(_STRUCT_MEMBERS)
    members = {}
    for component in (*abstract, *own, *plan.package.modules):
        base = member = escape(snake_case(component))
        number = 1
        while taken & {member.casefold(), f"{member}_".casefold()}:
            number += 1
            member = f"{base.rstrip('_')}_{number}"
        taken |= {member.casefold(), f"{member}_".casefold()}
        members[component] = member
    return members


def list_interfaces(plan: ProjectPlan) -> list[Interface]:
    designs = {design.component for design in plan.project.designs}
    return [item for item in plan.project.components if item.component not in designs]


def _frequency(plan: ProjectPlan, component: str) -> float | None:
    interface = plan.project.interface(component)
    return interface.frequency_hz if interface else None


def _in_order_of_use(uses: dict[str, list[str]]) -> list[str]:
    """Used components before those that use them."""
    ordered: dict[str, None] = {}

    def add(component: str) -> None:
        if component in ordered or component not in uses:
            return
        for used in uses[component]:
            add(used)
        ordered[component] = None

    for component in uses:
        add(component)
    return list(ordered)


def _enumeration(item: Enumeration, names: GlobalNames) -> CppEnumerationView:
    name = names.declared(item.name)
    elements = [
        line for element, doc in item.elements for line in (*doc_comment(doc, 4), f"    {element_name(element)},")
    ]
    cases = [
        line
        for element in item.element_names
        for line in (f"        case {name}::{element_name(element)}:", f"            return {quoted(element)};")
    ]
    return CppEnumerationView(
        name=name,
        type=integer_type(len(item.elements)),
        doc=tuple(doc_comment(item.doc)),
        elements=tuple(elements),
        cases=tuple(cases),
    )


def _constants(plan: ProjectPlan, printer: ExpressionPrinter) -> Iterator[str]:
    """The constants; with BICA_LIVE, tunable ones are variables, so that no `constexpr` can depend on them."""
    tunable = {each.name for each in plan.project.constants if each.tunable}
    variable: set[str] = set()
    for constant in plan.constants:
        depends = {node.name for node in walk(constant.initial) if isinstance(node, Variable)} & variable
        variable |= {constant.name} if constant.name in tunable or depends else set()
        is_tunable = constant.name in tunable
        yield from _constant(
            constant, printer, "BICA_TUNABLE" if is_tunable else "BICA_FROM_TUNABLE" if depends else ""
        )


def _constant(constant: ValuePlan, printer: ExpressionPrinter, live: str) -> Iterator[str]:
    is_constexpr = not any(isinstance(node, FunctionCall) for node in walk(constant.initial))
    value = printer.stored(constant.initial).text
    is_constexpr = is_constexpr and "bica::" not in value
    yield from doc_comment(describe(constant))
    type_ = printer.names.type_name(constant.type)
    specifier = (live or "inline constexpr") if is_constexpr else "inline const"
    yield f"{specifier} {type_} {printer.names.declared(constant.name)} = {value};"


def _interface(plan: ProjectPlan, item: InterfacePlan, names: GlobalNames) -> CppInterfaceView:
    frequency = _frequency(plan, item.component)
    is_world = item.implementation == WORLD
    is_abstract = item.implementation not in ("", "internal", WORLD)
    values = list(item.stored_values)
    declared = (*values, *item.outputs, *item.variables, *_results(item))
    inner = names.inside(member_name(value.name) for value in declared)
    printer = ExpressionPrinter(names=inner, ranges=plan.ranges)
    readable = [*item.outputs, *item.variables]
    stored, inputs = ([], readable) if is_world else (readable, [])
    hidden = {value.name for value in stored}
    shown = [value for value in item.parameters if value.name not in hidden]
    return CppInterfaceView(
        name=names.class_name(item.component),
        title=item.component,
        doc=tuple(doc_comment(item.doc or f"The component {item.component}.")),
        is_abstract=is_abstract,
        uses_world=is_world,
        frequency=format_number(float(frequency)) if frequency else "",
        parameters=tuple(line for value in item.parameters for line in declare_value(value, printer, inner, 8)),
        members=tuple(line for value in stored for line in declare_value(value, printer, inner, 4)),
        functions=tuple(_world_functions(item, inner) if is_world else _functions(item, inner, printer, is_abstract)),
        visits=tuple(f"        {line}" for line in (*visits(shown, "parameters."), *visits(stored))),
        parameter_visits=tuple(f"        {line}" for line in visits(item.parameters, "parameters.")),
        input_visits=tuple(f"        {line}" for line in visits(inputs, call="()")),
    )


def _functions(item: InterfacePlan, names: GlobalNames, printer: ExpressionPrinter, is_abstract: bool) -> Iterator[str]:
    for function in item.functions:
        yield from doc_comment(describe(function.result), 4)
        head = f"{names.type_name(function.result.type)} {member_name(function.result.name)}"
        if is_abstract:
            yield f"    virtual {head}({_arguments(function, names)}) = 0;"
        else:
            unnamed = ", ".join(names.type_name(argument.type) for argument in function.arguments)
            initial = printer.stored(function.result.initial).text
            yield f"    virtual {head}({unnamed}) {{ return {initial}; }}"
    if is_abstract:
        yield "    void work() override = 0;"


def _world_functions(item: InterfacePlan, names: GlobalNames) -> Iterator[str]:
    for value in (*item.outputs, *item.variables):
        yield from doc_comment(describe(value), 4)
        type_ = names.type_name(value.type)
        read = _limited(value, f"world_.{world_name(value)}()")
        yield f"    {type_} {member_name(value.name)}() const {{ return {read}; }}"
    for value in item.variables:
        type_ = names.type_name(value.type)
        yield f"    void set_{member_name(value.name)}({type_} value) {{ world_.set_{world_name(value)}(value); }}"
    for function in item.functions:
        yield from doc_comment(describe(function.result), 4)
        passed = ", ".join(member_name(argument.name) for argument in function.arguments)
        type_, name = names.type_name(function.result.type), member_name(function.result.name)
        call = _limited(function.result, f"world_.{world_name(function.result)}({passed})")
        yield f"    {type_} {name}({_arguments(function, names)}) const {{ return {call}; }}"
    if item.is_behavior:
        passed = ", ".join(f"parameters.{member_name(value.name)}" for value in item.parameters)
        yield f"    void work() override {{ world_.{world_behavior_name(item)}({passed}); }}"


def _limited(value: ValuePlan, read: str) -> str:
    return f"bica::limit({read})" if value.type == INT else read


def _arguments(function: FunctionPlan, names: GlobalNames) -> str:
    return ", ".join(f"{names.type_name(value.type)} {member_name(value.name)}" for value in function.arguments)


def world_behavior_name(item: InterfacePlan) -> str:
    return escape(python_attribute_name(item.xabsl_name or snake_case(item.component)))


def _world(interfaces: Iterable[InterfacePlan], names: GlobalNames) -> Iterator[str]:
    """The pure virtual methods of the world; components may share one."""
    provided = [item for item in interfaces if item.implementation == WORLD]
    methods = (each for item in provided for each in (*item.outputs, *item.variables, *_results(item)))
    names = names.inside(map(world_name, methods))
    declared: set[str] = set()
    for item in provided:
        for declaration, doc in _world_methods(item, names):
            if declaration not in declared:
                declared.add(declaration)
                yield from doc_comment(doc, 4)
                yield f"    virtual {declaration} = 0;"


def _results(item: InterfacePlan) -> tuple[ValuePlan, ...]:
    return tuple(function.result for function in item.functions)


def _world_methods(item: InterfacePlan, names: GlobalNames) -> Iterator[tuple[str, str]]:
    for value in (*item.outputs, *item.variables):
        yield f"{names.type_name(value.type)} {world_name(value)}()", describe(value)
    for value in item.variables:
        yield f"void set_{world_name(value)}({names.type_name(value.type)} value)", ""
    for function in item.functions:
        head = f"{names.type_name(function.result.type)} {world_name(function.result)}"
        yield f"{head}({_arguments(function, names)})", describe(function.result)
    if item.is_behavior:
        parameters = ", ".join(f"{names.type_name(value.type)} {member_name(value.name)}" for value in item.parameters)
        yield f"void {world_behavior_name(item)}({parameters})", item.doc
