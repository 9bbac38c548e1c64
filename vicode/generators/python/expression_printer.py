"""Prints typed expression trees as Python with the fewest brackets."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Self

from vicode.bica.arithmetic import MAX_INT
from vicode.generators.plan import (
    ComponentPlan,
    Condition,
    ExpressionCondition,
    FunctionPlan,
    IntRanges,
    ProjectPlan,
    TimerCondition,
    ValuePlan,
    literal_value,
)
from vicode.generators.python.expression_doc import (
    ADDITION,
    AND,
    COMPARISON,
    MULTIPLICATION,
    NEGATIVE,
    NOT,
    OR,
    ExpressionDoc,
    atom,
    call_expression,
    conditional_expression,
    operator_chain,
    unary_expression,
)
from vicode.generators.python.pretty_printer import Doc, concat
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
from vicode.model.names import python_attribute_name

_BUILTIN_FUNCTIONS = frozenset({"abs", "min", "max", "float"})
_ARITHMETIC_NAMES = {"int": "to_int", "round": "round_half_even"}
_SAFE_OPERATORS = {"/": "divide", "//": "floor_divide", "%": "modulo"}
_XABSL_OPERATORS = {"/": "xabsl_divide", "//": "floor_divide", "%": "xabsl_remainder"}


@dataclass(frozen=True, slots=True, kw_only=True)
class PythonExpressionPrinter:
    """Prints the expressions of one component.

    Attributes:
        names: Names of constants and enumerations in the module.
        ranges: The ranges of ints, which tell where results need no function that limits them.
        used_names: Collects the printed names of `names`, from which the imports are derived.
        time_unit: "s" or "ms".
        functions: Outputs with arguments by alias and name.
        inputs: Outputs of components that the world provides, by alias and name.
        enclosing_calls: Functions whose arguments contain the printed expression.
    """

    names: Mapping[str, str]
    ranges: IntRanges
    used_names: set[str] = field(default_factory=set)
    nonzero_constants: frozenset[str] = frozenset()
    time_unit: str = "s"
    uses_xabsl_arithmetic: bool = False
    functions: Mapping[tuple[str, str], FunctionPlan] = field(default_factory=dict)
    inputs: Mapping[tuple[str, str], ValuePlan] = field(default_factory=dict)
    enclosing_calls: frozenset[tuple[str, str]] = frozenset()

    @classmethod
    def of_component(cls, project: ProjectPlan, component: ComponentPlan, names: Mapping[str, str]) -> Self:
        """Return the printer for the expressions of a component in a module that uses these names."""
        return cls(
            names=names,
            ranges=component.ranges,
            nonzero_constants=project.nonzero_constants,
            time_unit=component.time_unit,
            uses_xabsl_arithmetic=component.arithmetic == "xabsl",
            functions={(use.alias, item.result.name): item for use in component.uses for item in use.functions},
            inputs={(use.alias, value.name): value for use in component.uses for value in use.inputs},
        )

    def to_doc(self, node: Expr) -> ExpressionDoc:
        """Return the document of a typed tree."""
        doc = self._unlimited_doc(node)
        if self._is_external(node):
            return self._arithmetic("limit", doc)
        return self._arithmetic("saturate", doc) if self.ranges.may_overflow(node) else doc

    def stored_doc(self, node: Expr) -> ExpressionDoc:
        """Return the document of a value that is stored or passed: ints are limited to ±2**53."""
        doc = self._unlimited_doc(node)
        is_storable = self.ranges.is_storable(node) and not self._is_external(node)
        return doc if is_storable else self._arithmetic("limit", doc)

    def _is_external(self, node: Expr) -> bool:
        is_input = isinstance(node, OutputRef) and (node.alias, node.output) in self.inputs
        return self.ranges.is_external(node) or (is_input and node.type == INT)

    def _arithmetic(self, function: str, *operands: ExpressionDoc) -> ExpressionDoc:
        name = f"{self.global_name('arithmetic')}.{function}"
        return call_expression(name, [operand.breakable for operand in operands])

    def _float_doc(self, node: Expr) -> ExpressionDoc:
        """Print an operand that Python converts to float, but not exactly as a double if it is a large int."""
        doc = self.to_doc(node)
        return doc if self.ranges.is_storable(node) else call_expression("float", [doc.breakable])

    def _unlimited_doc(self, node: Expr) -> ExpressionDoc:
        """Print a tree; the result of the outermost operation on ints is not limited."""
        match node:
            case Number(value=value):
                return atom(format_number(value))
            case Boolean(value=value):
                return atom(str(value))
            case EnumElement(element=element, type=enumeration):
                return atom(f"{self.global_name(enumeration)}.{element}")
            case Variable(name=name, kind=kind):
                return atom(self.global_name(name) if kind == ScopeSymbolKind.CONSTANT else f"self.{name}")
            case ElapsedTime(kind=of):
                return self._time_doc(of)
            case StatusFlag() | Done():
                return atom(_status(node))
            case OutputRef():
                return self._output_doc(node)
            case _:
                return self._operation_doc(node)

    def global_name(self, name: str) -> str:
        """Return the name in the module and mark it as used."""
        self.used_names.add(self.names[name])
        return self.names[name]

    def conditions_to_doc(self, conditions: tuple[Condition, ...]) -> ExpressionDoc:
        """Join the conditions of a guard by `and`."""
        pieces = [self._condition_doc(condition) for condition in conditions]
        if len(pieces) == 1:
            return pieces[0]
        return operator_chain([(None, pieces[0]), *(("and", piece) for piece in pieces[1:])], AND)

    def _condition_doc(self, condition: Condition) -> ExpressionDoc:
        match condition:
            case ExpressionCondition(expression=expression):
                return self.to_doc(expression)
            case TimerCondition():
                return self._timer_doc(condition)
            case _:
                return atom(f"self._when_{condition.code.stem}()")

    def _timer_doc(self, after: TimerCondition) -> ExpressionDoc:
        passed = operator_chain([(None, atom("self.root.now_ns")), ("-", atom("self._entered_ns"))], ADDITION)
        if after.ns is not None:
            return operator_chain([(None, passed), (">=", atom(f"{after.ns:_}"))], COMPARISON)
        factor = atom("1e6" if self.time_unit == "ms" else "1e9")
        product = operator_chain([(None, self.to_doc(after.time)), ("*", factor)], MULTIPLICATION)
        return operator_chain([(None, passed), (">=", call_expression("round", [product.breakable]))], COMPARISON)

    def _time_doc(self, of: str) -> ExpressionDoc:
        if self.time_unit != "ms":
            return atom(f"self.{of}_time")
        since = atom(f"self._{'entered' if of == 'state' else 'started'}_ns")
        passed = operator_chain([(None, atom("self.root.now_ns")), ("-", since)], ADDITION)
        return operator_chain([(None, passed), ("/", atom("1e6"))], MULTIPLICATION)

    def _output_doc(self, reference: OutputRef) -> ExpressionDoc:
        target, arguments = f"self.{reference.alias}.{reference.output}", reference.arguments
        if arguments is None:
            value = self.inputs.get((reference.alias, reference.output))
            return atom(target) if value is None else self.input_doc(value)
        if (reference.alias, reference.output) in self.enclosing_calls or (
            self.uses_xabsl_arithmetic and _calls_itself(reference)
        ):
            return self._nested_call_doc(reference)
        return call_expression(target, [_keyword(name, self.stored_doc(value)) for name, value in arguments])

    def input_doc(self, value: ValuePlan) -> ExpressionDoc:
        """Read an attribute of the world as a value of the declared type."""
        conversion = value.type if value.type in (BOOL, INT, FLOAT) else self.global_name(value.type)
        return call_expression(conversion, [f"self.world.{world_name(value)}"])

    def _nested_call_doc(self, reference: OutputRef) -> ExpressionDoc:
        """Pass the arguments lazily: XABSL stores them in one place per function, which a nested call overwrites."""
        values, function = dict(reference.arguments or ()), (reference.alias, reference.output)
        inside = replace(self, enclosing_calls=self.enclosing_calls | {function})
        declared = self.functions[function].arguments
        # XABSL stores decimals first, then bools, then elements.
        ordered = sorted(declared, key=lambda item: (item.type == BOOL) + 2 * (item.type not in (BOOL, INT, FLOAT)))
        arguments: list[Doc] = [f"self.{reference.alias}.{reference.output}"]
        for argument in ordered:
            value = inside.stored_doc(values.get(argument.name, argument.initial)).breakable
            arguments.append(concat(f"{argument.name}=lambda: ", value))
        return call_expression("self._ask", arguments)

    def _operation_doc(self, node: Expr) -> ExpressionDoc:
        match node:
            case Not(operand=operand):
                return unary_expression("not ", self.to_doc(operand), NOT)
            case Minus(operand=operand):
                return unary_expression("-", self.to_doc(operand), NEGATIVE)
            case Binary():
                return self._binary_doc(node)
            case Comparison(operators=operators, operands=operands):
                pieces = self._compared_docs(operands)
                return operator_chain([(None, pieces[0]), *zip(operators, pieces[1:], strict=True)], COMPARISON)
            case Logic(operator=operator, operands=operands):
                pieces = [self.to_doc(operand) for operand in operands]
                level = AND if operator == "and" else OR
                return operator_chain([(None, pieces[0]), *((operator, piece) for piece in pieces[1:])], level)
            case Ternary(test=test, then=then, otherwise=otherwise):
                return conditional_expression(self.to_doc(then), self.to_doc(test), self.to_doc(otherwise))
            case FunctionCall(function=function, arguments=arguments):
                pieces = [self.to_doc(argument) for argument in arguments]
                if function in _BUILTIN_FUNCTIONS:
                    return call_expression(function, [piece.breakable for piece in pieces])
                return self._arithmetic(_ARITHMETIC_NAMES.get(function, function), *pieces)
            case _:
                raise AssertionError(f"unexpected expression node: {node}")

    def _binary_doc(self, node: Binary) -> ExpressionDoc:
        operator, left, right = node.operator, node.left, node.right
        guarded = _XABSL_OPERATORS if self.uses_xabsl_arithmetic else _SAFE_OPERATORS
        print_operand = self._float_doc if operator == "/" else self.to_doc
        if operator in guarded and not self._is_nonzero(right, operator):
            return self._arithmetic(guarded[operator], print_operand(left), print_operand(right))
        right_piece = self.to_doc(_as_float(right)) if operator in ("//", "%") else print_operand(right)
        level = ADDITION if operator in "+-" else MULTIPLICATION
        return operator_chain([(None, print_operand(left)), (operator, right_piece)], level)

    def _compared_docs(self, operands: tuple[Expr, ...]) -> list[ExpressionDoc]:
        """Print the operands of a comparison; an int need not be limited next to numbers that lie inside the limits."""
        docs = []
        for index, operand in enumerate(operands):
            others = (*operands[max(0, index - 1) : index], *operands[index + 1 : index + 2])
            if operand.type == INT and all(self._is_inside(other) for other in others):
                docs.append(self._unlimited_doc(operand))
            elif operand.type == INT and any(other.type == FLOAT for other in others):
                docs.append(self._float_doc(operand))
            else:
                docs.append(self.to_doc(operand))
        return docs

    def _is_inside(self, node: Expr) -> bool:
        value = literal_value(node)
        if value is not None:
            return abs(value) < MAX_INT
        return self.ranges.is_inside(node) and not self._is_external(node)

    def _is_nonzero(self, node: Expr, operator: str) -> bool:
        """Whether the operator of Python gives the same result for this divisor; it raises only for zero."""
        if self.uses_xabsl_arithmetic and operator == "%":
            return False
        if isinstance(node, Variable) and node.kind == ScopeSymbolKind.CONSTANT:
            return node.name in self.nonzero_constants and (operator == "/" or node.type == FLOAT)
        return bool(literal_value(node))


def world_name(value: ValuePlan) -> str:
    """Return the name in the world, which is the same for the XABSL engine."""
    return python_attribute_name(value.xabsl_name or value.name)


def format_number(value: float) -> str:
    """Format a number as ruff does."""
    return repr(value).replace("e+", "e")


def _as_float(node: Expr) -> Expr:
    # `//` and `%` are defined to return floats, but return an int for two ints.
    match node:
        case Number(value=value, span=span):
            return Number(value=float(value), type=FLOAT, span=span)
        case Minus(operand=operand, span=span):
            return Minus(operand=_as_float(operand), type=FLOAT, span=span)
        case _:
            return node


def _calls_itself(reference: OutputRef) -> bool:
    """Whether a call of a function contains another call of it."""
    nodes = (node for _name, value in reference.arguments or () for node in walk(value))
    return any(
        isinstance(node, OutputRef) and (node.alias, node.output) == (reference.alias, reference.output)
        for node in nodes
    )


def _keyword(name: str, value: ExpressionDoc) -> Doc:
    return concat(f"{name}=", value.breakable)


def _status(node: StatusFlag | Done) -> str:
    if isinstance(node, Done):
        return f"self.{node.alias}.is_done"
    return "self.root.team.size" if node.name == TEAM_SIZE else f"self.{node.name}"
