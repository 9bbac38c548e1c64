"""Decision trees as chains of tests: `if … else if … else`."""

from dataclasses import dataclass, replace

from vicode.xabsl import tree
from vicode.xabsl.patching.source_edits import SourceEdits
from vicode.xabsl.tokens import DOC


@dataclass(frozen=True, slots=True)
class ChainBranch:
    """An `if` of a chain or its last `else`; `outer` includes the braces around it, `doc` that before its `else`."""

    node: tree.DecisionTreeNode
    outer: tree.DecisionTreeNode
    else_doc: str

    @property
    def doc(self) -> str:
        own = self.node.doc if isinstance(self.node, tree.IfNode) else ""
        return " ".join(doc for doc in (self.else_doc, own) if doc)


@dataclass(frozen=True, slots=True)
class Chain:
    """A decision tree: its tests, and the branches with their descriptions. An open chain has no last `else`."""

    tests: list[tree.IfNode]
    branches: list[ChainBranch]

    def indent(self, file: SourceEdits) -> str:
        """The indentation of the first test."""
        return file.indent_at(file.start(self.tests[0].first_token))

    @property
    def is_open(self) -> bool:
        return len(self.branches) == len(self.tests)


def else_token(file: SourceEdits, first: int) -> int | None:
    """The `else` directly before a token."""
    return first - 1 if first and file.tokens.kinds[first - 1] == "else" else None


def read_chain(node: tree.DecisionTreeNode, else_doc: str) -> Chain:
    tests: list[tree.IfNode] = []
    branches: list[ChainBranch] = []
    current: tree.DecisionTreeNode | None = node
    while current is not None:
        outer = current
        while isinstance(current, tree.BlockNode):
            current = current.inner
        branches.append(ChainBranch(current, outer, else_doc))
        if not isinstance(current, tree.IfNode):
            break
        tests.append(current)
        else_doc, current = current.else_doc, current.otherwise
    return Chain(tests, branches)


def doc_tokens(file: SourceEdits, branch: ChainBranch, *, own: bool = True) -> list[int]:
    """The tokens of the descriptions of a branch: before its `else`, and with `own` before its `if`."""
    kinds, first = file.tokens.kinds, branch.outer.first_token
    found = []
    before = else_token(file, first)
    if before is not None and before and kinds[before - 1] == DOC:
        found.append(before - 1)
    if own and kinds[branch.node.first_token] == DOC:
        found.append(branch.node.first_token)
    return found


def test_alone(test: tree.IfNode) -> tree.IfNode:
    """A test without its description and without what follows its first branch."""
    first = test.first_token + bool(test.doc)
    return replace(test, otherwise=None, else_doc="", doc="", first_token=first, last_token=test.then.last_token)
