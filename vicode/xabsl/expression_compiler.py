"""Resolves names, checks types and compiles expressions to the terms of a program.

An element of an enumeration is known only where that enumeration is expected, so the expected type is passed down the
expression. After an error, compilation continues with a placeholder value.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from vicode.findings import did_you_mean, write_instead
from vicode.xabsl import tree
from vicode.xabsl.engine.program import Term
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.ranges import check_range
from vicode.xabsl.symbol_collector import CompileReport
from vicode.xabsl.symbol_table import BOOLEAN, DECIMAL, ENUM, KIND_NAMES, Definition, SymbolTable

_RELATIONAL = {"<": "<", "<=": "l", ">": ">", ">=": "g"}
_ARITHMETIC = {"+": "+", "-": "-", "*": "*", "/": "d", "%": "%"}
_LOGICAL = {"&&": "&", "||": "|"}
_KEYWORD_TERMS: dict[str, tuple[str, Term]] = {
    "true": (BOOLEAN, ("v", True)),
    "false": (BOOLEAN, ("v", False)),
    "action_done": (BOOLEAN, ("t",)),
    "conflict": (BOOLEAN, ("x",)),
    "state_time": (DECIMAL, ("s",)),
    "option_time": (DECIMAL, ("t",)),
}
_ERROR_TERMS: dict[str, Term] = {DECIMAL: ("v", 0.0), BOOLEAN: ("v", False), ENUM: ("v", "")}
# Letters of readable symbols in intermediate code: inputs are "i", all assignable symbols are "o".
_READ_LETTERS = {"input": "i", "output": "o", "internal": "o", "parameter": "p"}


@dataclass(slots=True)
class ExpressionCompiler:
    """Compiles the expressions of one file; `parameters` are those of the current option."""

    table: SymbolTable
    report: CompileReport
    tokens: Tokens
    parameters: Mapping[str, Definition] = field(default_factory=dict)

    def compile(self, expression: tree.ExpressionNode, kind: str, enum: str = "") -> Term:
        """Compile an expression where a value of this kind is expected."""
        match expression:
            case tree.ReferenceNode():
                return self._ref(expression, kind, enum)
            case tree.ParenthesizedNode():
                return self.compile(expression.inner, kind, enum)
            case tree.NumberNode():
                term: Term = ("v", float(expression.text))
                return term if kind == DECIMAL else self._type_mismatch(expression, kind, DECIMAL, enum)
            case tree.KeywordNode():
                own_kind, term = _KEYWORD_TERMS[expression.text]
                return term if own_kind == kind else self._type_mismatch(expression, kind, own_kind, enum)
            case tree.FunctionCallNode():
                return self._function(expression, kind, enum)
            case tree.UnaryNode():
                return self._unary(expression, kind, enum)
            case tree.BinaryNode():
                return self._binary(expression, kind, enum)
            case tree.ConditionalNode():
                return self._conditional(expression, kind, enum)

    def compile_arguments(self, owner: Definition, arguments: tree.ArgumentListNode) -> tuple[Term, ...]:
        """Compile the arguments of a call to `owner`, in the order of the call."""
        terms: list[Term] = []
        seen: set[str] = set()
        for argument in arguments.items:
            name = argument.name.text
            parameter = owner.parameters.get(name.removeprefix("@"))
            if parameter is None:
                fix = did_you_mean(name, owner.parameters, _list_parameters(owner))
                self.add_finding(
                    argument.name.first_token, "X621", f"{owner.description} {owner.name} has no parameter {name}", fix
                )
                continue
            self.report.references.append((self.tokens, argument.name.first_token, parameter))
            if name != parameter.name:
                message = f"parameter names in a call are written without @: {name}"
                self.add_finding(argument.name.first_token, "X621", message, write_instead(parameter.name))
            check_range(self.report, self.tokens, argument.value, parameter)
            if parameter.name in seen:
                self.add_finding(
                    argument.name.first_token, "X627", f"parameter {name} has two values", "remove one of them"
                )
            seen.add(parameter.name)
            value = self.compile(argument.value, parameter.kind, parameter.enum)
            kind = (ENUM, parameter.enum) if parameter.kind == ENUM else (parameter.kind,)
            terms.append((*kind, parameter.qualified_name, value))
        missing = [name for name in owner.parameters if name not in seen]
        if missing:
            message = f"the call of {owner.name} omits {', '.join(missing)}: 0, false or the first element is used"
            self.add_finding(arguments.first_token, "X642", message, "give every parameter a value, even if it is 0")
        return tuple(terms)

    def add_finding(self, token: int, code: str, message: str, fix: str = "") -> None:
        """Report a problem with a token of this file."""
        self.report.add_finding(self.tokens, token, code, message, fix)

    def _ref(self, ref: tree.ReferenceNode, kind: str, enum: str) -> Term:
        candidates = self._lookup(ref.name, kind, enum)
        if not candidates:
            self._add_unknown_name(ref.name, ref.first_token, kind, enum)
            return _ERROR_TERMS[kind]
        if len(candidates) > 1:
            meanings = " and ".join(candidate.description for candidate in candidates)
            self.add_finding(ref.first_token, "X622", f"{ref.name} is ambiguous: {meanings}", "rename one of them")
        definition = candidates[0]
        self.report.references.append((self.tokens, ref.first_token, definition))
        if definition.kind != kind:
            return self._type_mismatch(ref, kind, definition.kind, enum)
        if definition.kind == ENUM and definition.enum != enum:
            message = f"{ref.name} is of enum {definition.enum}, not {enum}"
            self.add_finding(ref.first_token, "X626", message)
        return self._load_term(definition, ref.first_token)

    def _lookup(self, name: str, kind: str, enum: str) -> list[Definition]:
        """Find the candidates for a name; an element of the expected enumeration precedes symbols of other kinds."""
        if name[0] == "@":
            parameter = self.parameters.get(name[1:])
            return [parameter] if parameter else []
        candidates = self.table.readable.get(name, [])
        if kind == ENUM and enum in self.table.enums:
            definition = self.table.enums[enum]
            element = definition.elements.get(name.removeprefix(f"{enum}."))
            if element is not None:
                return [
                    element,
                    *(candidate for candidate in candidates if candidate.kind == ENUM and candidate.enum == enum),
                ]
        return candidates

    def _load_term(self, definition: Definition, token: int) -> Term:
        if definition.role == "const":
            assert isinstance(definition.node, tree.ConstantNode)
            return ("c", definition.node.number)
        if definition.role == "element":
            return ("v", definition.qualified_name)
        if definition.role == "input":
            if definition.parameters:
                self.add_finding(
                    token,
                    "X642",
                    f"{definition.name} is read without arguments",
                    "give its parameters values in parentheses",
                )
            return ("i", definition.qualified_name, ())
        return (_READ_LETTERS[definition.role], definition.qualified_name)

    def _function(self, function: tree.FunctionCallNode, kind: str, enum: str) -> Term:
        name = function.name.text
        inputs = [definition for definition in self.table.readable.get(name, []) if definition.role == "input"]
        if not inputs:
            readable = self.table.readable.get(name)
            if readable:
                message = f"{readable[0].description} {name} has no parameters"
                self.add_finding(function.name.first_token, "X624", message, "remove the parentheses")
            else:
                names = [symbol.name for symbol in self.table.symbols("input")]
                fix = did_you_mean(name, names, "declare it as an input symbol")
                self.add_finding(function.name.first_token, "X621", f"unknown input symbol {name}", fix)
            return _ERROR_TERMS[kind]
        definition = inputs[0]
        self.report.references.append((self.tokens, function.name.first_token, definition))
        arguments = self.compile_arguments(definition, function.arguments)
        if definition.kind != kind:
            return self._type_mismatch(function, kind, definition.kind, enum)
        if kind == ENUM and definition.enum != enum:
            self.add_finding(function.name.first_token, "X626", f"{name} is of enum {definition.enum}, not {enum}")
        return ("i", definition.qualified_name, arguments)

    def _unary(self, unary: tree.UnaryNode, kind: str, enum: str) -> Term:
        own_kind = DECIMAL if unary.operator == "-" else BOOLEAN
        operand = self.compile(unary.operand, own_kind)
        if own_kind != kind:
            return self._type_mismatch(unary, kind, own_kind, enum)
        if own_kind == BOOLEAN:
            return ("!", operand)
        return ("v", -operand[1]) if operand[0] == "v" else ("-", ("v", 0.0), operand)

    def _binary(self, binary: tree.BinaryNode, kind: str, enum: str) -> Term:
        operator = binary.operator
        if operator in _ARITHMETIC:
            term: Term = (
                _ARITHMETIC[operator],
                self.compile(binary.left, DECIMAL),
                self.compile(binary.right, DECIMAL),
            )
            return term if kind == DECIMAL else self._type_mismatch(binary, kind, DECIMAL, enum, binary.operator_token)
        if operator in _LOGICAL:
            letter = _LOGICAL[operator]
            operands: list[Term] = []
            for side in (binary.left, binary.right):
                operand = self.compile(side, BOOLEAN)
                operands += operand[1:] if operand[0] == letter else (operand,)
            term = (letter, *operands)
        elif operator in _RELATIONAL:
            term = (_RELATIONAL[operator], self.compile(binary.left, DECIMAL), self.compile(binary.right, DECIMAL))
        else:
            term = self._equality(binary)
        return term if kind == BOOLEAN else self._type_mismatch(binary, kind, BOOLEAN, enum, binary.operator_token)

    def _equality(self, binary: tree.BinaryNode) -> Term:
        kind, enum = self.infer_kind(binary.left)
        if kind == BOOLEAN:
            fix = "write a && b || !a && !b for a == b" if binary.operator == "==" else "write a && !b || !a && b"
            self.add_finding(
                binary.operator_token, "X625", f"{binary.operator} compares decimals and enums, not bools", fix
            )
            return _ERROR_TERMS[BOOLEAN]
        if kind == ENUM:
            equal: Term = ("c", self.compile(binary.left, ENUM, enum), self.compile(binary.right, ENUM, enum))
            return equal if binary.operator == "==" else ("!", equal)
        if self.infer_kind(binary.right)[0] == ENUM and isinstance(binary.left, tree.ReferenceNode):
            candidates = self._lookup(binary.left.name, DECIMAL, "")
            if not candidates:
                self._add_unknown_name(binary.left.name, binary.left.first_token, DECIMAL, "")
                return _ERROR_TERMS[BOOLEAN]
        letter = "=" if binary.operator == "==" else "n"
        return (letter, self.compile(binary.left, DECIMAL), self.compile(binary.right, DECIMAL))

    def _conditional(self, expression: tree.ConditionalNode, kind: str, enum: str) -> Term:
        condition = self.compile(expression.condition, BOOLEAN)
        yes, no = self.compile(expression.yes, kind, enum), self.compile(expression.no, kind, enum)
        if kind == BOOLEAN:
            question_mark = expression.condition.last_token + 1
            self.add_finding(
                question_mark, "X652", "the original engines cannot read ? : between bools", "write c && a || !c && b"
            )
        return ("q", condition, yes, no)

    def infer_kind(self, expression: tree.ExpressionNode) -> tuple[str, str]:
        """Infer the kind and enumeration of an expression without context; decimal by default."""
        match expression:
            case tree.ReferenceNode():
                candidates = self._lookup(expression.name, "", "")
            case tree.FunctionCallNode():
                candidates = self.table.readable.get(expression.name.text, [])
            case tree.ParenthesizedNode():
                return self.infer_kind(expression.inner)
            case tree.KeywordNode():
                return _KEYWORD_TERMS[expression.text][0], ""
            case tree.UnaryNode(operator="!"):
                return BOOLEAN, ""
            case tree.BinaryNode(operator=operator) if operator not in _ARITHMETIC:
                return BOOLEAN, ""
            case tree.ConditionalNode():
                kind = self.infer_kind(expression.yes)
                return kind if kind != (DECIMAL, "") else self.infer_kind(expression.no)
            case _:
                return DECIMAL, ""
        return (candidates[0].kind, candidates[0].enum) if candidates else (DECIMAL, "")

    def _type_mismatch(
        self, expression: tree.ExpressionNode, kind: str, found: str, enum: str, token: int = -1
    ) -> Term:
        expected = f"{'an' if kind == ENUM else 'a'} {KIND_NAMES[kind]}{f' {enum}' if enum else ''}"
        message = f"{'an' if found == ENUM else 'a'} {KIND_NAMES[found]} where {expected} is expected"
        fix = "compare it, for example with > 0 or != 0" if (kind, found) == (BOOLEAN, DECIMAL) else ""
        self.add_finding(expression.first_token if token < 0 else token, "X625", message, fix)
        return _ERROR_TERMS[kind]

    def _add_unknown_name(self, name: str, token: int, kind: str, enum: str) -> None:
        if name[0] == "@":
            fix = did_you_mean(
                name, [f"@{parameter}" for parameter in self.parameters], "declare it at the start of the option"
            )
            self.add_finding(token, "X621", f"the option has no parameter {name}", fix)
            return
        names = [*self.table.readable, *(f"@{parameter}" for parameter in self.parameters)]
        if kind == ENUM and enum in self.table.enums:
            elements = self.table.enums[enum].elements
            fix = did_you_mean(name, [*elements, *names], f"use one of {', '.join([*elements][:8])}")
            self.add_finding(token, "X621", f"{name} is neither an element of enum {enum} nor a symbol", fix)
            return
        owner = next((candidate for candidate in self.table.enums.values() if name in candidate.elements), None)
        otherwise = "declare it in a namespace of symbols"
        if owner is not None:
            otherwise = f"{name} is an element of {owner.name}: write it to the right of a symbol of that enumeration"
            self.add_finding(token, "X621", f"unknown symbol {name}", otherwise)
            return
        if name in self.parameters:
            otherwise = write_instead(f"@{name}")
        self.add_finding(token, "X621", f"unknown symbol {name}", did_you_mean(name, names, otherwise))


def _list_parameters(owner: Definition) -> str:
    return f"use one of {', '.join(owner.parameters)}" if owner.parameters else "remove the argument"
