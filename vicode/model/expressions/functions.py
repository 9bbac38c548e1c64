"""The functions that expressions may call, with what they take and give."""

from dataclasses import dataclass

from vicode.model.expressions.tree import BOOL, FLOAT, INT

NUMBER = "number"
"""An int or a float; where it is also the result, an int only if every argument is one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BuiltinFunction:
    """A listed function: types of its parameters (`is_variadic`: the last may repeat), type of its result."""

    name: str
    parameter_types: tuple[str, ...]
    return_type: str
    doc: str
    is_variadic: bool = False


def _build_table() -> dict[str, BuiltinFunction]:
    rows = [
        ("abs", (NUMBER,), NUMBER, "absolute value"),
        ("min", (NUMBER, NUMBER), NUMBER, "the smallest"),
        ("max", (NUMBER, NUMBER), NUMBER, "the largest"),
        ("clamp", (NUMBER, NUMBER, NUMBER), NUMBER, "value, kept between low and high"),
        ("sign", (NUMBER,), INT, "-1, 0 or 1"),
        ("floor", (FLOAT,), INT, "the next whole number below"),
        ("ceil", (FLOAT,), INT, "the next whole number above"),
        ("round", (FLOAT,), INT, "the nearest whole number, halves to the even one"),
        ("int", (FLOAT,), INT, "towards zero; of nan 0"),
        ("float", (FLOAT,), FLOAT, "as float"),
        ("sqrt", (FLOAT,), FLOAT, "square root; of a negative number nan"),
        ("exp", (FLOAT,), FLOAT, "e to the power of"),
        ("log", (FLOAT,), FLOAT, "natural logarithm; of 0 -inf, of a negative number nan"),
        ("sin", (FLOAT,), FLOAT, "sine of an angle in radians"),
        ("cos", (FLOAT,), FLOAT, "cosine of an angle in radians"),
        ("tan", (FLOAT,), FLOAT, "tangent of an angle in radians"),
        ("asin", (FLOAT,), FLOAT, "arc sine in radians; outside -1..1 nan"),
        ("acos", (FLOAT,), FLOAT, "arc cosine in radians; outside -1..1 nan"),
        ("atan", (FLOAT,), FLOAT, "arc tangent in radians"),
        ("atan2", (FLOAT, FLOAT), FLOAT, "angle of the vector (y, x) in radians"),
        ("hypot", (FLOAT, FLOAT), FLOAT, "length of the vector"),
        ("degrees", (FLOAT,), FLOAT, "radians to degrees"),
        ("radians", (FLOAT,), FLOAT, "degrees to radians"),
        ("is_nan", (FLOAT,), BOOL, "not a number"),
    ]
    variadic = {"min", "max"}
    return {
        name: BuiltinFunction(
            name=name, parameter_types=takes, return_type=gives, doc=doc, is_variadic=name in variadic
        )
        for name, takes, gives, doc in rows
    }


FUNCTIONS = _build_table()
