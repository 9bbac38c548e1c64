"""Writes the module of the components without a design, which access the world or hold values."""

from collections.abc import Iterator
from dataclasses import dataclass

from vicode.generators.plan import FunctionPlan, InterfacePlan, ProjectPlan, ValuePlan
from vicode.generators.python.expression_doc import format_statement
from vicode.generators.python.expression_printer import PythonExpressionPrinter, world_name
from vicode.generators.python.imports import RUNTIME, Import, format_imports
from vicode.generators.python.methods import BODY_INDENT
from vicode.generators.python.names import class_renaming, component_class_name
from vicode.generators.python.parameters import keyword_signature, modulate_method, type_name
from vicode.generators.python.pretty_printer import Doc, call_doc, concat, render_doc
from vicode.generators.python.text import declaration_description, docstring, quoted, section
from vicode.generators.python.views import InterfaceClassView, InterfacesModuleView, MethodView
from vicode.model.expressions import BOOL, FLOAT, INT
from vicode.model.names import python_attribute_name, snake_case
from vicode.model.project import INTERNAL, MISSING, REMOTE, TOPIC, WORLD, Elsewhere, TopicReference

_MARGIN = " " * BODY_INDENT


def build_interfaces_view(plan: ProjectPlan, names: dict[str, str]) -> InterfacesModuleView | None:
    """Return the view of the module; None if there are no such components."""
    if not plan.interfaces:
        return None
    # A property may have the same name as its type and would hide the type inside the class.
    shared = [*(item.name for item in plan.enumerations), *(item.name for item in plan.constants)]
    names = names | {name: f"declarations.{names[name]}" for name in shared}
    printer = PythonExpressionPrinter(names=names, ranges=plan.ranges, nonzero_constants=plan.nonzero_constants)
    classes = tuple(_InterfaceWriter(item, printer).build_view() for item in plan.interfaces)
    bases = {_base_class(item) for item in plan.interfaces}
    used = {(RUNTIME, "arithmetic")} if "arithmetic" in printer.used_names else set()
    imports = [Import(module=module, name=name) for module, name in sorted(bases | used)]
    uses_declarations = any(name.startswith("declarations.") for name in printer.used_names)
    own = [Import(module=".", name="declarations")] if uses_declarations else []
    return InterfacesModuleView(
        docstring=docstring(f"Components of the project {plan.name} that have neither a design nor a class.", 0),
        imports=tuple(tuple(format_imports(section)) for section in (imports, own) if section),
        imports_for_types=tuple(format_imports([Import(module=RUNTIME, name="Root")])),
        classes=classes,
    )


