"""Reads transition tables of boost::sml.

An iteration of a design stands for the processing of one event. Rows without event are taken in the iteration after the
state was entered, and for a machine inside of the table when it is done. Actions of rows become their descriptions.
"""

import ast
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from vicode.cpp_tokens import STRING, WORD
from vicode.importers.cpp.conditions import join, to_guard
from vicode.importers.cpp.machine import CppMachine
from vicode.importers.cpp.tree import CppTree, class_name, compact, split
from vicode.model.design import Code, Decision, Design, Guard, RunCode, State, Stay, Transition
from vicode.model.names import is_valid_state_name
from vicode.model.traversal import iter_expressions

TABLE = "make_transition_table"
_ENTRY, _EXIT, _TERMINATED = "on_entry", "on_exit", "X"
_KINDS = frozenset({"state", "event", _ENTRY, _EXIT, "unexpected_event", "exception"})
_LITERALS = {"_s": "state", "_e": "event"}
# Macros that declare names, such as `#define STATE(S) const auto S##_S = state<S>;`.
_MACRO = re.compile(
    r"#\s*define\s+(\w+)\(\s*(\w+)[^)]*\)[^#\n]*?(?:\\\s*\n[^#\n]*?)?\b\2\s*##\s*(\w+)\s*=((?:[^\n\\]|\\\s*\n)*)"
)

