"""Reads options of CABSL, the C-based agent behavior specification language.

An option is a design with the same rules: the first `goto` of the common transition, else of the active state, is
taken, then the action block runs. The design calls the options that an action block may call, and keeps its C++ text.
"""

import ast
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from vicode.cpp_tokens import WORD
from vicode.importers.cpp.conditions import ASSIGNING, CppConditions, join, negate, to_guard
from vicode.importers.cpp.machine import CppMachine
from vicode.importers.cpp.tree import CppTree, class_name, compact, split, words
from vicode.model.design import (
    Call,
    Code,
    CommonSection,
    Decision,
    DecisionGroup,
    Design,
    RunCode,
    State,
    Stay,
    Transition,
)

_STATES = frozenset({"initial_state", "state", "target_state", "aborted_state"})
_PARTS = frozenset({"common_transition", "transition", "action"})
_MAX_SHOWN = 60


def iter_options(nodes: Sequence[CppTree], owner: CppTree | None = None) -> Iterator[tuple[CppTree, CppTree, CppTree]]:
    """Yield the name, the head and the body of each option that has one; without a name, it has that of its class."""
    for index, node in enumerate(nodes):
        head, body = (*nodes[index + 1 : index + 3], node, node)[:2]
        if head.text == "{":
            head, body = replace(head, children=()), head
        name = next((each for each in head.children if each.kind == WORD), owner)
        if node.text == "option" and head.text in "({" and name and words(body.children) & _STATES:
            yield name, head, body
        elif node.text == "{":
            yield from iter_options(node.children, class_name(nodes, index) or owner)


def read_option(machine: CppMachine, head: CppTree, body: CppTree) -> tuple[CppMachine]:
    """Read an option into the design of a machine, which is returned."""
    machine.note_unread(body.start, body.end)
    # Declared variables stand last, after their types and initial values.
    variables = [part[1] for part in split(head.children, ",") if len(part) == 2 and part[0].text == "vars"]
    declared = {each[-1].text for group in variables for each in split(group.children, ",") if each}
    machine.conditions.changing = declared | set(_find_assigned(body.children))
    reader, initial, common, states = _OptionReader(machine, body.children), "", list[Decision](), list[State]()
    for part in _iter_statements(body.children):
        kind = part[0].text
        if kind == "common_transition":
            common += reader.read(part[1:])
        elif _is_state(part) and compact(part[1].children) not in {each.name for each in states}:
            shared = dict(machine.conditions.versions)
            states.append(machine.place(reader.state(*part), part[0]))
            initial = initial or (states[-1].name if kind == "initial_state" else "")
            machine.conditions.versions, machine.conditions.done = shared, ""
        else:
            reader.skip(part)
    machine.design = Design(
        component=machine.component,
        time_unit="ms",
        uses=machine.uses(),
        initial=initial,
        common=CommonSection(transitions=tuple(common)),
        states=tuple(states),
    )
    return (machine,)


def _find_assigned(nodes: Sequence[CppTree]) -> Iterator[str]:
    """The words that are assigned to or counted, and not declared there."""
    for index, node in enumerate(nodes):
        yield from _find_assigned(node.children)
        if node.text in ASSIGNING:
            is_declared = (
                node.text == "=" and index > 1 and (nodes[index - 2].kind == WORD or nodes[index - 2].text in "*&>")
            )
            around = nodes[max(0, index - 1) : index + (2 if node.text in ("++", "--") else 0)]
            yield from () if is_declared else (each.text for each in around if each.kind == WORD)


