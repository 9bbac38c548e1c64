"""Convert an XABSL option to a design; nested decision trees become groups."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from vicode.findings import DesignPath
from vicode.importers.comments import (
    Anchor,
    CommentPlaces,
    PlacedComment,
    comment_text,
    group_comments,
    looks_like_code,
    place_comments,
    place_header,
    plain_text,
)
from vicode.importers.declarations import ImportedDeclarations, convert_declaration
from vicode.importers.design_names import DesignNames, xabsl_name_or_empty
from vicode.importers.notes import TokenNote
from vicode.importers.xabsl_expressions import ExpressionTranslator
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

_MAX_GROUPS = 8
TokenReferences = dict[tuple[int, int], Definition]
"""Definitions by the id of the token list and the index of the token."""


@dataclass(slots=True)
class OptionImporter:
    """Converts one option to a design."""

    declarations: ImportedDeclarations
    references: TokenReferences
    parsed: ParsedFile
    definition: Definition
    names: DesignNames = field(init=False)
    states: dict[str, str] = field(init=False)
    uses: dict[str, str] = field(default_factory=dict)
    anchors: list[Anchor] = field(default_factory=list)
    places: CommentPlaces = field(default_factory=CommentPlaces)
    notes: list[TokenNote] = field(default_factory=list)
    parameter_names: dict[Definition, str] = field(default_factory=dict)
    translator: ExpressionTranslator = field(init=False)
    _comments: dict[int, list[Comment]] = field(init=False)

    def __post_init__(self) -> None:
        self.names = DesignNames(self.declarations.shared_names)
        self.parameter_names = {item: self.names.allocate(item.name) for item in self.definition.parameters.values()}
        state_names = DesignNames()
        self.states = {name: state_names.allocate(name) for name in self.definition.states}
        self.translator = ExpressionTranslator(self.parsed.tokens, self._resolve, self._design_name)
        self._comments = dict(self.parsed.file.comments)

    def import_design(self) -> tuple[Design, list[PlacedComment]]:
        option = self.option
        component = self.declarations.components[self.definition]
        self._add_anchor(option.first_token, ("component",))
        parameters = tuple(self._parameters())
        common = self._common()
        states = tuple(self._state(state) for state in option.states)
        initial = next(state.name.text for state in option.states if state.is_initial)
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
        header = place_header(self.parsed.tokens, self.parsed.file.header)
        return design, [*header, *place_comments(self._comments, self.places)]

    def _add_anchor(self, token: int, path: DesignPath) -> None:
        self.anchors.append((token, path))
        self.places.add(token, path)

    @property
    def option(self) -> tree.OptionNode:
        assert isinstance(self.definition.node, tree.OptionNode)
        return self.definition.node

    def _resolve(self, tokens: Tokens, token: int) -> Definition:
        return self.references[id(tokens), token]

    def _design_name(self, declared: Definition) -> str:
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
        for parameter, name in self.parameter_names.items():
            assert isinstance(parameter.node, tree.ParameterNode)
            self._add_anchor(parameter.node.first_token, ("parameters", name))
            yield convert_declaration(parameter.node, parameter, name, self.declarations)

    def _common(self) -> CommonSection:
        path: DesignPath = ("common",)
        decision, actions = self.option.common_decision, self.option.common_actions
        transitions: tuple[Decision, ...] = ()
        if decision is not None:
            self._add_anchor(decision.first_token - 3, path)
            transitions = self._decisions(decision, "", (*path, "transitions"))
            self.places.add_end(decision.last_token + 1, path)
        if actions is not None:
            self.places.add(actions.first_token - 2, path)
        return CommonSection(transitions=transitions, actions=self._actions(actions, (*path, "actions")))

    def _state(self, state: tree.StateNode) -> State:
        name = self.states[state.name.text]
        path: DesignPath = ("states", name)
        doc = self._leading_comment(state)
        self.anchors.append((state.first_token, path))
        # A comment above a state would become its description: new ones are written after its brace.
        self.places.add_end(state.first_token, path)
        transitions: tuple[Decision, ...] = ()
        keyword = state.actions.first_token - 1
        if state.decision is not None:
            self._add_anchor(state.decision.first_token, path)
            self.places.add_end(state.decision.last_token, path)
            transitions = self._decisions(state.decision.tree, state.decision.else_doc, (*path, "transitions"))
            # A final `stay` is the default.
            if isinstance(transitions[-1], Stay) and not transitions[-1].doc:
                transitions = transitions[:-1]
        has_place = state.decision is not None and bool(state.actions.actions)
        self.places.add(keyword, (*path, "actions") if has_place else path)
        actions = self._actions(state.actions, (*path, "actions"))
        self.places.add_end(state.last_token, path)
        robots = int(float(state.robots or 0))
        return State(
            name=name,
            xabsl_name=xabsl_name_or_empty(name, state.name.text),
            doc=doc,
            final=state.is_target,
            capacity=robots if state.cooperation == "capacity" else None,
            synchronized=robots if state.cooperation == "synchronized" else None,
            transitions=transitions,
            actions=actions,
        )

    def _leading_comment(self, state: tree.StateNode) -> str:
        """Take the comments directly before a state as its doc, up to a separator or a comment that contains code."""
        comments = self._comments.get(state.first_token, [])
        taken: list[Comment] = []
        for group in reversed(group_comments([comment for comment in comments if comment.own_line])):
            text = comment_text(group)
            if looks_like_code(text) or not any(char.isalnum() for char in text):
                break
            taken = [*group, *taken]
        text = comment_text(taken)
        if text:
            self._comments[state.first_token] = comments[: len(comments) - len(taken)]
        return text

    # Decisions

    def _decisions(self, node: tree.DecisionTreeNode, doc: str, path: DesignPath) -> tuple[Decision, ...]:
        """Flatten a tree to a list; the `else` branch of a decision follows it."""
        decisions: list[Decision] = []
        current: tree.DecisionTreeNode | None = node
        while current is not None:
            decision_path = (*path, len(decisions))
            self._add_anchor(current.first_token, decision_path)
            match current:
                case tree.BlockNode(inner=inner):
                    current = inner
                case tree.GotoNode() | tree.StayNode():
                    decisions.append(self._leaf(current, Guard(), doc))
                    current = None
                case tree.IfNode(otherwise=tree.SyntaxNode()) if self._is_inverted(current, path):
                    text = "decisions are nested too deeply: the design has the branches of this one in reverse order"
                    self.notes.append((current.first_token, text))
                    decisions.append(self._inverted_branch(current, self._join_docs(doc, current), decision_path))
                    doc, current = "", current.then
                case tree.IfNode():
                    decisions.append(self._branch(current, self._join_docs(doc, current), decision_path))
                    doc, current = current.else_doc, current.otherwise
        return tuple(decisions)

    def _branch(self, node: tree.IfNode, doc: str, path: DesignPath) -> Decision:
        guard = self._guard(node.condition)
        then = node.then
        while isinstance(then, tree.BlockNode):
            then = then.inner
        if isinstance(then, tree.GotoNode | tree.StayNode):
            self._add_anchor(then.first_token, path)
            return self._leaf(then, guard, doc)
        return DecisionGroup(guard=guard, then=self._decisions(then, "", (*path, "then")), doc=doc)

    def _join_docs(self, doc: str, node: tree.IfNode) -> str:
        """Join the description before an `else` and that before the `if` that follows."""
        if doc and node.doc:
            self.notes.append((node.first_token, "two descriptions of a decision: the design has them as one"))
        return _join_docs(doc, node.doc)

    def _is_inverted(self, node: tree.IfNode, path: DesignPath) -> bool:
        """Whether the first branch follows in the list and the second one forms a group.

        Files can hold only some groups inside each other; from there on, the deeper branch never starts a new group.
        """
        return path.count("then") >= _MAX_GROUPS and nesting(node.then) > nesting(node.otherwise)

    def _inverted_branch(self, node: tree.IfNode, doc: str, path: DesignPath) -> Decision:
        assert node.otherwise is not None
        guard = Guard(when=f"not ({self.translator.translate(node.condition)})")
        then = self._decisions(node.otherwise, node.else_doc, (*path, "then"))
        if len(then) == 1 and isinstance(then[0], Transition | Stay):
            return replace(then[0], guard=guard, doc=_join_docs(doc, then[0].doc))
        return DecisionGroup(guard=guard, then=then, doc=doc)

    def _leaf(self, node: tree.GotoNode | tree.StayNode, guard: Guard, doc: str) -> Decision:
        if isinstance(node, tree.StayNode):
            return Stay(guard=guard, doc=doc)
        return Transition(to=self.states[node.state.text], guard=guard, doc=doc)

    def _guard(self, condition: tree.ExpressionNode) -> Guard:
        """Convert a condition; a test of the state time becomes `after`."""
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
        converted: list[Action] = []
        place: DesignPath = path[:-1]
        for action in actions.actions if actions else ():
            converted = self._append_action(converted, action)
            last, here = converted[-1], (*path, len(converted) - 1)
            self.anchors.append((action.first_token, here))
            place = here
            if isinstance(last, Assign) and len(last.values) > 1:
                place = (*here, "set", last.values[-1][0])
            self.places.add(action.first_token, place)
        if actions is not None:
            self.places.add_end(actions.last_token, place)
        return tuple(converted)

    def _append_action(self, converted: list[Action], action: tree.ActionNode) -> list[Action]:
        """Append an action; consecutive assignments form one action, unless a comment stands above the second one."""
        if isinstance(action, tree.CallNode):
            called = self._resolve(self.parsed.tokens, action.name.first_token)
            alias = self._alias(self.declarations.components[called])
            names = {item: self._parameter_name(called, item) for item in called.parameters.values()}
            translator = replace(self.translator, design_name=lambda item: names.get(item) or self._design_name(item))
            return [*converted, Call(alias=alias, arguments=translator.translate_arguments(action.arguments))]
        symbol = self._resolve(self.parsed.tokens, action.symbol.first_token)
        pair = (self._design_name(symbol), self.translator.translate(action.value))
        last = converted[-1] if converted else None
        if isinstance(last, Assign) and pair[0] not in dict(last.values) and not self._has_comment(action):
            return [*converted[:-1], Assign(values=(*last.values, pair))]
        return [*converted, Assign(values=(pair,))]

    def _has_comment(self, action: tree.ActionNode) -> bool:
        return any(each.own_line and plain_text(each.text) for each in self._comments.get(action.first_token, ()))

    def _parameter_name(self, called: Definition, parameter: Definition) -> str:
        """Return the name of a parameter in the called design, which allocates its names in the same order."""
        if called.role == "behavior":
            return self.declarations.names[parameter]
        names = DesignNames(self.declarations.shared_names)
        return {item: names.allocate(item.name) for item in called.parameters.values()}[parameter]


def nesting(node: tree.DecisionTreeNode | None) -> int:
    """The number of decisions inside each other, not counting those that follow in an `else`."""
    deepest, pending = 0, [(node, 0)]
    while pending:
        current, depth = pending.pop()
        match current:
            case tree.BlockNode(inner=inner):
                pending.append((inner, depth))
            case tree.IfNode():
                deepest = max(deepest, depth + 1)
                pending += [(current.then, depth + 1), (current.otherwise, depth)]
    return deepest


def _join_docs(first: str, second: str) -> str:
    return "\n".join(doc for doc in (first, second) if doc)
