"""Spells typed trees as Python, with no bracket too many."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from vicode.generators.plan import After, ComponentPlan, Condition, Function, Holds, literal_of
from vicode.generators.python.layout import Doc, joined
from vicode.generators.python.pieces import (
    ADDITION,
    AND,
    COMPARISON,
    MULTIPLICATION,
    NEGATIVE,
    NOT,
    OR,
    Piece,
    atom,
    call_piece,
    chain,
    prefixed,
    ternary,
)
from vicode.model.expressions import (
    BOOL,
    FLOAT,
    INT,
    Apply,
    Binary,
    Choice,
    Comparison,
    Done,
    Element,
    Kind,
    Logic,
    Minus,
    Node,
    Not,
    Number,
    Reading,
    Status,
    Time,
    Truth,
    Variable,
    walk,
)

_BUILTIN = {"abs": "abs", "min": "min", "max": "max", "float": "float"}
_RENAMED = {"int": "to_int", "round": "round_half_even"}
_GUARDED = {"/": "divide", "//": "floor_divide", "%": "modulo"}
_XABSL = {"/": "xabsl_divide", "//": "floor_divide", "%": "xabsl_remainder"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Speller:
    """Spells expressions of one component: `names` of constants and enumerations in the module, the unit of times.

    `is_xabsl`: it divides as XABSL does. `functions` are outputs with arguments by alias and name, `asked` those among
    whose arguments this is.
    """

    names: Mapping[str, str]
    never_zero: frozenset[str] = frozenset()
    time_unit: str = "s"
    is_xabsl: bool = False
    functions: Mapping[tuple[str, str], Function] = field(default_factory=dict)
    asked: frozenset[tuple[str, str]] = frozenset()

    def spell(self, node: Node) -> Piece:
        """The Python of a typed tree."""
        match node:
            case Number(value=value):
                return atom(spell_number(value))
            case Truth(value=value):
                return atom(str(value))
            case Element(element=element, type=enumeration):
                return atom(f"{self.names[enumeration]}.{element}")
            case Variable(name=name, kind=kind):
                return atom(self.names[name] if kind == Kind.CONSTANT else f"self.{name}")
            case Time(of=of):
                return self._spell_time(of)
            case Status(of=of) | Done(alias=of):
                return atom(f"self.{of}" if isinstance(node, Status) else f"self.{of}.is_done")
            case Reading():
                return self._spell_reading(node)
            case _:
                return self._spell_operation(node)

    def spell_conditions(self, conditions: tuple[Condition, ...]) -> Piece:
        """All conditions of a guard, joined by `and`."""
        pieces = [self._spell_condition(condition) for condition in conditions]
        if len(pieces) == 1:
            return pieces[0]
        return chain([(None, pieces[0]), *(("and", piece) for piece in pieces[1:])], AND)

    def _spell_condition(self, condition: Condition) -> Piece:
        match condition:
            case Holds(expression=expression):
                return self.spell(expression)
            case After():
                return self._spell_after(condition)
            case _:
                return atom(f"self._when_{condition.body.stem}()")

    def _spell_after(self, after: After) -> Piece:
        passed = chain([(None, atom("self.root.now_ns")), ("-", atom("self._entered_ns"))], ADDITION)
        if after.ns is not None:
            return chain([(None, passed), (">=", atom(f"{after.ns:_}"))], COMPARISON)
        factor = atom("1e6" if self.time_unit == "ms" else "1e9")
        product = chain([(None, self.spell(after.time)), ("*", factor)], MULTIPLICATION)
        return chain([(None, passed), (">=", call_piece("round", [product.breakable]))], COMPARISON)

    def _spell_time(self, of: str) -> Piece:
        if self.time_unit != "ms":
            return atom(f"self.{of}_time")
        since = atom(f"self._{'entered' if of == 'state' else 'started'}_ns")
        passed = chain([(None, atom("self.root.now_ns")), ("-", since)], ADDITION)
        return chain([(None, passed), ("/", atom("1e6"))], MULTIPLICATION)

    def _spell_reading(self, reading: Reading) -> Piece:
        target, arguments = f"self.{reading.alias}.{reading.output}", reading.arguments
        if arguments is None:
            return atom(target)
        if (reading.alias, reading.output) in self.asked or (self.is_xabsl and _is_nested(reading)):
            return self._spell_nested(reading)
        return call_piece(target, [_keyword(name, self.spell(value)) for name, value in arguments])

    def _spell_nested(self, reading: Reading) -> Piece:
        """XABSL keeps the arguments of a function in one place, which a call of it among them changes."""
        given, function = dict(reading.arguments or ()), (reading.alias, reading.output)
        inside = replace(self, asked=self.asked | {function})
        declared = self.functions[function].arguments
        # Decimals are stored first, then bools, then elements.
        ordered = sorted(declared, key=lambda each: (each.type == BOOL) + 2 * (each.type not in (BOOL, INT, FLOAT)))
        arguments: list[Doc] = [f"self.{reading.alias}.{reading.output}"]
        for each in ordered:
            value = inside.spell(given.get(each.name, each.initial)).breakable
            arguments.append(joined(f"{each.name}=lambda: ", value))
        return call_piece("self._ask", arguments)

    def _spell_operation(self, node: Node) -> Piece:
        match node:
            case Not(operand=operand):
                return prefixed("not ", self.spell(operand), NOT)
            case Minus(operand=operand):
                return prefixed("-", self.spell(operand), NEGATIVE)
            case Binary():
                return self._spell_binary(node)
            case Comparison(operators=operators, operands=operands):
                pieces = [self.spell(operand) for operand in operands]
                return chain([(None, pieces[0]), *zip(operators, pieces[1:], strict=True)], COMPARISON)
            case Logic(operator=operator, operands=operands):
                pieces = [self.spell(operand) for operand in operands]
                level = AND if operator == "and" else OR
                return chain([(None, pieces[0]), *((operator, piece) for piece in pieces[1:])], level)
            case Choice(test=test, then=then, otherwise=otherwise):
                return ternary(self.spell(then), self.spell(test), self.spell(otherwise))
            case Apply(function=function, arguments=arguments):
                name = _BUILTIN.get(function) or f"{self.names['arithmetic']}.{_RENAMED.get(function, function)}"
                return call_piece(name, [self.spell(argument).breakable for argument in arguments])
            case _:
                raise AssertionError(f"no spelling for {node}")

    def _spell_binary(self, node: Binary) -> Piece:
        operator, left, right = node.operator, node.left, node.right
        guarded = _XABSL if self.is_xabsl else _GUARDED
        if operator in guarded and not self._is_never_zero(right, operator):
            name = f"{self.names['arithmetic']}.{guarded[operator]}"
            return call_piece(name, [self.spell(left).breakable, self.spell(right).breakable])
        right_piece = self.spell(_as_float(right)) if operator in ("//", "%") else self.spell(right)
        level = ADDITION if operator in "+-" else MULTIPLICATION
        return chain([(None, self.spell(left)), (operator, right_piece)], level)

    def _is_never_zero(self, node: Node, operator: str) -> bool:
        """Whether Python's own operator, which raises for zero alone, gives the same before it."""
        if self.is_xabsl and operator == "%":
            return False
        if isinstance(node, Variable) and node.kind == Kind.CONSTANT:
            return node.name in self.never_zero and (operator == "/" or node.type == FLOAT)
        return bool(literal_of(node))


def functions_of(component: ComponentPlan) -> dict[tuple[str, str], Function]:
    """The outputs with arguments that a component may ask, by alias and name."""
    return {(use.alias, each.result.name): each for use in component.uses for each in use.functions}


def spell_number(value: float) -> str:
    """A number as a formatter leaves it."""
    return repr(value).replace("e+", "e")


def _as_float(node: Node) -> Node:
    # `//` and `%` of two ints would be an int, and are defined to be floats.
    match node:
        case Number(value=value, span=span):
            return Number(value=float(value), type=FLOAT, span=span)
        case Minus(operand=operand, span=span):
            return Minus(operand=_as_float(operand), type=FLOAT, span=span)
        case _:
            return node


def _is_nested(reading: Reading) -> bool:
    """Whether a function is called among its own arguments."""
    inside = (each for _name, value in reading.arguments or () for each in walk(value))
    return any(
        isinstance(each, Reading) and (each.alias, each.output) == (reading.alias, reading.output) for each in inside
    )


def _keyword(name: str, value: Piece) -> Doc:
    return joined(f"{name}=", value.breakable)
