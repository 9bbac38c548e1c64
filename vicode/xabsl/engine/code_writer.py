"""Writes a program as intermediate code."""

from collections.abc import Iterator

from .program import CompiledOption, Program, Term, TypedSlot

_LOGICAL_OPERATORS = {"&", "|"}


def write_code(program: Program) -> str:
    """Write intermediate code with the line breaks of the original compiler. The first line is a comment."""
    lines = [f"// Intermediate code for the agents of {program.title}", "", str(len(program.enums))]
    lines += [f"{name} {len(elements)} {' '.join(elements)}" for name, elements in program.enums]
    lines += [str(len(program.symbols)), *(_slot(slot) for slot in program.symbols), "", str(len(program.options))]
    for option in program.options:
        slots = "".join(f" {_slot(slot)}" for slot in option.parameters)
        lines.append(f"{option.name} {len(option.parameters)}{slots}")
    for option in program.options:
        lines += _option(option)
    lines += ["", str(len(program.agents)), *(f"{name} {root}" for name, root in program.agents), ""]
    return "\n".join(lines)


def format_number(number: float) -> str:
    """Format a number without a redundant fraction."""
    return str(int(number)) if number == int(number) else repr(number)


def _slot(slot: TypedSlot) -> str:
    return f"e {slot.enum} {slot.name}" if slot.kind == "e" else f"{slot.kind} {slot.name}"


def _option(option: CompiledOption) -> Iterator[str]:
    yield ""
    yield str(len(option.states))
    for state in option.states:
        yield f"{state.name} {state.mode}" + (f" {state.robots}" if state.mode != "n" else "")
    yield option.initial
    lines: list[str] = []
    for state in option.states:
        lines += [str(int(state.is_target)), str(len(state.actions))]
        for action in state.actions:
            _action(action, lines)
        _term(state.decision, lines)
    yield from lines


def _action(action: Term, lines: list[str]) -> None:
    lines.append(f"{action[0]} {action[1]}")
    if action[0] in "oa":
        _arguments(action[2], lines)
    else:
        _term(action[2], lines)


def _arguments(arguments: tuple[Term, ...], lines: list[str]) -> None:
    lines.append(str(len(arguments)))
    for argument in arguments:
        lines.append(" ".join(argument[:-1]))
        _term(argument[-1], lines)


def _term(term: Term, lines: list[str]) -> None:
    letter = term[0]
    if letter == "v":
        value = term[1]
        text = value if isinstance(value, str) else str(value).lower() if value is True or value is False else ""
        lines.append(f"v {text or format_number(value)}")
    elif letter == "i" and isinstance(term[1], str):
        lines.append(f"i {term[1]}")
        _arguments(term[2], lines)
    elif letter in _LOGICAL_OPERATORS:
        lines.append(f"{letter} {len(term) - 1}")
        for operand in term[1:]:
            _term(operand, lines)
    elif len(term) > 1 and isinstance(term[1], str):
        lines.append(f"{letter} {term[1]}")
    else:
        lines.append(letter)
        for operand in term[1:]:
            _term(operand, lines)
