"""Checks that the original compiler lacks: option cycles, unreachable states, unused symbols, double execution."""

from collections import defaultdict
from collections.abc import Iterator

from vicode.findings import Note
from vicode.xabsl import tree
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.source_loader import ProgramSource
from vicode.xabsl.symbol_collector import CompileReport
from vicode.xabsl.symbol_table import Definition, SymbolTable

CallsByOption = dict[str, list[tuple[tree.StateNode, list[tree.CallNode]]]]


def check_semantics(source: ProgramSource, table: SymbolTable, report: CompileReport) -> None:
    """Check a program whose names are resolved."""
    calls: CallsByOption = {}
    tokens_by_option: dict[str, Tokens] = {}
    for parsed in source.files.values():
        for item in parsed.file.body:
            if isinstance(item, tree.OptionNode):
                _check_unreachable_states(item, parsed.tokens, report)
                calls[item.name.text] = [(state, _calls(item, state, table)) for state in item.states]
                tokens_by_option[item.name.text] = parsed.tokens
    descendants = _check_option_cycles(calls, tokens_by_option, report)
    _check_double_execution(calls, descendants, tokens_by_option, report)
    _check_unused(source, table, report)


def _calls(option: tree.OptionNode, state: tree.StateNode, table: SymbolTable) -> list[tree.CallNode]:
    """The calls of options in a state, common actions first."""
    actions = [*(option.common_actions.actions if option.common_actions else ()), *state.actions.actions]
    return [
        action
        for action in actions
        if isinstance(action, tree.CallNode) and action.kind != "behavior" and action.name.text in table.options
    ]


def _targets(node: tree.DecisionTreeNode | None) -> Iterator[str]:
    while isinstance(node, tree.IfNode | tree.BlockNode):
        if isinstance(node, tree.IfNode):
            yield from _targets(node.then)
        node = node.otherwise if isinstance(node, tree.IfNode) else node.inner
    if isinstance(node, tree.GotoNode):
        yield node.state.text


def _check_unreachable_states(option: tree.OptionNode, tokens: Tokens, report: CompileReport) -> None:
    targets = {
        state.name.text: set(_targets(state.decision.tree if state.decision else None)) for state in option.states
    }
    common_targets = set(_targets(option.common_decision))
    pending = [state.name.text for state in option.states if state.is_initial]
    reachable = set(pending)
    while pending:
        for target in (targets.get(pending.pop(), set()) | common_targets) - reachable:
            reachable.add(target)
            pending.append(target)
    for state in option.states if reachable else ():
        if state.name.text not in reachable:
            message = f"state {state.name.text} of option {option.name.text} is unreachable"
            report.add_finding(tokens, state.name.first_token, "X643", message, "add a goto to it or remove it")


def _check_option_cycles(
    calls: CallsByOption, tokens_by_option: dict[str, Tokens], report: CompileReport
) -> dict[str, frozenset[str]]:
    """Report calls that close a cycle; returns all direct and indirect callees of each option."""
    descendants: dict[str, frozenset[str]] = {}

    def visit(name: str, callers: tuple[str, ...]) -> frozenset[str]:
        if name in descendants:
            return descendants[name]
        path = (*callers, name)
        callees: set[str] = set()
        for _state, state_calls in calls[name]:
            for call in state_calls:
                callee = call.name.text
                if callee in path:
                    cycle = " → ".join((*path[path.index(callee) :], callee))
                    message = f"option {callee} calls itself: {cycle}"
                    fix = "engines cannot run it; remove one call from the cycle"
                    report.add_finding(tokens_by_option[name], call.name.first_token, "X636", message, fix)
                elif callee in calls:
                    callees |= {callee} | visit(callee, path)
        descendants[name] = frozenset(callees)
        return descendants[name]

    for name in calls:
        visit(name, ())
    return descendants


def _check_double_execution(
    calls: CallsByOption,
    descendants: dict[str, frozenset[str]],
    tokens_by_option: dict[str, Tokens],
    report: CompileReport,
) -> None:
    """Report options that two calls of one state may both execute in a cycle."""
    for name, states in calls.items():
        tokens = tokens_by_option[name]
        for state, state_calls in states:
            first_calls: dict[str, tree.CallNode] = {}
            for call in state_calls:
                executed = {call.name.text} | descendants.get(call.name.text, frozenset())
                repeated = sorted(executed & first_calls.keys())
                if repeated:
                    message = f"option {repeated[0]} may be executed twice in a cycle of state {state.name.text}"
                    first_call = tokens.location(first_calls[repeated[0]].name.first_token)
                    note = Note(message="this call may execute it too", location=first_call)
                    fix = "call it from one of them only"
                    report.add_finding(tokens, call.name.first_token, "X647", message, fix, note=note)
                first_calls |= dict.fromkeys(executed - first_calls.keys(), call)


def _check_unused(source: ProgramSource, table: SymbolTable, report: CompileReport) -> None:
    uses: dict[int, int] = defaultdict(int)
    for _tokens, _token, definition in report.references:
        uses[id(definition)] += 1
    assigned = _assigned_symbols(source)
    for symbol in table.symbols("input", "output", "internal", "const"):
        if not uses[id(symbol)]:
            _add_unused_finding(symbol, report)
        elif symbol.role == "internal" and symbol.name not in assigned:
            message = f"{symbol.description} {symbol.name} is read, but no action sets it"
            fix = "set it in an action, or use a constant"
            report.add_finding(symbol.tokens, symbol.name_node.first_token, "X645", message, fix)
    for definition in (*table.behaviors.values(), *table.options.values()):
        if not uses[id(definition)]:
            _add_unused_finding(definition, report)


def _assigned_symbols(source: ProgramSource) -> set[str]:
    blocks: list[tree.ActionBlockNode] = []
    for parsed in source.files.values():
        for item in parsed.file.body:
            if isinstance(item, tree.OptionNode):
                blocks += [state.actions for state in item.states]
                blocks += [item.common_actions] if item.common_actions else []
    return {
        action.symbol.text for block in blocks for action in block.actions if isinstance(action, tree.AssignmentNode)
    }


def _add_unused_finding(definition: Definition, report: CompileReport) -> None:
    message = f"{definition.description} {definition.name} is never used"
    report.add_finding(definition.tokens, definition.name_node.first_token, "X644", message, "use it or remove it")