_Name = tuple[str, str]
"""What a text stands for: "state", "event" or another kind, and the name; the kind of guards and actions is ""."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Row:
    node: CppTree
    source: str
    event: _Name | None
    guard: tuple[CppTree, ...]
    action: tuple[CppTree, ...]
    target: str

    def has(self, kind: str) -> bool:
        return self.event is not None and self.event[0] == kind


@dataclass(frozen=True, slots=True)
class Table:
    """A table: the name of its machine, its rows, and the function around it."""

    name: CppTree
    rows: tuple[tuple[CppTree, ...], ...]
    function: Sequence[CppTree]


def find_macros(text: str) -> dict[str, _Name]:
    """The kind and the suffix of the names that macros declare."""
    found = {}
    for macro, _parameter, suffix, value in _MACRO.findall(text):
        kind = re.search(r"\b(state|event)\s*<", value)
        found[macro] = (kind[1] if kind else "", suffix)
    return found


def iter_tables(nodes: Sequence[CppTree], name: CppTree | None = None) -> Iterator[Table]:
    """Yield the tables in a text, each with the innermost class around it."""
    for index, node in enumerate(nodes):
        following = nodes[index + 1] if index + 1 < len(nodes) else node
        if node.text == TABLE and following.text == "(" and following.children and name is not None:
            yield Table(name, tuple(row for row in split(following.children, ",") if row), nodes)
        yield from iter_tables(node.children, class_name(nodes, index) or name)


def read_table(machine: CppMachine, table: Table, macros: Mapping[str, _Name]) -> Iterator[CppMachine]:
    """Read a table; yields a machine for each of its regions."""
    machine.note_unread(table.function[0].start, table.function[-1].end)
    reader = _TableReader(machine, dict(_find_declared(table.function, macros)))
    rows = [row for nodes in table.rows if (row := reader.read(nodes)) is not None]
    if not any(row.target == _TERMINATED != row.source for row in rows):
        # Rows for the case that the machine ends, which it does not.
        rows = [row for row in rows if row.source != _TERMINATED]
    for number, start in enumerate(reader.initial or [""], start=1):
        found, size = {start} if len(reader.initial) > 1 else {row.source for row in rows}, 0
        while size < len(found):
            size = len(found)
            found |= {row.target for row in rows if row.source in found} - {""}
        component = machine.component + (f"_{number}" if number > 1 else "")
        states = dict.fromkeys(name for row in rows for name in (row.source, row.target) if name in found)
        design = Design(
            component=component,
            initial=start,
            states=tuple(reader.state(name, [row for row in rows if row.source == name], rows) for name in states),
        )
        read = {alias for each in iter_expressions(design) for alias in re.findall(r"\w+(?=\.)", each.text)}
        used = read.union(*(state.requires for state in design.states))
        uses = tuple(use for use in machine.uses() if use.alias in used)
        yield replace(machine, component=component, design=replace(design, uses=uses))


class _TableReader:
    def __init__(self, machine: CppMachine, names: Mapping[str, _Name]) -> None:
        self._machine = machine
        self._names = names
        self.initial: list[str] = []
        machine.conditions.spellings = {name: shown for name, (kind, shown) in names.items() if not kind}

    def _note(self, nodes: Sequence[CppTree], text: str) -> None:
        self._machine.notes.append((nodes[0].start, f"{text}: {compact(nodes)}"))

    def read(self, nodes: tuple[CppTree, ...]) -> _Row | None:
        """Read a row: `source + event [guard] / action = target`, or `target <= source + …`."""
        *first, left = split(nodes, "<=")
        before, *last = split(left, "=")
        before, *actions = split(before, "/")
        guards = [node for node in before if node.text == "["]
        source, *events = split([node for node in before if node.text != "["], "+")
        is_initial = bool(source) and source[0].text == "*"
        start, event = self._name(source[is_initial:]), self._name(events[0]) if events else None
        targets = [self._name(each) for each in (*first, *last)]
        is_event = not events or (event is not None and event[0] not in ("", "state"))
        are_states = all(each is not None and each[0] == "state" for each in (start, *targets))
        if (
            start is None
            or not is_event
            or not are_states
            or max(len(targets), len(actions), len(events), len(guards)) > 1
        ):
            self._machine.is_partial = True
            self._note(nodes, "not a row that is understood")
            return None
        self.initial += [start[1]] if is_initial and start[1] not in self.initial else []
        return _Row(
            node=source[0],
            source=start[1],
            event=event,
            guard=guards[0].children if guards else (),
            action=actions[0] if actions else (),
            target=next((each[1] for each in targets if each), ""),
        )

    def _name(self, nodes: Sequence[CppTree]) -> _Name | None:
        """The state or event that a text stands for; None if it is neither."""
        if nodes and nodes[-1].text == "(":
            self._note(nodes, "not in the design")
            nodes = nodes[:-1]
        if len(nodes) == 1 and nodes[0].text == _TERMINATED:
            return ("state", _TERMINATED)
        # Names of namespaces do not matter.
        return _read_name(nodes) or (self._names.get(nodes[-1].text) if nodes and nodes[-1].kind == WORD else None)

    def state(self, name: str, rows: Sequence[_Row], all_rows: Sequence[_Row]) -> State:
        node = rows[0].node if rows else self._machine.node
        alias = self._machine.use(name, node) if name in self._machine.components else ""
        # Rows without event are taken before the next event is processed.
        decided = sorted(
            (row for row in rows if not row.has(_ENTRY) and not row.has(_EXIT)), key=lambda row: bool(row.event)
        )
        events = list(dict.fromkeys(row.event[1] for row in all_rows if row.event and row.has("event")))
        state = State(
            name=name,
            final=name == _TERMINATED,
            requires=(alias,) if alias else (),
            enter=tuple(self._code(row) for row in rows if row.has(_ENTRY)),
            leave=tuple(self._code(row) for row in rows if row.has(_EXIT)),
            transitions=tuple(self._decision(alias, row, events) for row in decided),
        )
        return self._machine.place(state, node) if rows else state

    def _code(self, row: _Row) -> RunCode:
        if row.guard:
            self._note(row.guard, "a guard that is not in the design")
        return RunCode(code=Code(texts=(("cpp", self._machine.source.slice(row.action)),)))

    def _decision(self, alias: str, row: _Row, events: Sequence[str]) -> Decision:
        tests = [self._event(row.event, row.node, events)] if row.event else []
        if row.event is None and alias:
            tests = [ast.parse(f"done({alias})", mode="eval").body]
        if row.guard:
            tests.append(self._machine.conditions.read(row.guard))
        guard, doc = to_guard(join(ast.And(), tests)) if tests else Guard(), self._machine.source.slice(row.action)
        if row.target:
            return self._machine.place(Transition(to=row.target, guard=guard, doc=doc), row.node)
        return self._machine.place(Stay(guard=guard, doc=doc), row.node)

    def _event(self, event: _Name, node: CppTree, events: Sequence[str]) -> ast.expr:
        """Whether an event is processed; of those of a table, it is exactly one."""
        kind, name = event
        if kind != "event" or name == "_":
            self._note((node,), f"{kind} {name} is an input of its own")
            return self._machine.conditions.flag(f"{kind} {name}", str(node.start))
        return (
            self._machine.conditions.flag(name)
            if len(events) == 1
            else self._machine.conditions.element((), "event", f"{self._machine.component}Event", name)
        )


def _read_name(nodes: Sequence[CppTree]) -> _Name | None:
    """The name in `state<class X>`, `sml::event<e>`, `"x"_s` and similar."""
    if len(nodes) == 2 and nodes[0].kind == STRING and nodes[1].text in _LITERALS:
        name = nodes[0].text.strip('"').replace(" ", "_")
        return (_LITERALS[nodes[1].text], name) if is_valid_state_name(name) else None
    opening = next((index for index, node in enumerate(nodes) if node.text == "<"), 0)
    if not opening or nodes[opening - 1].text not in _KINDS or nodes[-1].text != ">":
        return None
    name = nodes[-2].text
    return (nodes[opening - 1].text, name) if is_valid_state_name(name) else None


def _find_declared(nodes: Sequence[CppTree], macros: Mapping[str, _Name]) -> Iterator[tuple[str, _Name]]:
    """Names that a function declares by `auto name = state<X>;` and by macros."""
    for index, node in enumerate(nodes[:-1]):
        if node.text in macros and nodes[index + 1].text == "(":
            (kind, suffix), name = macros[node.text], compact(split(nodes[index + 1].children, ",")[0])
            yield name + suffix, (kind, name)
        if node.text == "auto" and index + 2 < len(nodes) and nodes[index + 2].text == "=":
            value = split(nodes[index + 3 :], ";")[0]
            yield nodes[index + 1].text, _read_name(value) or ("", nodes[index + 1].text)
