"""Translates C++ conditions to expressions of designs.

`&&`, `||`, `!` and comparisons with numbers and enumerators are translated. What they join is not understood: it
becomes an input with the C++ text as description. Equal texts are the same input, unless a word in them was declared
or assigned in between, or the text itself assigns. Expressions are Python trees, which print with few parentheses.
"""

import ast
import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field

from vicode.cpp_tokens import NUMBER, WORD
from vicode.importers.cpp.tree import CppTree, compact, iter_plain, split, words
from vicode.importers.design_names import DesignNames, to_design_name
from vicode.model.design import Declaration, Guard
from vicode.model.project import WORLD, Interface

ALIAS = "robot"
TIMES = {"state_time": "state_time", "option_time": "component_time"}
_STATUS = frozenset({"action_done", "action_aborted", *TIMES})
_MIRRORED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "==": "==", "!=": "!="}
ASSIGNING = frozenset({"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "++", "--"})
_LOWER = ASSIGNING - {"++", "--"} | {"?", "&", "|", "^", ","}
_NUMBER = re.compile(
    r"(-?(?:0(?![xXbB\d])|[1-9]\d*|(?:\d+\.\d*|\.\d+)(?:[eE][+-]?\d+)?|\d+[eE][+-]?\d+))(?:[fFlLuUzZ]{1,3}|_?([A-Za-z]\w*))?"
)
_MAX_NAME = 48
OTHER_VALUE = "other_value"
"""The element of each enumeration that stands for all values that no condition mentions."""


def negate(condition: ast.expr) -> ast.expr:
    match condition:
        case ast.UnaryOp(ast.Not(), operand):
            return operand
        case ast.Compare(left, [ast.Eq()], values):
            return ast.Compare(left, [ast.NotEq()], values)
    return ast.UnaryOp(ast.Not(), condition)


def join(operator: ast.boolop, conditions: list[ast.expr]) -> ast.expr:
    return ast.BoolOp(operator, conditions) if len(conditions) > 1 else conditions[0]


def to_guard(condition: ast.expr) -> Guard:
    return Guard(when=ast.unparse(condition))


@dataclass(slots=True, kw_only=True)
class CppConditions:
    """The conditions of a machine, and the inputs that they read.

    Attributes:
        component: The name of the component that provides the inputs.
        names: Allocates names of the project.
        types: The enumerations of the project by their names in C++: the name, and the elements.
        changing: Words whose values the machine changes itself.
        unfixed: The inputs that may change while the world stands still.
        versions: Words that were declared or assigned in the block that is read, with the place of that.
        done: What stands for `action_done`, "" if nothing does.
        spellings: Other names of words.
    """

    machine: str
    component: str
    names: DesignNames
    types: dict[str, tuple[str, list[str]]]
    changing: Collection[str] = ()
    unfixed: set[str] = field(default_factory=set)
    versions: dict[str, int] = field(default_factory=dict)
    done: str = ""
    spellings: dict[str, str] = field(default_factory=dict)
    _inputs: dict[tuple[str, ...], Declaration] = field(default_factory=dict)
    _input_names: DesignNames = field(default_factory=DesignNames)

    def interface(self) -> Interface | None:
        doc = f"What the conditions of {self.machine} read, with their C++ texts."
        outputs = tuple(self._inputs.values())
        return Interface(component=self.component, doc=doc, implementation=WORLD, outputs=outputs) if outputs else None

    def change(self, nodes: Sequence[CppTree]) -> None:
        """Note that a statement gives new values to the words in it."""
        self.versions.update(dict.fromkeys(words(nodes), nodes[0].start if nodes else 0))

    def read(self, nodes: Sequence[CppTree]) -> ast.expr:
        if len(nodes) == 1 and nodes[0].text == "(":
            return self.read(nodes[0].children)
        if not nodes or _LOWER & {node.text for node in nodes}:
            return self._bool(nodes)
        for sign, word, operator in (("||", "or", ast.Or()), ("&&", "and", ast.And())):
            parts = max(split(nodes, sign), split(nodes, word), key=len)
            if len(parts) > 1:
                return join(operator, [self.read(part) for part in parts])
        places = [index for index in iter_plain(nodes) if nodes[index].text in _MIRRORED]
        if len(places) == 1 and 0 < places[0] < len(nodes) - 1:
            return self.compare(nodes[: places[0]], nodes[places[0]].text, nodes[places[0] + 1 :])
        if nodes[0].text in ("!", "not") and not places and not {*"+-*/%"} & {node.text for node in nodes[2:]}:
            return negate(self.read(nodes[1:]))
        return self._bool(nodes)

    def compare(self, left: Sequence[CppTree], sign: str, right: Sequence[CppTree]) -> ast.expr:
        if _number(left) and not _number(right):
            left, sign, right = right, _MIRRORED[sign], left
        number, first, second = _number(right), compact(left), compact(right)
        if first in TIMES or (number and not _number(left)):
            unit = number[1] if number else ""
            # Times of designs are in milliseconds.
            time = TIMES.get(first) if unit in ("", "ms") else None
            quantity = time or self._input("float", left, first, unit)
            return _parse(f"{quantity} {sign} {number[0] if number else self._input('float', right, second, '')}")
        if sign in ("==", "!=") and second in ("true", "false", "nullptr", "NULL"):
            return self.read(left) if (second == "true") == (sign == "==") else negate(self.read(left))
        if sign in ("==", "!=") and _is_enumerator(right):
            type_ = right[-3].text if len(right) > 2 else f"{self.machine}_{_stem(first)}"
            equal = self.element(left, first, type_, right[-1].text)
        elif sign in ("==", "!="):
            low, high = sorted((first, second))
            equal = _parse(self._input("bool", (*left, *right), f"{low} == {high}"))
        else:
            # All orders are written with `<`.
            low, high = (second, first) if sign in (">", "<=") else (first, second)
            equal = _parse(self._input("bool", (*left, *right), f"{low} < {high}"))
        return negate(equal) if sign in ("!=", "<=", ">=") else equal

    def element(self, nodes: Sequence[CppTree], text: str, type_: str, element: str) -> ast.expr:
        """Whether an input has a value of an enumeration."""
        if type_ not in self.types:
            self.types[type_] = (self.names.allocate(type_), [OTHER_VALUE])
        (name, elements), value = self.types[type_], to_design_name(element)
        elements += [] if value in elements else [value]
        return _parse(f"{self._input(name, nodes, text)} == {name}.{value}")

    def flag(self, text: str, *place: str) -> ast.expr:
        """A bool input; with a place, nothing is known about it, not even that it is the same the next time."""
        return _parse(self._add("bool", text, ("flag", *place), is_fixed=not place))

    def _bool(self, nodes: Sequence[CppTree]) -> ast.expr:
        text = compact(nodes)
        known = {"true": "True", "false": "False", "action_done": self.done}
        known |= {time: f"{name} != 0" for time, name in TIMES.items()}
        return _parse(known.get(text) or self._input("bool", nodes, self.spellings.get(text, text)))

    def _input(self, type_: str, nodes: Sequence[CppTree], text: str, unit: str = "") -> str:
        """The name of an input that stands for a text."""
        found = words(nodes)
        place = [f"{word} {self.versions[word]}" for word in sorted(found & self.versions.keys())]
        place += [str(nodes[0].start)] if _assigns(nodes) else []
        is_fixed = not place and not found & _STATUS and not found & set(self.changing)
        return self._add(type_, text, (unit, *place), is_fixed=is_fixed, unit=unit)

    def _add(self, type_: str, text: str, key: tuple[str, ...], *, is_fixed: bool, unit: str = "") -> str:
        key = (type_, text, *key)
        if key not in self._inputs:
            name = self._input_names.allocate(_stem(text))
            self._inputs[key] = Declaration(name=name, type=type_, doc=text, unit=unit)
            self.unfixed |= set() if is_fixed else {name}
        return f"{ALIAS}.{self._inputs[key].name}"


def _stem(text: str) -> str:
    return re.sub(r"\W+", "_", text.replace(" == ", "_is_").replace(" < ", "_below_"))[:_MAX_NAME].strip("_")


def _parse(text: str) -> ast.expr:
    return ast.parse(text, mode="eval").body


def _number(nodes: Sequence[CppTree]) -> tuple[str, str] | None:
    """The number in a text, as designs write it, and its unit."""
    is_number = 0 < len(nodes) < 3 and nodes[-1].kind == NUMBER
    found = _NUMBER.fullmatch(compact(nodes).replace("'", "")) if is_number else None
    if found is None or abs(float(found[1])) > 2.0**53:
        return None
    return found[1] if found[1].lstrip("-").isdigit() else repr(float(found[1])), found[2] or ""


def _is_enumerator(nodes: Sequence[CppTree]) -> bool:
    """Whether a text looks like an enumerator: qualified, or in capitals."""
    is_name = nodes[-1].kind == WORD and all(node.kind == WORD or node.text == "::" for node in nodes)
    return is_name and (len(nodes) > 1 or (nodes[0].text.isupper() and len(nodes[0].text) > 1))


def _assigns(nodes: Sequence[CppTree]) -> bool:
    return any(node.text in ASSIGNING or _assigns(node.children) for node in nodes)
