"""Writes the driver of `vicode conform`: a program that runs a project on inputs from a file and writes traces."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from vicode.generators.cpp.names import GlobalNames, escape, member_name, world_name
from vicode.generators.cpp.project import component_members, list_interfaces, world_behavior_name
from vicode.generators.plan import FunctionPlan, InterfacePlan, ProjectPlan, ValuePlan, plan_interface, plan_project
from vicode.model.expressions import BOOL, FLOAT, INT
from vicode.model.names import package_name
from vicode.model.project import INTERNAL, WORLD, Project
from vicode.templating import read_asset, render

__all__ = ["driver_support", "write_driver", "write_main"]


@dataclass(frozen=True, slots=True, kw_only=True)
class StubView:
    """A class in place of a hand-written component: `functions` are the lines of its outputs with arguments."""

    name: str
    base: str
    member: str
    functions: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class DriverView:
    """The driver of one project; `setters` are statements that set the inputs, by their number."""

    package: str
    namespace: str
    sources: tuple[str, ...]
    world: tuple[str, ...]
    has_world: bool
    stubs: tuple[StubView, ...]
    arguments: str
    main: str
    shared: tuple[str, ...]
    setters: tuple[str, ...]


def write_driver(project: Project, root: str, inputs: Sequence[tuple[str, str]], reserved: frozenset[str]) -> str:
    """The driver of one project; it includes the sources, so that one compiler run is enough.

    Args:
        project: The project with its C++ code.
        root: The component to run.
        inputs: The inputs as pairs of component and name; the component of the root's parameters is "".
        reserved: Names that no generated module may have.

    Raises:
        UnsoundDesignError: A design has errors.
    """
    plan = plan_project(project, {design.component for design in project.designs}, {}, reserved)
    return render("conformance/driver.cpp.jinja", view=_DriverWriter(plan, root).build_view(inputs))


def write_main(drivers: Iterable[tuple[str, str, Project]]) -> str:
    """The main file for drivers, given by their file, the name of the run and the project."""
    named = tuple((file, name, package_name(project.name)) for file, name, project in drivers)
    return render("conformance/main.cpp.jinja", drivers=named)


def driver_support() -> str:
    """The header that drivers share."""
    return read_asset("conformance/driver.hpp")


class _DriverWriter:
    def __init__(self, plan: ProjectPlan, root: str) -> None:
        self._plan, self._root = plan, root
        self._names, self._members = GlobalNames.of_project(plan), component_members(plan)
        self._interfaces = {item.component: plan_interface(plan.project, item) for item in list_interfaces(plan)}
        self._methods = frozenset(name for item in self._interfaces.values() for name in _method_names(item))
        self._fields: dict[tuple[str, str], str] = {}

    def build_view(self, inputs: Sequence[tuple[str, str]]) -> DriverView:
        stubs = tuple(self._stub(item) for item in self._interfaces.values() if self._is_stub(item))
        has_world = any(item.implementation == WORLD for item in self._interfaces.values())
        used = {use.component for component in self._plan.components for use in component.uses}
        return DriverView(
            package=self._plan.package.name,
            namespace=self._names.namespace,
            sources=tuple(f"{component.module}.cpp" for component in self._plan.components),
            world=tuple(self._world_methods()),
            has_world=has_world,
            stubs=stubs,
            arguments=", ".join(["root", *(["world"] if has_world else []), *(stub.member for stub in stubs)]),
            main=self._members[self._root],
            shared=tuple(
                self._members[item.component]
                for item in self._interfaces.values()
                if item.implementation == INTERNAL and item.component in used
            ),
            setters=tuple(self._setter(*key) for key in inputs),
        )

    def _is_stub(self, item: InterfacePlan) -> bool:
        return item.implementation not in ("", INTERNAL, WORLD)

    def _stub(self, item: InterfacePlan) -> StubView:
        functions = (
            line
            for each in item.functions
            for line in self._function(item, each, f"{self._type(each.result)} {member_name(each.result.name)}")
        )
        return StubView(
            name=f"Stub{item.component}",
            base=self._class(item.component),
            member=f"stub_{self._members[item.component]}",
            functions=tuple(functions),
        )

    def _world_methods(self) -> Iterator[str]:
        """The members of the world; components may share them."""
        lines = (
            line for item in self._interfaces.values() if item.implementation == WORLD for line in self._world_of(item)
        )
        yield from dict.fromkeys(lines)

    def _world_of(self, item: InterfacePlan) -> Iterator[str]:
        for value in (*item.outputs, *item.variables):
            field, type_ = self._field(item, value), self._type(value)
            yield f"{type_} {field}{{}};"
            yield f"{type_} {world_name(value)}() override {{ return {field}; }}"
        for value in item.variables:
            setter = f"set_{world_name(value)}({self._type(value)} value)"
            yield f"void {setter} override {{ {self._field(item, value)} = value; }}"
        for function in item.functions:
            yield from self._function(item, function, f"{self._type(function.result)} {world_name(function.result)}")
        if item.is_behavior:
            yield f"void {world_behavior_name(item)}({', '.join(map(self._type, item.parameters))}) override {{}}"

    def _field(self, item: InterfacePlan, value: ValuePlan) -> str:
        """The data member behind a method of the world or of a stub; no method has its name."""
        owner, name = ("", world_name(value)) if item.implementation == WORLD else (item.component, value.name)
        if (owner, name) not in self._fields:
            self._fields[owner, name] = escape(f"given_{name}", {*self._methods, *self._fields.values()})
        return self._fields[owner, name]

    def _function(self, item: InterfacePlan, function: FunctionPlan, head: str) -> Iterator[str]:
        arguments = ", ".join(f"{self._type(value)} a{index}" for index, value in enumerate(function.arguments))
        order = sorted(range(len(function.arguments)), key=lambda index: _group(function.arguments[index]))
        counts: dict[float, int] = {}
        terms = ["0.0"]
        for index in order:
            weight = (1.0, 0.5, 0.25)[_group(function.arguments[index])]
            counts[weight] = counts.get(weight, 0) + 1
            terms.append(f"{weight * counts[weight]} * static_cast<double>(a{index})")
        result = function.result
        base = self._field(item, result)
        elements = next((len(each.elements) for each in self._plan.enumerations if each.name == result.type), 0)
        value = f"bica::conformance::derive<{self._type(result)}>({base}, {' + '.join(terms)}, {elements})"
        yield f"{head}({arguments}) override {{ return {value}; }}"
        yield f"double {base} = 0.0;"

    def _setter(self, component: str, name: str) -> str:
        if not component:
            plan = next(each for each in self._plan.components if each.component == self._root)
            value = next(each for each in plan.parameters if each.name == name)
            given = "bica::to_int(value)" if value.type == INT else self._read(value)
            return f"components.{self._members[self._root]}.{member_name(name)} = {given}"
        item = self._interfaces[component]
        owner = "world" if item.implementation == WORLD else f"stub_{self._members[component]}"
        function = next((each.result for each in item.functions if each.result.name == name), None)
        if function is not None:
            return f"{owner}.{self._field(item, function)} = value"
        value = next(each for each in (*item.outputs, *item.variables) if each.name == name)
        if item.implementation == WORLD:
            return f"world.{self._field(item, value)} = {self._read(value)}"
        owner = owner if self._is_stub(item) else f"components.{self._members[component]}"
        return f"{owner}.{member_name(name)} = {self._read(value)}"

    def _read(self, value: ValuePlan) -> str:
        if value.type == BOOL:
            return "value != 0.0"
        if value.type == INT:
            return "bica::saturate(value)"
        return "value" if value.type == FLOAT else f"static_cast<{self._type(value)}>(value)"

    def _type(self, value: ValuePlan) -> str:
        name = self._names.type_name(value.type)
        return name if value.type in (BOOL, INT, FLOAT) else f"::{self._names.namespace}::{name}"

    def _class(self, component: str) -> str:
        return f"::{self._names.namespace}::{self._names.class_name(component)}"


def _method_names(item: InterfacePlan) -> Iterator[str]:
    for value in (*item.outputs, *item.variables, *(function.result for function in item.functions)):
        yield from (world_name(value), f"set_{world_name(value)}", member_name(value.name))
    yield world_behavior_name(item)


def _group(value: ValuePlan) -> int:
    return 0 if value.type in (INT, FLOAT) else 1 if value.type == BOOL else 2
