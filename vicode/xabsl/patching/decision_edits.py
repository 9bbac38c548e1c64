"""Edits decision trees. A chain of `if … else if …` is a list; if its parts cannot be mapped, the tree is replaced."""

from dataclasses import replace

from vicode.matching import find_unmoved
from vicode.xabsl import tree
from vicode.xabsl.lexer import Comment
from vicode.xabsl.patching.chain_rearrangement import ChainRearrangement
from vicode.xabsl.patching.decision_chains import Chain, ChainBranch, doc_tokens, else_token, read_chain, test_alone
from vicode.xabsl.patching.doc_edits import edit_words
from vicode.xabsl.patching.expression_edits import edit_expression
from vicode.xabsl.patching.list_edits import match_items, text_similarity
from vicode.xabsl.patching.source_edits import PatchError, SourceEdits, indented
from vicode.xabsl.printer import print_node


class DecisionEdits:
    """Edits the decision trees of one file.

    Args:
        file: The file.
        unit: One level of indentation.
        comments: The comments of the file of the new trees.
    """

    def __init__(self, file: SourceEdits, unit: str, comments: dict[int, list[Comment]]) -> None:
        self.file, self.unit, self.comments = file, unit, comments

    def edit(
        self,
        old: tree.DecisionTreeNode,
        before: tree.DecisionTreeNode,
        after: tree.DecisionTreeNode,
        else_docs: tuple[str, str, str] = ("", "", ""),
    ) -> None:
        """Change a tree; `else_docs` are the descriptions before the `else` that precedes it in each version."""
        chains = [read_chain(node, doc) for node, doc in zip((old, before, after), else_docs, strict=True)]
        if before == after and else_docs[1] == else_docs[2]:
            return
        edits = list(self.file.edits)
        if not self._edit_chain(*chains) or not self._is_consistent(old):
            self.file.edits = edits
            self.replace(old, after, else_docs[2])

    def _is_consistent(self, old: tree.DecisionTreeNode) -> bool:
        """Whether the edits of a tree exclude each other nowhere."""
        file = self.file
        try:
            file.read(file.start_with_comments(old.first_token), file.end_with_comment(old.last_token))
        except PatchError:
            return False
        return True

    def replace(self, old: tree.DecisionTreeNode, after: tree.DecisionTreeNode, else_doc: str = "") -> None:
        """Replace a tree; its comments are kept above the new one.

        Args:
            old: The original tree.
            after: The new tree.
            else_doc: The new description before the `else` that precedes the tree.
        """
        file = self.file
        branch = read_chain(old, "").branches[0]
        for token in doc_tokens(file, branch, own=False):
            file.delete(file.start(token), file.start(token + 1))
        while isinstance(old, tree.BlockNode):
            old = old.inner
        while isinstance(after, tree.BlockNode):
            after = after.inner
        if else_doc and isinstance(after, tree.IfNode):
            doc = " ".join(each for each in (else_doc, after.doc) if each)
            after = replace(after, doc=doc, first_token=after.first_token - (not after.doc))
        start, end = file.start(old.first_token), file.end(old.last_token)
        lines = [*file.comments_between(start, end), *self.print(after).split("\n")]
        indent = file.indent_at(start)
        if len(lines) == 1 or file.is_first_in_line(start):
            file.overwrite(start, end, indented("\n".join(lines), indent, self.unit))
            return
        inner = indent + self.unit
        first = len(file.text[:start].rstrip(" \t"))
        file.overwrite(first, end, f"\n{inner}" + indented("\n".join(lines), inner, self.unit))
        closing = len(file.text) - len(file.text[end:].lstrip(" \t"))
        if file.text.startswith("}", closing):
            file.replace(end, closing, f"\n{indent}")

    def print(self, node: tree.SyntaxNode) -> str:
        return print_node(node, self.comments)

    def _edit_chain(self, old: Chain, before: Chain, after: Chain) -> bool:
        if len(old.tests) != len(before.tests) or old.is_open != before.is_open or before.is_open != after.is_open:
            return False
        if not old.tests:
            return self._edit_leaf(old, before, after)
        if not after.tests and isinstance(old.branches[-1].outer, tree.BlockNode):
            return False
        keys = [
            (print_node(test_alone(test)), branch.doc)
            for test, branch in zip(before.tests, before.branches, strict=False)
        ]
        new_keys = [
            (print_node(test_alone(test)), branch.doc)
            for test, branch in zip(after.tests, after.branches, strict=False)
        ]
        matches = match_items(keys, new_keys, lambda one, other: _similarity(before.tests[one], after.tests[other]))
        kept = find_unmoved(matches)
        added = [
            "" if match is not None else self._print_test(test, old)
            for test, match in zip(after.tests, matches, strict=True)
        ]
        rearranging = ChainRearrangement(file=self.file, old=old, after=after, matches=matches, kept=kept, added=added)
        if not rearranging.is_possible():
            return False
        for index, match in enumerate(matches):
            if match is not None:
                self._edit_test(old.tests[match], before.tests[match], after.tests[index])
            # The description of a moved test is written where it moves.
            if match is not None and match in kept:
                branches = old.branches[match], before.branches[match], after.branches[index]
                self._edit_doc(*branches, becomes_first=match == min(kept))
        if not old.is_open:
            ends = old.branches[-1], before.branches[-1], after.branches[-1]
            self._edit_doc(*ends, becomes_first=not kept)
            self.edit(ends[0].outer, ends[1].node, ends[2].node)
        rearranging.apply()
        return True

    def _print_test(self, test: tree.IfNode, old: Chain) -> str:
        """Print an added test from its `if`, with braces if the others have them."""
        alone = test_alone(test)
        if not isinstance(test.then, tree.BlockNode) and any(
            isinstance(each.then, tree.BlockNode) for each in old.tests
        ):
            alone = replace(alone, then=tree.BlockNode(test.then))
        return indented(self.print(alone), old.indent(self.file), self.unit)

    def _edit_leaf(self, old: Chain, before: Chain, after: Chain) -> bool:
        """Edit a tree that is one goto or stay in both versions."""
        if old.tests or after.tests or old.is_open or after.branches[0].doc != before.branches[0].doc:
            return False
        self._replace_leaf(old.branches[0].node, before.branches[0].node, after.branches[0].node)
        return True

    def _replace_leaf(
        self, old: tree.DecisionTreeNode, before: tree.DecisionTreeNode, after: tree.DecisionTreeNode
    ) -> None:
        if before == after:
            return
        if isinstance(old, tree.GotoNode) and isinstance(after, tree.GotoNode):
            self.file.replace_node(old.state, after.state.text)
        else:
            self.file.replace_node(old, print_node(after))

    def _edit_test(self, old: tree.IfNode, before: tree.IfNode, after: tree.IfNode) -> None:
        edit_expression(self.file, old.condition, before.condition, after.condition)
        self.edit(old.then, before.then, after.then)

    def _edit_doc(self, old: ChainBranch, before: ChainBranch, after: ChainBranch, *, becomes_first: bool) -> None:
        """Change the description of a branch; the `else` before it is removed if it becomes the first one."""
        if before.doc == after.doc:
            return
        file = self.file
        tokens = doc_tokens(file, old)
        if tokens:
            edit_words(file, [(file.start(token), file.end(token)) for token in tokens], before.doc, after.doc)
            return
        first = None if becomes_first else else_token(file, old.outer.first_token)
        start = file.start(first if first is not None else old.node.first_token)
        indent = file.indent_at(start)
        line = f"/** {' '.join(after.doc.split())} */\n{indent}"
        if first is None or file.is_first_in_line(start):
            file.insert(start, line)
        else:
            before_space = len(file.text[:start].rstrip(" \t"))
            file.replace(before_space, start, f"\n{indent}{line}")


def _similarity(old: tree.IfNode, new: tree.IfNode) -> float:
    conditions = text_similarity(print_node(old.condition), print_node(new.condition))
    thens = text_similarity(print_node(old.then), print_node(new.then))
    return (conditions + thens) / 2