@dataclass(frozen=True, slots=True)
class _InterfaceWriter:
    """Writes the class of one component."""

    plan: InterfacePlan
    expression_printer: PythonExpressionPrinter

    def build_view(self) -> InterfaceClassView:
        plan = self.plan
        methods = [*self._constructor(), *modulate_method(plan.parameters, self.expression_printer)]
        if plan.implementation == MISSING:
            methods += [self._stored_function(function) for function in plan.functions]
        elif plan.implementation == WORLD:
            methods += [method for value in plan.outputs for method in self._getter(value)]
            methods += [self._function(function) for function in plan.functions]
            methods += [method for value in plan.variables for method in (*self._getter(value), self._setter(value))]
            methods += self._work_method()
        return InterfaceClassView(
            name=component_class_name(plan.component),
            base=_base_class(plan)[1],
            docstring=self._docstring(),
            methods=tuple(methods) or (_EMPTY_WORK,),
            renaming=class_renaming(plan.component),
        )

    def _docstring(self) -> str:
        plan = self.plan
        texts = [
            (value.name, declaration_description(value.doc, value.unit, value.range)) for value in plan.stored_values
        ]
        entries = [(name, text) for name, text in texts if text]
        sections = (section("Attributes", entries, 4),) if entries else ()
        return docstring(plan.doc or _DOCS[plan.implementation], 4, sections)

    def _constructor(self) -> Iterator[MethodView]:
        remote = self.plan.remote
        # The runtime sets these values of a component of another robot.
        set_already = REMOTE_VALUES if remote is not None else ()
        values = [value for value in self.plan.stored_values if value.name not in set_already]
        if not values and remote is None:
            return
        arguments: list[Doc] = ["root", *_remote_arguments(remote)]
        if self.plan.tunable:
            limits = (f"{quoted(value.name)}: {value.range!r}" for value in self.plan.tunable)
            arguments.append(f"tunable={{{', '.join(limits)}}}")
        lines = render_doc(call_doc("super().__init__", arguments), BODY_INDENT)
        for value in values:
            lines += format_statement(
                f"self.{value.name} = ", self.expression_printer.stored_doc(value.initial), indent=BODY_INDENT
            )
        yield MethodView(signature="    def __init__(self, root: Root) -> None:", body="\n".join(lines))

    def _getter(self, value: ValuePlan) -> Iterator[MethodView]:
        signature = f"    @property\n    def {value.name}(self) -> {type_name(value.type, self.expression_printer)}:"
        yield MethodView(signature=signature, body=self._return_body(value, f"self.world.{world_name(value)}"))

    def _setter(self, value: ValuePlan) -> MethodView:
        type_ = type_name(value.type, self.expression_printer)
        argument = "value" if self._is_plain(value) else "value.value"
        signature = f"    @{value.name}.setter\n    def {value.name}(self, value: {type_}) -> None:"
        return MethodView(signature=signature, body=f"{_MARGIN}self.world.{world_name(value)} = {argument}")

    def _function_signature(self, function: FunctionPlan) -> str:
        result = function.result
        return keyword_signature(
            result.name, function.arguments, type_name(result.type, self.expression_printer), self.expression_printer
        )

    def _stored_function(self, function: FunctionPlan) -> MethodView:
        result = function.result
        doc = declaration_description(result.doc, result.unit, result.range)
        lines = [docstring(doc, BODY_INDENT)] if doc else []
        lines += format_statement("return ", self.expression_printer.stored_doc(result.initial), indent=BODY_INDENT)
        return MethodView(signature=self._function_signature(function), body="\n".join(lines))

    def _function(self, function: FunctionPlan) -> MethodView:
        result = function.result
        signature = self._function_signature(function)
        arguments: list[Doc] = [
            concat(f"{world_name(value)}={value.name}" + ("" if self._is_plain(value) else ".value"))
            for value in function.arguments
        ]
        call = "\n".join(render_doc(call_doc(f"self.world.{world_name(result)}", arguments), BODY_INDENT)).strip()
        return MethodView(signature=signature, body=self._return_body(result, call))

    def _return_body(self, value: ValuePlan, source: str) -> str:
        doc = declaration_description(value.doc, value.unit, value.range)
        lines = [docstring(doc, BODY_INDENT)] if doc else []
        converted = f"{type_name(value.type, self.expression_printer)}({source})"
        if value.type == INT:
            converted = f"{self.expression_printer.global_name('arithmetic')}.limit({converted})"
        return "\n".join([*lines, f"{_MARGIN}return {converted}"])

    def _work_method(self) -> Iterator[MethodView]:
        if not self.plan.is_behavior:
            return
        arguments: list[Doc] = [
            f"{world_name(value)}=self.{value.name}" + ("" if self._is_plain(value) else ".value")
            for value in self.plan.parameters
        ]
        function = python_attribute_name(self.plan.xabsl_name or snake_case(self.plan.component))
        lines = render_doc(call_doc(f"self.world.{function}", arguments), BODY_INDENT)
        yield MethodView(signature="    def work(self) -> None:", body="\n".join(lines))

    def _is_plain(self, value: ValuePlan) -> bool:
        """Whether the world uses the same value; elements of enumerations are strings there."""
        return value.type in (BOOL, INT, FLOAT)


REMOTE_VALUES = ("data_age", "is_alive")


def _base_class(plan: InterfacePlan) -> tuple[str, str]:
    if isinstance(plan.remote, TopicReference):
        return f"{RUNTIME}.ros_topic", "TopicComponent"
    return (f"{RUNTIME}.remote", "RemoteComponent") if plan.remote is not None else (RUNTIME, "Component")


def _remote_arguments(remote: Elsewhere | None) -> Iterator[str]:
    if remote is None:
        return
    if isinstance(remote, TopicReference):
        yield from (quoted(remote.topic), quoted(remote.type))
        for name, fields in (("outputs", remote.outputs), ("parameters", remote.parameters)):
            if fields:
                yield f"{name}={{{', '.join(f'{quoted(key)}: {quoted(field)}' for key, field in fields)}}}"
        if remote.frame:
            yield f"frame={quoted(remote.frame)}"
    else:
        yield quoted(remote.remote)
        if remote.reliable:
            yield "reliable=True"
    if remote.max_age is not None:
        yield f"max_age={float(remote.max_age)!r}"


_DOCS = {
    WORLD: "Provided by the world.",
    INTERNAL: "Shared variables.",
    REMOTE: "A component of another robot.",
    TOPIC: "A topic of ROS 2.",
    MISSING: "Not implemented yet: the robot program sets the outputs.",
}
_EMPTY_WORK = MethodView(
    signature="    def work(self) -> None:",
    body=docstring("Do nothing; the component only holds values.", BODY_INDENT),
)
