"""Random edits of generated modules, as people write them: changes of the text, which know nothing of designs."""

import ast
import random
import re
from collections.abc import Callable

from tests.sync.module_text import Module, is_text

Edit = Callable[[Module, random.Random], str | None]
_STATE = re.compile(
    r"^ {12}State\((?:\n +)?\"(\w+)\", self\._in_(\w+).*?\),?\n(?= {8,12}[S)])", re.MULTILINE | re.DOTALL
)
_HELPER = "    def estimate(self) -> float:\n        return 20.0\n"


def _note(chance: random.Random) -> str:
    return f'print("note {chance.randrange(1000)}")'


def _beside_region(module: Module, chance: random.Random, *, is_behind: bool) -> str | None:
    mark = "# </vicode>" if is_behind else "# <vicode "
    marks = [n for n, line in enumerate(module.lines, start=1) if line.startswith(f"        {mark}")]
    if not marks:
        return None
    return module.inserted(chance.choice(marks) + is_behind, f"        {_note(chance)}")


def _statement_behind_region(module: Module, chance: random.Random) -> str | None:
    return _beside_region(module, chance, is_behind=True)


def _statement_before_region(module: Module, chance: random.Random) -> str | None:
    return _beside_region(module, chance, is_behind=False)


def _renamed_action(module: Module, chance: random.Random) -> str | None:
    names = [method.name for method in module.methods("_do_")]
    if not names:
        return None
    name = chance.choice(names)
    count = chance.choice([0, 1, 1])
    return re.sub(rf"\b{name}\b", f"{name}_now", module.text, count=count)


def _action_called_twice(module: Module, chance: random.Random) -> str | None:
    calls = [s for s in module.statements(ast.Expr) if module.source(s).startswith("self._do_")]
    if not calls:
        return None
    call = chance.choice(calls)
    return module.inserted(call.lineno, " " * call.col_offset + module.source(call))


def _guards(module: Module) -> list[ast.If]:
    found = [node for node in module.statements(ast.If) if isinstance(node, ast.If)]
    return [
        node for node in found if "decide_common" not in ast.unparse(node.test) and ast.unparse(node.test) != "decide"
    ]


def _nested_guard(module: Module, chance: random.Random) -> str | None:
    fitting = [n for n in _guards(module) if isinstance(n.test, ast.BoolOp) and isinstance(n.test.op, ast.And)]
    fitting = [n for n in fitting if not n.orelse and len(n.test.values) > 1 + (ast.unparse(n.test)[:6] == "decide")]  # type: ignore[attr-defined]
    if not fitting:
        return None
    node = chance.choice(fitting)
    assert isinstance(node.test, ast.BoolOp)
    margin = " " * node.col_offset
    body = module.lines[node.body[0].lineno - 1 : node.end_lineno]
    first = chance.randrange(1, len(node.test.values))
    sides = [
        " and ".join(f"({ast.unparse(v)})" for v in part)
        for part in (node.test.values[:first], node.test.values[first:])
    ]
    sides = [side if " and " in side else side[1:-1] for side in sides]
    new = [f"{margin}if {sides[0]}:", f"{margin}    if {sides[1]}:", *(f"    {line}" for line in body)]
    lines = module.lines
    return "\n".join([*lines[: node.lineno - 1], *new, *lines[node.end_lineno or 0 :]])


def _elif(module: Module, chance: random.Random) -> str | None:
    ends = {node.end_lineno: node for node in _guards(module)}
    lines = module.lines
    fitting = []
    for node in _guards(module):
        above = node.lineno - 1
        while above and lines[above - 1].lstrip().startswith("# "):
            above -= 1
        before = ends.get(above)
        if (
            before is not None
            and before.col_offset == node.col_offset
            and lines[node.lineno - 1].lstrip().startswith("if ")
        ):
            fitting.append(node)
    if not fitting:
        return None
    node = chance.choice(fitting)
    lines[node.lineno - 1] = " " * node.col_offset + "el" + lines[node.lineno - 1].lstrip()
    return "\n".join(lines)


