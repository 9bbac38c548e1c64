"""A generated C++ source as a person edits it, and random edits of its decisions; all of them compile."""

import random
import re
from collections.abc import Sequence
from dataclasses import dataclass

from vicode.model.design import Declaration, Design

IF = re.compile(r"^( +)if \((.*)\) \{$", re.MULTILINE)
CASE = re.compile(r"^        case State::\w+:$", re.MULTILINE)
_CHANGE = re.compile(r"change_to\(State::(\w+)(?=[,)])")
DECIMAL = re.compile(r"(?<![\w.])\d+\.\d+(?![\w.])")


class NotPossible(Exception):  # noqa: N818 - no error of the code under test
    """The text has no place for an edit."""


@dataclass(frozen=True)
class CppText:
    """A source, with what the person knows of its design."""

    text: str
    design: Design
    rng: random.Random

    def names(self, *types: str) -> list[str]:
        """Own values of some types that code may set."""
        own: tuple[Declaration, ...] = (*self.design.outputs, *self.design.variables)
        return [each.name for each in own if (each.type or _type_of(each.initial)) in types]

    def pick(self, items: Sequence[str]) -> str:
        if not items:
            raise NotPossible
        return self.rng.choice(items)

    def function(self, *names: str) -> tuple[int, int]:
        """The start and the end of the body of one of some functions."""
        spans = []
        for name in names:
            starts = re.finditer(rf"^.*::{name}\(.*\) \{{\n", self.text, re.MULTILINE)
            spans += [(found.end(), self.text.index("\n}\n", found.end() - 1) + 1) for found in starts]
        if not spans:
            raise NotPossible
        return self.rng.choice(spans)

    def place(self, pattern: re.Pattern[str], *names: str) -> re.Match[str]:
        """A match in one of some functions."""
        start, end = self.function(*names)
        found = list(pattern.finditer(self.text, start, end))
        if not found:
            raise NotPossible
        return self.rng.choice(found)

    def replaced(self, found: re.Match[str], text: str) -> str:
        return self.text[: found.start()] + text + self.text[found.end() :]

    def inserted(self, at: int, text: str) -> str:
        return self.text[:at] + text + self.text[at:]

    def block(self, found: re.Match[str]) -> tuple[int, int]:
        """The lines of an `if` with its branches."""
        end = re.compile(rf"^{found[1]}\}}\n", re.MULTILINE).search(self.text, found.end())
        if end is None:
            raise NotPossible
        return found.start(), end.end()

    def condition(self) -> str:
        whole, number, flag = self.names("int"), self.names("float"), self.names("bool")
        choices = ["state_time() > 0.05", "component_time() > 0.2"]
        choices += [f"{name} {sign} {value}" for name in whole for sign in ("<", ">=") for value in (2, 3)]
        choices += [f"{name} {sign} {value}" for name in number for sign in ("<", ">") for value in ("1", "0.5")]
        choices += [text for name in flag for text in (name, f"!{name}")]
        choices += [text for name in whole for text in (name, f"!{name}", f"({name} > 1 || {name} < -1)")]
        choices += [f"std::abs({name}) > 1" for name in number] + [f"{name} / 2 > 0.75" for name in number]
        return self.rng.choice(choices)

    def change(self) -> str:
        """A change of the state."""
        names = [state.name for state in self.design.states if not state.disabled]
        return f"change_to(State::{self.pick(names)});"

    def step(self) -> str:
        """A statement that the design can express."""
        whole, number, flag = self.names("int"), self.names("float"), self.names("bool")
        choices = [text for name in whole for text in (f"++{name};", f"{name} += 2;", f"{name} = {name} * 2;")]
        choices += [text for name in number for text in (f"{name} = 2;", f"{name} -= 0.5;", f"{name} = 7 / 2.0;")]
        choices += [f"{name} = {self.condition()};" for name in flag]
        return self.pick(choices)

    def code(self) -> str:
        """A statement that is hand-written code."""
        name = self.pick(self.names("int", "float"))
        number = self.rng.randrange(10**6)
        return self.rng.choice(
            (
                f"if ({self.condition()}) {{ {name} += 1; }}",
                f"for (int i = 0; i < 3; ++i) {{ {name} += i; }}  // {number}",
                f"static int tries = 0; {name} += ++tries;",
                f"const auto before{number} = {name}; {name} += before{number} > 3 ? 1 : 2;",
                f'std::printf("{number}");',
                f"{{ int local = 3; {name} += local / 2; }}",
                f"// note {number}\n            {name} += std::abs(-3);",
            )
        )


def _type_of(initial: str) -> str:
    if initial.lower() in ("true", "false"):
        return "bool"
    return "int" if re.fullmatch(r"-?\d+", initial) else "float"


def change_number(text: CppText) -> str:
    found = text.place(DECIMAL, "decide", "decide_common", "act", "enter", "leave")
    return text.replaced(found, text.rng.choice(("25", "0.25", "3", "1e1", "250.5")))


