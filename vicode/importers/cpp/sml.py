"""Reads transition tables of boost::sml.

An iteration of a design stands for the processing of one event. Rows without event are taken in the iteration after the
state was entered, and for a machine inside the table, when it is done. Actions of rows are in their descriptions.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from vicode.cpp_tokens import STRING, WORD
from vicode.importers.cpp.conditions import Condition, ConditionReader, join
from vicode.importers.cpp.machine import CppMachine
from vicode.importers.cpp.tree import CppNode, compact, split, template_end
from vicode.model.design import Code, Decision, Design, Guard, RunCode, State, Stay, Transition
from vicode.model.names import is_valid_state_name

TABLE = "make_transition_table"
_ENTRY, _EXIT, _ANY = "on_entry", "on_exit", "_"
_KINDS = frozenset({"state", "event", _ENTRY, _EXIT, "unexpected_event", "exception"})
# Macros that declare names, such as `#define STATE(S) const auto S##_S = state<S>;`.
_MACRO = re.compile(
    r"#\s*define\s+(\w+)\(\s*(\w+)[^)]*\)(?:\\\r?\n|\s)*(?:const\s+|constexpr\s+)*auto\s+(\w+)\s*##\s*(\w+)\s*=((?:[^\n\\]|\\\r?\n)*)"
)


@dataclass(frozen=True, slots=True)
class Name:
    """What a text of a table stands for: "state", "event" or another kind, and the name; "" for guards and actions."""

    kind: str
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """A row of a table; without `event`, it is anonymous."""

    node: CppNode
    is_initial: bool
    source: str
    event: Name | None
    guard: tuple[CppNode, ...]
    action: tuple[CppNode, ...]
    target: str


@dataclass(frozen=True, slots=True)
class Table:
    """A table: the name of its machine, its rows, and the function around it."""

    name: CppNode
    rows: tuple[tuple[CppNode, ...], ...]
    function: Sequence[CppNode]


def find_macros(text: str) -> dict[str, tuple[str, str]]:
    """The suffix and the kind of the names that macros declare, by macro; the kind is "" for guards and actions."""
    found = {}
    for macro, parameter, stem, suffix, value in _MACRO.findall(text):
        if parameter == stem:
            kind = re.search(r"\b(state|event)\s*<", value)
            found[macro] = (suffix, kind[1] if kind else "")
    return found


def iter_tables(
    nodes: Sequence[CppNode], name: CppNode | None = None, function: Sequence[CppNode] = ()
) -> Iterator[Table]:
    """Yield the tables in a text, each with the innermost class around it."""
    for index, node in enumerate(nodes):
        is_table = node.text == TABLE and index + 1 < len(nodes) and nodes[index + 1].is_group("(")
        if is_table and nodes[index + 1].children and name is not None:
            yield Table(name, tuple(row for row in split(nodes[index + 1].children, ",") if row), function or nodes)
        elif node.children:
            start = max((n for n in range(index) if nodes[n].text in (";", "{")), default=-1)
            inner = _class_name(nodes[start + 1 : index]) if node.is_group("{") else None
            yield from iter_tables(
                node.children, inner or name, node.children if node.is_group("{") and not inner else function
            )


def _class_name(nodes: Sequence[CppNode]) -> CppNode | None:
    """The name of the class or the lambda variable whose body follows."""
    for index, node in enumerate(nodes[:-1]):
        if node.text in ("struct", "class") and nodes[index + 1].is_word:
            return next((each for each in nodes[index + 1 :] if each.text not in ("final", "alignas")), None)
        if nodes[index + 1].text == "::" and any(each.text == "operator" for each in nodes[index:]):
            return node
    return None


def read_table(machine: CppMachine, table: Table, macros: Mapping[str, tuple[str, str]]) -> list[Design]:
    """Read a table; returns one design for each of its regions."""
    reader = _TableReader(machine, macros, table.function)
    rows = [row for row in (reader.row(each) for each in table.rows) if row is not None]
    machine.notes += [(row[0].start, f"not a row of a transition table: {compact(row)}") for row in reader.unread]
    machine.is_partial = bool(reader.unread)
    return list(reader.designs(rows))


class _TableReader:
    def __init__(self, machine: CppMachine, macros: Mapping[str, tuple[str, str]], function: Sequence[CppNode]) -> None:
        self.unread: list[tuple[CppNode, ...]] = []
        self._machine = machine
        self._names = dict(_find_declared(function, macros))
        self._conditions = ConditionReader(inputs=machine.inputs, atom=self._guard_name)

    def row(self, nodes: tuple[CppNode, ...]) -> Row | None:
        """Read `source + event [guard] / action = target`, or `target <= source + …`."""
        left, target = nodes, tuple[CppNode, ...]()
        for sign, is_first in (("<=", True), ("=", False)):
            parts = split(nodes, sign)
            if len(parts) == 2:
                left, target = (parts[1], parts[0]) if is_first else (parts[0], parts[1])
        before, *actions = split(left, "/")
        source, *events = split(before, "+")
        guards = [node for node in before if node.is_group("[")]
        source = tuple(node for node in source if not node.is_group("["))
        is_initial = source[:1] != () and source[0].text == "*"
        start, end = self._name(source[is_initial:]), self._name(target) if target else None
        event = self._name(tuple(node for node in events[0] if not node.is_group("["))) if events else None
        names = [start, *([end] if target else [])]
        is_known = all(each is not None and each.kind == "state" for each in names)
        if (
            not is_known
            or len(actions) > 1
            or len(events) > 1
            or len(guards) > 1
            or (events and (event is None or event.kind == "state"))
        ):
            self.unread.append(nodes)
            return None
        assert start is not None
        return Row(
            node=source[0],
            is_initial=is_initial,
            source=start.text,
            event=event,
            guard=guards[0].children if guards else (),
            action=actions[0] if actions else (),
            target=end.text if end else "",
        )

    def _name(self, nodes: Sequence[CppNode]) -> Name | None:
        """The state or event that a text stands for; None if it is neither."""
        if nodes and nodes[-1].is_group("("):
            if compact(nodes[-1].children) in ("H", "sml::H"):
                self._machine.note(nodes[-1], "history: the design starts again in the initial state")
            nodes = nodes[:-1]
        if len(nodes) == 2 and nodes[0].kind == STRING and nodes[1].text in ("_s", "_e"):
            return Name("state" if nodes[1].text == "_s" else "event", nodes[0].text.strip('"'))
        plain = [node for index, node in enumerate(nodes) if index + 1 == len(nodes) or nodes[index + 1].text != "::"]
        return (
            _template_name(nodes)
            or (self._names.get(plain[-1].text) if plain and plain[-1].kind == WORD else None)
            or _terminate(plain)
        )

    def _guard_name(self, nodes: Sequence[CppNode]) -> Condition | None:
        name = self._names.get(nodes[0].text) if len(nodes) == 1 else None
        if name is None or name.kind:
            return None
        return Condition(self._machine.inputs.add(("bool", name.text), "bool", name.text))

    def designs(self, rows: Sequence[Row]) -> Iterator[Design]:
        """A design for each initial state, with the states that rows lead to from it."""
        events = list(dict.fromkeys(row.event.text for row in rows if row.event and row.event.kind == "event"))
        starts = list(dict.fromkeys(row.source for row in rows if row.is_initial)) or [""]
        others = set[str]()
        for number, start in enumerate(starts, start=1):
            found = {start} if len(starts) > 1 else {row.source for row in rows} | {row.target for row in rows} - {""}
            size = 0
            while size < len(found):
                size = len(found)
                found |= {row.target for row in rows if row.source in found and row.target}
            if number > 1:
                node = next(row.node for row in rows if row.is_initial and row.source == start)
                self._machine.note(node, f"another region: it is the design {self._machine.component}_{number}")
            others |= found
            states = [
                self._state(name, [row for row in rows if row.source == name], events) for name in _ordered(rows, found)
            ]
            yield Design(
                component=self._machine.component + (f"_{number}" if number > 1 else ""),
                initial=start,
                states=tuple(states),
                uses=self._machine.uses(),
            )
        for row in rows:
            if row.source not in others:
                self._machine.note(row.node, f"no region reaches '{row.source}': the row is left out")

    def _state(self, name: str, rows: Sequence[Row], events: Sequence[str]) -> State:
        entry = tuple(self._phase(rows, _ENTRY))
        leave = tuple(self._phase(rows, _EXIT))
        alias = self._machine.use(name, rows[0].node) if name in self._machine.components and rows else ""
        # Rows without event are taken before the next event is processed.
        kept = [row for row in rows if row.event is None or row.event.kind not in (_ENTRY, _EXIT)]
        kept.sort(key=lambda row: row.event is not None)
        decisions = [self._decision(alias, row, events) for row in kept]
        state = State(
            name=name,
            final=name == "X",
            requires=(alias,) if alias else (),
            enter=entry,
            leave=leave,
            transitions=tuple(decisions),
        )
        return self._machine.place_state(state, rows[0].node) if rows else state

    def _phase(self, rows: Sequence[Row], kind: str) -> Iterator[RunCode]:
        for row in rows:
            if row.event and row.event.kind == kind and row.action:
                if row.guard:
                    self._machine.note(row.node, f"the guard of {kind} is left out: {compact(row.guard)}")
                yield RunCode(code=Code(texts=(("cpp", self._machine.source.slice(row.action)),)))

    def _decision(self, alias: str, row: Row, events: Sequence[str]) -> Decision:
        conditions = []
        if row.event and row.event.kind == "event" and row.event.text != _ANY:
            conditions.append(self._event(row.event.text, events))
        elif row.event and row.event.kind != "event":
            text = f"{row.event.kind} {row.event.text}"
            self._machine.note(row.node, f"{text} is an input of its own")
            conditions.append(Condition(self._machine.inputs.add((text,), "bool", text, is_fixed=False)))
        elif row.event is None and alias:
            conditions.append(Condition(f"done({alias})"))
        if row.guard:
            conditions.append(self._conditions.read(row.guard))
        guard = Guard(when=join(conditions, "and").text if conditions else "")
        doc = self._machine.source.slice(row.action)
        found = Transition(to=row.target, guard=guard, doc=doc) if row.target else Stay(guard=guard, doc=doc)
        return self._machine.place(found, row.node)

    def _event(self, name: str, events: Sequence[str]) -> Condition:
        """Exactly one event is processed in an iteration."""
        if len(events) == 1:
            return Condition(self._machine.inputs.add(("event", name), "bool", f"event {name}", name))
        return self._machine.inputs.element(("event",), "event", name)


def _ordered(rows: Sequence[Row], found: set[str]) -> list[str]:
    names = dict.fromkeys(name for row in rows for name in (row.source, row.target) if name in found)
    return list(names)


def _terminate(nodes: Sequence[CppNode]) -> Name | None:
    return Name("state", "X") if len(nodes) == 1 and nodes[0].text == "X" else None


def _template_name(nodes: Sequence[CppNode]) -> Name | None:
    """The name in `state<class X>`, `sml::event<e>` and similar."""
    opening = next((index for index, node in enumerate(nodes) if node.text == "<"), 0)
    if not opening or nodes[opening - 1].text not in _KINDS or template_end(nodes, opening) != len(nodes) - 1:
        return None
    inside = [node for node in nodes[opening + 1 : -1] if node.text not in ("class", "struct", "typename")]
    name = inside[-1].text if inside and inside[-1].is_word else compact(inside)
    return Name(nodes[opening - 1].text, name) if is_valid_state_name(name) else None


def _find_declared(nodes: Sequence[CppNode], macros: Mapping[str, tuple[str, str]]) -> Iterator[tuple[str, Name]]:
    """Names that a function declares by `auto name = state<X>;` and by macros."""
    for index, node in enumerate(nodes):
        following = nodes[index + 1 : index + 2]
        if node.text in macros and following and following[0].is_group("("):
            parts = split(following[0].children, ",")
            suffix, kind = macros[node.text]
            yield f"{compact(parts[0])}{suffix}", Name(kind, compact(parts[0]))
        if node.text == "auto" and index + 3 < len(nodes) and nodes[index + 2].text == "=":
            value = split(nodes[index + 3 :], ";")[0]
            is_literal = len(value) == 2 and value[0].kind == STRING and value[1].text in ("_s", "_e")
            literal = (
                Name("state" if value[1].text == "_s" else "event", value[0].text.strip('"')) if is_literal else None
            )
            yield nodes[index + 1].text, literal or _template_name(value) or Name("", nodes[index + 1].text)


def with_name(machine: CppMachine, design: Design) -> CppMachine:
    """The machine of one region."""
    return replace(machine, component=design.component, design=design)