def _operands(module: Module) -> list[ast.expr]:
    """The operands of tests that are bool: no numbers, no comparisons."""
    tests = [node.test for node in _guards(module)]
    values = [v for test in tests for v in (test.values if isinstance(test, ast.BoolOp) else [test])]
    values = [v.operand if isinstance(v, ast.UnaryOp) and isinstance(v.op, ast.Not) else v for v in values]
    return [value for value in values if isinstance(value, ast.Attribute)]


def _changed_operand(module: Module, chance: random.Random, new: Callable[[str], str]) -> str | None:
    operands = _operands(module)
    if not operands:
        return None
    operand = chance.choice(operands)
    return module.replaced(operand, new(module.source(operand)))


def _is_true(module: Module, chance: random.Random) -> str | None:
    form = chance.choice(["({} is True)", "({} is False)", "({} is not True)", "({} is not False)", "({} == True)"])
    return _changed_operand(module, chance, form.format)


def _truthiness(module: Module, chance: random.Random) -> str | None:
    numbers = [name for name in ("kicks", "n", "k") if f"self.{name} = " in module.text]
    number = f"self.{chance.choice(numbers)}" if numbers else "len(self.state)"
    form = chance.choice([f"({{0}} and {number})", f"({{0}} or not {number})", number])
    return _changed_operand(module, chance, form.format)


def _membership(module: Module, chance: random.Random) -> str | None:
    values = chance.choice(["(Side.left,)", "(Side.left, Side.right)", "[Side.left]", "{Side.right}"])
    return _changed_operand(module, chance, lambda _old: f"(self.side {chance.choice(['in', 'not in'])} {values})")


def _rounded(module: Module, chance: random.Random) -> str | None:
    values = [
        node.value
        for node in module.statements(ast.Assign, ast.AugAssign)
        if isinstance(node, ast.Assign | ast.AugAssign) and "Side" not in ast.unparse(node.value)
    ]
    if not values:
        return None
    value = chance.choice(values)
    return module.replaced(value, f"{chance.choice(['round', 'int', 'abs', 'bool'])}({module.source(value)})")


def _number(module: Module, chance: random.Random) -> str | None:
    numbers = [
        node
        for statement in module.statements()
        for node in ast.walk(statement)
        if isinstance(node, ast.Constant) and type(node.value) in (int, float)
    ]
    if not numbers:
        return None
    node = chance.choice(numbers)
    assert isinstance(node.value, int | float)
    return module.replaced(node, chance.choice([str(node.value + 1), f"{float(node.value)!r}", "7", "0.25"]))


def _target(module: Module, chance: random.Random) -> str | None:
    calls = [s for s in module.statements(ast.Expr) if "self._change_to(" in module.source(s)]
    names = _STATE.findall(module.text)
    if not calls or not names:
        return None
    new = chance.choice([f'self._change_to("{name}")' for name, _stem in names] + ["self._stay()"])
    return module.replaced(chance.choice(calls), new)


def _without_lines(text: str, ranges: list[tuple[int, int]]) -> str:
    dropped = {line for first, last in ranges for line in range(first, last + 1)}
    return "\n".join(line for number, line in enumerate(text.split("\n"), start=1) if number not in dropped)


def _deleted_state(module: Module, chance: random.Random) -> str | None:
    states = _STATE.findall(module.text)
    if len(states) < 2:
        return None
    name, stem = chance.choice(states[1:])
    own = re.compile(rf"_(in|enter|leave)_{stem}|_(do|when)_{stem}(_\w+)?")
    gone = [method for method in module.methods() if own.fullmatch(method.name)]
    drops = [(method.lineno, (method.end_lineno or 0) + 1) for method in gone]
    lines = module.lines
    for node in _guards(module) if chance.random() < 0.8 else ():
        if f'self._change_to("{name}"' in module.source(node.body[0]) and not node.orelse:
            first = node.lineno
            while lines[first - 2].lstrip().startswith("# ") and "vicode" not in lines[first - 2]:
                first -= 1
            drops.append((first, node.end_lineno or 0))
    text = _without_lines(module.text, drops)
    entry = next(m for m in _STATE.finditer(text) if m[1] == name)
    return text[: entry.start()] + text[entry.end() :]


