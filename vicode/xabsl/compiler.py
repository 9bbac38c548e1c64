"""Sources to a program: names bound, common decisions put before those of states, everything in its compiled order."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from vicode.findings import Finding, Severity, did_you_mean, sort_findings
from vicode.xabsl import tree
from vicode.xabsl.binding import Binder
from vicode.xabsl.checks import check_meaning
from vicode.xabsl.declared import BOOLEAN, Declared, Table
from vicode.xabsl.declaring import Report, declare
from vicode.xabsl.engine.program import Option, Program, Slot, State, Term
from vicode.xabsl.engine.symbols import Behavior, Symbol, Symbols
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.ranges import look_at_range
from vicode.xabsl.sources import Source

_MODES = {"": "n", "capacity": "c", "synchronized": "s"}


@dataclass(slots=True)
class Compiled:
    """What came of it: no program where a finding is an error. `uses` tell which word means which declaration."""

    program: Program | None
    table: Table
    findings: tuple[Finding, ...]
    uses: list[tuple[Tokens, int, Declared]] = field(default_factory=list)


def compile_source(source: Source) -> Compiled:
    """Compile a program that was loaded."""
    report = Report()
    table = declare(source, report)
    options: list[Option] = []
    agents: list[tuple[str, str]] = []
    for parsed in source.files.values():
        for item in parsed.file.body:
            if isinstance(item, tree.Option):
                options.append(_OptionCompiler(table, report, parsed.tokens, item).compile())
            elif isinstance(item, tree.Agent):
                agents.append((item.name.text, _root(item, table, report, parsed.tokens)))
    check_meaning(source, table, report)
    findings = sort_findings([*source.findings, *report.findings])
    is_sound = not any(each.severity is Severity.ERROR for each in findings)
    program = Program(
        options=tuple(sorted(options, key=lambda option: option.name.lower())),
        agents=tuple(agents),
        enums=_internal_enums(table),
        symbols=_internal_symbols(table),
        title=source.title,
    )
    return Compiled(program if is_sound else None, table, findings, report.uses)


def symbols_of(table: Table) -> Symbols:
    """What a robot program must have, as declared."""
    enums = [(each, tuple(element.full for element in each.elements.values())) for each in table.enums.values()]
    return Symbols(
        enums=tuple((each.name, elements) for each, elements in enums if not _is_internal(each)),
        internal_enums=tuple((each.name, elements) for each, elements in enums if _is_internal(each)),
        symbols=tuple(
            Symbol(each.role, each.kind, each.name, each.enum, tuple(map(_slot, each.parameters.values())))
            for each in table.symbols("input", "output", "internal")
        ),
        behaviors=tuple(
            Behavior(each.name, tuple(map(_slot, each.parameters.values()))) for each in table.behaviors.values()
        ),
    )


def _is_internal(enum: Declared) -> bool:
    return isinstance(enum.node, tree.Enumeration) and enum.node.is_internal


def _root(agent: tree.Agent, table: Table, report: Report, tokens: Tokens) -> str:
    root = table.options.get(agent.root.text)
    if root is None:
        mend = did_you_mean(agent.root.text, table.options, "include the file of the option")
        report.complain(tokens, agent.root.at, "X621", f"no option {agent.root.text}", mend)
    else:
        report.uses.append((tokens, agent.root.at, root))
    return agent.root.text


def _internal_enums(table: Table) -> tuple[tuple[str, tuple[str, ...]], ...]:
    found = [
        (each.name, tuple(element.full for element in each.elements.values()))
        for each in table.enums.values()
        if _is_internal(each)
    ]
    return tuple(sorted(found, key=lambda each: each[0].lower()))


def _internal_symbols(table: Table) -> tuple[Slot, ...]:
    slots = (_slot(each) for each in table.symbols("internal"))
    return tuple(sorted(slots, key=lambda slot: slot.name.lower()))


def _slot(declared: Declared) -> Slot:
    return Slot(declared.kind, declared.full, declared.enum)


class _OptionCompiler:
    """Compiles one option."""

    def __init__(self, table: Table, report: Report, tokens: Tokens, option: tree.Option) -> None:
        self.table, self.report, self.tokens, self.option = table, report, tokens, option
        self.declared = self._own()
        self.binder = Binder(table, report, tokens, self.declared.parameters)

    def _own(self) -> Declared:
        """The declaration of this option, which may be the second of its name."""
        found = self.table.options[self.option.name.text]
        if found.node is self.option:
            return found
        return Declared("option", found.name, self.tokens, self.option.name, self.option, full=found.name)

    def compile(self) -> Option:
        """The option as the engine has it."""
        common = self.option.common_decision
        before = self._open_tree(common) if common is not None else None
        actions = self._actions(self.option.common_actions)
        states = tuple(self._state(each, before, actions) for each in self.option.states)
        slots = tuple(_slot(each) for each in self.declared.parameters.values())
        return Option(self.option.name.text, self._initial(), states, slots)

    def _initial(self) -> str:
        initial = [each for each in self.option.states if each.is_initial]
        if not initial:
            name = self.option.name
            message = f"option {name.text} has no initial state"
            self.binder.complain(name.at, "X628", message, "write initial before one of its states")
            return ""
        for each in initial[1:]:
            message = f"a second initial state: {each.name.text}"
            self.binder.complain(each.name.at, "X629", message, f"the first is {initial[0].name.text}")
        return initial[0].name.text

    def _state(self, state: tree.State, before: "_OpenTree | None", common: tuple[Term, ...]) -> State:
        name = state.name.text
        stay: Term = ("t", name)
        decision = state.decision
        if decision is None:
            own = stay
        else:
            self._look_at_else(decision, has_common=before is not None)
            own = self._tree(decision.tree, stay)
        return State(
            name=name,
            decision=before.closed(own) if before is not None else own,
            actions=(*common, *self._actions(state.actions)),
            is_target=state.is_target,
            mode=_MODES[state.cooperation],
            robots=int(float(state.robots)) if state.robots else 0,
        )

    def _look_at_else(self, decision: tree.Decision, *, has_common: bool) -> None:
        if has_common and not decision.begins_with_else:
            message = "the decision goes on after the common one, and does not begin with else"
            self.binder.complain(decision.at, "X641", message, "write else before it")
        if decision.begins_with_else and not has_common:
            message = "the decision begins with else, but the option has no common decision"
            self.binder.complain(decision.at, "X632", message, "remove else")

    def _tree(self, node: tree.Tree, stay: Term) -> Term:
        match node:
            case tree.Goto():
                return ("t", self._target(node))
            case tree.Stay():
                return stay
            case tree.Block():
                return self._tree(node.inner, stay)
            case tree.If():
                condition = self.binder.value(node.condition, BOOLEAN)
                assert node.otherwise is not None
                return ("i", condition, self._tree(node.then, stay), self._tree(node.otherwise, stay))

    def _target(self, goto: tree.Goto) -> str:
        name = goto.state.text
        state = self.declared.states.get(name)
        if state is None:
            mend = did_you_mean(name, self.declared.states, f"option {self.option.name.text} has no such state")
            self.binder.complain(goto.state.at, "X621", f"no state {name}", mend)
        else:
            self.report.uses.append((self.tokens, goto.state.at, state))
        return name

    def _open_tree(self, node: tree.Tree) -> "_OpenTree":
        """A common decision, which ends in what the state decides."""
        while isinstance(node, tree.Block):
            node = node.inner
        branches: list[tuple[Term, Term]] = []
        current: tree.Tree | None = node
        while isinstance(current, tree.If | tree.Block):
            if isinstance(current, tree.Block):
                current = current.inner
                continue
            self._look_for_stay(current.then)
            condition = self.binder.value(current.condition, BOOLEAN)
            branches.append((condition, self._tree(current.then, ("t", ""))))
            current = current.otherwise
        return _OpenTree(branches)

    def _look_for_stay(self, node: tree.Tree) -> None:
        """In a common decision nobody knows which state it would be to stay in."""
        match node:
            case tree.Stay():
                self.binder.complain(node.at, "X633", "stay in a common decision", "write goto and the state's name")
            case tree.Block():
                self._look_for_stay(node.inner)
            case tree.If():
                self._look_for_stay(node.then)
                if node.otherwise is not None:
                    self._look_for_stay(node.otherwise)

    def _actions(self, actions: tree.Actions | None) -> tuple[Term, ...]:
        terms = [self._action(each) for each in actions.actions] if actions else []
        return tuple(term for term in terms if term is not None)

    def _action(self, action: tree.Action) -> Term | None:
        if isinstance(action, tree.Assignment):
            return self._assignment(action)
        name = action.name.text
        found = [each for each in self.table.callable.get(name, ()) if not action.kind or each.role == action.kind]
        if not found:
            what = action.kind or "option or basic behavior"
            mend = did_you_mean(name, self.table.callable, f"declare behavior {name}, or include its option's file")
            self.binder.complain(action.name.at, "X621", f"no {what} {name}", mend)
            return None
        if len(found) > 1:
            mend = f"write {name} option(…) or {name} behavior(…)"
            self.binder.complain(action.name.at, "X622", f"{name} is an option and a basic behavior", mend)
        self.report.uses.append((self.tokens, action.name.at, found[0]))
        letter = "o" if found[0].role == "option" else "a"
        return (letter, name, self.binder.given(found[0], action.arguments))

    def _assignment(self, action: tree.Assignment) -> Term | None:
        name = action.symbol.text
        found = self.table.assignable.get(name, [])
        if not found:
            others = self.table.readable.get(name)
            if others:
                message = f"{others[0].what} {name} cannot be set"
                self.binder.complain(action.symbol.at, "X624", message, "set an output or internal symbol")
            else:
                mend = did_you_mean(name, self.table.assignable, "declare it as an output or internal symbol")
                self.binder.complain(action.symbol.at, "X621", f"no output symbol {name}", mend)
            return None
        if len(found) > 1:
            whats = " and ".join(each.what for each in found)
            self.binder.complain(action.symbol.at, "X622", f"{name} may mean {whats}", "rename one of them")
        symbol = found[0]
        self.report.uses.append((self.tokens, action.symbol.at, symbol))
        look_at_range(self.report, self.tokens, action.value, symbol)
        return (symbol.kind, name, self.binder.value(action.value, symbol.kind, symbol.enum))


@dataclass(slots=True)
class _OpenTree:
    """Conditions with what follows from them; what follows from none is left open."""

    branches: Iterable[tuple[Term, Term]]

    def closed(self, last: Term) -> Term:
        """The tree that ends in `last`."""
        for condition, then in reversed(list(self.branches)):
            last = ("i", condition, then, last)
        return last
