"""A simple interpreter of programs, written from the specification of the original engine. It is the test oracle."""

import math
from typing import Any

from vicode.xabsl.engine.program import CompiledOption, CompiledState, Program, Term
from vicode.xabsl.engine.symbols import SymbolList


class Oracle:
    """Runs a program whose inputs have no parameters. `inputs` are values by symbol, enums as qualified names."""

    def __init__(self, program: Program, symbols: SymbolList) -> None:
        self.options = {option.name: option for option in program.options}
        self.root = program.agents[0][1]
        self.elements = dict((*symbols.enums, *symbols.internal_enums))
        self.values: dict[str, Any] = {}
        for symbol in symbols.symbols:
            if symbol.role != "input":
                self.values[symbol.name] = self._zero(symbol.kind, symbol.enum)
        self.behaviors = {behavior.name: behavior.parameters for behavior in symbols.behaviors}
        self.state = {name: option.initial for name, option in self.options.items()}
        self.since = dict.fromkeys(self.options, 0)
        self.activated: dict[str, int] = {}
        self.was: set[str] = set()
        self.now = 0
        self.is_active: set[str] = set()
        self.parameters: dict[str, Any] = {}
        self.inputs: dict[str, Any] = {}
        self.twice: list[str] = []

    def cycle(self, now: int, inputs: dict[str, Any]) -> list[Any]:
        """Run one cycle and return its trace nodes."""
        self.now, self.inputs, self.is_active, self.twice = now, inputs, set(), []
        nodes: list[Any] = []
        self._call(("o", self.root, ()), None, nodes)
        self.was = self.is_active
        return nodes

    def _zero(self, kind: str, enum: str) -> Any:
        return {"d": 0.0, "b": False}.get(kind, self.elements.get(enum, ("",))[0])

    def _call(self, action: Term, caller: tuple[CompiledOption, CompiledState] | None, nodes: list[Any]) -> None:
        _letter, name, arguments = action
        slots = self.options[name].parameters if action[0] == "o" else self.behaviors[name]
        values = {argument[-2]: argument for argument in arguments}
        for slot in sorted(slots, key=lambda slot: "dbe".index(slot.kind)):
            argument = values.get(slot.name)
            self.parameters[slot.name] = (
                self._value(argument[-1], slot.kind, caller)
                if argument and caller
                else self._zero(slot.kind, slot.enum)
            )
        key = f"{action[0]} {name}"
        if key not in self.was:
            self.activated[key] = self.now
        node = [action[0].replace("a", "b"), name]
        nodes.append(node)
        if action[0] == "o":
            self._execute(self.options[name], node)
        else:
            node += [self.now - self.activated[key], {slot.name: self.parameters[slot.name] for slot in slots}]
        self.is_active.add(key)

    def _execute(self, option: CompiledOption, node: list[Any]) -> None:
        name, key = option.name, f"o {option.name}"
        if key in self.is_active:
            self.twice.append(name)
        if key not in self.was:
            self.state[name], self.since[name] = option.initial, self.now
        before = self.state[name]
        state = next(candidate for candidate in option.states if candidate.name == before)
        target = self._decide(state.decision, (option, state))
        if target != state.name:
            self.state[name], self.since[name] = target, self.now
            state = next(candidate for candidate in option.states if candidate.name == target)
        inner: list[Any] = []
        for action in state.actions:
            if action[0] in "oa":
                self._call(action, (option, state), inner)
            else:
                self.values[action[1]] = self._value(action[2], action[0], (option, state))
                inner.append(["s", action[1], self.values[action[1]]])
        parameters = {slot.name: self.parameters[slot.name] for slot in option.parameters}
        times = [self.now - self.activated[key], self.now - self.since[name]]
        node += [self.state[name], *times, parameters, inner, before]

    def _decide(self, tree: Term, caller: tuple[CompiledOption, CompiledState]) -> str:
        while tree[0] == "i":
            tree = tree[2] if self._value(tree[1], "b", caller) else tree[3]
        return str(tree[1])

    def _is_done(self, state: CompiledState) -> bool:
        called = [self.options[action[1]] for action in state.actions if action[0] == "o"]
        return any(
            f"o {option.name}" in self.was
            and next(candidate for candidate in option.states if candidate.name == self.state[option.name]).is_target
            for option in called
        )

    def _value(self, term: Term, kind: str, caller: tuple[CompiledOption, CompiledState]) -> Any:
        letter = term[0]
        values = {"i": self.inputs, "o": self.values, "p": self.parameters}.get(letter)
        if values is not None:
            return values[term[1]]
        if letter == "v":
            return term[1]
        if letter == "q":
            return self._value(term[2] if self._value(term[1], "b", caller) else term[3], kind, caller)
        return self._decimal(term, caller) if kind == "d" else self._boolean(term, caller)

    def _boolean(self, term: Term, caller: tuple[CompiledOption, CompiledState]) -> bool:
        letter = term[0]
        if letter == "t":
            return self._is_done(caller[1])
        if letter in "!&|":
            parts = (self._value(operand, "b", caller) for operand in term[1:])
            return not next(parts) if letter == "!" else all(parts) if letter == "&" else any(parts)
        kind = "e" if letter == "c" else "d"
        left, right = (self._value(operand, kind, caller) for operand in term[1:])
        if letter in "c=n":
            return bool((left == right) != (letter == "n"))
        return bool({"<": left < right, "l": left <= right, ">": left > right, "g": left >= right}[letter])

    def _decimal(self, term: Term, caller: tuple[CompiledOption, CompiledState]) -> float:
        letter = term[0]
        if letter == "c":
            return float(term[1])
        if letter == "s":
            return self.now - self.since[caller[0].name]
        if letter == "t":
            return self.now - self.activated[f"o {caller[0].name}"]
        left, right = (self._value(operand, "d", caller) for operand in term[1:])
        if letter == "d":
            return left / (right or 0.0000001)
        if letter == "%":
            if not (math.isfinite(left) and math.isfinite(right) and int(right)):
                return 0.0
            return math.copysign(abs(int(left)) % abs(int(right)), left)
        return {"+": left + right, "-": left - right, "*": left * right}[letter]
