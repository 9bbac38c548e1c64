"""The text of a generated module, changed by statement and line."""

import ast
import re
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Module:
    """The text of a generated module, its lines, and those of its regions with their marks."""

    text: str

    @property
    def lines(self) -> list[str]:
        return self.text.split("\n")

    @property
    def region_lines(self) -> set[int]:
        """Numbers of lines from 1."""
        found, is_inside = set(), False
        for number, line in enumerate(self.lines, start=1):
            is_inside = is_inside or line.lstrip().startswith("# <vicode ")
            if is_inside:
                found.add(number)
            is_inside = is_inside and line.strip() != "# </vicode>"
        return found

    @property
    def name(self) -> str:
        """The name of the generated class."""
        return re.findall(r"^class (\w+)\((?:Xabsl)?Component\):", self.text, re.MULTILINE)[-1]

    def methods(self, prefix: str = "_") -> list[ast.FunctionDef]:
        (owner,) = (n for n in ast.parse(self.text).body if isinstance(n, ast.ClassDef) and n.name == self.name)
        return [node for node in owner.body if isinstance(node, ast.FunctionDef) and node.name.startswith(prefix)]

    def statements(self, *kinds: type[ast.stmt]) -> list[ast.stmt]:
        """The statements of methods outside regions."""
        fixed = self.region_lines
        found = [
            node
            for method in self.methods()
            for each in method.body
            for node in ast.walk(each)
            if isinstance(node, kinds or ast.stmt)
        ]
        return [n for n in found if fixed.isdisjoint(range(n.lineno, (n.end_lineno or 0) + 1)) and not is_text(n)]

    def replaced(self, node: ast.expr | ast.stmt, new: str) -> str:
        """The text with another one in place of a node."""
        lines = [line.encode() for line in self.lines]
        first, last = node.lineno - 1, (node.end_lineno or 0) - 1
        start, end = lines[first][: node.col_offset], lines[last][node.end_col_offset :]
        lines[first : last + 1] = [start + new.encode() + end]
        return b"\n".join(lines).decode()

    def source(self, node: ast.expr | ast.stmt) -> str:
        return ast.get_source_segment(self.text, node) or ""

    def inserted(self, at: int, *new: str) -> str:
        """The text with lines before a line that is counted from 1."""
        lines = self.lines
        return "\n".join([*lines[: at - 1], *new, *lines[at - 1 :]])

    def wrapped(self, node: ast.stmt, *heads: str, tail: tuple[str, ...] = ()) -> str:
        """The text with a statement indented below new lines."""
        margin = " " * node.col_offset
        inner = [f"    {line}" for line in self.lines[node.lineno - 1 : node.end_lineno]]
        new = [*(margin + head for head in heads), *inner, *(margin + line for line in tail)]
        lines = self.lines
        return "\n".join([*lines[: node.lineno - 1], *new, *lines[node.end_lineno or 0 :]])


def is_text(node: ast.stmt) -> bool:
    """Whether a statement is a docstring."""
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