class _OptionReader:
    def __init__(self, machine: CppMachine, body: Sequence[CppTree]) -> None:
        self._machine = machine
        self._conditions: CppConditions = machine.conditions
        self._states = {compact(name.children) for kind, name in pairwise(body) if kind.text in _STATES}

    def skip(self, nodes: Sequence[CppTree]) -> None:
        """Skip a statement outside of transitions."""
        if {node.text for node in nodes[:1]} & _STATES or self._states & set(_find_gotos(nodes)):
            self._machine.is_partial = True
            self._note(nodes, "a state or goto that is not understood")

    def _note(self, nodes: Sequence[CppTree], text: str) -> None:
        self._machine.notes.append((nodes[0].start, f"{text}: {_shown(nodes)}"))

    def state(self, kind: CppTree, name: CppTree, body: CppTree) -> State:
        called, texts, transitions = list[str](), list[str](), list[Decision]()
        parts = list(_iter_statements(body.children))
        for inner in (part[1:] for part in parts if part[0].text == "action"):
            block = inner[0].children if inner and inner[0].text == "{" else inner
            self.skip(block)
            called += self._calls(block)
            texts.append(self._machine.source.slice(block))
        # With several options, the last one that was called counts, which depends on conditions.
        self._conditions.done = f"done({called[0]})" if len(set(called)) == 1 else ""
        for part in parts:
            if part[0].text == "transition":
                transitions += self.read(part[1:])
            elif part[0].text != "action":
                self.skip(part)
                self._conditions.change(part)
        if kind.text == "aborted_state":
            self._machine.ends.add(compact(name.children))
        return State(
            name=compact(name.children),
            doc="Aborted state." if kind.text == "aborted_state" else "",
            final=kind.text == "target_state",
            actions=(
                *(Call(alias=alias) for alias in dict.fromkeys(called)),
                *(RunCode(code=Code(texts=(("cpp", text),))) for text in texts if text),
            ),
            transitions=tuple(transitions),
        )

    def _calls(self, nodes: Sequence[CppTree], *, is_list: bool = False) -> Iterator[str]:
        """The aliases of the options that statements call, or that `select_option` lists."""
        for before, node, after in zip((None, *nodes), nodes, (*nodes[1:], None), strict=False):
            is_member = before is not None and before.text in (".", "->", "::")
            is_call = after is not None and after.text == "(" and not is_member
            name = node.text.strip('"')
            if (is_list or is_call) and name in self._machine.components:
                alias = self._machine.use(name, node)
                yield from [alias] if alias else []
            is_selection = before is not None and before.text == "select_option"
            found = list(self._calls(node.children, is_list=is_list or is_selection))
            if is_selection and not found:
                self._note((node,), "the options are not named")
            yield from found

    def read(self, nodes: Sequence[CppTree]) -> list[Decision]:
        """Read the decision tree of a block."""
        return self._block(nodes)[0]

    def _block(self, nodes: Sequence[CppTree]) -> tuple[list[Decision], bool]:
        """The decisions of statements, and whether they reach a `break`."""
        found, broke, index = list[Decision](), False, 0
        while index < len(nodes) and not broke:
            node, end = nodes[index], _statement_end(nodes, index)
            statement, index, inner = nodes[index:end], end, list[Decision]()
            if node.text == "break":
                return found, True
            if node.text == "{":
                inner, broke = self._block(node.children)
            elif node.text == "if" and len(statement) > 2:
                inner, broke = self._if(statement, nodes[end:])
            elif node.text == "switch" and len(statement) > 2:
                inner = self._switch(node, statement[1], statement[2].children)
            elif node.text == "goto" and len(statement) > 1:
                inner = [self._machine.place(Transition(to=statement[1].text), node)]
            elif node.text == "return":
                self._note(statement, "the design runs the action of the state")
                inner = [self._machine.place(Stay(), node)]
            else:
                inner = self._other(statement)
            found += inner
        return found, broke

    def _if(self, nodes: Sequence[CppTree], rest: Sequence[CppTree]) -> tuple[list[Decision], bool]:
        start = 1 + (nodes[1].text == "constexpr")
        *first, tested = split(nodes[start].children, ";")
        self._conditions.change(first[0] if first else ())
        condition, end = self._conditions.read(tested), _statement_end(nodes, start + 1)
        branches = [self._block(nodes[start + 1 : end]), self._block(nodes[end + 1 :])]
        broke = any(each for _decisions, each in branches)
        # After a `break`, what follows is only reached by the other branch.
        after = _until_end(self._block(rest)[0]) if broke else []
        then, other = ([*decisions, *([] if is_broken else after)] for decisions, is_broken in branches)
        return self._choose(nodes[0], condition, then, other), broke

    def _choose(self, node: CppTree, test: ast.expr, then: list[Decision], other: list[Decision]) -> list[Decision]:
        if not then:
            test, then, other = negate(test), other, []
        guard = to_guard(test)
        match then:
            case []:
                return []
            case [(Transition() | Stay()) as only] if only.guard.is_empty:
                return [self._machine.place(replace(only, guard=guard), node), *other]
        is_ended = _is_end(then[-1])
        group = DecisionGroup(guard=guard, then=tuple(then), otherwise=() if is_ended else tuple(other))
        return [self._machine.place(group, node), *(other if is_ended else [])]

    def _switch(self, node: CppTree, value: CppTree, body: Sequence[CppTree]) -> list[Decision]:
        """The cases as groups; a case runs into the next ones until `break`."""
        cases, statements, index = dict[int, list[ast.expr | None]](), list[CppTree](), 0
        while index < len(body):
            if body[index].text in ("case", "default"):
                end = next((n for n in range(index, len(body)) if body[n].text == ":"), len(body))
                label = body[index + 1 : end]
                test = self._conditions.compare(value.children, "==", label) if label else None
                cases.setdefault(len(statements), []).append(test)
                index = end
            else:
                statements.append(body[index])
            index += 1
        named = [test for tests in cases.values() for test in tests if test]
        found = list[Decision]()
        for start, tests in cases.items():
            other = negate(join(ast.Or(), named)) if named else ast.Constant(True)
            then, _broke = self._block(statements[start:])
            test = join(ast.Or(), [test or other for test in tests])
            found += self._choose(node, test, _until_end(then), [])
        return found

    def _other(self, nodes: Sequence[CppTree]) -> list[Decision]:
        """A statement that is not understood; it may take each `goto` in it."""
        self._conditions.change(nodes)
        targets = list(dict.fromkeys(_find_gotos(nodes)))
        if targets or not (nodes[0].text.isupper() or nodes[0].text in (";", "static_assert")):
            self._note(nodes, "not in the design")
        tests = [self._conditions.flag(f"{target}: {_shown(nodes)}", str(nodes[0].start)) for target in targets]
        found = [Transition(to=target, guard=to_guard(test)) for target, test in zip(targets, tests, strict=True)]
        return [self._machine.place(each, nodes[0]) for each in found]


