"""An option of XABSL as a design: its states, decision trees as groups, actions, parameters."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from vicode.findings import Path
from vicode.importers.comments import Anchor, is_code, place_remarks, words_of
from vicode.importers.expressions import Wording
from vicode.importers.names import Names, other_name
from vicode.importers.vocabulary import Remark, Vocabulary, declaration_of
from vicode.model.design import (
    Action,
    Assign,
    Call,
    Common,
    Decision,
    Declaration,
    Design,
    Group,
    Guard,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.xabsl import tree
from vicode.xabsl.declared import Declared
from vicode.xabsl.lexer import Comment, Tokens
from vicode.xabsl.parser import Parsed

Meanings = dict[tuple[int, int], Declared]
"""What a word means: by the identity of its file's tokens and its number."""


@dataclass(slots=True)
class OptionImporter:
    """Makes the design of one option."""

    vocabulary: Vocabulary
    meanings: Meanings
    parsed: Parsed
    declared: Declared
    names: Names = field(init=False)
    states: dict[str, str] = field(init=False)
    uses: dict[str, str] = field(default_factory=dict)
    anchors: list[Anchor] = field(default_factory=list)
    own: dict[Declared, str] = field(default_factory=dict)
    wording: Wording = field(init=False)
    _comments: dict[int, list[Comment]] = field(init=False)

    def __post_init__(self) -> None:
        """Name what belongs to the option alone."""
        self.names = Names(self.vocabulary.shared_names)
        self.own = {each: self.names.give(each.name) for each in self.declared.parameters.values()}
        given = Names()
        self.states = {name: given.give(name) for name in self.declared.states}
        self.wording = Wording(self.parsed.tokens, self._meaning, self._name)
        self._comments = dict(self.parsed.file.comments)

    def design(self) -> tuple[Design, list[Remark]]:
        """The design, and the comments that have no other place in it."""
        option = self.option
        component = self.vocabulary.components[self.declared]
        self.anchors.append((option.at, ("component",)))
        parameters = tuple(self._parameters())
        common = self._common()
        states = tuple(self._state(each) for each in option.states)
        initial = next(each.name.text for each in option.states if each.is_initial)
        design = Design(
            component=component,
            xabsl_name=other_name(component, option.name.text),
            doc=option.doc,
            arithmetic="xabsl",
            time_unit="ms",
            uses=tuple(Use(alias=alias, component=used) for used, alias in self.uses.items()),
            parameters=parameters,
            initial=self.states[initial],
            common=common,
            states=states,
        )
        remarks = list(place_remarks(self._comments, self.anchors))
        head = self.parsed.file.initial
        return design, [*([((), head)] if head else []), *remarks]

    @property
    def option(self) -> tree.Option:
        """What was written."""
        assert isinstance(self.declared.node, tree.Option)
        return self.declared.node

    def _meaning(self, tokens: Tokens, at: int) -> Declared:
        return self.meanings[id(tokens), at]

    def _name(self, declared: Declared) -> str:
        """How this design says what a word means."""
        if declared in self.own:
            return self.own[declared]
        if declared in self.vocabulary.symbols:
            component, name = self.vocabulary.symbols[declared]
            return f"{self._alias(component)}.{name}"
        return self.vocabulary.plain[declared]

    def _alias(self, component: str) -> str:
        if component not in self.uses:
            self.uses[component] = self.names.give(component)
        return self.uses[component]

    def _parameters(self) -> Iterator[Declaration]:
        for each, name in self.own.items():
            assert isinstance(each.node, tree.Parameter)
            self.anchors.append((each.node.at, ("parameters", name)))
            yield declaration_of(each.node, each, name, self.vocabulary)

    def _common(self) -> Common:
        path: Path = ("common",)
        decision, actions = self.option.common_decision, self.option.common_actions
        transitions: tuple[Decision, ...] = ()
        if decision is not None:
            self.anchors.append((decision.at - 3, path))
            transitions = self._decisions(decision, "", (*path, "transitions"))
        return Common(transitions=transitions, actions=self._actions(actions, (*path, "actions")))

    def _state(self, state: tree.State) -> State:
        name = self.states[state.name.text]
        path: Path = ("states", name)
        doc = self._words_before(state)
        self.anchors.append((state.at, path))
        transitions: tuple[Decision, ...] = ()
        if state.decision is not None:
            at = (*path, "transitions")
            self.anchors.append((state.decision.at, path))
            transitions = self._decisions(state.decision.tree, state.decision.else_doc, at)
            # Nobody needs to be told that what has no reason to change stays.
            if isinstance(transitions[-1], Stay) and not transitions[-1].doc:
                transitions = transitions[:-1]
        actions = self._actions(state.actions, (*path, "actions"))
        number = float(state.robots or 0)
        return State(
            name=name,
            xabsl_name=other_name(name, state.name.text),
            doc=doc,
            final=state.is_target,
            capacity=number if state.cooperation == "capacity" else None,
            synchronized=number if state.cooperation == "synchronized" else None,
            transitions=transitions,
            actions=actions,
        )

    def _words_before(self, state: tree.State) -> str:
        """Comments right before a state say what it is for, as no others may stand there."""
        found = [each for each in self._comments.get(state.at, ()) if each.own_line]
        words = words_of(found)
        if not words or is_code(words):
            return ""
        self._comments[state.at] = [each for each in self._comments[state.at] if not each.own_line]
        return words

    # Decisions

    def _decisions(self, node: tree.Tree, doc: str, path: Path) -> tuple[Decision, ...]:
        """A tree as a list: what is tested when the one before does not hold follows it."""
        made: list[Decision] = []
        current: tree.Tree | None = node
        while current is not None:
            here = (*path, len(made))
            self.anchors.append((current.at, here))
            match current:
                case tree.Block(inner=inner):
                    current = inner
                case tree.Goto() | tree.Stay():
                    made.append(self._leaf(current, Guard(), doc))
                    current = None
                case tree.If():
                    made.append(self._branch(current, _both(doc, current.doc), here))
                    doc, current = current.else_doc, current.otherwise
        return tuple(made)

    def _branch(self, node: tree.If, doc: str, path: Path) -> Decision:
        guard = self._guard(node.condition)
        then = node.then
        while isinstance(then, tree.Block):
            then = then.inner
        if isinstance(then, tree.Goto | tree.Stay):
            self.anchors.append((then.at, path))
            return self._leaf(then, guard, doc)
        return Group(guard=guard, then=self._decisions(then, "", (*path, "then")), doc=doc)

    def _leaf(self, node: tree.Goto | tree.Stay, guard: Guard, doc: str) -> Decision:
        if isinstance(node, tree.Stay):
            return Stay(guard=guard, doc=doc)
        return Transition(to=self.states[node.state.text], guard=guard, doc=doc)

    def _guard(self, condition: tree.Expression) -> Guard:
        """A condition; that so much time has passed is said as people do."""
        after = self._time_in(condition)
        if after:
            return Guard(after=after)
        if isinstance(condition, tree.Binary) and condition.operator == "&&":
            after = self._time_in(condition.left)
            if after:
                return Guard(after=after, when=self.wording.spell(condition.right))
        return Guard(when=self.wording.spell(condition))

    def _time_in(self, condition: tree.Expression) -> str:
        match condition:
            case tree.Parentheses(inner=inner):
                return self._time_in(inner)
            case tree.Binary(operator=">=", left=tree.Word(text="state_time"), right=tree.Number() as number):
                return self.wording.spell(number)
            case tree.Binary(operator=">=", left=tree.Word(text="state_time"), right=tree.Ref() as ref):
                named = self._meaning(self.parsed.tokens, ref.at).node
                is_time = isinstance(named, tree.Constant) and not named.number.startswith("-")
                return self.wording.spell(ref) if is_time else ""
            case _:
                return ""

    # Actions

    def _actions(self, actions: tree.Actions | None, path: Path) -> tuple[Action, ...]:
        made: list[Action] = []
        for each in actions.actions if actions else ():
            made = self._add(made, each)
            self.anchors.append((each.at, (*path, len(made) - 1)))
        return tuple(made)

    def _add(self, made: list[Action], action: tree.Action) -> list[Action]:
        """The actions with one more; assignments that follow each other stand together."""
        if isinstance(action, tree.Call):
            called = self._meaning(self.parsed.tokens, action.name.at)
            alias = self._alias(self.vocabulary.components[called])
            names = {each: self._parameter_name(called, each) for each in called.parameters.values()}
            wording = replace(self.wording, name=lambda each: names.get(each) or self._name(each))
            return [*made, Call(alias=alias, arguments=wording.arguments(action.arguments))]
        symbol = self._meaning(self.parsed.tokens, action.symbol.at)
        pair = (self._name(symbol), self.wording.spell(action.value))
        last = made[-1] if made else None
        if isinstance(last, Assign) and pair[0] not in dict(last.values):
            return [*made[:-1], Assign(values=(*last.values, pair))]
        return [*made, Assign(values=(pair,))]

    def _parameter_name(self, called: Declared, parameter: Declared) -> str:
        """The name of a parameter in the design that is called, which gives names in the same order."""
        if called.role == "behavior":
            return self.vocabulary.plain[parameter]
        names = Names(self.vocabulary.shared_names)
        return {each: names.give(each.name) for each in called.parameters.values()}[parameter]


def _both(first: str, second: str) -> str:
    return "\n".join(each for each in (first, second) if each)
