"""Decisions of a design as complete trees: every `if` has its `else`, and what is exhausted stays."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

from vicode.findings import Path
from vicode.generators.plan import Alternative, Branch, Change, Keep
from vicode.generators.xabsl.expressions import Speller, all_of, negated
from vicode.generators.xabsl.printing import in_one_line
from vicode.xabsl import tree


@dataclass(frozen=True, slots=True)
class _Item:
    """An alternative with what is asked for it: by the groups that were opened around it, and by itself."""

    around: tuple[tree.Expression, ...]
    own: tuple[tree.Expression, ...]
    outcome: Change | Keep | Branch
    doc: str
    path: Path

    @property
    def tests(self) -> tuple[tree.Expression, ...]:
        """All of it."""
        return (*self.around, *self.own)

    def inside(self, *tests: tree.Expression) -> "_Item":
        """The same in a group that asks these."""
        return replace(self, around=(*tests, *self.around))


@dataclass(frozen=True, slots=True)
class _Follow:
    """What follows when nothing before it was taken; `is_leaf`: it asks nothing, so that it may be said twice."""

    make: Callable[[], tree.Tree | None]
    is_leaf: bool


@dataclass(slots=True)
class DecisionWriter:
    """Builds the trees of one option, and notes from which decision each outcome comes.

    `words` are descriptions that the language has no place for, by the tree they belong to.
    """

    speller: Speller
    state_name: Callable[[str], str]
    places: list[tuple[tree.Tree, Path]] = field(default_factory=list)
    words: list[tuple[tree.Node, str]] = field(default_factory=list)
    _docs: dict[int, str] = field(default_factory=dict)

    def complete(self, alternatives: Sequence[tuple[str, Alternative]]) -> tree.Tree:
        """The tree of alternatives, each with the state (or COMMON) whose decision it is."""
        items = [item for state, each in alternatives for item in self._items([each], state)]
        found = self._chain(items, _Follow(tree.Stay, is_leaf=True))
        assert found is not None
        return self._with_doc(found)

    def open(self, alternatives: Sequence[Alternative], state: str) -> tree.Tree:
        """The tree of alternatives that `is_open` holds for, which ends where the states go on."""
        found = self._chain(list(self._items(alternatives, state)), _Follow(lambda: None, is_leaf=False))
        assert found is not None
        return self._with_doc(found)

    def take_else_doc(self, node: tree.Tree) -> str:
        """The description of a tree that is to stand before the `else` in front of it."""
        doc = node.doc if isinstance(node, tree.If) else ""
        if isinstance(node, tree.If):
            node.doc = ""
        return doc or self._take_words(node)

    def _items(self, alternatives: Sequence[Alternative], state: str) -> Iterator[_Item]:
        for each in alternatives:
            own = self.speller.conditions(each.conditions, state)
            outcome = each.outcome
            if isinstance(outcome, Branch):
                outcome = _Grown(
                    then=outcome.then, otherwise=outcome.otherwise, then_ends=outcome.then_ends, state=state
                )
            yield _Item((), own, outcome, in_one_line(each.doc), each.path)

    def _chain(self, items: Sequence[_Item], follow: _Follow) -> tree.Tree | None:
        """One item after the other, then what follows."""
        for item in reversed(items):
            is_leaf = not item.tests and not isinstance(item.outcome, Branch)
            follow = _Follow(partial(self._one, item, follow), is_leaf)
        return follow.make()

    def _one(self, item: _Item, follow: _Follow) -> tree.Tree | None:
        outcome = item.outcome
        if isinstance(outcome, _Grown):
            return self._branch(item, outcome, follow)
        assert not isinstance(outcome, Branch)
        leaf = tree.Stay() if isinstance(outcome, Keep) else tree.Goto(tree.Name(self.state_name(outcome.state)))
        if not item.tests:
            self.places.append((leaf, item.path))
            self._docs[id(leaf)] = item.doc
            return leaf
        node = tree.If(all_of(item.tests), leaf, None, doc=item.doc)
        self.places.append((node, item.path))
        return self._followed(node, follow.make())

    def _branch(self, item: _Item, branch: "_Grown", follow: _Follow) -> tree.Tree | None:
        inner = list(self._items(branch.then, branch.state))
        others = list(self._items(branch.otherwise, branch.state))
        if not item.tests:
            return self._chain(inner, follow)
        test = all_of(item.tests)
        must_open = not branch.then_ends and not follow.is_leaf
        if must_open or (item.around and others):
            # What falls through goes on with what follows; said twice, a few groups would become thousands of lines.
            before = [each.inside(test) for each in inner]
            after = [each.inside(*item.around, negated(all_of(item.own))) for each in others]
            found = self._chain([*before, *after], follow)
            if item.doc and isinstance(found, tree.If) and not found.doc:
                found.doc = item.doc
            return found
        then = self._chain(inner, follow)
        assert then is not None
        block = tree.Block(self._with_doc(then)) if isinstance(then, tree.If) else self._with_doc(then)
        node = tree.If(test, block, None, doc=item.doc)
        return self._followed(node, self._chain(others, follow))

    def _followed(self, node: tree.If, otherwise: tree.Tree | None) -> tree.If:
        if otherwise is not None:
            node.else_doc = self.take_else_doc(otherwise)
            node.otherwise = otherwise
        return node

    def _with_doc(self, node: tree.Tree) -> tree.Tree:
        """A tree with no `else` before it: only an `if` has a place for a description."""
        words = self._take_words(node)
        if words:
            self.words.append((node, words))
        return node

    def _take_words(self, node: tree.Tree) -> str:
        return self._docs.pop(id(node), "")


@dataclass(frozen=True, slots=True, kw_only=True)
class _Grown(Branch):
    """A branch that knows whose decision it is."""

    state: str


def is_open(alternatives: Sequence[Alternative]) -> bool:
    """Whether alternatives can be a common decision: each asks something, groups end, and none of them stays."""
    return bool(alternatives) and all(each.conditions and _is_open_outcome(each.outcome) for each in alternatives)


def _is_open_outcome(outcome: Change | Keep | Branch) -> bool:
    match outcome:
        case Change():
            return True
        case Keep():
            return False
        case Branch(then=then, otherwise=otherwise, then_ends=then_ends):
            return then_ends and not _keeps(then) and (not otherwise or is_open(otherwise))


def _keeps(alternatives: Sequence[Alternative]) -> bool:
    return any(
        isinstance(each.outcome, Keep)
        or (isinstance(each.outcome, Branch) and _keeps((*each.outcome.then, *each.outcome.otherwise)))
        for each in alternatives
    )
