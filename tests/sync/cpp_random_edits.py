"""Random edits of a generated C++ source, made in the text as a person makes them; all of them compile."""

import random
import re
from collections.abc import Callable

from tests.sync.cpp_text_edits import (
    CASE,
    IF,
    CppText,
    NotPossible,
    add_operand,
    add_stay_without_braces,
    add_transition,
    change_comment,
    change_number,
    change_target,
    change_timer,
    divide_whole_numbers,
    drop_operand,
    join_else,
    join_otherwise,
    negate,
    nest,
    remove_block,
    spell_operator,
    swap_blocks,
    swap_operator,
    write_else,
    write_number_alike,
)
from vicode.model.design import Design

Edit = Callable[[CppText], str]


def add_comment(text: CppText) -> str:
    found = text.place(re.compile(r"^( +)(?=\w)", re.MULTILINE), "decide", "act", "enter", "leave", "change_to")
    return text.inserted(found.start(), f"{found[1]}// remark {text.rng.randrange(10**6)}\n")


def add_trailing_comment(text: CppText) -> str:
    found = text.place(re.compile(r"(?<=;)$", re.MULTILINE), "decide", "act", "enter")
    return text.inserted(found.start(), f"  // remark {text.rng.randrange(10**6)}")


def add_step(text: CppText) -> str:
    found = text.place(re.compile(r"^ {12}(?=\w.*;$)", re.MULTILINE), "act", "enter", "leave")
    return text.inserted(found.start(), f"            {text.step()}\n")


def add_code(text: CppText) -> str:
    found = text.place(re.compile(r"^ {12}(?=\w.*;$)", re.MULTILINE), "act", "enter", "leave")
    return text.inserted(found.start(), f"            {text.code()}\n")


def add_case(text: CppText) -> str:
    start, end = text.function("act", "enter")
    cases = re.findall(r"case State::(\w+):", text.text[start:end])
    free = [each.name for each in text.design.states if each.name not in cases and not each.disabled]
    opening = text.text.find("    switch (state_) {\n", start, end)
    if opening < 0:
        raise NotPossible
    block = f"        case State::{text.pick(free)}:\n            {text.step()}\n            break;\n"
    return text.inserted(opening + len("    switch (state_) {\n"), block)


def remove_step(text: CppText) -> str:
    found = text.place(re.compile(r"^ {12}(?!break|return)\w.*;\n", re.MULTILINE), "act", "enter", "leave")
    return text.replaced(found, "")


def add_beside_region(text: CppText) -> str:
    found = text.place(re.compile(r"^    // <(/?)vicode.*\n", re.MULTILINE), r"do_\w+")
    line = f"    {text.code() if text.rng.random() < 0.5 else text.step()}\n"
    return text.inserted(found.end() if found[1] else found.start(), line)


def return_early(text: CppText) -> str:
    start, _end = text.function("act", "decide", "enter")
    return text.inserted(start, f"    if ({text.condition()}) {{\n        return;\n    }}\n")


def return_in_case(text: CppText) -> str:
    found = text.place(re.compile(r"^ {12}(?=\w.*;$)", re.MULTILINE), "act", "enter")
    return text.inserted(
        found.start(), f"            if ({text.condition()}) {{\n                return;\n            }}\n"
    )


def add_local(text: CppText) -> str:
    found = text.place(IF, "decide")
    if "decide_common" in found[2] or found[1] == " " * 4:
        raise NotPossible
    name = text.pick(text.names("int", "float"))
    # A label cannot be followed by a declaration in a switch with other cases.
    body = f"if (const auto local = {name} / 2; local > 1) {{\n{found[1]}    {text.change()}\n{found[1]}    return;\n"
    return text.inserted(found.start(), f"{found[1]}{body}{found[1]}}}\n")


def shadow(text: CppText) -> str:
    found = text.place(re.compile(r"^ {12}(?=\w.*;$)", re.MULTILINE), "act", "enter")
    names = text.names("int", "float")
    name, other = text.pick(names), text.pick(names)
    if name == other:
        raise NotPossible
    end = text.text.index("            break;", found.start())
    block = text.text[found.start() : end]
    inner = f"            double {name} = 41;\n{block}            {other} += {name} > 40 ? 1 : 2;\n"
    return text.text[: found.start()] + f"            {{\n{inner}            }}\n" + text.text[end:]


def add_helper(text: CppText) -> str:
    at = text.text.index(" {\n", text.text.index("\nnamespace ")) + 3
    helper = "\nstatic int count_calls() {\n    static int calls = 0;\n    return ++calls;\n}\n"
    changed = CppText(text.inserted(at, helper), text.design, text.rng)
    name = text.pick(text.names("int", "float"))
    found = changed.place(re.compile(r"^ {12}(?=\w.*;$)", re.MULTILINE), "act", "enter")
    return changed.inserted(found.start(), f"            {name} += count_calls();\n")


