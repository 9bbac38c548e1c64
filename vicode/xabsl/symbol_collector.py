"""Collects the declarations of all files into one symbol table. Their order has no effect."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from vicode.findings import Finding, Note, did_you_mean, get_rule, write_instead
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
        self, tokens: Tokens, token: int, code: str, message: str, fix: str = "", *, note: Note | None = None
    ) -> None:
        notes = (note,) if note else ()
        location = tokens.location(token)
        self.findings.append(Finding(rule=get_rule(code), message=message, fix=fix, location=location, notes=notes))


def collect_symbols(source: ProgramSource, report: CompileReport) -> SymbolTable:
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

    def add(self, definitions: dict[str, Definition], new: Definition) -> bool:
        """Add a definition unless its name is taken; returns whether it was added."""
        old = definitions.setdefault(new.name, new)
        if old is not new:
            self._add_duplicate_finding(old, new)
        return old is new

    def add_namespace(self, item: tree.NamespaceNode, tokens: Tokens) -> None:
        if not item.declarations and item.last_token >= 0:
            self.report.add_finding(
                tokens, item.name.first_token, "X631", f"namespace {item.name.text} is empty", "remove it"
            )
        kinds = {isinstance(declaration, tree.BehaviorNode) for declaration in item.declarations}
        if len(kinds) == 2:
            first = isinstance(item.declarations[0], tree.BehaviorNode)
            other = next(
                declaration for declaration in item.declarations if isinstance(declaration, tree.BehaviorNode) != first
            )
            message = f"namespace {item.name.text} mixes symbols and basic behaviors: {other.name.text}"
            self.report.add_finding(
                tokens, other.name.first_token, "X630", message, "move the basic behaviors to a separate namespace"
            )
        for declaration in item.declarations:
            match declaration:
                case tree.BehaviorNode():
                    self._add_behavior(declaration, tokens)
                case tree.EnumerationNode():
                    self._add_enumeration(declaration, tokens)
                case tree.ConstantNode():
                    constant = Definition(
                        "const",
                        declaration.name.text,
                        tokens,
                        declaration.name,
                        declaration,
                        DECIMAL,
                        qualified_name=declaration.name.text,
                    )
                    self._add_symbol(constant, self.table.readable)
                case tree.SymbolNode():
                    self._collect_symbol(declaration, tokens)

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
        for type_node, tokens in self.type_nodes:
            if type_node is None or type_node.enum is None:
                continue
            enum = self.table.enums.get(type_node.enum.text)
            if enum is None:
                fix = did_you_mean(type_node.enum.text, self.table.enums, "declare it: enum NAME { … };")
                self.report.add_finding(
                    tokens, type_node.enum.first_token, "X621", f"unknown enumeration {type_node.enum.text}", fix
                )
            else:
                self.report.references.append((tokens, type_node.enum.first_token, enum))

    def _add_behavior(self, item: tree.BehaviorNode, tokens: Tokens) -> None:
        name = item.name.text
        behavior = Definition("behavior", name, tokens, item.name, item, qualified_name=name)
        self._add_parameters(behavior, item.parameters)
        if self.add(self.table.behaviors, behavior):
            self.table.callable.setdefault(name, []).append(behavior)

    def _add_enumeration(self, item: tree.EnumerationNode, tokens: Tokens) -> None:
        name = item.name.text
        enum = Definition("enum", name, tokens, item.name, item, qualified_name=name)
        for element_name in item.elements:
            element = Definition(
                "element", element_name.text, tokens, element_name, item, ENUM, name, f"{name}.{element_name.text}"
            )
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
        for node in parameters:
            kind, enum = resolve_type(node.type)
            self.type_nodes.append((node.type, owner.tokens))
            written_name = node.name.text
            if is_option and not written_name.startswith("@"):
                message = f"parameter {written_name} has no @, so the option cannot refer to it"
                self.report.add_finding(
                    owner.tokens, node.name.first_token, "X635", message, write_instead(f"@{written_name}")
                )
            name = written_name.removeprefix("@") if is_option else written_name
            full = f"{owner.name}.{name}"
            parameter = Definition("parameter", name, owner.tokens, node.name, node, kind, enum, full)
            self._check_range_type(node, kind, owner.tokens)
            self.add(owner.parameters, parameter)

    def _add_symbol(self, new: Definition, definitions: dict[str, list[Definition]]) -> bool:
        namesakes = definitions.setdefault(new.name, [])
        outputs = new.role in _OUTPUTS
        for old in namesakes:
            if old.kind == new.kind and (old.role == new.role or (outputs and old.role in _OUTPUTS)):
                self._add_duplicate_finding(old, new)
                return False
        namesakes.append(new)
        return True

    def _check_range_type(self, item: tree.SymbolNode | tree.ParameterNode, kind: str, tokens: Tokens) -> None:
        if kind != DECIMAL and (item.range or item.unit):
            excess = "range or unit" if item.range and item.unit else "range" if item.range else "unit"
            message = f"{item.name.text} is not a decimal and cannot have a {excess}"
            self.report.add_finding(tokens, item.name.first_token, "X634", message, "remove it")

    def _add_duplicate_finding(self, old: Definition, new: Definition) -> None:
        note = Note(message="the first declaration", location=old.tokens.location(old.name_node.first_token))
        message = f"a second {new.description} named {new.name}"
        self.report.add_finding(
            new.tokens, new.name_node.first_token, "X623", message, "rename or remove it", note=note
        )
