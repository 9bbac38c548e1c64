"""An option of XABSL as a design: its states, decision trees as groups, actions, parameters."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from vicode.findings import DesignPath
from vicode.importers.comments import Anchor, comment_text, looks_like_code, place_comments
from vicode.importers.declarations import ImportedDeclarations, PlacedComment, convert_declaration
from vicode.importers.expressions import ExpressionTranslator
from vicode.importers.names import DesignNames, xabsl_name_or_empty
from vicode.model.design import (
    Action,
    Assign,
    Call,
    CommonSection,
    Decision,
    DecisionGroup,
    Declaration,
    Design,
    Guard,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.xabsl import tree
from vicode.xabsl.lexer import Comment, Tokens
from vicode.xabsl.parser import ParsedFile
from vicode.xabsl.symbol_table import Definition

TokenReferences = dict[tuple[int, int], Definition]
"""What a word means: by the identity of its file's tokens and its number."""


@dataclass(slots=True)
class OptionImporter:
    """Makes the design of one option."""

    declarations: ImportedDeclarations
    references: TokenReferences
    parsed: ParsedFile
    definition: Definition
    names: DesignNames = field(init=False)
    states: dict[str, str] = field(init=False)
    uses: dict[str, str] = field(default_factory=dict)
    anchors: list[Anchor] = field(default_factory=list)
    parameter_names: dict[Definition, str] = field(default_factory=dict)
    translator: ExpressionTranslator = field(init=False)
    _comments: dict[int, list[Comment]] = field(init=False)

    def __post_init__(self) -> None:
        """Name what belongs to the option alone."""
        self.names = DesignNames(self.declarations.shared_names)
        self.parameter_names = {each: self.names.allocate(each.name) for each in self.definition.parameters.values()}
        given = DesignNames()
        self.states = {name: given.allocate(name) for name in self.definition.states}
        self.translator = ExpressionTranslator(self.parsed.tokens, self._resolve, self._design_name)
        self._comments = dict(self.parsed.file.comments)

    def import_design(self) -> tuple[Design, list[PlacedComment]]:
        """The design, and the comments that have no other place in it."""
        option = self.option
        component = self.declarations.components[self.definition]
        self.anchors.append((option.first_token, ("component",)))
        parameters = tuple(self._parameters())
        common = self._common()
        states = tuple(self._state(each) for each in option.states)
        initial = next(each.name.text for each in option.states if each.is_initial)
        design = Design(
            component=component,
            xabsl_name=xabsl_name_or_empty(component, option.name.text),
            doc=option.doc,
            arithmetic="xabsl",
            time_unit="ms",
            uses=tuple(Use(alias=alias, component=used) for used, alias in self.uses.items()),
            parameters=parameters,
            initial=self.states[initial],
            common=common,
            states=states,
        )
        remarks = list(place_comments(self._comments, self.anchors))
        head = self.parsed.file.header
        return design, [*([((), head)] if head else []), *remarks]

    @property
    def option(self) -> tree.OptionNode:
        """What was written."""
        assert isinstance(self.definition.node, tree.OptionNode)
        return self.definition.node

    def _resolve(self, tokens: Tokens, at: int) -> Definition:
        return self.references[id(tokens), at]

    def _design_name(self, declared: Definition) -> str:
        """How this design says what a word means."""
        if declared in self.parameter_names:
            return self.parameter_names[declared]
        if declared in self.declarations.symbols:
            component, name = self.declarations.symbols[declared]
            return f"{self._alias(component)}.{name}"
        return self.declarations.names[declared]

    def _alias(self, component: str) -> str:
        if component not in self.uses:
            self.uses[component] = self.names.allocate(component)
        return self.uses[component]

    def _parameters(self) -> Iterator[Declaration]:
        for each, name in self.parameter_names.items():
            assert isinstance(each.node, tree.ParameterNode)
            self.anchors.append((each.node.first_token, ("parameters", name)))
            yield convert_declaration(each.node, each, name, self.declarations)

    def _common(self) -> CommonSection:
        path: DesignPath = ("common",)
        decision, actions = self.option.common_decision, self.option.common_actions
        transitions: tuple[Decision, ...] = ()
        if decision is not None:
            self.anchors.append((decision.first_token - 3, path))
            transitions = self._decisions(decision, "", (*path, "transitions"))
        return CommonSection(transitions=transitions, actions=self._actions(actions, (*path, "actions")))

    def _state(self, state: tree.StateNode) -> State:
        name = self.states[state.name.text]
        path: DesignPath = ("states", name)
        doc = self._leading_comment(state)
        self.anchors.append((state.first_token, path))
        transitions: tuple[Decision, ...] = ()
        if state.decision is not None:
            at = (*path, "transitions")
            self.anchors.append((state.decision.first_token, path))
            transitions = self._decisions(state.decision.tree, state.decision.else_doc, at)
            # Nobody needs to be told that what has no reason to change stays.
            if isinstance(transitions[-1], Stay) and not transitions[-1].doc:
                transitions = transitions[:-1]
        actions = self._actions(state.actions, (*path, "actions"))
        number = float(state.robots or 0)
        return State(
            name=name,
            xabsl_name=xabsl_name_or_empty(name, state.name.text),
            doc=doc,
            final=state.is_target,
            capacity=number if state.cooperation == "capacity" else None,
            synchronized=number if state.cooperation == "synchronized" else None,
            transitions=transitions,
            actions=actions,
        )

    def _leading_comment(self, state: tree.StateNode) -> str:
        """Comments right before a state say what it is for, as no others may stand there."""
        found = [each for each in self._comments.get(state.first_token, ()) if each.own_line]
        words = comment_text(found)
        if not words or looks_like_code(words):
            return ""
        self._comments[state.first_token] = [each for each in self._comments[state.first_token] if not each.own_line]
        return words

    # Decisions

    def _decisions(self, node: tree.DecisionTreeNode, doc: str, path: DesignPath) -> tuple[Decision, ...]:
        """A tree as a list: what is tested when the one before does not hold follows it."""
        made: list[Decision] = []
        current: tree.DecisionTreeNode | None = node
        while current is not None:
            here = (*path, len(made))
            self.anchors.append((current.first_token, here))
            match current:
                case tree.BlockNode(inner=inner):
                    current = inner
                case tree.GotoNode() | tree.StayNode():
                    made.append(self._leaf(current, Guard(), doc))
                    current = None
                case tree.IfNode():
                    made.append(self._branch(current, _join_docs(doc, current.doc), here))
                    doc, current = current.else_doc, current.otherwise
        return tuple(made)

    def _branch(self, node: tree.IfNode, doc: str, path: DesignPath) -> Decision:
        guard = self._guard(node.condition)
        then = node.then
        while isinstance(then, tree.BlockNode):
            then = then.inner
        if isinstance(then, tree.GotoNode | tree.StayNode):
            self.anchors.append((then.first_token, path))
            return self._leaf(then, guard, doc)
        return DecisionGroup(guard=guard, then=self._decisions(then, "", (*path, "then")), doc=doc)

    def _leaf(self, node: tree.GotoNode | tree.StayNode, guard: Guard, doc: str) -> Decision:
        if isinstance(node, tree.StayNode):
            return Stay(guard=guard, doc=doc)
        return Transition(to=self.states[node.state.text], guard=guard, doc=doc)

    def _guard(self, condition: tree.ExpressionNode) -> Guard:
        """A condition; that so much time has passed is said as people do."""
        after = self._elapsed_time(condition)
        if after:
            return Guard(after=after)
        if isinstance(condition, tree.BinaryNode) and condition.operator == "&&":
            after = self._elapsed_time(condition.left)
            if after:
                return Guard(after=after, when=self.translator.translate(condition.right))
        return Guard(when=self.translator.translate(condition))

    def _elapsed_time(self, condition: tree.ExpressionNode) -> str:
        match condition:
            case tree.ParenthesizedNode(inner=inner):
                return self._elapsed_time(inner)
            case tree.BinaryNode(
                operator=">=", left=tree.KeywordNode(text="state_time"), right=tree.NumberNode() as number
            ):
                return self.translator.translate(number)
            case tree.BinaryNode(
                operator=">=", left=tree.KeywordNode(text="state_time"), right=tree.ReferenceNode() as ref
            ):
                named = self._resolve(self.parsed.tokens, ref.first_token).node
                is_time = isinstance(named, tree.ConstantNode) and not named.number.startswith("-")
                return self.translator.translate(ref) if is_time else ""
            case _:
                return ""

    # Actions

    def _actions(self, actions: tree.ActionBlockNode | None, path: DesignPath) -> tuple[Action, ...]:
        made: list[Action] = []
        for each in actions.actions if actions else ():
            made = self._append_action(made, each)
            self.anchors.append((each.first_token, (*path, len(made) - 1)))
        return tuple(made)

    def _append_action(self, made: list[Action], action: tree.ActionNode) -> list[Action]:
        """The actions with one more; assignments that follow each other stand together."""
        if isinstance(action, tree.CallNode):
            called = self._resolve(self.parsed.tokens, action.name.first_token)
            alias = self._alias(self.declarations.components[called])
            names = {each: self._parameter_name(called, each) for each in called.parameters.values()}
            wording = replace(self.translator, design_name=lambda each: names.get(each) or self._design_name(each))
            return [*made, Call(alias=alias, arguments=wording.translate_arguments(action.arguments))]
        symbol = self._resolve(self.parsed.tokens, action.symbol.first_token)
        pair = (self._design_name(symbol), self.translator.translate(action.value))
        last = made[-1] if made else None
        if isinstance(last, Assign) and pair[0] not in dict(last.values):
            return [*made[:-1], Assign(values=(*last.values, pair))]
        return [*made, Assign(values=(pair,))]

    def _parameter_name(self, called: Definition, parameter: Definition) -> str:
        """The name of a parameter in the design that is called, which gives names in the same order."""
        if called.role == "behavior":
            return self.declarations.names[parameter]
        names = DesignNames(self.declarations.shared_names)
        return {each: names.allocate(each.name) for each in called.parameters.values()}[parameter]


def _join_docs(first: str, second: str) -> str:
    return "\n".join(each for each in (first, second) if each)