def define_macro(text: CppText) -> str:
    at = text.text.index("\nnamespace ")
    name = text.pick(text.names("int", "float"))
    changed = CppText(text.inserted(at, "\n#define LIMIT_OF_LAW 2\n"), text.design, text.rng)
    found = changed.place(IF, "decide")
    if "decide_common" in found[2]:
        raise NotPossible
    return changed.replaced(found, f"{found[1]}if ({name} > LIMIT_OF_LAW) {{")


def add_include(text: CppText) -> str:
    at = text.text.index("\n", text.text.index("#include")) + 1
    return text.inserted(at, "#include <cstdlib>  // for std::abs\n")


def move_functions(text: CppText) -> str:
    pieces = re.split(r"(?<=^}\n)\n(?=\S)", text.text, flags=re.MULTILINE)
    if len(pieces) < 5:
        raise NotPossible
    inner = pieces[1:-1]
    text.rng.shuffle(inner)
    return "\n".join([pieces[0], *inner, pieces[-1]])


def reorder_cases(text: CppText) -> str:
    start, end = text.function("decide", "act", "enter", "leave", "state_name")
    opening = text.text.find("    switch (state_) {\n", start, end)
    if opening < 0:
        raise NotPossible
    first = opening + len("    switch (state_) {\n")
    last = text.text.index("\n    }\n", first) + 1
    blocks = re.split(r"(?<=break;\n|eturn;\n)(?=        (?:case|default))", text.text[first:last])
    if len(blocks) < 2 or any(not CASE.match(each) and "default" not in each for each in blocks):
        raise NotPossible
    text.rng.shuffle(blocks)
    return text.text[:first] + "".join(blocks) + text.text[last:]


def format_otherwise(text: CppText) -> str:
    lines = [re.sub(r"^(?:    )+", lambda found: "  " * (len(found[0]) // 4), line) for line in text.text.split("\n")]
    return re.sub(r"^(.*\)(?: const)?) \{$", r"\1\n{", "\n".join(lines), flags=re.MULTILINE)


def write_crlf(text: CppText) -> str:
    return text.text.replace("\r\n", "\n").replace("\n", "\r\n")


def use_standard_function(text: CppText) -> str:
    found = text.place(re.compile(r"bica::(abs|min|max|sqrt|sin|cos)\((?!std)"), "decide", "act", "enter")
    return text.replaced(found, f"std::{found[1]}(")


def write_cast(text: CppText) -> str:
    found = text.place(re.compile(r"bica::to_float\("), "decide", "act", "enter")
    return text.replaced(found, text.rng.choice(("static_cast<double>(", "double(", "(double)(")))


def change_frequency(text: CppText) -> str:
    found = re.search(r"(?<=\w\", )\d+\.\d+(?=\))", text.text)
    if found is None:
        raise NotPossible
    return text.replaced(found, "25")


def change_resume(text: CppText) -> str:
    found = re.search(r"(?<=step_machine\(\*this, )\w+", text.text)
    assert found is not None
    return text.replaced(found, "false" if found[0] == "true" else "true")


def delete_state(text: CppText) -> str:
    names = [each.name for each in text.design.states if each.name != text.design.initial]
    name = text.pick(names)
    label = f"        case State::{name}:\n"
    if f"change_to(State::{name}" in text.text:
        raise NotPossible
    edited = re.sub(rf"{label}(?=        case)", "", text.text)
    edited = re.sub(rf"(        case State::\w+:\n){label}", r"\1", edited)
    return re.sub(rf"{label}(?: {{12}}.*\n)+", "", edited)


EDITS: tuple[Edit, ...] = (
    *(change_number, write_number_alike, divide_whole_numbers, swap_operator, spell_operator, join_otherwise),
    *(drop_operand, add_operand, negate, nest, join_else, write_else, add_transition, add_stay_without_braces),
    *(remove_block, swap_blocks, change_target, change_timer, change_comment, add_comment, add_trailing_comment),
    *(add_step, add_code, add_case, remove_step, add_beside_region, return_early, return_in_case, add_local, shadow),
    *(add_helper, define_macro, add_include, move_functions, reorder_cases, use_standard_function),
    *(write_cast, change_frequency, change_resume, delete_state),
)
LAYOUTS: tuple[Edit, ...] = (format_otherwise, write_crlf)


def edit_text(text: str, design: Design, rng: random.Random) -> tuple[str, tuple[str, ...]]:
    """Make one to three edits, at times with another layout; returns the text and the names of the edits."""
    names: list[str] = []
    for _step in range(200):
        if len(names) >= rng.choice((1, 1, 2, 3)):
            break
        edit = rng.choice(EDITS)
        try:
            edited = edit(CppText(text, design, rng))
        except NotPossible:
            continue
        if edited != text:
            text = edited
            names.append(edit.__name__)
    if rng.random() < 0.2:
        layout = rng.choice(LAYOUTS)
        text = layout(CppText(text, design, rng))
        names.append(layout.__name__)
    return text, tuple(names)
