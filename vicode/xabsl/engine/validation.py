"""Checks of a program before it runs: missing symbols, invalid references and cycles of options."""

from collections.abc import Iterable, Iterator

from .program import CompiledOption, CompiledState, Program, Term, TypedSlot
from .symbols import BasicBehavior, RobotSymbol, SymbolList

_KIND_NAMES = {"d": "decimal", "b": "bool", "e": "enum"}


class LoadError(ValueError):
    """A program cannot run on this robot. `problems` lists all reasons."""

    def __init__(self, problems: Iterable[str]) -> None:
        self.problems = tuple(dict.fromkeys(problems))
        super().__init__("; ".join(self.problems))


def iter_values(program: Program) -> Iterator[tuple[str, Term]]:
    """Yield all terms of a program with their expected kinds, outer terms before inner ones."""
    for option in program.options:
        for state in option.states:
            yield from _iter_tree_values(state.decision)
            for action in state.actions:
                if action[0] in ("o", "a"):
                    yield from _iter_argument_values(action[2])
                else:
                    yield from _iter_term_values(action[0], action[2])


def _iter_tree_values(tree: Term) -> Iterator[tuple[str, Term]]:
    while tree[0] == "i":
        yield from _iter_term_values("b", tree[1])
        yield from _iter_tree_values(tree[2])
        tree = tree[3]


def _iter_argument_values(arguments: Iterable[Term]) -> Iterator[tuple[str, Term]]:
    for argument in arguments:
        yield from _iter_term_values(argument[0], argument[-1])


def _iter_term_values(kind: str, term: Term) -> Iterator[tuple[str, Term]]:
    yield kind, term
    letter = term[0]
    if letter == "i":
        yield from _iter_argument_values(term[2])
    elif letter == "q":
        yield from _iter_term_values("b", term[1])
        yield from _iter_term_values(kind, term[2])
        yield from _iter_term_values(kind, term[3])
    elif letter not in ("v", "c", "o", "p") or (letter == "c" and kind == "b"):
        inner = kind if letter in ("&", "|", "!") or kind == "d" else "e" if letter == "c" else "d"
        for operand in term[1:]:
            yield from _iter_term_values(inner, operand)


def iter_actions(program: Program) -> Iterator[tuple[CompiledOption, CompiledState, Term]]:
    """Yield all actions of a program with their option and state."""
    for option in program.options:
        for state in option.states:
            for action in state.actions:
                yield option, state, action


def find_nested_inputs(program: Program) -> set[str]:
    """Find input symbols with a call nested in the arguments of another call of the same symbol."""
    nested: set[str] = set()
    for _kind, term in iter_values(program):
        if term[0] == "i" and any(
            inner[0] == "i" and inner[1] == term[1]
            for argument in term[2]
            for _, inner in _iter_term_values(argument[0], argument[-1])
        ):
            nested.add(term[1])
    return nested


def used_symbols(program: Program) -> SymbolList:
    """Derive the symbols and basic behaviors from their uses in a program. Enumerations are unknown."""
    internal = {slot.name for slot in program.symbols}
    symbols_by_key: dict[tuple[str, str], RobotSymbol] = {}
    slots: dict[tuple[str, str], dict[str, TypedSlot]] = {}
    behaviors: dict[str, dict[str, TypedSlot]] = {}
    for kind, term in iter_values(program):
        if term[0] == "i":
            symbols_by_key.setdefault(("input", term[1]), RobotSymbol("input", kind, term[1]))
            slots.setdefault(("input", term[1]), {}).update(_slots(term[2]))
        elif term[0] == "o" and term[1] not in internal:
            symbols_by_key.setdefault(("output", term[1]), RobotSymbol("output", kind, term[1]))
    for _option, _state, action in iter_actions(program):
        if action[0] == "a":
            behaviors.setdefault(action[1], {}).update(_slots(action[2]))
        elif action[0] != "o" and action[1] not in internal:
            symbols_by_key.setdefault(("output", action[1]), RobotSymbol("output", action[0], action[1]))
    symbols = tuple(
        RobotSymbol(symbol.role, symbol.kind, symbol.name, "", tuple(slots.get(key, {}).values()))
        for key, symbol in symbols_by_key.items()
    )
    return SymbolList(
        symbols=symbols,
        behaviors=tuple(BasicBehavior(name, tuple(parameters.values())) for name, parameters in behaviors.items()),
    )


def _slots(arguments: Iterable[Term]) -> dict[str, TypedSlot]:
    return {
        argument[-2]: TypedSlot(argument[0], argument[-2], argument[1] if argument[0] == "e" else "")
        for argument in arguments
    }


def select_used_symbols(symbols: SymbolList, program: Program) -> SymbolList:
    """Select the symbols that a program uses; the world may lack the others."""
    names = {(symbol.role, symbol.name) for symbol in used_symbols(program).symbols}
    behaviors = {action[1] for _option, _state, action in iter_actions(program) if action[0] == "a"}
    return SymbolList(
        symbols.enums,
        symbols.internal_enums,
        tuple(symbol for symbol in symbols.symbols if (symbol.role, symbol.name) in names),
        tuple(behavior for behavior in symbols.behaviors if behavior.name in behaviors),
    )


