"""Decisions of a design as complete trees: every `if` has its `else`, and what is exhausted stays."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

from vicode.findings import DesignPath
from vicode.generators.plan import Branch, DecisionPlan, NoChange, StateChange
from vicode.generators.xabsl.expressions import XabslExpressionBuilder, conjunction, negation
from vicode.generators.xabsl.option_printer import description_line
from vicode.xabsl import tree


@dataclass(frozen=True, slots=True)
class _DecisionItem:
    """An alternative with what is asked for it: by the groups that were opened around it, and by itself."""

    around: tuple[tree.ExpressionNode, ...]
    own: tuple[tree.ExpressionNode, ...]
    outcome: StateChange | NoChange | Branch
    doc: str
    path: DesignPath

    @property
    def tests(self) -> tuple[tree.ExpressionNode, ...]:
        """All of it."""
        return (*self.around, *self.own)

    def inside(self, *tests: tree.ExpressionNode) -> "_DecisionItem":
        """The same in a group that asks these."""
        return replace(self, around=(*tests, *self.around))


@dataclass(frozen=True, slots=True)
class _Continuation:
    """What follows when nothing before it was taken; `is_leaf`: it asks nothing, so that it may be said twice."""

    build: Callable[[], tree.DecisionTreeNode | None]
    is_leaf: bool


@dataclass(slots=True)
class DecisionTreeBuilder:
    """Builds the trees of one option, and notes from which decision each outcome comes.

    `unplaced_docs` are descriptions that the language has no place for, by the tree they belong to.
    """

    expressions: XabslExpressionBuilder
    state_name: Callable[[str], str]
    node_paths: list[tuple[tree.DecisionTreeNode, DesignPath]] = field(default_factory=list)
    unplaced_docs: list[tuple[tree.SyntaxNode, str]] = field(default_factory=list)
    _docs: dict[int, str] = field(default_factory=dict)

    def build_complete(self, alternatives: Sequence[tuple[str, DecisionPlan]]) -> tree.DecisionTreeNode:
        """The tree of alternatives, each with the state (or COMMON) whose decision it is."""
        items = [item for state, each in alternatives for item in self._items([each], state)]
        found = self._build_chain(items, _Continuation(tree.StayNode, is_leaf=True))
        assert found is not None
        return self._with_doc(found)

    def build_open(self, alternatives: Sequence[DecisionPlan], state: str) -> tree.DecisionTreeNode:
        """The tree of alternatives that `can_be_common_decision` holds for, which ends where the states go on."""
        found = self._build_chain(list(self._items(alternatives, state)), _Continuation(lambda: None, is_leaf=False))
        assert found is not None
        return self._with_doc(found)

    def pop_else_doc(self, node: tree.DecisionTreeNode) -> str:
        """The description of a tree that is to stand before the `else` in front of it."""
        doc = node.doc if isinstance(node, tree.IfNode) else ""
        if isinstance(node, tree.IfNode):
            node.doc = ""
        return doc or self._pop_doc(node)

    def _items(self, alternatives: Sequence[DecisionPlan], state: str) -> Iterator[_DecisionItem]:
        for each in alternatives:
            own = self.expressions.build_conditions(each.conditions, state)
            outcome = each.outcome
            if isinstance(outcome, Branch):
                outcome = _OwnedBranch(
                    then=outcome.then,
                    otherwise=outcome.otherwise,
                    then_always_ends=outcome.then_always_ends,
                    state=state,
                )
            yield _DecisionItem((), own, outcome, description_line(each.doc), each.path)

    def _build_chain(self, items: Sequence[_DecisionItem], follow: _Continuation) -> tree.DecisionTreeNode | None:
        """One item after the other, then what follows."""
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
            # What falls through goes on with what follows; said twice, a few groups would become thousands of lines.
            before = [each.inside(test) for each in inner]
            after = [each.inside(*item.around, negation(conjunction(item.own))) for each in others]
            found = self._build_chain([*before, *after], follow)
            if item.doc and isinstance(found, tree.IfNode) and not found.doc:
                found.doc = item.doc
            return found
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
        """A tree with no `else` before it: only an `if` has a place for a description."""
        words = self._pop_doc(node)
        if words:
            self.unplaced_docs.append((node, words))
        return node

    def _pop_doc(self, node: tree.DecisionTreeNode) -> str:
        return self._docs.pop(id(node), "")


@dataclass(frozen=True, slots=True, kw_only=True)
class _OwnedBranch(Branch):
    """A branch that knows whose decision it is."""

    state: str


def can_be_common_decision(alternatives: Sequence[DecisionPlan]) -> bool:
    """Whether alternatives can be a common decision: each asks something, groups end, and none of them stays."""
    return bool(alternatives) and all(each.conditions and _can_end_in_common(each.outcome) for each in alternatives)


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
        isinstance(each.outcome, NoChange)
        or (isinstance(each.outcome, Branch) and _may_keep_state((*each.outcome.then, *each.outcome.otherwise)))
        for each in alternatives
    )