def _pasted_state(module: Module, chance: random.Random) -> str | None:
    methods = module.methods("_in_")
    method = chance.choice(methods)
    stem = method.name.removeprefix("_in_")
    copy = "\n".join(module.lines[method.lineno - 1 : method.end_lineno]).replace(f"_in_{stem}", "_in_pasted_again")
    if chance.random() < 0.5:
        copy += "\n        print(self.estimate())"
        copy += f"\n\n{_HELPER}".rstrip("\n")
    text = f"{module.text.rstrip()}\n\n{copy}\n"
    if chance.random() < 0.7:
        text = re.sub(
            r"\n {8}\)\n", '\n            State("PastedAgain", self._in_pasted_again),\n        )\n', text, count=1
        )
    return text


def _shuffled_methods(module: Module, chance: random.Random) -> str | None:
    head, *methods = re.split(r"^(?=    def _)", f"{module.text}\n", flags=re.MULTILINE)
    init, *rest = methods if "def __init__" in methods[0] else ["", *methods]
    chance.shuffle(rest)
    return f"{head}{init}{''.join(rest).rstrip()}\n"


def _new_parameter(module: Module, chance: random.Random) -> str | None:
    if "def modulate" in module.text:
        return None
    text = module.text.replace("        self._set_states(", "        self.pace = 2.5\n        self._set_states(", 1)
    method = "    def modulate(self, *, pace: float = 2.5) -> None:\n        self.pace = pace\n\n"
    place = re.search(r"^    def _(?!_)", text, re.MULTILINE)
    return None if place is None else text[: place.start()] + method + text[place.start() :]


def _new_attribute(module: Module, chance: random.Random) -> str | None:
    value = chance.choice(["5", "0.5", "True", "[]", "None", "{}", '"text"'])
    return module.text.replace(
        "        self._set_states(", f"        self.extra = {value}\n        self._set_states(", 1
    )


def _new_import(module: Module, chance: random.Random) -> str | None:
    statement = chance.choice(["import math", "from math import pi", "from enum import Enum as Kind"])
    return module.text.replace("from typing import", f"{statement}\nfrom typing import", 1)


def _comment(module: Module, chance: random.Random) -> str | None:
    statement = chance.choice(module.statements())
    words = f"# written by hand {chance.randrange(1000)}"
    if chance.random() < 0.5:
        return module.inserted(statement.lineno, " " * statement.col_offset + words)
    lines = module.lines
    lines[(statement.end_lineno or 0) - 1] += f"  {words}"
    return "\n".join(lines)


def _changed_comment(module: Module, chance: random.Random) -> str | None:
    fixed = module.region_lines
    lines = module.lines
    found = [n for n, line in enumerate(lines, start=1) if re.match(r" +# \w", line) and n not in fixed]
    if not found:
        return None
    number = chance.choice(found)
    if chance.random() < 0.5:
        return _without_lines(module.text, [(number, number)])
    lines[number - 1] += f" {chance.randrange(1000)}"
    return "\n".join(lines)


def _swapped(module: Module, chance: random.Random) -> str | None:
    pairs = [
        (a, b)
        for a, b in zip(module.statements(), module.statements()[1:], strict=False)
        if a.col_offset == b.col_offset and (a.end_lineno or 0) < b.lineno
    ]
    if not pairs:
        return None
    a, b = chance.choice(pairs)
    lines = module.lines
    first, second = lines[a.lineno - 1 : a.end_lineno], lines[b.lineno - 1 : b.end_lineno]
    between = lines[a.end_lineno or 0 : b.lineno - 1]
    return "\n".join([*lines[: a.lineno - 1], *second, *between, *first, *lines[b.end_lineno or 0 :]])