def check_symbols(program: Program, symbols: SymbolList) -> list[str]:
    """Find symbols and behaviors that a program uses and a robot does not have."""
    registered = {(symbol.role, symbol.name): symbol for symbol in symbols.symbols}
    behaviors = {behavior.name: behavior for behavior in symbols.behaviors}
    elements = {
        element for _name, names in (*symbols.enums, *symbols.internal_enums, *program.enums) for element in names
    }
    problems: list[str] = []
    used = used_symbols(program)
    for symbol in used.symbols:
        definition = registered.get((symbol.role, symbol.name))
        if definition is None or definition.kind != symbol.kind:
            problems.append(f"{_KIND_NAMES[symbol.kind]} {symbol.role} symbol {symbol.name} is not registered")
            continue
        problems += _check_slots(f"input symbol {symbol.name}", symbol.parameters, definition.parameters)
    for behavior in used.behaviors:
        if behavior.name not in behaviors:
            problems.append(f"basic behavior {behavior.name} is not registered")
            continue
        parameters = behaviors[behavior.name].parameters
        problems += _check_slots(f"basic behavior {behavior.name}", behavior.parameters, parameters)
    for kind, term in iter_values(program):
        if kind == "e" and term[0] == "v" and term[1] not in elements:
            problems.append(f"enum element {term[1]} is not registered")
    return problems


def _check_slots(owner: str, used: Iterable[TypedSlot], declared: Iterable[TypedSlot]) -> list[str]:
    known = {(slot.kind, slot.name) for slot in declared}
    return [f"{owner} has no parameter {slot.name}" for slot in used if (slot.kind, slot.name) not in known]


def check_structure(program: Program) -> list[str]:
    """Find references to missing options, states and parameters, and duplicate options."""
    names = [option.name for option in program.options]
    problems = [f"two options {name}" for name in dict.fromkeys(names) if names.count(name) > 1]
    problems += [f"agent {agent}: there is no option {root}" for agent, root in program.agents if root not in names]
    slots = {option.name: {(slot.kind, slot.name) for slot in option.parameters} for option in program.options}
    for option in program.options:
        states = {state.name for state in option.states}
        if option.initial not in states:
            problems.append(f"option {option.name} has no initial state {option.initial}")
        for state in option.states:
            problems += [
                f"option {option.name} has no state {target}"
                for target in _targets(state.decision)
                if target not in states
            ]
    for option, state, action in iter_actions(program):
        if action[0] == "o" and action[1] not in slots:
            problems.append(f"state {state.name} of option {option.name}: there is no option {action[1]}")
        elif action[0] == "o":
            parameters = slots[action[1]]
            problems += [
                f"option {action[1]} has no parameter {argument[-2]}"
                for argument in action[2]
                if (argument[0], argument[-2]) not in parameters
            ]
    all_parameters = set().union(*slots.values()) if slots else set()
    problems += [
        f"there is no parameter {term[1]}"
        for kind, term in iter_values(program)
        if term[0] == "p" and (kind, term[1]) not in all_parameters
    ]
    return problems


def _targets(tree: Term) -> Iterator[str]:
    while tree[0] == "i":
        yield from _targets(tree[2])
        tree = tree[3]
    yield tree[1]


def check_loops(program: Program, *, strict: bool) -> list[str]:
    """Find cycles of options; with `strict`, also options and behaviors that may be active twice in a cycle."""
    options = {option.name: option for option in program.options}
    problems: list[str] = []
    descendants: dict[str, frozenset[str]] = {}

    def visit(option: CompiledOption, path: tuple[str, ...]) -> frozenset[str]:
        """Collect everything that an option may activate, and report calls of an option in the path."""
        if option.name in descendants:
            return descendants[option.name]
        path, callees = (*path, option.name), set[str]()
        for state in option.states:
            earlier: set[str] = set()
            for action in state.actions:
                activated = {action[1]} if action[0] in ("o", "a") else set()
                if action[0] == "o" and action[1] in path:
                    problems.append(_loop_message(state, option, action[1]))
                elif action[0] == "o":
                    activated |= visit(options[action[1]], path)
                problems.extend(
                    _double_activation_message(state, option, repeated)
                    for repeated in sorted(activated & earlier)
                    if strict
                )
                earlier |= activated
            callees |= earlier
        descendants[option.name] = frozenset(callees)
        return descendants[option.name]

    for _agent, root in program.agents:
        if root in options:
            visit(options[root], ())
    return problems


def _loop_message(state: CompiledState, option: CompiledOption, name: str) -> str:
    return (
        f'checkForLoops(): state "{state.name}" in option "{option.name}" references subsequent option "{name}". '
        f'But option "{name}" leads to this state'
    )


def _double_activation_message(state: CompiledState, option: CompiledOption, name: str) -> str:
    return (
        f'checkForLoops(): state "{state.name}" in option "{option.name}" references subsequent behavior "{name}", '
        "which is already included in another possible activation tree"
    )