def _is_end(decision: Decision) -> bool:
    return not isinstance(decision, DecisionGroup) and decision.guard.is_empty


def _until_end(decisions: list[Decision]) -> list[Decision]:
    """Decisions of a case up to an unconditional `goto`: what follows belongs to the next cases."""
    length = next((number for number, each in enumerate(decisions, start=1) if _is_end(each)), len(decisions))
    return decisions[:length]


def _find_gotos(nodes: Sequence[CppTree]) -> Iterator[str]:
    yield from (after.text for before, after in pairwise(nodes) if before.text == "goto")
    for node in nodes:
        yield from _find_gotos(node.children)


def _shown(nodes: Sequence[CppTree]) -> str:
    text = compact(nodes)
    return text if len(text) <= _MAX_SHOWN else f"{text[:_MAX_SHOWN]} …"


def _is_state(nodes: Sequence[CppTree]) -> bool:
    texts, name = [node.text for node in nodes], nodes[1].children if len(nodes) > 1 else ()
    return texts[0] in _STATES and texts[1:] == ["(", "{"] and len(name) == 1 and name[0].kind == WORD


def _iter_statements(nodes: Sequence[CppTree]) -> Iterator[Sequence[CppTree]]:
    """The statements of a block; words of CABSL belong to the statement after them."""
    index = 0
    while index < len(nodes):
        end = (
            index + 3
            if _is_state(nodes[index : index + 3])
            else _statement_end(nodes, index + (nodes[index].text in _PARTS))
        )
        yield nodes[index:end]
        index = end


def _statement_end(nodes: Sequence[CppTree], start: int) -> int:
    """The index after the statement that starts at an index."""
    first, second, third = [node.text for node in nodes[start : start + 3]] + [""] * (3 - len(nodes[start : start + 3]))
    if first == "{":
        return start + 1
    # A macro without semicolon may be the condition of the statement after it.
    is_macro = first.isupper() and second == "(" and (third == "{" or (third != "" and nodes[start + 2].kind == WORD))
    if first in ("if", "for", "while", "switch", "catch") or is_macro:
        end = _statement_end(nodes, start + 2 + (second == "constexpr"))
        has_else = first == "if" and end < len(nodes) and nodes[end].text == "else"
        return _statement_end(nodes, end + 1) if has_else else end
    if first in ("do", "try", "else"):
        end = _statement_end(nodes, start + 1)
        return end if first == "else" else _statement_end(nodes, end)
    return next((index + 1 for index in range(start, len(nodes)) if nodes[index].text == ";"), len(nodes))
