"""Terms of a program as Python's own expressions.

The text is compiled by Python, so nothing of the program's words gets into it but numbers: symbols and parameters are
looked up before, and named by us; elements of enumerations are written by `repr`.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

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
TIME_MASK = "0xFFFFFFFF"
"""Times are whole milliseconds that begin again after 32 bits, as the original's."""

_DEFAULTS = {"d": "0.0", "b": "False"}


@dataclass(frozen=True, slots=True)
class InputAccess:
    """How an input symbol is read: a Python expression, a call of it if `keywords` are its parameters' keywords.

    `cells` is a list that holds its parameters where a call of it stands among them: those of the original are shared
    by all calls, so that the inner one changes what the outer was given before.
    """

    text: str
    keywords: Mapping[str, str] | None = None
    parameters: tuple[TypedSlot, ...] = ()
    cells: str = ""


@dataclass(slots=True)
class TermEmitter:
    """Spells the terms of one state. `action_done` and `conflict` are expressions for them."""

    inputs: Mapping[str, InputAccess]
    outputs: Mapping[str, str]
    parameters: Mapping[str, str]
    first_element: Callable[[str], str]
    state_time: str = "0"
    option_time: str = "0"
    action_done: str = "False"
    conflict: str = "False"
    _inside: list[str] = field(default_factory=list)

    def emit(self, term: Term, kind: str) -> str:
        """The expression of a term of this kind, in parentheses where it needs them."""
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

    def emit_arguments(self, order: tuple[TypedSlot, ...], given: tuple[Term, ...]) -> list[tuple[TypedSlot, str]]:
        """What a call stores into the parameters, in the order of storing: decimals, then bools, then enums."""
        terms = {each[-2]: each[-1] for each in given}
        ordered = sorted(order, key=lambda slot: "dbe".index(slot.kind))
        return [
            (slot, self.emit(terms[slot.name], slot.kind) if slot.name in terms else self._default(slot))
            for slot in ordered
        ]

    def _default(self, slot: TypedSlot) -> str:
        return _DEFAULTS.get(slot.kind) or repr(self.first_element(slot.enum))

    def _input(self, term: Term) -> str:
        known = self.inputs[term[1]]
        if known.keywords is None:
            return known.text
        self._inside.append(term[1])
        given = self.emit_arguments(known.parameters, term[2])
        self._inside.pop()
        if known.cells:
            sets = "".join(f"{known.cells}.__setitem__({at}, {text}), " for at, (_slot, text) in enumerate(given))
            words = ", ".join(f"{known.keywords[slot.name]}={known.cells}[{at}]" for at, (slot, _) in enumerate(given))
            return f"({sets}{known.text}({words}))[-1]"
        words = ", ".join(f"{known.keywords[slot.name]}={text}" for slot, text in given)
        return f"{known.text}({words})"

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
        return f"({self.emit(term[1], 'd')} {_INFIX[term[0]]} {self.emit(term[2], 'd')})"

    def _boolean(self, term: Term) -> str:
        match term[0]:
            case "t":
                return self.action_done
            case "x":
                return self.conflict
            case "!":
                return f"(not {self.emit(term[1], 'b')})"
            case "&" | "|":
                return f"({f' {_INFIX[term[0]]} '.join(self.emit(each, 'b') for each in term[1:])})"
        kind = "e" if term[0] == "c" else "d"
        return f"({self.emit(term[1], kind)} {_INFIX[term[0]]} {self.emit(term[2], kind)})"


def _number(value: float | bool) -> str:
    if value is True or value is False:
        return repr(value)
    text = repr(float(value))
    return f"({text})" if value < 0 or text in ("inf", "nan") else text