def _dropped(module: Module, chance: random.Random) -> str | None:
    statement = chance.choice(module.statements())
    return module.replaced(statement, "pass")


def _local(module: Module, chance: random.Random) -> str | None:
    operands = _operands(module)
    if not operands or chance.random() < 0.3:
        statement = chance.choice(module.statements())
        margin = " " * statement.col_offset
        return module.inserted(statement.lineno, f"{margin}value = 3", f"{margin}print(value)")
    operand = chance.choice(operands)
    owner = next(node for node in _guards(module) if any(each is operand for each in ast.walk(node.test)) or True)
    text = module.replaced(operand, "fact")
    return Module(text).inserted(owner.lineno, f"{' ' * owner.col_offset}fact = {module.source(operand)}")


def _wrapped(module: Module, chance: random.Random) -> str | None:
    statement = chance.choice(module.statements())
    kind = chance.randrange(4)
    if kind == 0:
        return module.wrapped(statement, "try:", tail=("except ValueError:", f"    {_note(chance)}"))
    head = ["for _ in range(2):", "if self.state_time > 0.3:", "while not self.state:"][kind - 1]
    return module.wrapped(statement, head)


def _statement(module: Module, chance: random.Random) -> str | None:
    statement = chance.choice(module.statements())
    return module.inserted(statement.lineno, " " * statement.col_offset + _note(chance))


def _method(module: Module, chance: random.Random) -> str | None:
    place = chance.choice(module.methods())
    first = min([place.lineno, *(each.lineno for each in place.decorator_list)])
    text = module.inserted(first, *_HELPER.split("\n"))
    if chance.random() < 0.5:
        return text
    statement = chance.choice(Module(text).statements())
    return Module(text).inserted(statement.lineno, " " * statement.col_offset + "print(self.estimate())")


def _docstring(module: Module, chance: random.Random) -> str | None:
    texts = [
        method.body[0]
        for method in module.methods()
        if is_text(method.body[0]) and method.body[0].end_lineno == method.body[0].lineno
    ]
    if not texts:
        return None
    return module.replaced(chance.choice(texts), f'"""Words {chance.randrange(1000)} of a person."""')


def _added_transition(module: Module, chance: random.Random) -> str | None:
    names = _STATE.findall(module.text)
    statement = chance.choice([s for m in module.methods("_in_") for s in m.body[-1:]])
    if not names or statement.lineno in module.region_lines:
        return None
    block = ["if decide and self.state_time > 4:", f'    self._change_to("{chance.choice(names)[0]}")', "    return"]
    return module.inserted(statement.lineno, *(" " * statement.col_offset + line for line in block))


EDITS: dict[str, Edit] = {
    "statement behind a region": _statement_behind_region,
    "statement before a region": _statement_before_region,
    "renamed action": _renamed_action,
    "action called twice": _action_called_twice,
    "nested guard": _nested_guard,
    "elif": _elif,
    "is True": _is_true,
    "truth of a number": _truthiness,
    "in": _membership,
    "round or int": _rounded,
    "number": _number,
    "target": _target,
    "deleted state": _deleted_state,
    "pasted state": _pasted_state,
    "shuffled methods": _shuffled_methods,
    "new parameter": _new_parameter,
    "new attribute": _new_attribute,
    "new import": _new_import,
    "new comment": _comment,
    "changed comment": _changed_comment,
    "swapped statements": _swapped,
    "dropped statement": _dropped,
    "local variable": _local,
    "wrapped statement": _wrapped,
    "new statement": _statement,
    "new method": _method,
    "docstring": _docstring,
    "added transition": _added_transition,
}
"""Changes of a module; None if there is nothing to change in this way."""
