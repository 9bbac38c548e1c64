"""Translates C++ conditions to expressions of designs.

`&&`, `||`, `!` and comparisons with numbers and enumerators are translated. What they join is not understood, and
becomes an input of the design, with the C++ text as its description. Equal texts are the same input, unless a word in
them was assigned or declared in between, or the text itself assigns.
"""

import re
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, field

from vicode.cpp_tokens import NUMBER
from vicode.importers.cpp.tree import CppNode, compact, split, template_end, words
from vicode.importers.design_names import DesignNames
from vicode.model.design import Declaration
from vicode.model.names import name_from_text
from vicode.model.project import WORLD, Enumeration, Interface

ALIAS = "robot"
TIMES = {"state_time": "state_time", "option_time": "component_time"}
STATUS = frozenset({"action_done", "action_aborted", *TIMES})
_MIRRORED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "==": "==", "!=": "!="}
_ASSIGNING = frozenset({"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "++", "--"})
_LOWER = _ASSIGNING - {"++", "--"} | {"?", "&", "|", "^", ","}
_NUMBER = re.compile(r"(0|[1-9][\d']*|(?:\d[\d']*)?\.\d*(?:[eE][+-]?\d+)?|\d+[eE][+-]?\d+)(_?[A-Za-z]\w*)?")
_PLAIN_SUFFIXES = frozenset({"f", "l", "u", "ul", "lu", "ull", "z", "uz"})
_MAX_NAME = 48
_OR, _AND, _NOT, _ATOM = range(4)


@dataclass(frozen=True, slots=True)
class Condition:
    """An expression of a design, and how strongly it binds."""

    text: str
    level: int = _ATOM

    def within(self, level: int) -> str:
        return self.text if self.level >= level else f"({self.text})"

    def negated(self) -> "Condition":
        if self.level == _NOT and self.text.startswith("not "):
            return Condition(self.text.removeprefix("not "), _NOT)
        return Condition(f"not {self.within(_NOT if ' ' not in self.text else _ATOM)}", _NOT)


def join(conditions: Sequence[Condition], word: str) -> Condition:
    """Join conditions by "and" or "or"."""
    level = _AND if word == "and" else _OR
    if len(conditions) == 1:
        return conditions[0]
    return Condition(f" {word} ".join(each.within(level + 1) for each in conditions), level)


@dataclass(slots=True, kw_only=True)
class Inputs:
    """The inputs of a machine.

    Attributes:
        component: The name of the component that provides them.
        types: Allocates the names of enumerations.
        changing: Words whose values the machine changes itself.
        unfixed: The inputs that may change while the world stands still.
    """

    machine: str
    component: str
    types: DesignNames
    changing: Collection[str] = ()
    declarations: dict[tuple[str, ...], Declaration] = field(default_factory=dict)
    enumerations: dict[tuple[str, ...], tuple[str, dict[str, str]]] = field(default_factory=dict)
    unfixed: set[str] = field(default_factory=set)
    names: DesignNames = field(default_factory=DesignNames)

    def interface(self) -> Interface:
        return Interface(
            component=self.component,
            doc=f"What the conditions of {self.machine} read, with their C++ texts.",
            implementation=WORLD,
            outputs=tuple(self.declarations.values()),
        )

    def project_enumerations(self) -> list[Enumeration]:
        """An element of an enumeration stands for all values that are not mentioned."""
        found = []
        for name, elements in self.enumerations.values():
            other = DesignNames(taken=frozenset(elements.values())).allocate("other")
            pairs = [(element, "") for element in elements.values()]
            found.append(Enumeration(name=name, elements=((other, "any other value"), *pairs)))
        return found

    def add(self, key: tuple[str, ...], type_: str, text: str, stem: str = "", *, is_fixed: bool = True) -> str:
        """The name of an input; it is declared on first use."""
        if key not in self.declarations:
            name = self.names.allocate(re.sub(r"\W+", "_", stem or text)[:_MAX_NAME])
            self.declarations[key] = Declaration(name=name, type=type_, doc=text)
            if not is_fixed:
                self.unfixed.add(name)
        return f"{ALIAS}.{self.declarations[key].name}"

    def element(self, key: tuple[str, ...], text: str, element: str, *, is_fixed: bool = True) -> Condition:
        """Whether an input equals an enumerator."""
        type_name = f"{self.machine}_{name_from_text(re.sub(r'[^0-9A-Za-z]+', '_', text)[-_MAX_NAME:]) or 'value'}"
        if key not in self.enumerations:
            self.enumerations[key] = (self.types.allocate(type_name), {})
        type_, elements = self.enumerations[key]
        if element not in elements:
            elements[element] = DesignNames(taken=frozenset(elements.values())).allocate(element)
        name = self.add((*key, "enumeration"), type_, text, is_fixed=is_fixed)
        return Condition(f"{name} == {type_}.{elements[element]}", _NOT)


@dataclass(slots=True, kw_only=True)
class ConditionReader:
    """Translates the conditions of one block of a machine.

    Attributes:
        versions: Words that were declared or assigned so far, each with the place of that.
        done: The condition for `action_done`, "" if it is not known.
        atom: Returns the condition that a text stands for; None for others.
    """

    inputs: Inputs
    versions: dict[str, int] = field(default_factory=dict)
    done: str = ""
    atom: Callable[[Sequence[CppNode]], Condition | None] = lambda _nodes: None

    def change(self, nodes: Sequence[CppNode]) -> None:
        """Note that a statement gives new values to the words in it."""
        self.versions.update(dict.fromkeys(words(nodes), nodes[0].start))

    def read(self, nodes: Sequence[CppNode]) -> Condition:
        if not nodes:
            return self.unknown(nodes, "")
        own = self.atom(nodes)
        if own is not None:
            return own
        if len(nodes) == 1 and nodes[0].is_group("("):
            return self.read(nodes[0].children)
        if _LOWER & {node.text for node in nodes if node.kind != NUMBER}:
            return self._bool(nodes)
        for word, spellings in (("or", ("||", "or")), ("and", ("&&", "and"))):
            for spelling in spellings:
                parts = split(nodes, spelling)
                if len(parts) > 1:
                    return join([self.read(part) for part in parts], word)
        places = _find_comparisons(nodes)
        if len(places) == 1 and 0 < places[0] < len(nodes) - 1:
            return self._comparison(nodes[: places[0]], nodes[places[0]].text, nodes[places[0] + 1 :])
        if nodes[0].text in ("!", "not") and not places and not {"+", "-", "*", "/", "%"} & {n.text for n in nodes[2:]}:
            return self.read(nodes[1:]).negated()
        return self._bool(nodes)

    def unknown(self, nodes: Sequence[CppNode], text: str) -> Condition:
        """A condition that nothing is known about, not even that it is the same the next time."""
        start = nodes[0].start if nodes else len(self.inputs.declarations)
        return Condition(self.inputs.add(("unknown", str(start), text), "bool", text, is_fixed=False))

    def _bool(self, nodes: Sequence[CppNode]) -> Condition:
        text = compact(nodes)
        if text in ("true", "false"):
            return Condition(text.capitalize())
        if text in TIMES:
            return Condition(f"{TIMES[text]} != 0", _NOT)
        if text == "action_done" and self.done:
            return Condition(self.done)
        return Condition(self._input("bool", text, words(nodes), nodes))

    def _input(self, type_: str, text: str, found: set[str], nodes: Sequence[CppNode], stem: str = "") -> str:
        key, is_fixed = self._key(type_, text, found, nodes)
        return self.inputs.add(key, type_, text, stem, is_fixed=is_fixed)

    def _key(self, type_: str, text: str, found: set[str], nodes: Sequence[CppNode]) -> tuple[tuple[str, ...], bool]:
        changed = sorted((word, self.versions[word]) for word in found if word in self.versions)
        place = [f"{word} {start}" for word, start in changed]
        if _assigns(nodes):
            place.append(str(nodes[0].start))
        is_fixed = not place and not found & STATUS and not found & set(self.inputs.changing)
        return (type_, text, *place), is_fixed

    def _comparison(self, left: Sequence[CppNode], sign: str, right: Sequence[CppNode]) -> Condition:
        if _number(left) and not _number(right):
            left, sign, right = right, _MIRRORED[sign], left
        number, (first, second) = _number(right), (compact(left), compact(right))
        if first in TIMES or (number and not _number(left)):
            quantity = TIMES.get(first) or self._number_input(left, number[1] if number else "")
            limit = number[0] if number else self._number_input(right, "")
            return Condition(f"{quantity} {sign} {limit}", _NOT)
        if sign not in ("==", "!="):
            return self._order(left, sign, right)
        if second in ("true", "false", "nullptr", "NULL"):
            is_positive = (second == "true") == (sign == "==")
            return self.read(left) if is_positive else self.read(left).negated()
        if _is_enumerator(right):
            key, is_fixed = self._key("enumeration", first, words(left), left)
            equal = self.inputs.element(key, first, right[-1].text, is_fixed=is_fixed)
        else:
            first, second = sorted((first, second))
            both = (*left, *right)
            text = f"{first} == {second}"
            equal = Condition(self._input("bool", text, words(both), both, f"{first}_is_{second}"))
        return equal if sign == "==" else equal.negated()

    def _order(self, left: Sequence[CppNode], sign: str, right: Sequence[CppNode]) -> Condition:
        """A comparison of two values, written with `<`."""
        is_negated = sign in ("<=", ">=")
        if sign in (">", "<="):
            left, right = right, left
        first, second, both = compact(left), compact(right), (*left, *right)
        less = Condition(self._input("bool", f"{first} < {second}", words(both), both, f"{first}_below_{second}"))
        return less.negated() if is_negated else less

    def _number_input(self, nodes: Sequence[CppNode], unit: str) -> str:
        key, is_fixed = self._key("float", compact(nodes), words(nodes), nodes)
        return self.inputs.add(
            (*key, unit), "float", compact(nodes) + (f" in {unit}" if unit else ""), compact(nodes), is_fixed=is_fixed
        )

    def equals(self, nodes: Sequence[CppNode], label: Sequence[CppNode]) -> Condition:
        """The condition of a `case`."""
        return self._comparison(nodes, "==", label)


def _find_comparisons(nodes: Sequence[CppNode]) -> list[int]:
    found, index = [], 0
    while index < len(nodes):
        end = template_end(nodes, index)
        if end == index and nodes[index].text in _MIRRORED:
            found.append(index)
        index = end + 1
    return found


def _number(nodes: Sequence[CppNode]) -> tuple[str, str] | None:
    """The number in a text, as designs write it, and its unit."""
    sign = "-" if len(nodes) == 2 and nodes[0].text == "-" else ""
    if not nodes or len(nodes) > 1 + bool(sign) or nodes[-1].kind != NUMBER:
        return None
    found = _NUMBER.fullmatch(nodes[-1].text)
    if found is None:
        return None
    unit = (found[2] or "").lstrip("_")
    digits = found[1].replace("'", "")
    value = float(digits)
    if value > 2.0**53:
        return None
    return sign + (digits if digits.isdigit() else repr(value)), "" if unit.lower() in _PLAIN_SUFFIXES else unit


def _is_enumerator(nodes: Sequence[CppNode]) -> bool:
    """Whether a text looks like an enumerator: qualified, or in capitals."""
    is_name = all(node.is_word or node.text == "::" for node in nodes) and nodes[-1].is_word
    return is_name and (len(nodes) > 1 or (nodes[0].text.isupper() and len(nodes[0].text) > 1))


def _assigns(nodes: Sequence[CppNode]) -> bool:
    return any(node.text in _ASSIGNING or _assigns(node.children) for node in nodes)