def write_number_alike(text: CppText) -> str:
    found = text.place(re.compile(r"(?<![\w.])(\d+)\.0(?![\w.])"), "decide", "act", "enter")
    return text.replaced(found, found[1])


def divide_whole_numbers(text: CppText) -> str:
    found = text.place(DECIMAL, "decide", "act", "enter")
    return text.replaced(found, "(7 / 2)")


def swap_operator(text: CppText) -> str:
    found = text.place(re.compile(r" (<|>|<=|>=) "), "decide", "decide_common")
    return text.replaced(found, f" {text.rng.choice(('<', '>', '<=', '>='))} ")


def spell_operator(text: CppText) -> str:
    found = text.place(re.compile(r" (&&|\|\|) "), "decide", "decide_common")
    return text.replaced(found, " and " if found[1] == "&&" else " or ")


def join_otherwise(text: CppText) -> str:
    found = text.place(re.compile(r" && (?!\[)"), "decide", "decide_common")
    return text.replaced(found, " || ")


def drop_operand(text: CppText) -> str:
    found = text.place(re.compile(r"(?<=\()([\w.()!]+ (?:[<>=!]=?) [\w.']+|!?[\w.]+(?:\(\))?) && (?=[\w!])"), "decide")
    return text.replaced(found, "")


def add_operand(text: CppText) -> str:
    found = text.place(IF, "decide", "decide_common")
    if "||" in found[2] or "?" in found[2] or "decide_common" in found[2]:
        raise NotPossible
    return text.replaced(found, f"{found[1]}if ({found[2]} && {text.condition()}) {{")


def negate(text: CppText) -> str:
    found = text.place(IF, "decide", "decide_common")
    if "decide_common" in found[2]:
        raise NotPossible
    return text.replaced(found, f"{found[1]}if (!({found[2]})) {{")


def nest(text: CppText) -> str:
    found = text.place(IF, "decide", "decide_common")
    start, end = text.block(found)
    lines = text.text[start:end].splitlines(keepends=True)
    if "else" in text.text[start:end] or "decide_common()" in found[2]:
        raise NotPossible
    inner = "".join(f"    {line}" for line in lines[1:-1])
    wrapped = f"{lines[0]}{found[1]}    if ({text.condition()}) {{\n{inner}{found[1]}    }}\n{lines[-1]}"
    return text.text[:start] + wrapped + text.text[end:]


def join_else(text: CppText) -> str:
    pattern = re.compile(r"^( {8,})\}\n(?: +// .*\n)?\1if ", re.MULTILINE)
    found = text.place(pattern, "decide")
    return text.replaced(found, f"{found[1]}}} else if ")


def write_else(text: CppText) -> str:
    found = text.place(IF, "decide")
    start, end = text.block(found)
    if "else" in text.text[start:end] or "decide_common" in found[2]:
        raise NotPossible
    margin, change = found[1], text.change()
    return text.text[: end - 1] + f" else {{\n{margin}    {change}\n{margin}    return;\n{margin}}}\n" + text.text[end:]


def add_transition(text: CppText) -> str:
    found = text.place(IF, "decide")
    if "decide_common" in found[2]:
        raise NotPossible
    start, end = text.block(found)
    note = f"{found[1]}// new reason\n" if text.rng.random() < 0.5 else ""
    test = f"{note}{found[1]}if ({text.condition()}) {{\n{found[1]}    {text.change()}\n"
    block = f"{test}{found[1]}    return;\n{found[1]}}}\n"
    return text.inserted(start if text.rng.random() < 0.5 else end, block)


def add_stay_without_braces(text: CppText) -> str:
    found = text.place(IF, "decide")
    if "decide_common" in found[2]:
        raise NotPossible
    return text.inserted(found.start(), f"{found[1]}if ({text.condition()})\n{found[1]}    return;\n")


def remove_block(text: CppText) -> str:
    found = text.place(IF, "decide")
    if "decide_common" in found[2] or found[1] == " " * 4:
        raise NotPossible
    start, end = text.block(found)
    return text.text[:start] + text.text[end:]


def swap_blocks(text: CppText) -> str:
    found = text.place(IF, "decide")
    start, end = text.block(found)
    following = IF.match(text.text, end)
    if following is None or "decide_common" in found[2]:
        raise NotPossible
    _begin, last = text.block(following)
    return text.text[:start] + text.text[end:last] + text.text[start:end] + text.text[last:]


def change_target(text: CppText) -> str:
    found = text.place(_CHANGE, "decide", "decide_common")
    names = [state.name for state in text.design.states if not state.disabled]
    return text.replaced(found, f"change_to(State::{text.pick(names)}")


def change_timer(text: CppText) -> str:
    found = text.place(re.compile(r"(?<=_time_ns\(\) >= )[\d']+"), "decide", "decide_common")
    return text.replaced(found, text.rng.choice(("100'000'000", "20000000", "1'500'000'000")))


def change_comment(text: CppText) -> str:
    found = text.place(re.compile(r"(?<=// )(?!<)(?!</).*"), "decide", "decide_common")
    return text.replaced(found, f"another reason {text.rng.randrange(99)}")
