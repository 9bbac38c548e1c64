"""Expressions of guards as formulas of the solver z3 (package `z3-solver`)."""

from collections.abc import Iterator, Sequence

import z3

from benchmarks.random_guards import ENUMERATION, RANGES, SIDES
from vicode.model.expressions import (
    FLOAT,
    INT,
    Binary,
    Boolean,
    Comparison,
    ElapsedTime,
    EnumElement,
    Expr,
    FunctionCall,
    Logic,
    Minus,
    Not,
    Number,
    Ternary,
    Variable,
)
from vicode.semantics.values import Value

NS_PER_S = 10**9
LARGEST_INT = 2**53
TIMES = {"state": "state_time", "component": "component_time"}
_OPERATORS = {
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b,
    "==": lambda a, b: a == b,
    "!=": lambda a, b: a != b,
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
}


class Encoder:
    """Expressions as formulas of z3: ints are integers, floats exact real numbers.

    Attributes:
        facts: The declared ranges of the variables that occur, and that no divisor is 0.
    """

    def __init__(self) -> None:
        self.variables: dict[str, z3.ExprRef] = {}
        self.facts: list[z3.BoolRef] = []

    def encode(self, node: Expr) -> z3.ExprRef:
        match node:
            case Number(value=value, type=type_):
                return z3.IntVal(value) if type_ == INT else z3.RealVal(repr(value))
            case Boolean(value=value):
                return z3.BoolVal(value)
            case EnumElement(element=element):
                return z3.IntVal(SIDES.index(element))
            case Variable(name=name, type=type_):
                return self._variable(name, type_)
            case ElapsedTime(kind=kind):
                return self._variable(TIMES[kind], FLOAT)
            case Not() | Logic() | Comparison():
                return self._encode_bool(node)
            case _:
                return self._encode_operation(node)

    def _encode_bool(self, node: Not | Logic | Comparison) -> z3.ExprRef:
        match node:
            case Not(operand=operand):
                return z3.Not(self.encode(operand))
            case Logic(operator=operator, operands=operands):
                return (z3.And if operator == "and" else z3.Or)(*map(self.encode, operands))
            case Comparison(operators=operators, operands=operands):
                neighbors = zip(operators, operands, operands[1:], strict=False)
                return z3.And(*(self._operate(operator, a, b) for operator, a, b in neighbors))

    def _encode_operation(self, node: Expr) -> z3.ExprRef:
        match node:
            case Ternary(test=test, then=then, otherwise=otherwise, type=type_):
                return z3.If(self.encode(test), self._as(then, type_), self._as(otherwise, type_))
            case Minus(operand=operand):
                return -self.encode(operand)
            case Binary(operator="/", left=left, right=right):
                divisor = self._as(right, FLOAT)
                self.facts.append(divisor != 0)
                return self._as(left, FLOAT) / divisor
            case Binary(operator=operator, left=left, right=right):
                return self._operate(operator, left, right)
            case FunctionCall(function=function, arguments=arguments, type=type_):
                return _call(function, [self._as(each, type_) for each in arguments])
        raise ValueError(type(node))

    def values_of(self, model: z3.ModelRef) -> dict[str, Value]:
        """The values of a solution, as near as doubles come."""
        found: dict[str, Value] = {}
        for name, variable in self.variables.items():
            value = model.eval(variable, model_completion=True)
            if z3.is_bool(value):
                found[name] = z3.is_true(value)
            elif z3.is_algebraic_value(value):
                found[name] = float(value.approx(20).as_fraction())
            elif name == "side":
                found[name] = f"{ENUMERATION.name}.{SIDES[value.as_long()]}"
            elif name == "state_time":
                found[name] = value.as_long() / NS_PER_S
            else:
                found[name] = value.as_long() if variable.is_int() else float(value.as_fraction())
        return found

    def _operate(self, operator: str, left: Expr, right: Expr) -> z3.ExprRef:
        type_ = FLOAT if FLOAT in (left.type, right.type) else left.type
        return _OPERATORS[operator](self._as(left, type_), self._as(right, type_))

    def _as(self, node: Expr, type_: str) -> z3.ExprRef:
        encoded = self.encode(node)
        return z3.ToReal(encoded) if type_ == FLOAT and encoded.is_int() else encoded

    def _variable(self, name: str, type_: str) -> z3.ExprRef:
        if name not in self.variables:
            if name == "state_time":
                self.variables[name] = z3.Int("ns")
                self.facts.append(self.variables[name] >= 0)
            else:
                sort = {FLOAT: z3.Real, "bool": z3.Bool}.get(type_, z3.Int)
                variable = self.variables[name] = sort(name)
                self.facts += _limits(variable, name, type_)
        variable = self.variables[name]
        return z3.ToReal(variable) / NS_PER_S if name == "state_time" else variable


def _limits(variable: z3.ExprRef, name: str, type_: str) -> Iterator[z3.BoolRef]:
    if name == "component_time":
        yield variable >= 0
    elif name in RANGES:
        low, high = RANGES[name]
        yield variable >= z3.RealVal(repr(low))
        yield variable <= z3.RealVal(repr(high))
    elif type_ == ENUMERATION.name:
        yield variable >= 0
        yield variable < len(SIDES)
    elif type_ == INT:
        yield variable >= -LARGEST_INT
        yield variable <= LARGEST_INT


def _call(function: str, given: Sequence[z3.ExprRef]) -> z3.ExprRef:
    match function:
        case "abs":
            return z3.If(given[0] < 0, -given[0], given[0])
        case "min":
            chosen = given[0]
            for each in given[1:]:
                chosen = z3.If(each < chosen, each, chosen)
            return chosen
        case "max":
            chosen = given[0]
            for each in given[1:]:
                chosen = z3.If(each > chosen, each, chosen)
            return chosen
        case "clamp":
            x, low, high = given
            return z3.If(x < low, low, z3.If(high < x, high, x))
    raise ValueError(function)
