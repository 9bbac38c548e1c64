"""What the original never looked for: options that call themselves, states nobody reaches, words nobody uses."""

from collections import defaultdict
from collections.abc import Iterator

from vicode.findings import Note
from vicode.xabsl import tree
from vicode.xabsl.declared import Declared, Table
from vicode.xabsl.declaring import Report
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.sources import Source

Callers = dict[str, list[tuple[tree.State, list[tree.Call]]]]


def check_meaning(source: Source, table: Table, report: Report) -> None:
    """Look at a program whose names are bound."""
    calls: Callers = {}
    homes: dict[str, Tokens] = {}
    for parsed in source.files.values():
        for item in parsed.file.body:
            if isinstance(item, tree.Option):
                _look_for_unreached(item, parsed.tokens, report)
                calls[item.name.text] = [(state, _calls(item, state, table)) for state in item.states]
                homes[item.name.text] = parsed.tokens
    below = _look_for_cycles(calls, homes, report)
    _look_for_twins(calls, below, homes, report)
    _look_for_unused(source, table, report)


def _calls(option: tree.Option, state: tree.State, table: Table) -> list[tree.Call]:
    """The options that a state calls, common actions first."""
    actions = [*(option.common_actions.actions if option.common_actions else ()), *state.actions.actions]
    return [
        each
        for each in actions
        if isinstance(each, tree.Call) and each.kind != "behavior" and each.name.text in table.options
    ]


def _targets(node: tree.Tree | None) -> Iterator[str]:
    while isinstance(node, tree.If | tree.Block):
        if isinstance(node, tree.If):
            yield from _targets(node.then)
        node = node.otherwise if isinstance(node, tree.If) else node.inner
    if isinstance(node, tree.Goto):
        yield node.state.text


def _look_for_unreached(option: tree.Option, tokens: Tokens, report: Report) -> None:
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
            report.complain(tokens, state.name.at, "X643", message, "lead to it or remove it")


def _look_for_cycles(calls: Callers, homes: dict[str, Tokens], report: Report) -> dict[str, frozenset[str]]:
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
                    report.complain(homes[name], call.name.at, "X636", message, "no engine runs it; break the circle")
                elif callee in calls:
                    found |= {callee} | look(callee, (*path, name))
        below[name] = frozenset(found)
        return below[name]

    for name in calls:
        look(name, ())
    return below


def _look_for_twins(calls: Callers, below: dict[str, frozenset[str]], homes: dict[str, Tokens], report: Report) -> None:
    """What two calls of one state both lead to is executed twice in a cycle, if both get there."""
    for name, states in calls.items():
        for state, called in states:
            seen: dict[str, tree.Call] = {}
            for call in called:
                reached = {call.name.text} | below.get(call.name.text, frozenset())
                twins = sorted(reached & seen.keys())
                if twins:
                    other = seen[twins[0]]
                    message = f"option {twins[0]} may be executed twice in a cycle of state {state.name.text}"
                    note = Note(message="it may also be by this call", place=homes[name].place(other.name.at))
                    mend = "call it from one of them only"
                    report.complain(homes[name], call.name.at, "X647", message, mend, note=note)
                seen |= dict.fromkeys(reached - seen.keys(), call)


def _look_for_unused(source: Source, table: Table, report: Report) -> None:
    uses: dict[int, int] = defaultdict(int)
    for _tokens, _at, declared in report.uses:
        uses[id(declared)] += 1
    sets = _set_symbols(source)
    for declared in table.symbols("input", "output", "internal", "const"):
        if not uses[id(declared)]:
            _tell_unused(declared, report)
        elif declared.role == "internal" and declared.name not in sets:
            message = f"{declared.what} {declared.name} is read, but no action sets it"
            report.complain(declared.tokens, declared.word.at, "X645", message, "set it somewhere, or use a constant")
    for declared in (*table.behaviors.values(), *table.options.values()):
        if not uses[id(declared)]:
            _tell_unused(declared, report)


def _set_symbols(source: Source) -> set[str]:
    blocks: list[tree.Actions] = []
    for parsed in source.files.values():
        for item in parsed.file.body:
            if isinstance(item, tree.Option):
                blocks += [state.actions for state in item.states]
                blocks += [item.common_actions] if item.common_actions else []
    return {each.symbol.text for block in blocks for each in block.actions if isinstance(each, tree.Assignment)}


def _tell_unused(declared: Declared, report: Report) -> None:
    message = f"nothing uses {declared.what} {declared.name}"
    report.complain(declared.tokens, declared.word.at, "X644", message, "use it or remove it")
