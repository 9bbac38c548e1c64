"""The module of one component in Python."""

from dataclasses import dataclass, replace

from vicode.generators.plan import (
    Body,
    ComponentPlan,
    ProjectPlan,
    StatePlan,
    UnsoundDesignError,
    UsedComponent,
)
from vicode.generators.python.imports import Import, import_lines
from vicode.generators.python.layout import (
    Doc,
    IfBroken,
    Line,
    bracketed,
    call,
    joined,
    render,
    separated,
)
from vicode.generators.python.methods import BODY, METHOD, MethodWriter, python_code
from vicode.generators.python.names import name_class, words_in_code
from vicode.generators.python.parameters import modulate_method
from vicode.generators.python.pieces import statement
from vicode.generators.python.spelling import Speller, functions_of, spell_number
from vicode.generators.python.text import described, docstring, quoted, section
from vicode.generators.python.views import ComponentView, MethodView
from vicode.regions import wrap


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentWriter:
    """Writes one component; `runtime` is the package it imports."""

    project: ProjectPlan
    component: ComponentPlan
    names: dict[str, str]
    runtime: str

    @property
    def speller(self) -> Speller:
        """Spells this component's expressions."""
        return Speller(
            names=self.names,
            never_zero=self.project.never_zero,
            time_unit=self.component.time_unit,
            is_xabsl=self.component.arithmetic == "xabsl",
            functions=functions_of(self.component),
        )

    def view(self) -> ComponentView:
        """What the template of a component sees."""
        plan = self.component
        methods = (
            self._write_constructor(),
            *modulate_method(plan.parameters, self.speller),
            *MethodWriter(component=plan, speller=self.speller).write_states(),
        )
        view = ComponentView(
            docstring=docstring(f"The component {plan.component} of the project {self.project.name}.", 0),
            imports=(),
            imports_for_types=tuple(import_lines([Import(module=self.runtime, name="Root")])),
            module_code=_whole(plan.module_code, ""),
            class_name=name_class(plan.component),
            base=self._base,
            class_docstring=self._write_docstring(),
            settings=self._list_settings(),
            methods=methods,
            members=_whole(plan.members, " " * METHOD),
        )
        return replace(view, imports=self._list_imports(view))

    @property
    def _base(self) -> str:
        return "XabslComponent" if self.component.arithmetic == "xabsl" else "Component"

    def _write_docstring(self) -> str:
        plan = self.component
        values = [*plan.parameters, *plan.outputs, *plan.variables]
        texts = [(value.name, described(value.doc, value.unit, value.range)) for value in values]
        entries = [(name, text) for name, text in texts if text]
        sections = (section("Attributes", entries, METHOD),) if entries else ()
        return docstring(plan.doc or f"The component {plan.component}.", METHOD, sections)

    def _list_settings(self) -> tuple[str, ...]:
        plan = self.component
        settings = []
        if plan.source:
            settings.append(f"design_file = {quoted(plan.source)}")
        if plan.frequency_hz is not None:
            hertz = plan.frequency_hz
            settings.append(f"frequency_hz = {spell_number(int(hertz) if hertz == int(hertz) else hertz)}")
        if plan.resume:
            settings.append("resume = True")
        return tuple(settings)

    def _write_constructor(self) -> MethodView:
        plan = self.component
        margin = " " * BODY
        lines = [f"{margin}super().__init__(root)"]
        lines += [f"{margin}self.{use.alias} = root.component({self._class_of(use)})" for use in plan.uses]
        for value in (*plan.parameters, *plan.outputs, *plan.variables):
            lines += statement(f"self.{value.name} = ", self.speller.spell(value.initial), indent=BODY)
        states: list[Doc] = [_state(state, asks_done=plan.asks_done) for state in plan.states]
        lines += render(call("self._set_states", states, is_broken=True), BODY)
        return MethodView(signature="    def __init__(self, root: Root) -> None:", body="\n".join(lines))

    def _class_of(self, use: UsedComponent) -> str:
        return name_class(use.component)

    def _list_imports(self, view: ComponentView) -> tuple[tuple[str, ...], ...]:
        """Sections: the runtime, hand-written modules, the package's own."""
        written = words_in_code([view.module_code, *self._texts(view)])
        runtime = [Import(module=self.runtime, name=name) for name in (self._base, "State")]
        if "arithmetic" in written:
            runtime.append(Import(module=self.runtime, name="arithmetic"))
        hand_written = [self._import_class(use) for use in self.component.uses if use.implementation or not use.module]
        own = [self._import_class(use) for use in self.component.uses if use.module]
        own += self._import_declarations(written)
        is_inside = self.runtime.startswith(".")
        sections = ([], hand_written, [*runtime, *own]) if is_inside else (runtime, hand_written, own)
        return tuple(tuple(import_lines(each)) for each in sections if each)

    def _texts(self, view: ComponentView) -> list[str]:
        """All code of the class, so that what it names can be imported."""
        methods = [f"{method.signature}\n{method.body}" for method in view.methods]
        return ["\n".join([f"class {view.class_name}:", "    pass", *methods, view.members])]

    def _import_declarations(self, written: frozenset[str]) -> list[Import]:
        shared = [*(each.name for each in self.project.enumerations), *(each.name for each in self.project.constants)]
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


def _state(state: StatePlan, *, asks_done: bool) -> Doc:
    arguments: list[Doc] = [quoted(state.name), f"self._in_{state.stem}"]
    if state.requires:
        arguments.append(joined("requires=", _tuple([f"self.{alias}" for alias in state.requires])))
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
    if asks_done and state.calls:
        arguments.append(joined("calls=", _tuple([f"self.{alias}" for alias in state.calls])))
    return call("State", arguments)


def _tuple(items: list[str]) -> Doc:
    if len(items) == 1:
        return bracketed("(", f"{items[0]},")
    inner = joined(separated(list(items), joined(",", Line())), IfBroken(","))
    return bracketed("(", inner)


def _whole(body: Body | None, indent: str) -> str:
    return wrap(body.region, python_code(body), indent=indent).removesuffix("\n") if body else ""
