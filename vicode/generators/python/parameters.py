"""Signatures of methods with keyword parameters."""

from collections.abc import Iterable

from vicode.bica.arithmetic import MAX_INT
from vicode.generators.plan import ValuePlan
from vicode.generators.python.expression_printer import PythonExpressionPrinter
from vicode.generators.python.methods import BODY_INDENT, METHOD_INDENT
from vicode.generators.python.pretty_printer import LINE_WIDTH, Doc, DocGroup, call_doc, concat, join_docs, render_doc
from vicode.generators.python.text import docstring
from vicode.generators.python.views import MethodView
from vicode.model.expressions import BOOL, FLOAT, INT


def modulate_method(
    parameters: tuple[ValuePlan, ...], expression_printer: PythonExpressionPrinter, *, limits_ints: bool = False
) -> list[MethodView]:
    """Write the method that sets the parameters of a component; empty without parameters."""
    if not parameters:
        return []
    margin = " " * BODY_INDENT
    lines = [docstring("Set the parameters.", BODY_INDENT)]
    names = {value.name for value in parameters}
    for value in parameters:
        name = value.name
        if not limits_ints or value.type != INT:
            given = name
        elif "arithmetic" in names:  # a parameter hides the module
            given = f"{name} if -{MAX_INT} <= {name} <= {MAX_INT} else {MAX_INT} if {name} > 0 else -{MAX_INT}"
        else:
            given = f"{expression_printer.global_name('arithmetic')}.limit({name})"
        lines.append(f"{margin}self.{name} = {given}")
    signature = keyword_signature("modulate", parameters, "None", expression_printer)
    return [MethodView(signature=signature, body="\n".join(lines))]


def keyword_signature(
    name: str, parameters: Iterable[ValuePlan], result: str, expression_printer: PythonExpressionPrinter
) -> str:
    """Format the signature of a method whose parameters are all keyword-only and have defaults."""
    arguments: list[Doc] = [_parameter(value, expression_printer) for value in parameters]
    arguments = ["self", "*", *arguments] if arguments else ["self"]
    signature = render_doc(
        DocGroup(concat(f"def {name}(", join_docs(arguments, ", "), f") -> {result}:")), METHOD_INDENT
    )
    if len(signature) > 1 or len(signature[0]) > LINE_WIDTH:
        signature = render_doc(
            concat(call_doc(f"def {name}", arguments, must_break=True), f" -> {result}:"), METHOD_INDENT
        )
    return "\n".join(signature)


def type_name(type_: str, expression_printer: PythonExpressionPrinter) -> str:
    return type_ if type_ in (BOOL, INT, FLOAT) else expression_printer.global_name(type_)


def _parameter(value: ValuePlan, printer: PythonExpressionPrinter) -> Doc:
    return concat(f"{value.name}: {type_name(value.type, printer)} = ", printer.stored_doc(value.initial).breakable)
