"""Compiles the sources of a program: resolves names and puts common decisions before the decisions of states."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from vicode.findings import Finding, Severity, did_you_mean, sort_findings
from vicode.xabsl import tree
from vicode.xabsl.checks import check_semantics
from vicode.xabsl.engine.program import CompiledOption, CompiledState, Program, Term, TypedSlot
from vicode.xabsl.engine.recursion import allow_calls
from vicode.xabsl.engine.symbols import BasicBehavior, RobotSymbol, SymbolList
from vicode.xabsl.expression_compiler import ExpressionCompiler
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.ranges import check_range
from vicode.xabsl.source_loader import ProgramSource
from vicode.xabsl.symbol_collector import CompileReport, collect_symbols
from vicode.xabsl.symbol_table import BOOLEAN, Definition, SymbolTable

_MODES = {"": "n", "capacity": "c", "synchronized": "s"}


@dataclass(slots=True)
class CompileResult:
    """Result of a compilation; `program` is None if a finding is an error. `references` are the resolved names."""

    program: Program | None
    table: SymbolTable
    findings: tuple[Finding, ...]
    references: list[tuple[Tokens, int, Definition]] = field(default_factory=list)


def compile_source(source: ProgramSource) -> CompileResult:
    report = CompileReport()
    table = collect_symbols(source, report)
    options: list[CompiledOption] = []
    agents: list[tuple[str, str]] = []
    for parsed in source.files.values():
        for item in parsed.file.body:
            if isinstance(item, tree.OptionNode):
                options.append(_OptionCompiler(table, report, parsed.tokens, item).compile())
            elif isinstance(item, tree.AgentNode):
                agents.append((item.name.text, _resolve_root(item, table, report, parsed.tokens)))
    allow_calls(len(options))
    check_semantics(source, table, report)
    findings = sort_findings([*source.findings, *report.findings])
    is_sound = not any(finding.severity is Severity.ERROR for finding in findings)
    program = Program(
        options=tuple(sorted(options, key=lambda option: option.name.lower())),
        agents=tuple(agents),
        enums=_internal_enums(table),
        symbols=_internal_symbols(table),
        title=source.title,
    )
    return CompileResult(program if is_sound else None, table, findings, report.references)


def declared_symbols(table: SymbolTable) -> SymbolList:
    """The symbols and basic behaviors that the robot program must provide, as declared."""
    enums = [
        (definition, tuple(element.qualified_name for element in definition.elements.values()))
        for definition in table.enums.values()
    ]
    return SymbolList(
        enums=tuple((definition.name, elements) for definition, elements in enums if not _is_internal(definition)),
        internal_enums=tuple((definition.name, elements) for definition, elements in enums if _is_internal(definition)),
        symbols=tuple(
            RobotSymbol(
                definition.role,
                definition.kind,
                definition.name,
                definition.enum,
                tuple(map(_slot, definition.parameters.values())),
            )
            for definition in table.symbols("input", "output", "internal")
        ),
        behaviors=tuple(
            BasicBehavior(definition.name, tuple(map(_slot, definition.parameters.values())))
            for definition in table.behaviors.values()
        ),
    )


def _is_internal(enum: Definition) -> bool:
    return isinstance(enum.node, tree.EnumerationNode) and enum.node.is_internal


def _resolve_root(agent: tree.AgentNode, table: SymbolTable, report: CompileReport, tokens: Tokens) -> str:
    root = table.options.get(agent.root.text)
    if root is None:
        fix = did_you_mean(agent.root.text, table.options, "include the file of the option")
        report.add_finding(tokens, agent.root.first_token, "X621", f"unknown option {agent.root.text}", fix)
    else:
        report.references.append((tokens, agent.root.first_token, root))
    return agent.root.text


def _internal_enums(table: SymbolTable) -> tuple[tuple[str, tuple[str, ...]], ...]:
    enums = [
        (enum.name, tuple(element.qualified_name for element in enum.elements.values()))
        for enum in table.enums.values()
        if _is_internal(enum)
    ]
    return tuple(sorted(enums, key=lambda enum: enum[0].lower()))


def _internal_symbols(table: SymbolTable) -> tuple[TypedSlot, ...]:
    slots = (_slot(symbol) for symbol in table.symbols("internal"))
    return tuple(sorted(slots, key=lambda slot: slot.name.lower()))


def _slot(definition: Definition) -> TypedSlot:
    return TypedSlot(definition.kind, definition.qualified_name, definition.enum)


class _OptionCompiler:
    def __init__(self, table: SymbolTable, report: CompileReport, tokens: Tokens, option: tree.OptionNode) -> None:
        self.table, self.report, self.tokens, self.option = table, report, tokens, option
        self.definition = self._find_definition()
        self.expressions = ExpressionCompiler(table, report, tokens, self.definition.parameters)

    def _find_definition(self) -> Definition:
        """The definition of this option, even if another option has the same name."""
        definition = self.table.options[self.option.name.text]
        if definition.node is self.option:
            return definition
        return Definition(
            "option", definition.name, self.tokens, self.option.name, self.option, qualified_name=definition.name
        )

    def compile(self) -> CompiledOption:
        common = self.option.common_decision
        before = self._open_tree(common) if common is not None else None
        actions = self._actions(self.option.common_actions)
        states = tuple(self._state(state, before, actions) for state in self.option.states)
        slots = tuple(_slot(parameter) for parameter in self.definition.parameters.values())
        return CompiledOption(self.option.name.text, self._initial(), states, slots)

    def _initial(self) -> str:
        initial = [state for state in self.option.states if state.is_initial]
        if not initial:
            name = self.option.name
            message = f"option {name.text} has no initial state"
            self.expressions.add_finding(name.first_token, "X628", message, "mark one of its states as initial")
            return ""
        for state in initial[1:]:
            message = f"a second initial state: {state.name.text}"
            self.expressions.add_finding(
                state.name.first_token,
                "X629",
                message,
                f"the first one is {initial[0].name.text}: remove initial from one of them",
            )
        return initial[0].name.text

    def _state(self, state: tree.StateNode, before: "_OpenTree | None", common: tuple[Term, ...]) -> CompiledState:
        name = state.name.text
        stay: Term = ("t", name)
        decision = state.decision
        if decision is None:
            own_tree = stay
        else:
            self._check_else(decision, has_common=before is not None)
            own_tree = self._tree(decision.tree, stay)
        return CompiledState(
            name=name,
            decision=before.close(own_tree) if before is not None else own_tree,
            actions=(*common, *self._actions(state.actions)),
            is_target=state.is_target,
            mode=_MODES[state.cooperation],
            robots=int(float(state.robots)) if state.robots else 0,
        )

    def _check_else(self, decision: tree.DecisionNode, *, has_common: bool) -> None:
        if has_common and not decision.begins_with_else:
            message = "the decision follows the common decision, but does not start with else"
            self.expressions.add_finding(decision.first_token, "X641", message, "write else at its start")
        if decision.begins_with_else and not has_common:
            message = "the decision starts with else, but the option has no common decision"
            self.expressions.add_finding(decision.first_token, "X632", message, "remove else")

    def _tree(self, node: tree.DecisionTreeNode, stay: Term) -> Term:
        match node:
            case tree.GotoNode():
                return ("t", self._target(node))
            case tree.StayNode():
                return stay
            case tree.BlockNode():
                return self._tree(node.inner, stay)
            case tree.IfNode():
                condition = self.expressions.compile(node.condition, BOOLEAN)
                assert node.otherwise is not None
                return ("i", condition, self._tree(node.then, stay), self._tree(node.otherwise, stay))

    def _target(self, goto: tree.GotoNode) -> str:
        name = goto.state.text
        state = self.definition.states.get(name)
        if state is None:
            fix = did_you_mean(name, self.definition.states, f"use a state of option {self.option.name.text}")
            self.expressions.add_finding(goto.state.first_token, "X621", f"unknown state {name}", fix)
        else:
            self.report.references.append((self.tokens, goto.state.first_token, state))
        return name

    def _open_tree(self, node: tree.DecisionTreeNode) -> "_OpenTree":
        """Compile a common decision, whose last branch is the decision of the state."""
        while isinstance(node, tree.BlockNode):
            node = node.inner
        branches: list[tuple[Term, Term]] = []
        current: tree.DecisionTreeNode | None = node
        while isinstance(current, tree.IfNode | tree.BlockNode):
            if isinstance(current, tree.BlockNode):
                current = current.inner
                continue
            self._check_no_stay(current.then)
            condition = self.expressions.compile(current.condition, BOOLEAN)
            branches.append((condition, self._tree(current.then, ("t", ""))))
            current = current.otherwise
        return _OpenTree(branches)

    def _check_no_stay(self, node: tree.DecisionTreeNode) -> None:
        """Report `stay` in a common decision, where the current state is not known."""
        match node:
            case tree.StayNode():
                self.expressions.add_finding(
                    node.first_token, "X633", "stay in a common decision", "write goto with the name of a state"
                )
            case tree.BlockNode():
                self._check_no_stay(node.inner)
            case tree.IfNode():
                self._check_no_stay(node.then)
                if node.otherwise is not None:
                    self._check_no_stay(node.otherwise)

    def _actions(self, actions: tree.ActionBlockNode | None) -> tuple[Term, ...]:
        terms = [self._action(action) for action in actions.actions] if actions else []
        return tuple(term for term in terms if term is not None)

    def _action(self, action: tree.ActionNode) -> Term | None:
        if isinstance(action, tree.AssignmentNode):
            return self._assignment(action)
        name = action.name.text
        callees = [
            callee for callee in self.table.callable.get(name, ()) if not action.kind or callee.role == action.kind
        ]
        if not callees:
            expected = action.kind or "option or basic behavior"
            fix = did_you_mean(name, self.table.callable, f"declare behavior {name}, or include the file of the option")
            self.expressions.add_finding(action.name.first_token, "X621", f"unknown {expected} {name}", fix)
            return None
        if len(callees) > 1:
            fix = f"write {name} option(…) or {name} behavior(…)"
            self.expressions.add_finding(
                action.name.first_token, "X622", f"{name} is both an option and a basic behavior", fix
            )
        self.report.references.append((self.tokens, action.name.first_token, callees[0]))
        letter = "o" if callees[0].role == "option" else "a"
        return (letter, name, self.expressions.compile_arguments(callees[0], action.arguments))

    def _assignment(self, action: tree.AssignmentNode) -> Term | None:
        name = action.symbol.text
        symbols = self.table.assignable.get(name, [])
        if not symbols:
            readable = self.table.readable.get(name)
            if readable:
                message = f"{readable[0].description} {name} cannot be set"
                self.expressions.add_finding(
                    action.symbol.first_token, "X624", message, "set an output or internal symbol"
                )
            else:
                fix = did_you_mean(name, self.table.assignable, "declare it as an output or internal symbol")
                self.expressions.add_finding(action.symbol.first_token, "X621", f"unknown output symbol {name}", fix)
            return None
        if len(symbols) > 1:
            meanings = " and ".join(candidate.description for candidate in symbols)
            self.expressions.add_finding(
                action.symbol.first_token, "X622", f"{name} is ambiguous: {meanings}", "rename one of them"
            )
        symbol = symbols[0]
        self.report.references.append((self.tokens, action.symbol.first_token, symbol))
        check_range(self.report, self.tokens, action.value, symbol)
        return (symbol.kind, name, self.expressions.compile(action.value, symbol.kind, symbol.enum))


@dataclass(slots=True)
class _OpenTree:
    """The branches of a common decision; the final branch is open."""

    branches: Iterable[tuple[Term, Term]]

    def close(self, last: Term) -> Term:
        """Complete the tree with its final branch."""
        for condition, then in reversed(list(self.branches)):
            last = ("i", condition, then, last)
        return last
