"""Adds, moves and removes the tests of a decision tree.

A chain `if … else if … else` is a list of tests, but its items overlap: the `else` before a test belongs to its place,
not to the test, and the first one has none. So tests are cut out from their `if` to the end of their branch, and `else`
is written anew. Braces around the rest of a chain, and descriptions before an `else`, tie a test to its place:
`is_possible` refuses these, and the caller replaces the whole tree.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from vicode.matching import Match
from vicode.xabsl import tree
from vicode.xabsl.patching.decision_chains import Chain, doc_tokens, else_token
from vicode.xabsl.patching.source_edits import SourceEdits
from vicode.xabsl.tokens import DOC


@dataclass(frozen=True, slots=True, kw_only=True)
class ChainRearrangement:
    """The new order of the tests of a chain.

    Attributes:
        old: The original chain.
        after: The new chain.
        matches: The original test of each new one.
        kept: The original tests that stay in their place.
        added: The text of each added test from its `if`; empty for the others.
    """

    file: SourceEdits
    old: Chain
    after: Chain
    matches: Sequence[Match]
    kept: set[int]
    added: Sequence[str]

    @property
    def removed(self) -> list[int]:
        """The original tests that are cut out, as they are removed or move."""
        return [index for index in range(len(self.old.tests)) if index not in self.kept]

    def is_possible(self) -> bool:
        """Whether braces and descriptions allow it."""
        branches = self.old.branches
        if not self.kept and self.old.is_open:
            return False
        for index in self.removed:
            following = branches[index + 1] if index + 1 < len(branches) else None
            if following is not None and self._is_first(index) and doc_tokens(self.file, following, own=False):
                return False
            if not self._is_first(index) and branches[index].outer is not branches[index].node:
                return False
            if index - 1 in self.removed and branches[index].outer is not branches[index].node:
                return False
        adds_first = bool(self.matches) and (self.matches[0] is None or self.matches[0] not in self.kept)
        return not (adds_first and doc_tokens(self.file, branches[0], own=False))

    def _is_first(self, index: int) -> bool:
        """Whether all tests before this one are cut out, too."""
        return all(other in self.removed for other in range(index))

    def apply(self) -> None:
        texts = [self._text(index, match) for index, match in enumerate(self.matches)]
        self._remove()
        self._insert(texts)

    def _text(self, index: int, match: Match) -> str:
        """The text of an added or moved test from its `if`, with the comments above it."""
        if match in self.kept:
            return ""
        file, doc = self.file, self.after.branches[index].doc
        if match is None:
            text = self.added[index]
            comments: list[str] = []
        else:
            node = self.old.tests[match]
            first = node.first_token + (file.tokens.kinds[node.first_token] == DOC)
            text = file.read(file.start(first), file.end_with_comment(node.then.last_token))
            text = text.replace("\r\n", "\n")
            before = else_token(file, node.first_token)
            begin = file.end_with_comment((node.first_token if before is None else before) - 1)
            comments = file.comments_between(begin, file.start(first))
        docs = [f"/** {' '.join(doc.split())} */"] if doc else []
        return "".join(f"{line}\n{self._indent()}" for line in (*comments, *docs)) + "\0" + text

    def _indent(self) -> str:
        return self.old.indent(self.file)

    def _remove(self) -> None:
        file, old = self.file, self.old
        last_first = max((index for index in self.removed if self._is_first(index)), default=-1)
        if last_first >= 0:
            end = file.start(old.branches[last_first + 1].outer.first_token)
            # The comments above the next test stay.
            above = file.comments_between(file.end_with_comment(old.tests[last_first].then.last_token), end)
            file.overwrite(self._front(), end, "".join(f"{comment}\n{self._indent()}" for comment in above))
        for index in self.removed:
            if index > last_first:
                start = file.end_with_comment(old.tests[index - 1].then.last_token)
                file.delete(start, file.end_with_comment(old.tests[index].then.last_token))

    def _insert(self, texts: Sequence[str]) -> None:
        file, old = self.file, self.old
        previous: Match = None
        first = ""
        for match, text in zip(self.matches, texts, strict=True):
            above, _zero, body = text.partition("\0")
            if match is not None and match in self.kept:
                previous = match
            elif previous is None:
                gap = f"\n{self._indent()}" if above else self._gap_after(first)
                first = f"{first}{gap}{above}else {body}" if first else above + body
            else:
                position = file.end_with_comment(old.tests[previous].then.last_token)
                has_comment = position != file.end(old.tests[previous].then.last_token)
                follows_block = isinstance(old.tests[previous].then, tree.BlockNode)
                is_line = bool(above) or has_comment or not (follows_block and self._is_same_line())
                file.insert(position, f"\n{self._indent()}{above}else {body}" if is_line else f" else {body}")
        if first:
            self._insert_first(first)

    def _insert_first(self, text: str) -> None:
        file, front, start = self.file, self._front(), self.file.start(self.old.tests[0].first_token)
        if front == start or 0 in self.removed:
            file.insert(front, f"{text}{self._gap_after(text)}else ")
        else:
            # The comments of the next test are between both.
            file.insert(front, f"{text}\n{self._indent()}")
            file.insert(start, "else ")

    def _gap_after(self, test: str) -> str:
        """What separates an `else` from the test before it."""
        has_comment = "//" in test.rpartition("\n")[2]
        return " " if self._is_same_line() and not has_comment else f"\n{self._indent()}"

    def _front(self) -> int:
        """The start of the first test with the comments directly above it."""
        file, first = self.file, self.old.tests[0].first_token
        line = file.start_with_comments(first)
        return line + len(file.indent_at(line)) if line < file.start(first) else line

    def _is_same_line(self) -> bool:
        """Whether `else` follows the closing brace in the same line."""
        file = self.file
        for test in self.old.tests:
            following = test.then.last_token + 1
            if isinstance(test.then, tree.BlockNode) and file.tokens.kinds[following] == "else":
                return "\n" not in file.text[file.end(following - 1) : file.start(following)]
        return False
