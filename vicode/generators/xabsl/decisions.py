"""Build XABSL decision trees, which are complete: every `if` has an `else`."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

from vicode.findings import DesignPath
from vicode.generators.plan import Branch, DecisionPlan, NoChange, StateChange
from vicode.generators.xabsl.expression_builder import XabslExpressionBuilder, conjunction, negation
from vicode.generators.xabsl.option_printer import description_line
from vicode.xabsl import tree


@dataclass(frozen=True, slots=True)
class _DecisionItem:
    """A decision with its own tests and the tests of the enclosing groups that were dissolved."""

    around: tuple[tree.ExpressionNode, ...]
    own: tuple[tree.ExpressionNode, ...]
    outcome: StateChange | NoChange | Branch
    doc: str
    path: DesignPath

    @property
    def tests(self) -> tuple[tree.ExpressionNode, ...]:
        return (*self.around, *self.own)

    def inside(self, *tests: tree.ExpressionNode) -> "_DecisionItem":
        """Add the tests of an enclosing group."""
        return replace(self, around=(*tests, *self.around))


@dataclass(frozen=True, slots=True)
class _Continuation:
    """Builds the tree that applies if no earlier decision did; a leaf has no tests, so it may be built twice."""

    build: Callable[[], tree.DecisionTreeNode | None]
    is_leaf: bool


@dataclass(slots=True)
class DecisionTreeBuilder:
    """Builds the trees of one option.

    Attributes:
        node_paths: The paths of the decisions that the nodes come from.
        unplaced_docs: Descriptions that XABSL has no syntax for, by tree.
    """

    expressions: XabslExpressionBuilder
    state_name: Callable[[str], str]
    node_paths: list[tuple[tree.DecisionTreeNode, DesignPath]] = field(default_factory=list)
    unplaced_docs: list[tuple[tree.SyntaxNode, str]] = field(default_factory=list)
    _docs: dict[int, str] = field(default_factory=dict)

    def build_complete(self, alternatives: Sequence[tuple[str, DecisionPlan]]) -> tree.DecisionTreeNode:
        """Build the tree of decisions, each with its state (or COMMON); without a match the state stays."""
        items = [item for state, decision in alternatives for item in self._items([decision], state)]
        node = self._build_chain(items, _Continuation(tree.StayNode, is_leaf=True))
        assert node is not None
        return self._with_doc(node)

    def build_open(self, alternatives: Sequence[DecisionPlan], state: str) -> tree.DecisionTreeNode:
        """Build the tree of a common decision, which has no final `else`: the decisions of the states follow."""
        node = self._build_chain(list(self._items(alternatives, state)), _Continuation(lambda: None, is_leaf=False))
        assert node is not None
        return self._with_doc(node)

    def pop_else_doc(self, node: tree.DecisionTreeNode) -> str:
        """Remove the description of a tree and return it; it is printed before the `else`."""
        doc = node.doc if isinstance(node, tree.IfNode) else ""
        if isinstance(node, tree.IfNode):
            node.doc = ""
        return doc or self._pop_doc(node)

    def _items(self, alternatives: Sequence[DecisionPlan], state: str) -> Iterator[_DecisionItem]:
        for decision in alternatives:
            own = self.expressions.build_conditions(decision.conditions, state)
            outcome = decision.outcome
            if isinstance(outcome, Branch):
                outcome = _OwnedBranch(
                    then=outcome.then,
                    otherwise=outcome.otherwise,
                    then_always_ends=outcome.then_always_ends,
                    state=state,
                )
            yield _DecisionItem((), own, outcome, description_line(decision.doc), decision.path)

    def _build_chain(self, items: Sequence[_DecisionItem], follow: _Continuation) -> tree.DecisionTreeNode | None:
        """Build the items in order, followed by `follow`."""
        for item in reversed(items):
            is_leaf = not item.tests and not isinstance(item.outcome, Branch)
            follow = _Continuation(partial(self._build_item, item, follow), is_leaf)
        return follow.build()

    def _build_item(self, item: _DecisionItem, follow: _Continuation) -> tree.DecisionTreeNode | None:
        outcome = item.outcome
        if isinstance(outcome, _OwnedBranch):
            return self._build_branch(item, outcome, follow)
        assert not isinstance(outcome, Branch)
        leaf = (
            tree.StayNode()
            if isinstance(outcome, NoChange)
            else tree.GotoNode(tree.NameNode(self.state_name(outcome.state)))
        )
        if not item.tests:
            self.node_paths.append((leaf, item.path))
            self._docs[id(leaf)] = item.doc
            return leaf
        node = tree.IfNode(conjunction(item.tests), leaf, None, doc=item.doc)
        self.node_paths.append((node, item.path))
        return self._with_else(node, follow.build())

    def _build_branch(
        self, item: _DecisionItem, branch: "_OwnedBranch", follow: _Continuation
    ) -> tree.DecisionTreeNode | None:
        inner = list(self._items(branch.then, branch.state))
        others = list(self._items(branch.otherwise, branch.state))
        if not item.tests:
            return self._build_chain(inner, follow)
        test = conjunction(item.tests)
        must_open = not branch.then_always_ends and not follow.is_leaf
        if must_open or (item.around and others):
            # Falling through must reach `follow`. Repeating it in each branch would grow exponentially with the groups.
            before = [nested.inside(test) for nested in inner]
            after = [other.inside(*item.around, negation(conjunction(item.own))) for other in others]
            chain = self._build_chain([*before, *after], follow)
            if item.doc and isinstance(chain, tree.IfNode) and not chain.doc:
                chain.doc = item.doc
            return chain
        then = self._build_chain(inner, follow)
        assert then is not None
        block = tree.BlockNode(self._with_doc(then)) if isinstance(then, tree.IfNode) else self._with_doc(then)
        node = tree.IfNode(test, block, None, doc=item.doc)
        return self._with_else(node, self._build_chain(others, follow))

    def _with_else(self, node: tree.IfNode, otherwise: tree.DecisionTreeNode | None) -> tree.IfNode:
        if otherwise is not None:
            node.else_doc = self.pop_else_doc(otherwise)
            node.otherwise = otherwise
        return node

    def _with_doc(self, node: tree.DecisionTreeNode) -> tree.DecisionTreeNode:
        """Keep the description of a tree without an `else` before it; only an `if` can hold one itself."""
        doc = self._pop_doc(node)
        if doc:
            self.unplaced_docs.append((node, doc))
        return node

    def _pop_doc(self, node: tree.DecisionTreeNode) -> str:
        return self._docs.pop(id(node), "")


@dataclass(frozen=True, slots=True, kw_only=True)
class _OwnedBranch(Branch):
    """A branch with the state whose decision it is."""

    state: str


def can_be_common_decision(alternatives: Sequence[DecisionPlan]) -> bool:
    """Whether decisions can form a common decision: all have conditions, groups always end, none keeps the state."""
    return bool(alternatives) and all(item.conditions and _can_end_in_common(item.outcome) for item in alternatives)


def _can_end_in_common(outcome: StateChange | NoChange | Branch) -> bool:
    match outcome:
        case StateChange():
            return True
        case NoChange():
            return False
        case Branch(then=then, otherwise=otherwise, then_always_ends=then_ends):
            return then_ends and not _may_keep_state(then) and (not otherwise or can_be_common_decision(otherwise))


def _may_keep_state(alternatives: Sequence[DecisionPlan]) -> bool:
    return any(
        isinstance(item.outcome, NoChange)
        or (isinstance(item.outcome, Branch) and _may_keep_state((*item.outcome.then, *item.outcome.otherwise)))
        for item in alternatives
    )
