"""The module with a project's enumerations and constants in Python."""

from vicode.generators.plan import ProjectPlan, Value
from vicode.generators.python.imports import Import, import_lines
from vicode.generators.python.pieces import statement
from vicode.generators.python.spelling import Speller
from vicode.generators.python.text import comment, described, docstring, quoted, section
from vicode.generators.python.views import ClassView, DeclarationsView
from vicode.model.project import Enumeration


def declarations_view(plan: ProjectPlan, names: dict[str, str], runtime: str) -> DeclarationsView | None:
    """What the template of the declarations sees; None when the project declares nothing."""
    if not plan.enumerations and not plan.constants:
        return None
    speller = Speller(names=names, never_zero=plan.never_zero)
    constants = tuple(line for constant in plan.constants for line in _constant(constant, speller))
    enumerations = tuple(_enumeration(each, names[each.name]) for each in plan.enumerations)
    standard = [Import(module="enum", name="Enum")] if enumerations else []
    standard += [Import(module="typing", name="Final")] if constants else []
    imports = import_lines(standard)
    if any("arithmetic." in line for line in constants if not line.startswith("#")):
        imports += ["", *import_lines([Import(module=runtime, name="arithmetic")])]
    return DeclarationsView(
        docstring=docstring(f"What the components of the project {plan.name} share.", 0),
        imports=tuple(imports),
        enumerations=enumerations,
        constants=constants,
    )


def _enumeration(enumeration: Enumeration, name: str) -> ClassView:
    entries = [(element, doc) for element, doc in enumeration.elements if doc.strip()]
    sections = (section("Attributes", entries, 4),) if entries else ()
    # The world calls elements as XABSL does.
    written = dict(enumeration.xabsl_elements)
    return ClassView(
        name=name,
        docstring=docstring(enumeration.doc or f"The enumeration {enumeration.name}.", 4, sections),
        members=tuple(f"{element} = {quoted(written.get(element, element))}" for element in enumeration.element_names),
    )


def _constant(constant: Value, speller: Speller) -> list[str]:
    text = described(constant.doc, constant.unit, constant.range)
    remarks = comment(text, 0) if text else []
    before = f"{speller.names[constant.name]}: Final = "
    return [*remarks, *statement(before, speller.spell(constant.initial), indent=0)]
