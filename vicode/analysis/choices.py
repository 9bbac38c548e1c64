"""Functions that choose among their arguments, as the conditional expressions that docs/semantics.md defines."""

from vicode.model.expressions import INT, Comparison, Expr, FunctionCall, Minus, Number, Ternary

_NO_SPAN = (0, 0)


def lower_to_choices(node: Expr) -> Expr:
    """A minimum, maximum, limit or sign as the choices that docs/semantics.md defines."""
    match node:
        case FunctionCall(function="min" | "max" as name, arguments=(a, b), type=type_):
            test = Comparison(operators=("<" if name == "min" else ">",), operands=(b, a), span=_NO_SPAN)
            return Ternary(test=test, then=b, otherwise=a, type=type_, span=node.span)
        case FunctionCall(function="clamp", arguments=(x, low, high), type=type_):
            is_low = Comparison(operators=("<",), operands=(x, low), span=_NO_SPAN)
            is_high = Comparison(operators=("<",), operands=(high, x), span=_NO_SPAN)
            inner = Ternary(test=is_high, then=high, otherwise=x, type=type_, span=node.span)
            return Ternary(test=is_low, then=low, otherwise=inner, type=type_, span=node.span)
        case FunctionCall(function="sign", arguments=(x,)):
            zero, one = (Number(value=value, type=INT, span=_NO_SPAN) for value in (0, 1))
            minus = Minus(operand=one, type=INT, span=_NO_SPAN)
            is_negative = Comparison(operators=("<",), operands=(x, zero), span=_NO_SPAN)
            is_positive = Comparison(operators=(">",), operands=(x, zero), span=_NO_SPAN)
            inner = Ternary(test=is_negative, then=minus, otherwise=zero, type=INT, span=node.span)
            return Ternary(test=is_positive, then=one, otherwise=inner, type=INT, span=node.span)
        case _:
            return node
