"""Writes the module of one component."""

from collections.abc import Iterator, Set
from dataclasses import dataclass
from functools import cached_property

from vicode.generators.plan import (
    CodePlan,
    ComponentPlan,
    ProjectPlan,
    StatePlan,
    UnsoundDesignError,
    UsedComponent,
)
from vicode.generators.python.expression_doc import format_statement
from vicode.generators.python.expression_printer import PythonExpressionPrinter, format_number
from vicode.generators.python.imports import RUNTIME, Import, format_imports
from vicode.generators.python.methods import (
    BODY_INDENT,
    METHOD_INDENT,
    MethodWriter,
    python_code,
    section_code,
)
from vicode.generators.python.names import class_renaming, component_class_name, names_in_code
from vicode.generators.python.parameters import modulate_method
from vicode.generators.python.pretty_printer import (
    Doc,
    IfBreak,
    SoftLine,
    bracketed,
    call_doc,
    concat,
    join_docs,
    render_doc,
)
from vicode.generators.python.text import declaration_description, docstring, quoted, section
from vicode.generators.python.views import ComponentModuleView, MethodView
from vicode.regions import wrap_region


@dataclass(frozen=True, kw_only=True)
class ComponentWriter:
    """Writes one component."""

    project: ProjectPlan
    component: ComponentPlan
    names: dict[str, str]

    @cached_property
    def expression_printer(self) -> PythonExpressionPrinter:
        return PythonExpressionPrinter.of_component(self.project, self.component, self.names)

    def build_view(self) -> ComponentModuleView:
        plan = self.component
        methods = (
            self._write_constructor(),
            *modulate_method(plan.parameters, self.expression_printer, limits_ints=True),
            *MethodWriter(component=plan, expression_printer=self.expression_printer).write_states(),
        )
        return ComponentModuleView(
            docstring=docstring(f"The component {plan.component} of the project {self.project.name}.", 0),
            imports=self._list_imports(),
            imports_for_types=tuple(format_imports([Import(module=RUNTIME, name="Root")])),
            module_code=_region_text(plan.module_code, ""),
            class_name=component_class_name(plan.component),
            base=self._base,
            class_docstring=self._write_docstring(),
            settings=self._list_settings(),
            methods=methods,
            members=_region_text(plan.members, " " * METHOD_INDENT),
            renaming=class_renaming(plan.component),
        )

    @property
    def _base(self) -> str:
        return "XabslComponent" if self.component.arithmetic == "xabsl" else "Component"

    def _write_docstring(self) -> str:
        plan = self.component
        values = [*plan.parameters, *plan.outputs, *plan.variables]
        texts = [(value.name, declaration_description(value.doc, value.unit, value.range)) for value in values]
        entries = [(name, text) for name, text in texts if text]
        sections = (section("Attributes", entries, METHOD_INDENT),) if entries else ()
        return docstring(plan.doc or f"The component {plan.component}.", METHOD_INDENT, sections)

    def _list_settings(self) -> tuple[str, ...]:
        plan = self.component
        settings = []
        if plan.source:
            settings.append(f"design_file = {quoted(plan.source)}")
        if plan.frequency_hz is not None:
            hertz = plan.frequency_hz
            settings.append(f"frequency_hz = {format_number(int(hertz) if hertz == int(hertz) else hertz)}")
        if plan.resume:
            settings.append("resume = True")
        return tuple(settings)

    def _write_constructor(self) -> MethodView:
        plan = self.component
        margin = " " * BODY_INDENT
        lines = [f"{margin}super().__init__(root)"]
        lines += [f"{margin}self.{use.alias} = root.component({self._class_of(use)})" for use in plan.uses]
        for value in (*plan.parameters, *plan.outputs, *plan.variables):
            lines += format_statement(
                f"self.{value.name} = ", self.expression_printer.stored_doc(value.initial), indent=BODY_INDENT
            )
        states: list[Doc] = [_state(state, uses_action_done=plan.uses_action_done) for state in plan.states]
        lines += render_doc(call_doc("self._set_states", states, must_break=True), BODY_INDENT)
        return MethodView(signature="    def __init__(self, root: Root) -> None:", body="\n".join(lines))

    def _class_of(self, use: UsedComponent) -> str:
        return component_class_name(use.component)

    def _list_imports(self) -> tuple[tuple[str, ...], ...]:
        """List the import sections: the runtime, hand-written modules, modules of the package.

        The methods must be written before, since their expressions determine the imports.
        """
        written = self.expression_printer.used_names | names_in_code(self._hand_written_code())
        runtime = [Import(module=RUNTIME, name=name) for name in (self._base, "State")]
        if "arithmetic" in written:
            runtime.append(Import(module=RUNTIME, name="arithmetic"))
        hand_written = [self._import_class(use) for use in self.component.uses if use.implementation or not use.module]
        own = [self._import_class(use) for use in self.component.uses if use.module]
        own += self._import_declarations(written)
        return tuple(tuple(format_imports(imports)) for imports in (runtime, hand_written, own) if imports)

    def _hand_written_code(self) -> Iterator[str]:
        for code in (*section_code(self.component), *self.component.action_code, *self.component.guard_code):
            yield python_code(code)

    def _import_declarations(self, written: Set[str]) -> list[Import]:
        shared = [*(item.name for item in self.project.enumerations), *(item.name for item in self.project.constants)]
        used = [name for name in dict.fromkeys(shared) if self.names[name] in written]
        return [Import(module=".declarations", name=self.names[name]) for name in used]

    def _import_class(self, use: UsedComponent) -> Import:
        name = self._class_of(use)
        if use.module:
            return Import(module=f".{use.module}", name=name)
        module, _colon, class_name = use.implementation.partition(":")
        if not module or not class_name:
            raise UnsoundDesignError(f"'{use.component}' has no implementation module:Class")
        return Import(module=module, name=class_name, alias="" if class_name == name else name)


def _state(state: StatePlan, *, uses_action_done: bool) -> Doc:
    arguments: list[Doc] = [quoted(state.name), f"self._in_{state.stem}"]
    if state.requires:
        arguments.append(concat("requires=", _tuple([f"self.{alias}" for alias in state.requires])))
    if state.enter:
        arguments.append(f"enter=self._enter_{state.stem}")
    if state.leave:
        arguments.append(f"leave=self._leave_{state.stem}")
    if state.final:
        arguments.append("final=True")
    if state.capacity is not None:
        arguments.append(f"capacity={state.capacity}")
    if state.synchronized is not None:
        arguments.append(f"synchronized={state.synchronized}")
    if uses_action_done and state.calls:
        arguments.append(concat("calls=", _tuple([f"self.{alias}" for alias in state.calls])))
    return call_doc("State", arguments)


def _tuple(items: list[str]) -> Doc:
    if len(items) == 1:
        return bracketed(f"{items[0]},")
    inner = concat(join_docs(list(items), concat(",", SoftLine())), IfBreak(","))
    return bracketed(inner)


def _region_text(body: CodePlan | None, indent: str) -> str:
    if body is None or body.code.in_language("python") is None:
        return ""
    return wrap_region(body.region_id, python_code(body), indent=indent).removesuffix("\n")
