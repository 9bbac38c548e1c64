"""Collects the declarations of all files into one table; where they stand makes no difference to what they mean."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from vicode.findings import Finding, Note, did_you_mean, rule
from vicode.xabsl import tree
from vicode.xabsl.declared import DECIMAL, ENUM, Declared, Table, kind_of_type
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.sources import Source

_OUTPUTS = ("output", "internal")


@dataclass(slots=True)
class Report:
    """Gathers what is wrong, and which word means which declaration: (file, number of the token, declaration)."""

    findings: list[Finding] = field(default_factory=list)
    uses: list[tuple[Tokens, int, Declared]] = field(default_factory=list)

    def complain(
        self, tokens: Tokens, at: int, code: str, message: str, mend: str = "", *, note: Note | None = None
    ) -> None:
        """Tell what is wrong with a token."""
        notes = (note,) if note else ()
        place = tokens.place(max(at, 0))
        self.findings.append(Finding(rule=rule(code), message=message, mend=mend, place=place, notes=notes))


def declare(source: Source, report: Report) -> Table:
    """The table of a program."""
    table = Table()
    collector = _Collector(table, report)
    for parsed in source.files.values():
        for item in parsed.file.body:
            match item:
                case tree.Namespace():
                    collector.namespace(item, parsed.tokens)
                case tree.Option():
                    collector.option(item, parsed.tokens)
                case tree.Agent():
                    agent = Declared("agent", item.name.text, parsed.tokens, item.name, item)
                    collector.add(table.agents, agent)
    collector.check_types()
    return table


class _Collector:
    """Adds one declaration after the other."""

    def __init__(self, table: Table, report: Report) -> None:
        self.table, self.report = table, report
        self.typed: list[tuple[tree.Type | None, Tokens]] = []

    def add(self, found: dict[str, Declared], new: Declared) -> bool:
        """Add a declaration unless its name is taken; returns whether it was."""
        old = found.setdefault(new.name, new)
        if old is not new:
            self._complain_twice(old, new)
        return old is new

    def namespace(self, item: tree.Namespace, tokens: Tokens) -> None:
        """Add all that a namespace holds."""
        if not item.declarations and item.to >= 0:
            self.report.complain(tokens, item.name.at, "X631", f"namespace {item.name.text} is empty", "remove it")
        kinds = {isinstance(each, tree.Behavior) for each in item.declarations}
        if len(kinds) == 2:
            first = isinstance(item.declarations[0], tree.Behavior)
            other = next(each for each in item.declarations if isinstance(each, tree.Behavior) != first)
            message = f"namespace {item.name.text} holds symbols and basic behaviors: {other.name.text}"
            self.report.complain(tokens, other.name.at, "X630", message, "give the behaviors a namespace of their own")
        for each in item.declarations:
            match each:
                case tree.Behavior():
                    self._behavior(each, tokens)
                case tree.Enumeration():
                    self._enumeration(each, tokens)
                case tree.Constant():
                    constant = Declared("const", each.name.text, tokens, each.name, each, DECIMAL, full=each.name.text)
                    self._add_symbol(constant, self.table.readable)
                case tree.Symbol():
                    self._symbol(each, tokens)

    def option(self, item: tree.Option, tokens: Tokens) -> None:
        """Add an option with its parameters and states."""
        name = item.name.text
        option = Declared("option", name, tokens, item.name, item, full=name)
        self._parameters(option, item.parameters)
        for state in item.states:
            self.add(option.states, Declared("state", state.name.text, tokens, state.name, state, full=state.name.text))
        if self.add(self.table.options, option):
            self.table.callable.setdefault(name, []).append(option)

    def check_types(self) -> None:
        """Look whether all enumerations that types name are declared."""
        for of, tokens in self.typed:
            if of is None or of.enum is None:
                continue
            enum = self.table.enums.get(of.enum.text)
            if enum is None:
                mend = did_you_mean(of.enum.text, self.table.enums, "declare it: enum NAME { … };")
                self.report.complain(tokens, of.enum.at, "X621", f"no enumeration {of.enum.text}", mend)
            else:
                self.report.uses.append((tokens, of.enum.at, enum))

    def _behavior(self, item: tree.Behavior, tokens: Tokens) -> None:
        name = item.name.text
        behavior = Declared("behavior", name, tokens, item.name, item, full=name)
        self._parameters(behavior, item.parameters)
        if self.add(self.table.behaviors, behavior):
            self.table.callable.setdefault(name, []).append(behavior)

    def _enumeration(self, item: tree.Enumeration, tokens: Tokens) -> None:
        name = item.name.text
        enum = Declared("enum", name, tokens, item.name, item, full=name)
        for word in item.elements:
            element = Declared("element", word.text, tokens, word, item, ENUM, name, f"{name}.{word.text}")
            self.add(enum.elements, element)
        self.add(self.table.enums, enum)

    def _symbol(self, item: tree.Symbol, tokens: Tokens) -> None:
        kind, enum = kind_of_type(item.type)
        self.typed.append((item.type, tokens))
        name = item.name.text
        symbol = Declared(item.direction, name, tokens, item.name, item, kind, enum, name)
        self._parameters(symbol, item.parameters or ())
        self._look_at_range(item, kind, tokens)
        if self._add_symbol(symbol, self.table.readable) and item.direction in _OUTPUTS:
            self.table.assignable.setdefault(name, []).append(symbol)

    def _parameters(self, owner: Declared, parameters: Iterable[tree.Parameter]) -> None:
        is_option = owner.role == "option"
        for each in parameters:
            kind, enum = kind_of_type(each.type)
            self.typed.append((each.type, owner.tokens))
            word = each.name.text
            if is_option and not word.startswith("@"):
                message = f"a parameter that the option cannot refer to: {word}"
                self.report.complain(owner.tokens, each.name.at, "X635", message, f"write @{word}")
            name = word.removeprefix("@") if is_option else word
            full = f"{owner.name}.{name}"
            parameter = Declared("parameter", name, owner.tokens, each.name, each, kind, enum, full)
            self._look_at_range(each, kind, owner.tokens)
            self.add(owner.parameters, parameter)

    def _add_symbol(self, new: Declared, found: dict[str, list[Declared]]) -> bool:
        same = found.setdefault(new.name, [])
        outputs = new.role in _OUTPUTS
        for old in same:
            if old.kind == new.kind and (old.role == new.role or (outputs and old.role in _OUTPUTS)):
                self._complain_twice(old, new)
                return False
        same.append(new)
        return True

    def _look_at_range(self, item: tree.Symbol | tree.Parameter, kind: str, tokens: Tokens) -> None:
        if kind != DECIMAL and (item.range or item.unit):
            words = "range or unit" if item.range and item.unit else "range" if item.range else "unit"
            message = f"{item.name.text} is no decimal and has no {words}"
            self.report.complain(tokens, item.name.at, "X634", message, "remove it")

    def _complain_twice(self, old: Declared, new: Declared) -> None:
        note = Note(message="it was declared here", place=old.tokens.place(old.word.at))
        message = f"a second {new.what} named {new.name}"
        self.report.complain(new.tokens, new.word.at, "X623", message, "rename or remove it", note=note)
