"""The built-in functions of expressions."""

from dataclasses import dataclass

from vicode.model.expressions.tree import BOOL, FLOAT, INT

NUMBER = "number"
"""An int or a float. As a return type: int if all arguments are ints, else float."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BuiltinFunction:
    """A built-in function. If `is_variadic`, the last parameter may be repeated."""

    name: str
    parameter_types: tuple[str, ...]
    return_type: str
    doc: str
    is_variadic: bool = False


def _build_table() -> dict[str, BuiltinFunction]:
    rows = [
        ("abs", (NUMBER,), NUMBER, "absolute value"),
        ("min", (NUMBER, NUMBER), NUMBER, "the smallest value"),
        ("max", (NUMBER, NUMBER), NUMBER, "the largest value"),
        ("clamp", (NUMBER, NUMBER, NUMBER), NUMBER, "value limited to low and high"),
        ("sign", (NUMBER,), INT, "-1, 0 or 1"),
        ("floor", (FLOAT,), INT, "the largest integer that is not greater"),
        ("ceil", (FLOAT,), INT, "the smallest integer that is not less"),
        ("round", (FLOAT,), INT, "the nearest integer, halves to the even one"),
        ("int", (FLOAT,), INT, "truncated towards zero; 0 for nan"),
        ("float", (FLOAT,), FLOAT, "conversion to float"),
        ("sqrt", (FLOAT,), FLOAT, "square root; nan for a negative number"),
        ("exp", (FLOAT,), FLOAT, "exponential function"),
        ("log", (FLOAT,), FLOAT, "natural logarithm; -inf for 0, nan for a negative number"),
        ("sin", (FLOAT,), FLOAT, "sine of an angle in radians"),
        ("cos", (FLOAT,), FLOAT, "cosine of an angle in radians"),
        ("tan", (FLOAT,), FLOAT, "tangent of an angle in radians"),
        ("asin", (FLOAT,), FLOAT, "arc sine in radians; nan outside -1..1"),
        ("acos", (FLOAT,), FLOAT, "arc cosine in radians; nan outside -1..1"),
        ("atan", (FLOAT,), FLOAT, "arc tangent in radians"),
        ("atan2", (FLOAT, FLOAT), FLOAT, "angle of the vector (y, x) in radians"),
        ("hypot", (FLOAT, FLOAT), FLOAT, "length of the vector"),
        ("degrees", (FLOAT,), FLOAT, "radians to degrees"),
        ("radians", (FLOAT,), FLOAT, "degrees to radians"),
        ("is_nan", (FLOAT,), BOOL, "whether the value is nan"),
    ]
    variadic = {"min", "max"}
    return {
        name: BuiltinFunction(
            name=name, parameter_types=takes, return_type=gives, doc=doc, is_variadic=name in variadic
        )
        for name, takes, gives, doc in rows
    }


FUNCTIONS = _build_table()
