"""The built-in functions of expressions."""

from dataclasses import dataclass

from vicode.model.expressions.tree import BOOL, FLOAT, INT

NUMBER = "number"
"""An int or a float. As a return type: int if all arguments are ints, else float."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BuiltinFunction:
    """A built-in function. If `is_variadic`, the last parameter may be repeated."""

    name: str
    parameter_names: tuple[str, ...]
    parameter_types: tuple[str, ...]
    return_type: str
    doc: str
    is_variadic: bool = False


def _build_table() -> dict[str, BuiltinFunction]:
    rows = [
        ("abs", "x", (NUMBER,), NUMBER, "absolute value of x"),
        ("min", "a b", (NUMBER, NUMBER), NUMBER, "the smallest argument"),
        ("max", "a b", (NUMBER, NUMBER), NUMBER, "the largest argument"),
        ("clamp", "x low high", (NUMBER, NUMBER, NUMBER), NUMBER, "x limited to the range from low to high"),
        ("sign", "x", (NUMBER,), INT, "-1, 0 or 1, the sign of x"),
        ("floor", "x", (FLOAT,), INT, "the largest integer that is not greater than x"),
        ("ceil", "x", (FLOAT,), INT, "the smallest integer that is not less than x"),
        ("round", "x", (FLOAT,), INT, "the integer nearest to x; halves are rounded to the even one"),
        ("int", "x", (FLOAT,), INT, "x truncated towards zero; 0 for nan"),
        ("float", "x", (FLOAT,), FLOAT, "x as a float"),
        ("sqrt", "x", (FLOAT,), FLOAT, "square root of x; nan for a negative number"),
        ("exp", "x", (FLOAT,), FLOAT, "e to the power of x"),
        ("log", "x", (FLOAT,), FLOAT, "natural logarithm of x; -inf for 0, nan for a negative number"),
        ("sin", "x", (FLOAT,), FLOAT, "sine of x, an angle in radians"),
        ("cos", "x", (FLOAT,), FLOAT, "cosine of x, an angle in radians"),
        ("tan", "x", (FLOAT,), FLOAT, "tangent of x, an angle in radians"),
        ("asin", "x", (FLOAT,), FLOAT, "arc sine of x in radians, from -pi/2 to pi/2; nan outside -1..1"),
        ("acos", "x", (FLOAT,), FLOAT, "arc cosine of x in radians, from 0 to pi; nan outside -1..1"),
        ("atan", "x", (FLOAT,), FLOAT, "arc tangent of x in radians, from -pi/2 to pi/2"),
        ("atan2", "y x", (FLOAT, FLOAT), FLOAT, "angle of the vector (x, y) in radians, from -pi to pi; y comes first"),
        ("hypot", "x y", (FLOAT, FLOAT), FLOAT, "length of the vector (x, y)"),
        ("degrees", "x", (FLOAT,), FLOAT, "converts x from radians to degrees"),
        ("radians", "x", (FLOAT,), FLOAT, "converts x from degrees to radians"),
        ("is_nan", "x", (FLOAT,), BOOL, "whether x is nan"),
    ]
    variadic = {"min", "max"}
    return {
        name: BuiltinFunction(
            name=name,
            parameter_names=tuple(parameters.split()),
            parameter_types=takes,
            return_type=gives,
            doc=doc,
            is_variadic=name in variadic,
        )
        for name, parameters, takes, gives, doc in rows
    }


FUNCTIONS = _build_table()
