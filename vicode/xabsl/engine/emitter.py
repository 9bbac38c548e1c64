"""Emits a program as Python source, one function per state: it decides, then executes the actions of the new state.

The record `o` of an option holds the function of its current state (`run`), times of activation and its last cycle.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from .program import CompiledOption, CompiledState, Program, Term, TypedSlot
from .term_emitter import TIME_MASK, InputAccess, TermEmitter

_MAX_DEPTH = 30
"""Deeper decisions are moved to separate functions, because Python limits the depth of indentation."""

_MAX_BRANCHES = 200
"""Longer chains of branches are continued in separate functions: Python compiles each one inside the previous one."""


@dataclass(frozen=True, slots=True)
class BehaviorBinding:
    """Names of a basic behavior in the source: its callable, its record and the keywords of its parameters."""

    text: str
    record: str
    slots: tuple[TypedSlot, ...]
    keywords: Mapping[str, str]


@dataclass(slots=True, kw_only=True)
class LinkedNames:
    """Names in the Python source of the symbols and basic behaviors of the robot."""

    inputs: Mapping[str, InputAccess]
    outputs: Mapping[str, str]
    behaviors: Mapping[str, BehaviorBinding]
    elements: Mapping[str, str]
    """The first element of each enumeration."""


@dataclass(slots=True)
class PythonEmitter:
    """Emits the functions of all options. With `traced`, they also record a trace; `strict`: see `Engine`."""

    program: Program
    names: LinkedNames
    traced: bool = False
    strict: bool = False
    coop: dict[tuple[str, str], int] = field(default_factory=dict)
    _numbers: dict[str, int] = field(default_factory=dict)
    _options: dict[str, CompiledOption] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for number, option in enumerate(self.program.options):
            self._numbers[option.name] = number
            self._options[option.name] = option
            for state in option.states:
                if state.mode != "n":
                    self.coop[option.name, state.name] = len(self.coop)

    def source(self) -> str:
        """Emit the source of all functions: `run3` executes option 3, `s3_1` its state 1."""
        lines: list[str] = []
        for option in self.program.options:
            lines += self._run(option)
            for number in range(len(option.states)):
                lines += _StateEmitter(self, option, number).lines()
        return "\n".join([*lines, ""])

    def number(self, option: str) -> int:
        """The number of an option, part of the names of its record and functions."""
        return self._numbers[option]

    def slots(self, option: str) -> tuple[TypedSlot, ...]:
        return self._options[option].parameters

    def parameters(self, option: CompiledOption) -> dict[str, str]:
        """Names of the variables that hold the parameters of an option."""
        return {slot.name: f"o{self.number(option.name)}.p{index}" for index, slot in enumerate(option.parameters)}

    def _run(self, option: CompiledOption) -> Iterator[str]:
        """Emit the function that executes an option after its parameters are stored."""
        number = self.number(option.name)
        initial = next(index for index, state in enumerate(option.states) if state.name == option.initial)
        target = option.states[initial].is_target
        o = f"o{number}"
        yield f"def run{number}(now, cycle):"
        yield f"    last = {o}.last_cycle"
        yield "    if last == cycle:"
        yield f"        twice({number})"
        if self.strict:
            yield "        return"
        yield "    else:"
        yield f"        {o}.was_active = last == cycle - 1"
        yield f"    if not {o}.was_active:"
        yield f"        {o}.option_since = {o}.state_since = now"
        yield f"        {o}.run = s{number}_{initial}"
        yield f"        {o}.is_target = {target}"
        if self.traced:
            yield f"    log = begin({number})"
        yield f"    {o}.run(now, cycle)"
        yield f"    {o}.last_cycle = cycle"
        if self.traced:
            yield f"    end({number}, log, now)"


class _StateEmitter:
    """Emits the functions of one state: `s` decides and acts, `g` enters the state and acts."""

    def __init__(self, emitter: PythonEmitter, option: CompiledOption, number: int) -> None:
        self.emitter, self.option = emitter, option
        self.state: CompiledState = option.states[number]
        self.option_number = emitter.number(option.name)
        self.name = f"{self.option_number}_{number}"
        self.states = {state.name: index for index, state in enumerate(option.states)}
        self.helpers: list[str] = []
        o = f"o{self.option_number}"
        names = emitter.names
        common = (names.inputs, names.outputs, emitter.parameters(option), names.elements.__getitem__)
        option_time = f"((now - {o}.option_since) & {TIME_MASK})"
        self.deciding = TermEmitter(
            *common,
            f"((now - {o}.state_since) & {TIME_MASK})",
            option_time,
            self._action_done(),
            self._conflict(),
            self._to_function,
        )
        # On entry state_time is 0; action_done still refers to the last execution of the callees.
        self.entering = TermEmitter(*common, "0", option_time, self._action_done(), self._conflict(), self._to_function)

    def lines(self) -> list[str]:
        """Emit both functions, preceded by helper functions for deep decisions."""
        decision = list(self._tree(self.state.decision, 1, "return {}(now, cycle)"))
        actions = [f"    {line}" for line in self._actions(self.deciding)]
        entry_actions = [f"    {line}" for line in self._actions(self.entering)]
        o = f"o{self.option_number}"
        return [
            *self.helpers,
            f"def s{self.name}(now, cycle):",
            *self._update_conflict(),
            *(decision if decision or actions else ["    pass"]),
            *actions,
            f"def g{self.name}(now, cycle):",
            f"    {o}.run = s{self.name}",
            f"    {o}.state_since = now",
            f"    {o}.is_target = {self.state.is_target}",
            *entry_actions,
        ]

    def _action_done(self) -> str:
        called = dict.fromkeys(action[1] for action in self.state.actions if action[0] == "o")
        records = [f"o{self.emitter.number(name)}" for name in called]
        parts = [
            f"{o}.is_target and ({o}.was_active if {o}.last_cycle == cycle else {o}.last_cycle == cycle - 1)"
            for o in records
        ]
        return f"({' or '.join(parts)})" if parts else "False"

    def _conflict(self) -> str:
        coop = self.emitter.coop.get((self.option.name, self.state.name))
        return f"c{coop}.conflict" if self.state.mode == "c" else "False"

    def _update_conflict(self) -> list[str]:
        """Emit the update of the conflict flag, which a capacity state needs before its decision."""
        coop = self.emitter.coop.get((self.option.name, self.state.name))
        return [f"    c{coop}.conflict = c{coop}.is_full()"] if self.state.mode == "c" else []

    def _tree(self, tree: Term, depth: int, goto: str) -> Iterator[str]:
        """Emit a decision; a branch that stays in the state does not return."""
        pad = "    " * depth
        if tree[0] == "t":
            yield from (f"{pad}{line}" for line in self._goto(tree[1], goto))
            return
        if depth > _MAX_DEPTH:
            yield from (f"{pad}{line}" for line in self._helper(tree, goto))
            return
        keyword, branches = "if", 0
        while tree[0] == "i":
            branches += 1
            if branches > _MAX_BRANCHES:
                yield f"{pad}else:"
                yield from (f"{pad}    {line}" for line in self._helper(tree, goto))
                return
            condition, then, last = tree[1], tree[2], tree[3]
            yield f"{pad}{keyword} {_strip_parentheses(self.deciding.emit(condition, 'b'))}:"
            yield from self._branch(then, depth + 1, goto)
            keyword, tree = "elif", last
        otherwise = list(self._tree(tree, depth + 1, goto))
        if otherwise:
            yield f"{pad}else:"
            yield from otherwise

    def _branch(self, tree: Term, depth: int, goto: str) -> Iterator[str]:
        lines = list(self._tree(tree, depth, goto))
        yield from lines or ["    " * depth + "pass"]

    def _goto(self, target: str, goto: str) -> list[str]:
        coop = self.emitter.coop.get((self.option.name, target))
        if target == self.state.name:
            # A cooperative state also calls may_enter to stay, for its side effect: it informs the other robots.
            return [f"c{coop}.may_enter()"] if coop is not None else []
        line = goto.format(f"g{self.option_number}_{self.states[target]}")
        return [line] if coop is None else [f"if c{coop}.may_enter():", f"    {line}"]

    def _helper(self, tree: Term, goto: str) -> list[str]:
        name = f"d{self.name}_{len(self.helpers)}"
        self.helpers.append("")
        index = len(self.helpers) - 1
        body = list(self._tree(tree, 1, "return {}(now, cycle) or True"))
        self.helpers[index] = "\n".join([f"def {name}(now, cycle):", *body])
        is_inner = goto.endswith("True")
        return [f"if {name}(now, cycle):", "    return True" if is_inner else "    return"]

    def _to_function(self, text: str) -> str:
        name = f"x{self.name}_{len(self.helpers)}"
        self.helpers.append(f"def {name}(now, cycle):\n    return {text}")
        return f"{name}(now, cycle)"

    def _actions(self, terms: TermEmitter) -> Iterator[str]:
        for action in self.state.actions:
            match action[0]:
                case "o":
                    yield from self._call_option(action, terms)
                case "a":
                    yield from self._call_behavior(action, terms)
                case _:
                    yield from self._assign(action, terms)

    def _assign(self, action: Term, terms: TermEmitter) -> Iterable[str]:
        kind, symbol, value = action
        text = _strip_parentheses(terms.emit(value, kind))
        if kind == "b" and value[0] != "v":
            text = f"bool({text})"
        elif kind == "d" and value[0] in "st" and len(value) == 1:
            text = f"float({text})"
        target = self.emitter.names.outputs[symbol]
        if not self.emitter.traced:
            return (f"{target} = {text}",)
        return (f"value = {text}", f"{target} = value", f"note({symbol!r}, value)")

    def _call_option(self, action: Term, terms: TermEmitter) -> Iterator[str]:
        number = self.emitter.number(action[1])
        slots = self.emitter.slots(action[1])
        indices = {slot.name: index for index, slot in enumerate(slots)}
        for slot, text in terms.emit_arguments(slots, action[2]):
            yield f"o{number}.p{indices[slot.name]} = {_strip_parentheses(text)}"
        yield f"run{number}(now, cycle)"

    def _call_behavior(self, action: Term, terms: TermEmitter) -> Iterator[str]:
        binding = self.emitter.names.behaviors[action[1]]
        arguments = terms.emit_arguments(binding.slots, action[2])
        keywords = ", ".join(f"{binding.keywords[slot.name]}={text}" for slot, text in arguments)
        if not self.emitter.traced:
            yield f"{binding.text}({keywords})"
            return
        yield f"play({binding.record}, now, cycle, dict({keywords}))"


def _strip_parentheses(text: str) -> str:
    """Remove parentheses that enclose the entire text."""
    if not text.startswith("("):
        return text
    depth = 0
    for index, character in enumerate(text):
        depth += (character == "(") - (character == ")")
        if not depth:
            return text[1:-1] if index == len(text) - 1 and "," not in text else text
    return text
