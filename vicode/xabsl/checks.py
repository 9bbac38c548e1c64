"""What the original never looked for: options that call themselves, states nobody reaches, words nobody uses."""

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
    """Look at a program whose names are bound."""
    calls: CallsByOption = {}
    homes: dict[str, Tokens] = {}
    for parsed in source.files.values():
        for item in parsed.file.body:
            if isinstance(item, tree.OptionNode):
                _check_unreachable_states(item, parsed.tokens, report)
                calls[item.name.text] = [(state, _calls(item, state, table)) for state in item.states]
                homes[item.name.text] = parsed.tokens
    below = _check_option_cycles(calls, homes, report)
    _check_double_execution(calls, below, homes, report)
    _check_unused(source, table, report)


def _calls(option: tree.OptionNode, state: tree.StateNode, table: SymbolTable) -> list[tree.CallNode]:
    """The options that a state calls, common actions first."""
    actions = [*(option.common_actions.actions if option.common_actions else ()), *state.actions.actions]
    return [
        each
        for each in actions
        if isinstance(each, tree.CallNode) and each.kind != "behavior" and each.name.text in table.options
    ]


def _targets(node: tree.DecisionTreeNode | None) -> Iterator[str]:
    while isinstance(node, tree.IfNode | tree.BlockNode):
        if isinstance(node, tree.IfNode):
            yield from _targets(node.then)
        node = node.otherwise if isinstance(node, tree.IfNode) else node.inner
    if isinstance(node, tree.GotoNode):
        yield node.state.text


def _check_unreachable_states(option: tree.OptionNode, tokens: Tokens, report: CompileReport) -> None:
    ways = {state.name.text: set(_targets(state.decision.tree if state.decision else None)) for state in option.states}
    common = set(_targets(option.common_decision))
    waiting = [state.name.text for state in option.states if state.is_initial]
    reached = set(waiting)
    while waiting:
        for target in (ways.get(waiting.pop(), set()) | common) - reached:
            reached.add(target)
            waiting.append(target)
    for state in option.states if reached else ():
        if state.name.text not in reached:
            message = f"no decision leads to state {state.name.text} of option {option.name.text}"
            report.add_finding(tokens, state.name.first_token, "X643", message, "lead to it or remove it")


def _check_option_cycles(
    calls: CallsByOption, homes: dict[str, Tokens], report: CompileReport
) -> dict[str, frozenset[str]]:
    """All options below each option; a call that leads back is told, and followed no further."""
    below: dict[str, frozenset[str]] = {}

    def look(name: str, path: tuple[str, ...]) -> frozenset[str]:
        if name in below:
            return below[name]
        found: set[str] = set()
        for _state, called in calls[name]:
            for call in called:
                callee = call.name.text
                if callee in (*path, name):
                    circle = " → ".join((*path, name)[(*path, name).index(callee) :]) + f" → {callee}"
                    message = f"option {callee} leads back to itself: {circle}"
                    report.add_finding(
                        homes[name], call.name.first_token, "X636", message, "no engine runs it; break the circle"
                    )
                elif callee in calls:
                    found |= {callee} | look(callee, (*path, name))
        below[name] = frozenset(found)
        return below[name]

    for name in calls:
        look(name, ())
    return below


def _check_double_execution(
    calls: CallsByOption, below: dict[str, frozenset[str]], homes: dict[str, Tokens], report: CompileReport
) -> None:
    """What two calls of one state both lead to is executed twice in a cycle, if both get there."""
    for name, states in calls.items():
        for state, called in states:
            seen: dict[str, tree.CallNode] = {}
            for call in called:
                reached = {call.name.text} | below.get(call.name.text, frozenset())
                twins = sorted(reached & seen.keys())
                if twins:
                    other = seen[twins[0]]
                    message = f"option {twins[0]} may be executed twice in a cycle of state {state.name.text}"
                    note = Note(
                        message="it may also be by this call", location=homes[name].location(other.name.first_token)
                    )
                    mend = "call it from one of them only"
                    report.add_finding(homes[name], call.name.first_token, "X647", message, mend, note=note)
                seen |= dict.fromkeys(reached - seen.keys(), call)


def _check_unused(source: ProgramSource, table: SymbolTable, report: CompileReport) -> None:
    uses: dict[int, int] = defaultdict(int)
    for _tokens, _at, declared in report.references:
        uses[id(declared)] += 1
    sets = _assigned_symbols(source)
    for declared in table.symbols("input", "output", "internal", "const"):
        if not uses[id(declared)]:
            _add_unused_finding(declared, report)
        elif declared.role == "internal" and declared.name not in sets:
            message = f"{declared.description} {declared.name} is read, but no action sets it"
            report.add_finding(
                declared.tokens, declared.name_node.first_token, "X645", message, "set it somewhere, or use a constant"
            )
    for declared in (*table.behaviors.values(), *table.options.values()):
        if not uses[id(declared)]:
            _add_unused_finding(declared, report)


def _assigned_symbols(source: ProgramSource) -> set[str]:
    blocks: list[tree.ActionBlockNode] = []
    for parsed in source.files.values():
        for item in parsed.file.body:
            if isinstance(item, tree.OptionNode):
                blocks += [state.actions for state in item.states]
                blocks += [item.common_actions] if item.common_actions else []
    return {each.symbol.text for block in blocks for each in block.actions if isinstance(each, tree.AssignmentNode)}


def _add_unused_finding(declared: Definition, report: CompileReport) -> None:
    message = f"nothing uses {declared.description} {declared.name}"
    report.add_finding(declared.tokens, declared.name_node.first_token, "X644", message, "use it or remove it")
