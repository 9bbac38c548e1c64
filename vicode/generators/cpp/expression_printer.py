"""Prints typed expression trees as C++ with the fewest brackets."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from vicode.generators.cpp.names import GlobalNames, element_name, member_name
from vicode.generators.cpp.text import LINE_WIDTH
from vicode.generators.plan import (
    ComponentPlan,
    Condition,
    ExpressionCondition,
    FunctionPlan,
    IntRanges,
    TimerCondition,
    literal_value,
)
from vicode.model.expressions import (
    BOOL,
    FLOAT,
    INT,
    TEAM_SIZE,
    Binary,
    Boolean,
    Comparison,
    Done,
    ElapsedTime,
    EnumElement,
    Expr,
    FunctionCall,
    Logic,
    Minus,
    Not,
    Number,
    OutputRef,
    ScopeSymbolKind,
    StatusFlag,
    Ternary,
    Variable,
    walk,
)
from vicode.model.project import WORLD

TERNARY, OR, AND, COMPARISON, SUM, PRODUCT, UNARY, ATOM = range(8)
_FUNCTIONS = {"/": "divide", "//": "floor_divide", "%": "modulo"}
_XABSL_FUNCTIONS = {"/": "xabsl_divide", "//": "floor_divide", "%": "xabsl_remainder"}
_SATURATING = {"+": "add", "-": "subtract", "*": "multiply"}
_TEMPLATES = frozenset({"abs", "min", "max", "clamp", "sign"})


@dataclass(frozen=True, slots=True)
class Text:
    """A printed expression and the level of its outermost operator; `operands` are those of `&&` or `||`."""

    text: str
    level: int = ATOM
    operator: str = ""
    operands: "tuple[Text, ...]" = ()
    is_bracketed: bool = False

    def at(self, level: int) -> str:
        """The text, in brackets if an operator of this level needs them."""
        return self.text if self.level >= level else f"({self.text})"

    def bracketed_at(self, level: int) -> "Text":
        """The same as a text that can be broken into lines."""
        return self if self.level >= level else replace(self, text=f"({self.text})", level=ATOM, is_bracketed=True)

    def lines(self, before: str, after: str, indent: int) -> list[str]:
        """The text in one line, or one line per operand if it is too long."""
        line = f"{before}{self.text}{after}"
        if len(line) <= LINE_WIDTH or not self.operands:
            return [line]
        opening, closing = ("(", ")") if self.is_bracketed else ("", "")
        inner = indent + (4 if self.is_bracketed else 0)
        lines: list[str] = []
        for index, operand in enumerate(self.operands):
            first = f"{before}{opening}" if index == 0 else " " * (inner + 4)
            is_last = index == len(self.operands) - 1
            last = f"{closing}{after}" if is_last else f" {self.operator}"
            lines += operand.lines(first, last, inner)
        return lines


def chain(operator: str, operands: Sequence[Text]) -> Text:
    """Operands joined with `&&` or `||`."""
    # Compilers warn about `a && b || c` without brackets.
    parts = tuple(operand.bracketed_at(COMPARISON) for operand in operands)
    level = AND if operator == "&&" else OR
    return Text(f" {operator} ".join(part.text for part in parts), level, operator, parts)


@dataclass(frozen=True, slots=True, kw_only=True)
class ExpressionPrinter:
    """Prints the expressions of one component.

    Attributes:
        names: Global names as seen in the class.
        ranges: The ranges of ints, which tell where results need no function that limits them.
        nonzero_constants: Constants that are safe divisors.
        time_unit: "s" or "ms".
        functions: Outputs with arguments by alias and name.
        inputs: Outputs that the world provides, by alias and name: they are read by a method.
        enclosing_calls: Functions whose arguments contain the printed expression.
    """

    names: GlobalNames
    ranges: IntRanges
    nonzero_constants: frozenset[str] = frozenset()
    time_unit: str = "s"
    uses_xabsl_arithmetic: bool = False
    functions: Mapping[tuple[str, str], FunctionPlan] = field(default_factory=dict)
    inputs: frozenset[tuple[str, str]] = frozenset()
    enclosing_calls: frozenset[tuple[str, str]] = frozenset()

    @classmethod
    def of_component(
        cls, component: ComponentPlan, names: GlobalNames, nonzero_constants: frozenset[str]
    ) -> "ExpressionPrinter":
        interfaces = component.project.interfaces()
        provided = [use for use in component.uses if interfaces[use.component].implementation == WORLD]
        inputs = {(use.alias, value.name) for use in provided for value in interfaces[use.component].readable}
        return cls(
            names=names,
            ranges=component.ranges,
            nonzero_constants=nonzero_constants,
            time_unit=component.time_unit,
            uses_xabsl_arithmetic=component.arithmetic == "xabsl",
            functions={(use.alias, item.result.name): item for use in component.uses for item in use.functions},
            inputs=frozenset(inputs),
        )

    def print(self, node: Expr) -> Text:
        match node:
            case Number(value=value):
                return Text(format_number(value))
            case Boolean(value=value):
                return Text(str(value).lower())
            case EnumElement(element=element, type=enumeration):
                return Text(f"{self.names.declared(enumeration)}::{element_name(element)}")
            case Variable(name=name, kind=kind):
                is_constant = kind == ScopeSymbolKind.CONSTANT
                return Text(self.names.declared(name) if is_constant else member_name(name))
            case ElapsedTime(kind=of):
                is_in_ms = self.time_unit == "ms"
                return Text(f"bica::to_float({of}_time_ns()) / 1e6", PRODUCT) if is_in_ms else Text(f"{of}_time()")
            case StatusFlag() | Done():
                return Text(_status(node))
            case OutputRef():
                return self._limited(self._output(node)) if self.ranges.is_external(node) else self._output(node)
            case _:
                return self._operation(node)

    def stored(self, node: Expr) -> Text:
        """A value that is stored or passed: ints are limited to ±2^53."""
        text = self.print(node)
        return text if self.ranges.is_storable(node) else self._limited(text)

    @staticmethod
    def _limited(text: Text) -> Text:
        return Text(f"bica::limit({text.text})")

    def _operation(self, node: Expr) -> Text:
        match node:
            case Not(operand=operand):
                return Text(f"!{self.print(operand).at(UNARY)}", UNARY)
            case Minus(operand=operand):
                inner = self.print(operand)
                if self.ranges.may_overflow(node):
                    return Text(f"bica::negate({inner.text})")
                # Two signs in a row are the operator `--`.
                return Text(f"-({inner.text})" if inner.text.startswith("-") else f"-{inner.at(UNARY)}", UNARY)
            case Binary():
                return self._binary(node)
            case Comparison():
                return self._comparison(node)
            case Logic(operator=operator, operands=operands):
                return self._logic(operator, operands)
            case Ternary():
                return self._ternary(node, node.type)
            case FunctionCall(function=function, arguments=arguments):
                return self._call(function, arguments)
            case _:
                raise AssertionError(f"unexpected expression node: {node}")

    def condition(self, condition: Condition) -> Text:
        match condition:
            case ExpressionCondition(expression=expression):
                return self.print(expression)
            case TimerCondition(ns=ns) if ns is not None:
                return Text(f"state_time_ns() >= {_digit_groups(ns)}", COMPARISON)
            case TimerCondition(time=time):
                factor = "1e6" if self.time_unit == "ms" else "1e9"
                return Text(
                    f"state_time_ns() >= bica::nanoseconds({self._float(time).at(PRODUCT)} * {factor})", COMPARISON
                )
            case _:
                return Text(f"when_{condition.code.stem}()")

    def guard(self, conditions: tuple[Condition, ...]) -> Text:
        """All conditions, joined with `&&`."""
        texts = [self.condition(each) for each in conditions]
        if len(texts) == 1:
            return texts[0]
        return chain("&&", [part for text in texts for part in (text.operands if text.level == AND else (text,))])

    def _float(self, node: Expr) -> Text:
        """An operand of a calculation with doubles."""
        value = literal_value(node)
        if node.type == FLOAT:
            return self.print(node)
        if isinstance(node, Ternary):
            return self._ternary(node, FLOAT)
        if value is not None:
            return Text(format_number(float(value)), UNARY if value < 0 else ATOM)
        return Text(f"bica::to_float({self.print(node).text})")

    def _ternary(self, node: Ternary, type_: str) -> Text:
        then, otherwise = (self._operand(side, type_).at(OR) for side in (node.then, node.otherwise))
        return Text(f"{self.print(node.test).at(OR)} ? {then} : {otherwise}", TERNARY)

    def _operand(self, node: Expr, type_: str) -> Text:
        return self._float(node) if type_ == FLOAT else self.print(node)

    def _binary(self, node: Binary) -> Text:
        operator, left, right = node.operator, node.left, node.right
        functions = _XABSL_FUNCTIONS if self.uses_xabsl_arithmetic else _FUNCTIONS
        if operator in functions and not (operator == "/" and self._is_nonzero(right)):
            return Text(f"bica::{functions[operator]}({self._float(left).text}, {self._float(right).text})")
        if self.ranges.may_overflow(node):
            return Text(f"bica::{_SATURATING[operator]}({self.print(left).text}, {self.print(right).text})")
        level = SUM if operator in "+-" else PRODUCT
        type_ = FLOAT if operator == "/" else node.type
        first = self._operand(left, type_)
        if type_ == INT and _is_c_int(left) and _is_c_int(right):
            first = Text(f"std::int64_t{{{first.text}}}")
        return Text(f"{first.at(level)} {operator} {self._operand(right, type_).at(level + 1)}", level)

    def _is_nonzero(self, node: Expr) -> bool:
        if isinstance(node, Variable) and node.kind == ScopeSymbolKind.CONSTANT:
            return node.name in self.nonzero_constants
        return bool(literal_value(node))

    def _comparison(self, node: Comparison) -> Text:
        operands, operators = node.operands, node.operators
        pairs = list(zip(operands, operators, operands[1:], strict=False))
        if len(pairs) == 1:
            return self._compare(*pairs[0])
        if all(_is_simple(operand) for operand in operands[1:-1]):
            return chain("&&", [self._compare(*pair) for pair in pairs])
        return Text(f"[&] {{ const auto value_0 = {self.print(operands[0]).text}; {self._compared_once(pairs, 0)} }}()")

    def _compared_once(self, pairs: Sequence[tuple[Expr, str, Expr]], index: int) -> str:
        """The rest of a chain: each operand is evaluated at most once, and only if the comparisons before it hold."""
        left, operator, right = pairs[index]
        sides = [f"value_{index}", f"value_{index + 1}"]
        if FLOAT in (left.type, right.type) and INT in (left.type, right.type):
            sides = [f"bica::to_float({side})" for side in sides]
        value = f"const auto value_{index + 1} = {self.print(right).text};"
        test = f"{sides[0]} {operator} {sides[1]}"
        if index == len(pairs) - 1:
            return f"{value} return {test};"
        return f"{value} return {test} && [&] {{ {self._compared_once(pairs, index + 1)} }}();"

    def _compare(self, left: Expr, operator: str, right: Expr) -> Text:
        type_ = FLOAT if FLOAT in (left.type, right.type) else left.type
        pairs = ((left, right), (right, left))
        sides = [self._compared(side, other, type_).at(SUM) for side, other in pairs]
        if sides[0] == sides[1] and type_ != FLOAT and self._is_stored(left):
            # Compilers warn that a comparison of a variable with itself is constant.
            return Text("true" if operator in ("==", "<=", ">=") else "false")
        return Text(f"{sides[0]} {operator} {sides[1]}", COMPARISON)

    def _compared(self, node: Expr, other: Expr, type_: str) -> Text:
        """An operand of a comparison; an int need not be limited next to one that lies inside the limits."""
        is_free = self.ranges.is_inside(other) and not self.ranges.is_external(other)
        if isinstance(node, OutputRef) and self.ranges.is_external(node) and is_free:
            return self._output(node)
        return self._operand(node, type_)

    def _is_stored(self, node: Expr) -> bool:
        match node:
            case Variable():
                return True
            case OutputRef(alias=alias, output=output, arguments=None):
                return (alias, output) not in self.inputs
            case _:
                return False

    def _logic(self, operator: str, operands: tuple[Expr, ...]) -> Text:
        return chain("&&" if operator == "and" else "||", [self.print(operand) for operand in operands])

    def _call(self, function: str, arguments: tuple[Expr, ...]) -> Text:
        if function == "float":
            return self._float(arguments[0])
        if function not in _TEMPLATES:
            return Text(f"bica::{function if function != 'int' else 'to_int'}({self._list(arguments, FLOAT)})")
        type_ = FLOAT if any(argument.type == FLOAT for argument in arguments) else INT
        return Text(f"bica::{function}({self._list(arguments, type_)})")

    def _list(self, arguments: tuple[Expr, ...], type_: str) -> str:
        return ", ".join(self._argument(argument, type_) for argument in arguments)

    def _argument(self, node: Expr, type_: str) -> str:
        # 3 is an int, as is a choice between literals: templates need the type of the other arguments.
        if type_ == INT and _is_c_int(node):
            return f"std::int64_t{{{self.print(node).text}}}"
        return self._operand(node, type_).text

    def _output(self, reference: OutputRef) -> Text:
        key = (reference.alias, reference.output)
        target = f"{member_name(reference.alias)}.{member_name(reference.output)}"
        if reference.arguments is None:
            return Text(f"{target}()" if key in self.inputs else target)
        if key in self.enclosing_calls or (self.uses_xabsl_arithmetic and _calls_itself(reference)):
            return self._nested_call(reference)
        given = dict(reference.arguments)
        values = (given.get(argument.name, argument.initial) for argument in self.functions[key].arguments)
        return Text(f"{target}({', '.join(self.stored(value).text for value in values)})")

    def _nested_call(self, reference: OutputRef) -> Text:
        """XABSL stores the arguments of a function in one place, which a call in an argument overwrites."""
        key, given = (reference.alias, reference.output), dict(reference.arguments or ())
        inside = replace(self, enclosing_calls=self.enclosing_calls | {key})
        declared = self.functions[key].arguments
        cells = {each.name: f"argument_{index}_{'_'.join(key)}" for index, each in enumerate(declared)}
        # XABSL stores decimals first, then bools, then elements.
        ordered = sorted(declared, key=lambda each: (each.type == BOOL) + 2 * (each.type not in (BOOL, INT, FLOAT)))
        statements = [
            f"{cells[each.name]} = {inside.stored(given.get(each.name, each.initial)).text};" for each in ordered
        ]
        if key not in self.enclosing_calls:
            statements = [
                *(f"{self.names.type_name(each.type)} {cells[each.name]}{{}};" for each in declared),
                *statements,
            ]
        target = f"{member_name(reference.alias)}.{member_name(reference.output)}({', '.join(cells.values())})"
        return Text(f"[&] {{ {' '.join(statements)} return {target}; }}()")


def _calls_itself(reference: OutputRef) -> bool:
    """Whether an argument of a call contains a call of the same function."""
    return any(
        isinstance(node, OutputRef) and (node.alias, node.output) == (reference.alias, reference.output)
        for _name, value in reference.arguments or ()
        for node in walk(value)
    )


def _status(node: StatusFlag | Done) -> str:
    if isinstance(node, Done):
        return f"{member_name(node.alias)}.is_done()"
    return "root.team.size" if node.name == TEAM_SIZE else f"{node.name}()"


def format_number(value: float) -> str:
    return repr(value).replace("e+", "e")


def _digit_groups(value: int) -> str:
    return f"{value:,}".replace(",", "'")


def _is_c_int(node: Expr) -> bool:
    """Whether the type of the printed expression is `int`, in which calculations overflow early."""
    match node:
        case Number(type=type_):
            return type_ == INT
        case Minus(operand=operand):
            return _is_c_int(operand)
        case Ternary(then=then, otherwise=otherwise):
            return _is_c_int(then) and _is_c_int(otherwise)
        case _:
            return False


def _is_simple(node: Expr) -> bool:
    """Whether evaluating a node twice gives the same value without a cost."""
    match node:
        case Number() | Boolean() | EnumElement() | Variable():
            return True
        case Minus(operand=operand):
            return _is_simple(operand)
        case _:
            return False
