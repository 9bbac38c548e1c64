"""Reads options of CABSL, the C-based agent behavior specification language.

An option is a design with the same rules: the first `goto` of the common transition, else of the active state, is taken,
then the action block runs. Options that an action block calls are called by the design, too; the C++ text stays.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from vicode.cpp_tokens import STRING
from vicode.importers.cpp.conditions import Condition, ConditionReader, join
from vicode.importers.cpp.machine import CppMachine
from vicode.importers.cpp.tree import CppNode, compact, split, words
from vicode.model.design import (
    Action,
    Call,
    Code,
    CommonSection,
    Decision,
    DecisionGroup,
    Design,
    Guard,
    RunCode,
    State,
    Stay,
    Transition,
)

_STATES = frozenset({"initial_state", "state", "target_state", "aborted_state"})
_LOOPS = frozenset({"for", "while", "switch", "catch"})
_MAX_SHOWN = 60


def iter_options(nodes: Sequence[CppNode]) -> Iterator[tuple[CppNode, CppNode, CppNode]]:
    """Yield the name, the head and the body of each option that has a body."""
    for index, node in enumerate(nodes):
        following = nodes[index + 1 : index + 3]
        is_option = node.text == "option" and len(following) == 2 and following[0].is_group("(")
        name = next((each for each in following[0].children if each.is_word), None) if is_option else None
        if name is not None and following[1].is_group("{") and words(following[1].children) & _STATES:
            yield name, following[0], following[1]
        elif node.is_group("{"):
            yield from iter_options(node.children)


def read_option(machine: CppMachine, head: CppNode, body: CppNode) -> None:
    """Read an option into the design of a machine."""
    machine.inputs.changing = _find_variables(head) | set(_find_assigned(body.children))
    reader = _OptionReader(machine)
    initial = reader.read(body.children)
    machine.design = Design(
        component=machine.component,
        time_unit="ms",
        initial=initial,
        common=CommonSection(transitions=tuple(reader.common)),
        states=tuple(reader.states),
    )
    machine.design = replace(machine.design, uses=machine.uses())


def _find_variables(head: CppNode) -> set[str]:
    parts = split(head.children, ",")
    variables = [part[1] for part in parts if len(part) == 2 and part[0].text == "vars"]
    return {each[-1].text for group in variables for each in split(group.children, ",") if each}


def _find_assigned(nodes: Sequence[CppNode]) -> Iterator[str]:
    """The words that are assigned to, or counted, but not declared."""
    for index, node in enumerate(nodes):
        yield from _find_assigned(node.children)
        before = nodes[index - 1] if index else node
        if node.text in ("=", "+=", "-=", "*=", "/=", "++", "--") and before.is_word:
            if (
                node.text != "="
                or index < 2
                or not (nodes[index - 2].is_word or nodes[index - 2].text in (">", "&", "*"))
            ):
                yield before.text
        if node.text in ("++", "--") and index + 1 < len(nodes) and nodes[index + 1].is_word:
            yield nodes[index + 1].text


class _OptionReader:
    def __init__(self, machine: CppMachine) -> None:
        self.machine = machine
        self.states: list[State] = []
        self.common: list[Decision] = []
        self.names: set[str] = set()

    def read(self, nodes: Sequence[CppNode]) -> str:
        """Read a body; returns the name of the initial state."""
        self.names = {compact(each.children) for node, each in pairwise(nodes) if node.text in _STATES}
        initial, index, conditions = "", 0, ConditionReader(inputs=self.machine.inputs)
        while index < len(nodes):
            node = nodes[index]
            if node.text == "common_transition" and index + 1 < len(nodes):
                end = _statement_end(nodes, index + 1)
                self.common += _DecisionReader(self.machine, conditions).read(nodes[index + 1 : end])
            elif node.text in _STATES and index + 2 < len(nodes) and nodes[index + 2].is_group("{"):
                end = index + 3
                own = replace(conditions, versions=dict(conditions.versions))
                state = self._state(node, nodes[index + 1], nodes[index + 2].children, own)
                initial = initial or (state.name if node.text == "initial_state" else "")
            else:
                end = _statement_end(nodes, index)
                _note_gotos(self.machine, nodes[index:end], self.names)
            index = end
        return initial

    def _state(self, kind: CppNode, name: CppNode, body: Sequence[CppNode], conditions: ConditionReader) -> State:
        called, actions = self._actions(body)
        # With several, the last one that was called counts, which depends on conditions.
        conditions.done = f"done({called[0]})" if len(called) == 1 else ""
        transitions: list[Decision] = []
        index = 0
        while index < len(body):
            is_part = body[index].text in ("transition", "action")
            end = _statement_end(body, index + is_part)
            if body[index].text == "transition":
                transitions += _DecisionReader(self.machine, conditions).read(body[index + 1 : end])
            elif not is_part:
                _note_gotos(self.machine, body[index:end], self.names)
                conditions.change(body[index:end])
            index = end
        state = State(
            name=compact(name.children),
            doc="Aborted state." if kind.text == "aborted_state" else "",
            final=kind.text == "target_state",
            actions=actions,
            transitions=tuple(transitions),
        )
        if kind.text == "aborted_state":
            self.machine.ends.add(state.name)
        self.states.append(self.machine.place_state(state, kind))
        return state

    def _actions(self, body: Sequence[CppNode]) -> tuple[list[str], tuple[Action, ...]]:
        """The aliases of the options that the action blocks of a state call, and its actions."""
        called, texts = list[str](), list[Action]()
        for index, node in enumerate(body):
            if node.text != "action":
                continue
            block = body[index + 1 : _statement_end(body, index + 1)]
            inner = block[0].children if block and block[0].is_group("{") else block
            called += self._calls(inner)
            text = self.machine.source.slice(inner)
            texts += [RunCode(code=Code(texts=(("cpp", text),)))] if text else []
        aliases = list(dict.fromkeys(called))
        return aliases, (*(Call(alias=alias) for alias in aliases), *texts)

    def _calls(self, nodes: Sequence[CppNode], *, is_list: bool = False) -> Iterator[str]:
        for index, node in enumerate(nodes):
            is_member = index > 0 and nodes[index - 1].text in (".", "->", "::") and not is_list
            is_call = is_list or (index + 1 < len(nodes) and nodes[index + 1].is_group("("))
            name = node.text.strip('"') if is_list and node.kind == STRING else node.text
            if is_call and not is_member and name in self.machine.components:
                alias = self.machine.use(name, node)
                yield from [alias] if alias else []
            is_selection = index > 0 and nodes[index - 1].text == "select_option"
            found = list(self._calls(node.children, is_list=is_list or is_selection))
            if is_selection and not found:
                self.machine.is_open = True
                self.machine.note(node, f"the options of select_option are not named: {_shown(node.children)}")
            yield from found


class _DecisionReader:
    """Reads the decision tree of a block."""

    def __init__(self, machine: CppMachine, conditions: ConditionReader) -> None:
        self._machine = machine
        self._conditions = conditions

    def read(self, nodes: Sequence[CppNode]) -> list[Decision]:
        return self._block(nodes)[0]

    def _block(self, nodes: Sequence[CppNode]) -> tuple[list[Decision], bool]:
        """The decisions of statements, and whether they reach a `break`."""
        found, index = list[Decision](), 0
        while index < len(nodes):
            node, end = nodes[index], _statement_end(nodes, index)
            statement, rest = nodes[index:end], nodes[end:]
            inner, broke = list[Decision](), False
            match node.text:
                case "break":
                    return found, True
                case "{":
                    inner, broke = self._block(node.children)
                case "goto" if len(statement) > 1:
                    inner = [self._machine.place(Transition(to=statement[1].text), node)]
                case "return":
                    self._machine.note(node, "return: the design stays in the state, and runs its action")
                    inner = [self._machine.place(Stay(), node)]
                case "if" if len(statement) > 2:
                    inner, broke = self._if(statement, rest)
                case "switch" if len(statement) > 2 and statement[2].is_group("{"):
                    inner = self._switch(node, statement[1], statement[2].children)
                case _:
                    inner = self._other(statement)
            found += inner
            if broke:
                return found, True
            index = end
        return found, False

    def _if(self, nodes: Sequence[CppNode], rest: Sequence[CppNode]) -> tuple[list[Decision], bool]:
        start = 1 + (nodes[1].text == "constexpr")
        parts = split(nodes[start].children, ";") if nodes[start].is_group("(") else [nodes[start : start + 1]]
        if len(parts) > 1:
            self._conditions.change(parts[0] or nodes[:1])
        condition = self._conditions.read(parts[-1])
        end = _statement_end(nodes, start + 1)
        then, then_broke = self._block(nodes[start + 1 : end])
        other, other_broke = self._block(nodes[end + 1 :])
        broke = then_broke or other_broke
        if broke:
            # What follows is only reached by the branch without `break`.
            after, _ends = self._block(rest)
            then += after if not then_broke else []
            other += after if not other_broke else []
        return self._choose(nodes[0], condition, then, other), broke

    def _choose(
        self, node: CppNode, condition: Condition, then: list[Decision], other: list[Decision]
    ) -> list[Decision]:
        if not then and other:
            condition, then, other = condition.negated(), other, []
        if not then:
            return []
        guard = Guard(when=condition.text)
        if len(then) == 1 and not isinstance(then[0], DecisionGroup) and then[0].guard.is_empty:
            return [self._machine.place(replace(then[0], guard=guard), node), *other]
        if _is_end(then[-1]):
            return [self._machine.place(DecisionGroup(guard=guard, then=tuple(then)), node), *other]
        return [self._machine.place(DecisionGroup(guard=guard, then=tuple(then), otherwise=tuple(other)), node)]

    def _switch(self, node: CppNode, value: CppNode, body: Sequence[CppNode]) -> list[Decision]:
        """The cases as groups; a case runs into the next ones until `break`."""
        cases, statements = list[tuple[tuple[CppNode, ...], int]](), list[CppNode]()
        index = 0
        while index < len(body):
            if body[index].text in ("case", "default"):
                end = next((n for n in range(index, len(body)) if body[n].text == ":"), len(body))
                cases.append((tuple(body[index + 1 : end]), len(statements)))
                index = end
            else:
                statements.append(body[index])
            index += 1
        tests = {label: self._conditions.equals(value.children, label) for label, _start in cases if label}
        found: list[Decision] = []
        for start in dict.fromkeys(start for _label, start in cases):
            labels = [label for label, place in cases if place == start]
            named = [tests[label] for label in labels if label]
            if () in labels:
                named = [join(list(tests.values()), "or").negated()] if tests else []
                named += [tests[label] for label in labels if label]
            condition = join(named, "or") if named else Condition("True")
            then, _broke = self._block(statements[start:])
            found += self._choose(node, condition, then, [])
        return found

    def _other(self, nodes: Sequence[CppNode]) -> list[Decision]:
        """A statement that is not understood; it may take each `goto` in it."""
        self._conditions.change(nodes)
        targets = list(dict.fromkeys(_find_gotos(nodes)))
        is_macro = nodes[0].text.isupper() or nodes[0].text in (";", "static_assert")
        if targets or not is_macro:
            self._machine.note(nodes[0], f"the design does not contain this statement: {_shown(nodes)}")
        return [
            self._machine.place(
                Transition(
                    to=target, guard=Guard(when=self._conditions.unknown(nodes, f"{target}: {_shown(nodes)}").text)
                ),
                nodes[0],
            )
            for target in targets
        ]


def _is_end(decision: Decision) -> bool:
    return not isinstance(decision, DecisionGroup) and decision.guard.is_empty


def _find_gotos(nodes: Sequence[CppNode]) -> Iterator[str]:
    for index, node in enumerate(nodes):
        yield from _find_gotos(node.children)
        if node.text == "goto" and index + 1 < len(nodes):
            yield nodes[index + 1].text


def _note_gotos(machine: CppMachine, nodes: Sequence[CppNode], states: set[str]) -> None:
    if states & set(_find_gotos(nodes)):
        machine.is_partial = True
        machine.note(nodes[0], f"goto outside of a transition: {_shown(nodes)}")


def _shown(nodes: Sequence[CppNode]) -> str:
    text = compact(nodes)
    return text if len(text) <= _MAX_SHOWN else f"{text[:_MAX_SHOWN]} …"


def _statement_end(nodes: Sequence[CppNode], start: int) -> int:
    """The index after the statement that starts at an index."""
    if start >= len(nodes):
        return len(nodes)
    first = nodes[start].text
    if first == "{":
        return start + 1
    if first == "if" or first in _LOOPS:
        place = start + 1 + (first == "if" and start + 1 < len(nodes) and nodes[start + 1].text == "constexpr")
        end = _statement_end(nodes, place + 1)
        has_else = first == "if" and end < len(nodes) and nodes[end].text == "else"
        return _statement_end(nodes, end + 1) if has_else else end
    if first in ("do", "try"):
        return _statement_end(nodes, _statement_end(nodes, start + 1))
    is_macro = first.isupper() and start + 1 < len(nodes) and nodes[start + 1].is_group("(")
    if is_macro and (start + 2 == len(nodes) or nodes[start + 2].is_word or nodes[start + 2].is_group("{")):
        return start + 2 + (start + 2 < len(nodes) and not nodes[start + 2].is_word)
    return next((index + 1 for index in range(start, len(nodes)) if nodes[index].text == ";"), len(nodes))
