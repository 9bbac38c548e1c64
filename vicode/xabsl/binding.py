"""Binds names to declarations, looks at types, and turns expressions into the terms of a program.

An element of an enumeration means something only where that enumeration is wanted, so binding goes from what is
wanted to what is written. After a mistake it goes on with a value that nobody will see.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from vicode.findings import did_you_mean
from vicode.xabsl import tree
from vicode.xabsl.declared import BOOLEAN, DECIMAL, ENUM, WORDS, Declared, Table
from vicode.xabsl.declaring import Report
from vicode.xabsl.engine.program import Term
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.ranges import look_at_range

_NOTHING: Mapping[str, Declared] = {}
_ORDER = {"<": "<", "<=": "l", ">": ">", ">=": "g"}
_ARITHMETIC = {"+": "+", "-": "-", "*": "*", "/": "d", "%": "%"}
_JOINING = {"&&": "&", "||": "|"}
_WORDS: dict[str, tuple[str, Term]] = {
    "true": (BOOLEAN, ("v", True)),
    "false": (BOOLEAN, ("v", False)),
    "action_done": (BOOLEAN, ("t",)),
    "conflict": (BOOLEAN, ("x",)),
    "state_time": (DECIMAL, ("s",)),
    "option_time": (DECIMAL, ("t",)),
}
_NO_VALUE: dict[str, Term] = {DECIMAL: ("v", 0.0), BOOLEAN: ("v", False), ENUM: ("v", "")}
# What may stand in a place for reading: in intermediate code inputs are "i", and all others that are set "o".
_LETTERS = {"input": "i", "output": "o", "internal": "o", "parameter": "p"}


@dataclass(slots=True)
class Binder:
    """Binds what stands in one file; `parameters` are those of the option that is read."""

    table: Table
    report: Report
    tokens: Tokens
    parameters: Mapping[str, Declared] = field(default_factory=dict)
    reads_conflict: bool = False

    def value(self, expression: tree.Expression, kind: str, enum: str = "") -> Term:
        """The term of an expression where a value of this kind is wanted."""
        match expression:
            case tree.Ref():
                return self._ref(expression, kind, enum)
            case tree.Parentheses():
                return self.value(expression.inner, kind, enum)
            case tree.Number():
                term: Term = ("v", float(expression.text))
                return term if kind == DECIMAL else self._wrong(expression, kind, DECIMAL, enum)
            case tree.Word():
                own, term = _WORDS[expression.text]
                return term if own == kind else self._wrong(expression, kind, own, enum)
            case tree.Function():
                return self._function(expression, kind, enum)
            case tree.Unary():
                return self._unary(expression, kind, enum)
            case tree.Binary():
                return self._binary(expression, kind, enum)
            case tree.Conditional():
                return self._conditional(expression, kind, enum)

    def given(self, owner: Declared, arguments: tree.Arguments) -> tuple[Term, ...]:
        """What a call gives to the parameters of what is called, in the order of the call."""
        given: list[Term] = []
        seen: set[str] = set()
        for argument in arguments.given:
            name = argument.name.text
            parameter = owner.parameters.get(name.removeprefix("@"))
            if parameter is None:
                mend = did_you_mean(name, owner.parameters, _known(owner))
                self.complain(argument.name.at, "X621", f"{owner.what} {owner.name} has no parameter {name}", mend)
                continue
            self.report.uses.append((self.tokens, argument.name.at, parameter))
            if name != parameter.name:
                message = f"in a call parameters are written without @: {name}"
                self.complain(argument.name.at, "X621", message, f"write {parameter.name}")
            look_at_range(self.report, self.tokens, argument.value, parameter)
            if parameter.name in seen:
                self.complain(argument.name.at, "X627", f"parameter {name} is given twice", "remove one of them")
            seen.add(parameter.name)
            value = self.value(argument.value, parameter.kind, parameter.enum)
            kind = (ENUM, parameter.enum) if parameter.kind == ENUM else (parameter.kind,)
            given.append((*kind, parameter.full, value))
        missing = [name for name in owner.parameters if name not in seen]
        if missing:
            message = f"{owner.name} is not given {', '.join(missing)}: 0, false or the first element"
            self.complain(arguments.at, "X642", message, "give a value, also if it is 0")
        return tuple(given)

    def complain(self, at: int, code: str, message: str, mend: str = "") -> None:
        """Tell what is wrong with a token of this file."""
        self.report.complain(self.tokens, at, code, message, mend)

    def _ref(self, ref: tree.Ref, kind: str, enum: str) -> Term:
        found = self._named(ref.name, kind, enum)
        if not found:
            self._complain_unknown(ref.name, ref.at, kind, enum)
            return _NO_VALUE[kind]
        if len(found) > 1:
            whats = " and ".join(each.what for each in found)
            self.complain(ref.at, "X622", f"{ref.name} may mean {whats}", "rename one of them")
        declared = found[0]
        self.report.uses.append((self.tokens, ref.at, declared))
        if declared.kind != kind:
            return self._wrong(ref, kind, declared.kind, enum)
        if declared.kind == ENUM and declared.enum != enum:
            message = f"{ref.name} is of enum {declared.enum}, not {enum}"
            self.complain(ref.at, "X626", message)
        return self._read(declared, ref.at)

    def _named(self, name: str, kind: str, enum: str) -> list[Declared]:
        """What a name may mean here: the element of the wanted enumeration before symbols of another kind."""
        if name[0] == "@":
            parameter = self.parameters.get(name[1:])
            return [parameter] if parameter else []
        found = self.table.readable.get(name, [])
        if kind == ENUM and enum in self.table.enums:
            known = self.table.enums[enum]
            element = known.elements.get(name.removeprefix(f"{enum}."))
            if element is not None:
                return [element, *(each for each in found if each.kind == ENUM and each.enum == enum)]
        return found

    def _read(self, declared: Declared, at: int) -> Term:
        if declared.role == "const":
            assert isinstance(declared.node, tree.Constant)
            return ("c", declared.node.number)
        if declared.role == "element":
            return ("v", declared.full)
        if declared.role == "input":
            if declared.parameters:
                self.complain(at, "X642", f"{declared.name} is not given its parameters", "give values in parentheses")
            return ("i", declared.full, ())
        return (_LETTERS[declared.role], declared.full)

    def _function(self, function: tree.Function, kind: str, enum: str) -> Term:
        name = function.name.text
        found = [each for each in self.table.readable.get(name, []) if each.role == "input"]
        if not found:
            others = self.table.readable.get(name)
            if others:
                message = f"{others[0].what} {name} takes no parentheses"
                self.complain(function.name.at, "X624", message, "remove them")
            else:
                known = [each.name for each in self.table.symbols("input")]
                mend = did_you_mean(name, known, "declare it as an input symbol")
                self.complain(function.name.at, "X621", f"no input symbol {name}", mend)
            return _NO_VALUE[kind]
        declared = found[0]
        self.report.uses.append((self.tokens, function.name.at, declared))
        given = self.given(declared, function.arguments)
        if declared.kind != kind:
            return self._wrong(function, kind, declared.kind, enum)
        if kind == ENUM and declared.enum != enum:
            self.complain(function.name.at, "X626", f"{name} is of enum {declared.enum}, not {enum}")
        return ("i", declared.full, given)

    def _unary(self, unary: tree.Unary, kind: str, enum: str) -> Term:
        own = DECIMAL if unary.operator == "-" else BOOLEAN
        operand = self.value(unary.operand, own)
        if own != kind:
            return self._wrong(unary, kind, own, enum)
        if own == BOOLEAN:
            return ("!", operand)
        return ("v", -operand[1]) if operand[0] == "v" else ("-", ("v", 0.0), operand)

    def _binary(self, binary: tree.Binary, kind: str, enum: str) -> Term:
        operator = binary.operator
        if operator in _ARITHMETIC:
            term: Term = (
                _ARITHMETIC[operator],
                self.value(binary.left, DECIMAL),
                self.value(binary.right, DECIMAL),
            )
            return term if kind == DECIMAL else self._wrong(binary, kind, DECIMAL, enum, binary.sign)
        if operator in _JOINING:
            letter = _JOINING[operator]
            operands: list[Term] = []
            for each in (binary.left, binary.right):
                operand = self.value(each, BOOLEAN)
                operands += operand[1:] if operand[0] == letter else (operand,)
            term = (letter, *operands)
        elif operator in _ORDER:
            term = (_ORDER[operator], self.value(binary.left, DECIMAL), self.value(binary.right, DECIMAL))
        else:
            term = self._equality(binary)
        return term if kind == BOOLEAN else self._wrong(binary, kind, BOOLEAN, enum, binary.sign)

    def _equality(self, binary: tree.Binary) -> Term:
        kind, enum = self.kind_of(binary.left)
        if kind == BOOLEAN:
            mend = "write a && b || !a && !b for a == b" if binary.operator == "==" else "write a && !b || !a && b"
            self.complain(binary.sign, "X625", f"{binary.operator} compares decimals and enums, no bools", mend)
            return _NO_VALUE[BOOLEAN]
        if kind == ENUM:
            equal: Term = ("c", self.value(binary.left, ENUM, enum), self.value(binary.right, ENUM, enum))
            return equal if binary.operator == "==" else ("!", equal)
        if self.kind_of(binary.right)[0] == ENUM and isinstance(binary.left, tree.Ref):
            known = self._named(binary.left.name, DECIMAL, "")
            if not known:
                self._complain_unknown(binary.left.name, binary.left.at, DECIMAL, "")
                return _NO_VALUE[BOOLEAN]
        letter = "=" if binary.operator == "==" else "n"
        return (letter, self.value(binary.left, DECIMAL), self.value(binary.right, DECIMAL))

    def _conditional(self, expression: tree.Conditional, kind: str, enum: str) -> Term:
        condition = self.value(expression.condition, BOOLEAN)
        yes, no = self.value(expression.yes, kind, enum), self.value(expression.no, kind, enum)
        if kind == BOOLEAN:
            at = expression.condition.to + 1
            self.complain(at, "X652", "no original engine reads ? : between bools", "write c && a || !c && b")
        return ("q", condition, yes, no)

    def kind_of(self, expression: tree.Expression) -> tuple[str, str]:
        """Kind and enumeration that an expression has of itself; decimal where it has none."""
        match expression:
            case tree.Ref():
                found = self._named(expression.name, "", "")
            case tree.Function():
                found = self.table.readable.get(expression.name.text, [])
            case tree.Parentheses():
                return self.kind_of(expression.inner)
            case tree.Word():
                return _WORDS[expression.text][0], ""
            case tree.Unary(operator="!"):
                return BOOLEAN, ""
            case tree.Binary(operator=operator) if operator not in _ARITHMETIC:
                return BOOLEAN, ""
            case tree.Conditional():
                kind = self.kind_of(expression.yes)
                return kind if kind != (DECIMAL, "") else self.kind_of(expression.no)
            case _:
                return DECIMAL, ""
        return (found[0].kind, found[0].enum) if found else (DECIMAL, "")

    def _wrong(self, expression: tree.Expression, kind: str, own: str, enum: str, at: int = -1) -> Term:
        wanted = f"{'an' if kind == ENUM else 'a'} {WORDS[kind]}{f' {enum}' if enum else ''}"
        message = f"{'an' if own == ENUM else 'a'} {WORDS[own]} where {wanted} is wanted"
        mend = "compare it: > 0 or != 0" if (kind, own) == (BOOLEAN, DECIMAL) else ""
        self.complain(expression.at if at < 0 else at, "X625", message, mend)
        return _NO_VALUE[kind]

    def _complain_unknown(self, name: str, at: int, kind: str, enum: str) -> None:
        if name[0] == "@":
            mend = did_you_mean(name, [f"@{each}" for each in self.parameters], "declare it at the option's beginning")
            self.complain(at, "X621", f"the option has no parameter {name}", mend)
            return
        known = [*self.table.readable, *(f"@{each}" for each in self.parameters)]
        if kind == ENUM and enum in self.table.enums:
            elements = self.table.enums[enum].elements
            mend = did_you_mean(name, [*elements, *known], f"one of {', '.join([*elements][:8])}")
            self.complain(at, "X621", f"enum {enum} has no element {name}, and no symbol is named so", mend)
            return
        owner = next((each for each in self.table.enums.values() if name in each.elements), None)
        otherwise = "declare it in a namespace of symbols"
        if owner is not None:
            otherwise = f"write the element of {owner.name} to the right of a symbol of that enumeration"
            self.complain(at, "X621", f"no symbol {name}", otherwise)
            return
        if name in self.parameters:
            otherwise = f"write @{name}"
        self.complain(at, "X621", f"no symbol {name}", did_you_mean(name, known, otherwise))


def _known(owner: Declared) -> str:
    return f"it has {', '.join(owner.parameters)}" if owner.parameters else "it has none"
