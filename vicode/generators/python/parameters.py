"""How parameters are taken: the signature of a method with keywords, and their types."""

from collections.abc import Iterable

from vicode.generators.plan import Value
from vicode.generators.python.layout import WIDTH, Doc, Group, call, joined, render, separated
from vicode.generators.python.methods import BODY, METHOD
from vicode.generators.python.spelling import Speller
from vicode.generators.python.text import docstring
from vicode.generators.python.views import MethodView
from vicode.model.expressions import BOOL, FLOAT, INT


def modulate_method(parameters: tuple[Value, ...], speller: Speller) -> list[MethodView]:
    """The method that takes the parameters of a component; none without parameters."""
    if not parameters:
        return []
    margin = " " * BODY
    lines = [docstring("Take the parameters of an activation.", BODY)]
    lines += [f"{margin}self.{value.name} = {value.name}" for value in parameters]
    signature = keyword_signature("modulate", parameters, "None", speller)
    return [MethodView(signature=signature, body="\n".join(lines))]


def keyword_signature(name: str, parameters: Iterable[Value], result: str, speller: Speller) -> str:
    """The lines of a method up to its colon: everything but self is given by keyword and has a default."""
    given: list[Doc] = [_parameter(value, speller) for value in parameters]
    given = ["self", "*", *given] if given else ["self"]
    signature = render(Group(joined(f"def {name}(", separated(given, ", "), f") -> {result}:")), METHOD)
    if len(signature) > 1 or len(signature[0]) > WIDTH:
        signature = render(joined(call(f"def {name}", given, is_broken=True), f" -> {result}:"), METHOD)
    return "\n".join(signature)


def type_name(type_: str, speller: Speller) -> str:
    """How a type is written."""
    return type_ if type_ in (BOOL, INT, FLOAT) else speller.names[type_]


def _parameter(value: Value, speller: Speller) -> Doc:
    return joined(f"{value.name}: {type_name(value.type, speller)} = ", speller.spell(value.initial).breakable)
