"""Writes the module with the enumerations and constants of a project."""

from vicode.generators.plan import ProjectPlan, ValuePlan
from vicode.generators.python.expression_doc import format_statement
from vicode.generators.python.expression_printer import PythonExpressionPrinter
from vicode.generators.python.imports import RUNTIME, Import, format_imports
from vicode.generators.python.text import comment, declaration_description, docstring, quoted, section
from vicode.generators.python.views import DeclarationsModuleView, EnumerationClassView
from vicode.model.project import Enumeration


def build_declarations_view(plan: ProjectPlan, names: dict[str, str]) -> DeclarationsModuleView | None:
    """Return the view of the declarations module; None if the project declares nothing."""
    if not plan.enumerations and not plan.constants:
        return None
    printer = PythonExpressionPrinter(names=names, ranges=plan.ranges, nonzero_constants=plan.nonzero_constants)
    constants = tuple(line for constant in plan.constants for line in _constant(constant, printer))
    enumerations = tuple(_enumeration(item, names[item.name]) for item in plan.enumerations)
    standard = [Import(module="enum", name="Enum")] if enumerations else []
    standard += [Import(module="typing", name="Final")] if constants else []
    imports = format_imports(standard)
    if any("arithmetic." in line for line in constants if not line.startswith("#")):
        imports += ["", *format_imports([Import(module=RUNTIME, name="arithmetic")])]
    return DeclarationsModuleView(
        docstring=docstring(f"Enumerations and constants of the project {plan.name}.", 0),
        imports=tuple(imports),
        enumerations=enumerations,
        constants=constants,
    )


def _enumeration(enumeration: Enumeration, name: str) -> EnumerationClassView:
    entries = [(element, doc) for element, doc in enumeration.elements if doc.strip()]
    sections = (section("Attributes", entries, 4),) if entries else ()
    # The world uses the XABSL names of the elements.
    values = dict(enumeration.xabsl_elements)
    return EnumerationClassView(
        name=name,
        docstring=docstring(enumeration.doc or f"The enumeration {enumeration.name}.", 4, sections),
        renaming="" if name == enumeration.name else f'{name}.__name__ = "{enumeration.name}"',
        members=tuple(f"{element} = {quoted(values.get(element, element))}" for element in enumeration.element_names),
    )


def _constant(constant: ValuePlan, printer: PythonExpressionPrinter) -> list[str]:
    text = declaration_description(constant.doc, constant.unit, constant.range)
    comments = comment(text, 0) if text else []
    before = f"{printer.names[constant.name]}: Final = "
    return [*comments, *format_statement(before, printer.stored_doc(constant.initial), indent=0)]
