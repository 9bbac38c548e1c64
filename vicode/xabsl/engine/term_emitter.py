"""Emits the terms of a program as Python expressions.

Python compiles the text, so it contains no word of the program except numbers: symbols and parameters get generated
names, elements of enumerations are written by `repr`.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from .program import Term, TypedSlot

_INFIX = {
    "+": "+",
    "-": "-",
    "*": "*",
    "=": "==",
    "n": "!=",
    "<": "<",
    "l": "<=",
    ">": ">",
    "g": ">=",
    "c": "==",
    "&": "and",
    "|": "or",
}
_CHAINS = ("+-", "*")
_MAX_NESTING = 60
"""Python reads at most 200 nested parentheses; deeper expressions are moved to functions."""
TIME_MASK = "0xFFFFFFFF"
"""Times are integer milliseconds that wrap around after 32 bits, as in the original."""

_DEFAULTS = {"d": "0.0", "b": "False"}


@dataclass(frozen=True, slots=True)
class InputAccess:
    """Access to an input symbol: a Python expression, or a callable if `keywords` is set (keyword by parameter).

    `cells` names a list of the parameter values, set if a call is nested in the arguments of another call of the same
    symbol. In the original all calls share the parameters, so that the inner call overwrites those of the outer one.
    """

    text: str
    keywords: Mapping[str, str] | None = None
    parameters: tuple[TypedSlot, ...] = ()
    cells: str = ""


@dataclass(slots=True)
class TermEmitter:
    """Emits the terms of one state. `action_done`, `conflict` and the times are Python expressions."""

    inputs: Mapping[str, InputAccess]
    outputs: Mapping[str, str]
    parameters: Mapping[str, str]
    first_element: Callable[[str], str]
    state_time: str = "0"
    option_time: str = "0"
    action_done: str = "False"
    conflict: str = "False"
    to_function: Callable[[str], str] = str
    """Moves an expression to a function and returns the call."""

    def emit(self, term: Term, kind: str) -> str:
        """Emit a term of this kind, in parentheses where necessary."""
        text = self._emit(term, kind)
        return self.to_function(text) if len(text) > 2 * _MAX_NESTING and _nesting(text) > _MAX_NESTING else text

    def _emit(self, term: Term, kind: str) -> str:
        letter = term[0]
        match letter:
            case "v":
                return repr(term[1].rpartition(".")[2]) if kind == "e" else _number(term[1])
            case "o":
                return self.outputs[term[1]]
            case "p":
                return self.parameters[term[1]]
            case "i":
                return self._input(term)
            case "q":
                condition = self.emit(term[1], "b")
                return f"({self.emit(term[2], kind)} if {condition} else {self.emit(term[3], kind)})"
        return self._decimal(term) if kind == "d" else self._boolean(term)

    def emit_arguments(self, slots: tuple[TypedSlot, ...], arguments: tuple[Term, ...]) -> list[tuple[TypedSlot, str]]:
        """Emit the values of all parameters in the order of evaluation: decimals, then bools, then enums."""
        terms = {argument[-2]: argument[-1] for argument in arguments}
        ordered = sorted(slots, key=lambda slot: "dbe".index(slot.kind))
        return [
            (slot, self.emit(terms[slot.name], slot.kind) if slot.name in terms else self._default(slot))
            for slot in ordered
        ]

    def _default(self, slot: TypedSlot) -> str:
        return _DEFAULTS.get(slot.kind) or repr(self.first_element(slot.enum))

    def _input(self, term: Term) -> str:
        access = self.inputs[term[1]]
        if access.keywords is None:
            return access.text
        arguments = self.emit_arguments(access.parameters, term[2])
        if not access.cells:
            return f"{access.text}({', '.join(f'{access.keywords[slot.name]}={text}' for slot, text in arguments)})"
        stores, reads = "", []
        for index, (slot, text) in enumerate(arguments):
            stores += f"{access.cells}.__setitem__({index}, {text}), "
            reads.append(f"{access.keywords[slot.name]}={access.cells}[{index}]")
        return f"({stores}{access.text}({', '.join(reads)}))[-1]"

    def _decimal(self, term: Term) -> str:
        match term[0]:
            case "c":
                return _number(float(term[1]))
            case "s":
                return self.state_time
            case "t":
                return self.option_time
            case "d":
                divisor = term[2]
                if divisor[0] in "vc" and float(divisor[1]):
                    return f"({self.emit(term[1], 'd')} / {self.emit(divisor, 'd')})"
                return f"divide({self.emit(term[1], 'd')}, {self.emit(divisor, 'd')})"
            case "%":
                return f"remainder({self.emit(term[1], 'd')}, {self.emit(term[2], 'd')})"
        return self._chain(term)

    def _chain(self, term: Term) -> str:
        """Emit a chain of operators that Python evaluates from the left as well, without parentheses and recursion."""
        operators = next(group for group in _CHAINS if term[0] in group)
        operands: list[str] = []
        while term[0] in operators:
            operands.append(f" {_INFIX[term[0]]} {self.emit(term[2], 'd')}")
            term = term[1]
        return f"({self.emit(term, 'd')}{''.join(reversed(operands))})"

    def _boolean(self, term: Term) -> str:
        match term[0]:
            case "t":
                return self.action_done
            case "x":
                return self.conflict
            case "!":
                return f"(not {self.emit(term[1], 'b')})"
            case "&" | "|":
                return f"({f' {_INFIX[term[0]]} '.join(self.emit(operand, 'b') for operand in term[1:])})"
        kind = "e" if term[0] == "c" else "d"
        return f"({self.emit(term[1], kind)} {_INFIX[term[0]]} {self.emit(term[2], kind)})"


def _nesting(text: str) -> int:
    """The greatest number of open parentheses in a text."""
    depth = deepest = 0
    for character in text:
        if character == "(":
            depth += 1
            deepest = max(deepest, depth)
        elif character == ")":
            depth -= 1
    return deepest


def _number(value: float | bool) -> str:
    if value is True or value is False:
        return repr(value)
    text = repr(float(value))
    return f"({text})" if value < 0 or text in ("inf", "nan") else text
