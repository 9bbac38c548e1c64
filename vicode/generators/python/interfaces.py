"""The module with what a project declares but nobody wrote: components that hand on to the world, or keep variables."""

from collections.abc import Iterator
from dataclasses import dataclass

from vicode.generators.plan import Function, InterfacePlan, ProjectPlan, Value
from vicode.generators.python.imports import Import, import_lines
from vicode.generators.python.layout import Doc, call, joined, render
from vicode.generators.python.methods import BODY
from vicode.generators.python.names import name_class, words_in_code
from vicode.generators.python.parameters import keyword_signature, modulate_method, type_name
from vicode.generators.python.pieces import statement
from vicode.generators.python.spelling import Speller
from vicode.generators.python.text import described, docstring, section
from vicode.generators.python.views import HandedOnView, InterfacesView, MethodView
from vicode.model.expressions import BOOL, FLOAT, INT
from vicode.model.names import attribute_name, snake_case

_MARGIN = " " * BODY


def interfaces_view(plan: ProjectPlan, names: dict[str, str], runtime: str) -> InterfacesView | None:
    """What the template of these components sees; None when there are none."""
    if not plan.interfaces:
        return None
    # A property may have the name of its type, which inside the class would then be the property.
    shared = [each.name for each in plan.enumerations] + [each.name for each in plan.constants]
    names = names | {name: f"declarations.{names[name]}" for name in shared}
    speller = Speller(names=names, never_zero=plan.never_zero)
    classes = tuple(_Writer(each, speller).view() for each in plan.interfaces)
    texts = [f"{method.signature}\n{method.body}" for each in classes for method in each.methods]
    written = words_in_code(["\n".join(["class X:", "    pass", *texts])])
    imports = [Import(module=runtime, name="Component")]
    own = [Import(module=".", name="declarations")] if "declarations" in written else []
    return InterfacesView(
        docstring=docstring(f"What the components of the project {plan.name} have of the world, and keep for all.", 0),
        imports=tuple(tuple(import_lines(each)) for each in (imports, own) if each),
        imports_for_types=tuple(import_lines([Import(module=runtime, name="Root")])),
        classes=classes,
    )


@dataclass(frozen=True, slots=True)
class _Writer:
    """Writes one class."""

    plan: InterfacePlan
    speller: Speller

    def view(self) -> HandedOnView:
        """What the template sees of it."""
        plan = self.plan
        methods = [*self._constructor(), *modulate_method(plan.parameters, self.speller)]
        if not plan.is_internal:
            methods += [method for value in plan.outputs for method in self._reading(value)]
            methods += [self._function(each) for each in plan.functions]
            methods += [method for value in plan.variables for method in (*self._reading(value), self._setting(value))]
            methods += self._work()
        return HandedOnView(
            name=name_class(plan.component), docstring=self._docstring(), methods=tuple(methods) or (_NOTHING,)
        )

    def _docstring(self) -> str:
        plan = self.plan
        values = [*plan.parameters, *(plan.variables if plan.is_internal else ())]
        texts = [(value.name, described(value.doc, value.unit, value.range)) for value in values]
        entries = [(name, text) for name, text in texts if text]
        sections = (section("Attributes", entries, 4),) if entries else ()
        default = "Variables that all may read and set." if plan.is_internal else "Handed on to the world."
        return docstring(plan.doc or default, 4, sections)

    def _constructor(self) -> Iterator[MethodView]:
        kept = (*self.plan.parameters, *(self.plan.variables if self.plan.is_internal else ()))
        if not kept:
            return
        lines = [f"{_MARGIN}super().__init__(root)"]
        for value in kept:
            lines += statement(f"self.{value.name} = ", self.speller.spell(value.initial), indent=BODY)
        yield MethodView(signature="    def __init__(self, root: Root) -> None:", body="\n".join(lines))

    def _reading(self, value: Value) -> Iterator[MethodView]:
        signature = f"    @property\n    def {value.name}(self) -> {type_name(value.type, self.speller)}:"
        yield MethodView(signature=signature, body=self._returning(value, f"self.world.{_world_name(value)}"))

    def _setting(self, value: Value) -> MethodView:
        type_ = type_name(value.type, self.speller)
        given = "value" if self._is_plain(value) else "value.value"
        signature = f"    @{value.name}.setter\n    def {value.name}(self, value: {type_}) -> None:"
        return MethodView(signature=signature, body=f"{_MARGIN}self.world.{_world_name(value)} = {given}")

    def _function(self, function: Function) -> MethodView:
        result = function.result
        signature = keyword_signature(
            result.name, function.arguments, type_name(result.type, self.speller), self.speller
        )
        given: list[Doc] = [
            joined(f"{_world_name(each)}={each.name}" + ("" if self._is_plain(each) else ".value"))
            for each in function.arguments
        ]
        asked = "\n".join(render(call(f"self.world.{_world_name(result)}", given), BODY)).strip()
        return MethodView(signature=signature, body=self._returning(result, asked))

    def _returning(self, value: Value, asked: str) -> str:
        text = asked if self._is_plain(value) else f"{type_name(value.type, self.speller)}({asked})"
        doc = described(value.doc, value.unit, value.range)
        lines = [docstring(doc, BODY)] if doc else []
        if value.type == BOOL:
            text = f"bool({text})"
        elif value.type in (FLOAT, INT):
            text = f"{value.type}({text})"
        return "\n".join([*lines, f"{_MARGIN}return {text}"])

    def _work(self) -> Iterator[MethodView]:
        if not self.plan.acts:
            return
        given: list[Doc] = [
            f"{_world_name(each)}=self.{each.name}" + ("" if self._is_plain(each) else ".value")
            for each in self.plan.parameters
        ]
        asked = attribute_name(self.plan.xabsl_name or snake_case(self.plan.component))
        lines = render(call(f"self.world.{asked}", given), BODY)
        yield MethodView(signature="    def work(self) -> None:", body="\n".join(lines))

    def _is_plain(self, value: Value) -> bool:
        """Whether the world has it as it is; of elements it has the names."""
        return value.type in (BOOL, INT, FLOAT)


def _world_name(value: Value) -> str:
    """What the world calls it: as an engine of XABSL would, so that one world serves both."""
    return attribute_name(value.xabsl_name or value.name)


_NOTHING = MethodView(
    signature="    def work(self) -> None:", body=docstring("Do nothing: it only keeps variables.", BODY)
)
