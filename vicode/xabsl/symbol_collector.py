"""Collects the declarations of all files into one symbol table. Their order has no effect."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from vicode.findings import Finding, Note, did_you_mean, get_rule
from vicode.xabsl import tree
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.source_loader import ProgramSource
from vicode.xabsl.symbol_table import DECIMAL, ENUM, Definition, SymbolTable, resolve_type

_OUTPUTS = ("output", "internal")


@dataclass(slots=True)
class CompileReport:
    """Collects the findings and the resolved references: (tokens of the file, number of the token, definition)."""

    findings: list[Finding] = field(default_factory=list)
    references: list[tuple[Tokens, int, Definition]] = field(default_factory=list)

    def add_finding(
        self, tokens: Tokens, at: int, code: str, message: str, fix: str = "", *, note: Note | None = None
    ) -> None:
        """Report a problem with a token."""
        notes = (note,) if note else ()
        place = tokens.location(max(at, 0))
        self.findings.append(Finding(rule=get_rule(code), message=message, fix=fix, location=place, notes=notes))


def collect_symbols(source: ProgramSource, report: CompileReport) -> SymbolTable:
    """Build the symbol table of a program."""
    table = SymbolTable()
    collector = _Collector(table, report)
    for parsed in source.files.values():
        for item in parsed.file.body:
            match item:
                case tree.NamespaceNode():
                    collector.add_namespace(item, parsed.tokens)
                case tree.OptionNode():
                    collector.add_option(item, parsed.tokens)
                case tree.AgentNode():
                    agent = Definition("agent", item.name.text, parsed.tokens, item.name, item)
                    collector.add(table.agents, agent)
    collector.check_types()
    return table


class _Collector:
    def __init__(self, table: SymbolTable, report: CompileReport) -> None:
        self.table, self.report = table, report
        self.type_nodes: list[tuple[tree.TypeNode | None, Tokens]] = []

    def add(self, found: dict[str, Definition], new: Definition) -> bool:
        """Add a definition unless its name is taken; returns whether it was added."""
        old = found.setdefault(new.name, new)
        if old is not new:
            self._add_duplicate_finding(old, new)
        return old is new

    def add_namespace(self, item: tree.NamespaceNode, tokens: Tokens) -> None:
        if not item.declarations and item.last_token >= 0:
            self.report.add_finding(
                tokens, item.name.first_token, "X631", f"namespace {item.name.text} is empty", "remove it"
            )
        kinds = {isinstance(each, tree.BehaviorNode) for each in item.declarations}
        if len(kinds) == 2:
            first = isinstance(item.declarations[0], tree.BehaviorNode)
            other = next(each for each in item.declarations if isinstance(each, tree.BehaviorNode) != first)
            message = f"namespace {item.name.text} mixes symbols and basic behaviors: {other.name.text}"
            self.report.add_finding(
                tokens, other.name.first_token, "X630", message, "move the basic behaviors to a separate namespace"
            )
        for each in item.declarations:
            match each:
                case tree.BehaviorNode():
                    self._add_behavior(each, tokens)
                case tree.EnumerationNode():
                    self._add_enumeration(each, tokens)
                case tree.ConstantNode():
                    constant = Definition(
                        "const", each.name.text, tokens, each.name, each, DECIMAL, qualified_name=each.name.text
                    )
                    self._add_symbol(constant, self.table.readable)
                case tree.SymbolNode():
                    self._collect_symbol(each, tokens)

    def add_option(self, item: tree.OptionNode, tokens: Tokens) -> None:
        name = item.name.text
        option = Definition("option", name, tokens, item.name, item, qualified_name=name)
        self._add_parameters(option, item.parameters)
        for state in item.states:
            self.add(
                option.states,
                Definition("state", state.name.text, tokens, state.name, state, qualified_name=state.name.text),
            )
        if self.add(self.table.options, option):
            self.table.callable.setdefault(name, []).append(option)

    def check_types(self) -> None:
        """Check that all enumerations named in types are declared."""
        for of, tokens in self.type_nodes:
            if of is None or of.enum is None:
                continue
            enum = self.table.enums.get(of.enum.text)
            if enum is None:
                mend = did_you_mean(of.enum.text, self.table.enums, "declare it: enum NAME { … };")
                self.report.add_finding(tokens, of.enum.first_token, "X621", f"no enumeration {of.enum.text}", mend)
            else:
                self.report.references.append((tokens, of.enum.first_token, enum))

    def _add_behavior(self, item: tree.BehaviorNode, tokens: Tokens) -> None:
        name = item.name.text
        behavior = Definition("behavior", name, tokens, item.name, item, qualified_name=name)
        self._add_parameters(behavior, item.parameters)
        if self.add(self.table.behaviors, behavior):
            self.table.callable.setdefault(name, []).append(behavior)

    def _add_enumeration(self, item: tree.EnumerationNode, tokens: Tokens) -> None:
        name = item.name.text
        enum = Definition("enum", name, tokens, item.name, item, qualified_name=name)
        for word in item.elements:
            element = Definition("element", word.text, tokens, word, item, ENUM, name, f"{name}.{word.text}")
            self.add(enum.elements, element)
        self.add(self.table.enums, enum)

    def _collect_symbol(self, item: tree.SymbolNode, tokens: Tokens) -> None:
        kind, enum = resolve_type(item.type)
        self.type_nodes.append((item.type, tokens))
        name = item.name.text
        symbol = Definition(item.direction, name, tokens, item.name, item, kind, enum, name)
        self._add_parameters(symbol, item.parameters or ())
        self._check_range_type(item, kind, tokens)
        if self._add_symbol(symbol, self.table.readable) and item.direction in _OUTPUTS:
            self.table.assignable.setdefault(name, []).append(symbol)

    def _add_parameters(self, owner: Definition, parameters: Iterable[tree.ParameterNode]) -> None:
        is_option = owner.role == "option"
        for each in parameters:
            kind, enum = resolve_type(each.type)
            self.type_nodes.append((each.type, owner.tokens))
            word = each.name.text
            if is_option and not word.startswith("@"):
                message = f"parameter {word} has no @, so the option cannot refer to it"
                self.report.add_finding(owner.tokens, each.name.first_token, "X635", message, f"write @{word}")
            name = word.removeprefix("@") if is_option else word
            full = f"{owner.name}.{name}"
            parameter = Definition("parameter", name, owner.tokens, each.name, each, kind, enum, full)
            self._check_range_type(each, kind, owner.tokens)
            self.add(owner.parameters, parameter)

    def _add_symbol(self, new: Definition, found: dict[str, list[Definition]]) -> bool:
        same = found.setdefault(new.name, [])
        outputs = new.role in _OUTPUTS
        for old in same:
            if old.kind == new.kind and (old.role == new.role or (outputs and old.role in _OUTPUTS)):
                self._add_duplicate_finding(old, new)
                return False
        same.append(new)
        return True

    def _check_range_type(self, item: tree.SymbolNode | tree.ParameterNode, kind: str, tokens: Tokens) -> None:
        if kind != DECIMAL and (item.range or item.unit):
            words = "range or unit" if item.range and item.unit else "range" if item.range else "unit"
            message = f"{item.name.text} is not a decimal and cannot have a {words}"
            self.report.add_finding(tokens, item.name.first_token, "X634", message, "remove it")

    def _add_duplicate_finding(self, old: Definition, new: Definition) -> None:
        note = Note(message="the first declaration", location=old.tokens.location(old.name_node.first_token))
        message = f"a second {new.description} named {new.name}"
        self.report.add_finding(
            new.tokens, new.name_node.first_token, "X623", message, "rename or remove it", note=note
        )
