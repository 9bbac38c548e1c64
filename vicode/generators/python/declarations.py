"""The module with a project's enumerations and constants in Python."""

from vicode.generators.plan import ProjectPlan, ValuePlan
from vicode.generators.python.expression_doc import format_statement
from vicode.generators.python.expression_printer import PythonExpressionPrinter
from vicode.generators.python.imports import Import, format_imports
from vicode.generators.python.text import comment, declaration_description, docstring, quoted, section
from vicode.generators.python.views import DeclarationsModuleView, EnumerationClassView
from vicode.model.project import Enumeration


def build_declarations_view(plan: ProjectPlan, names: dict[str, str], runtime: str) -> DeclarationsModuleView | None:
    """What the template of the declarations sees; None when the project declares nothing."""
    if not plan.enumerations and not plan.constants:
        return None
    speller = PythonExpressionPrinter(names=names, nonzero_constants=plan.nonzero_constants)
    constants = tuple(line for constant in plan.constants for line in _constant(constant, speller))
    enumerations = tuple(_enumeration(each, names[each.name]) for each in plan.enumerations)
    standard = [Import(module="enum", name="Enum")] if enumerations else []
    standard += [Import(module="typing", name="Final")] if constants else []
    imports = format_imports(standard)
    if any("arithmetic." in line for line in constants if not line.startswith("#")):
        imports += ["", *format_imports([Import(module=runtime, name="arithmetic")])]
    return DeclarationsModuleView(
        docstring=docstring(f"What the components of the project {plan.name} share.", 0),
        imports=tuple(imports),
        enumerations=enumerations,
        constants=constants,
    )


def _enumeration(enumeration: Enumeration, name: str) -> EnumerationClassView:
    entries = [(element, doc) for element, doc in enumeration.elements if doc.strip()]
    sections = (section("Attributes", entries, 4),) if entries else ()
    # The world calls elements as XABSL does.
    written = dict(enumeration.xabsl_elements)
    return EnumerationClassView(
        name=name,
        docstring=docstring(enumeration.doc or f"The enumeration {enumeration.name}.", 4, sections),
        members=tuple(f"{element} = {quoted(written.get(element, element))}" for element in enumeration.element_names),
    )


def _constant(constant: ValuePlan, speller: PythonExpressionPrinter) -> list[str]:
    text = declaration_description(constant.doc, constant.unit, constant.range)
    remarks = comment(text, 0) if text else []
    before = f"{speller.names[constant.name]}: Final = "
    return [*remarks, *format_statement(before, speller.to_doc(constant.initial), indent=0)]
