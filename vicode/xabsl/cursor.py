"""The token cursor of the parsers: lookahead, expected tokens, syntax errors and error recovery."""

from collections.abc import Collection

from vicode.findings import Finding, did_you_mean, get_rule
from vicode.xabsl.engine.recursion import depth_limit
from vicode.xabsl.lexer import Tokens, plain_line_ends
from vicode.xabsl.tokens import DOC, END, HEADER, KEYWORDS, NAME
from vicode.xabsl.tree import NameNode

_MAX_DEPTH, _FRAMES_PER_LEVEL = 1200, 8
"""Limit of nesting. The functions that read and traverse the tree are recursive: see `depth_limit`."""

_RESUME_KINDS = (KEYWORDS | {"}", DOC, END}) - {"true", "false"}


class XabslSyntaxError(Exception):
    """The current construct cannot be parsed. The finding is already recorded."""


class TokenCursor:
    """Reads the tokens of a file in order. `kind` is the kind of the next token, `position` its number."""

    __slots__ = ("depth", "findings", "kind", "kinds", "max_depth", "position", "tokens")

    def __init__(self, tokens: Tokens) -> None:
        self.tokens = tokens
        self.kinds = tokens.kinds
        self.position = 0
        self.kind = self.kinds[0]
        self.depth = 0
        self.max_depth = depth_limit(_MAX_DEPTH, _FRAMES_PER_LEVEL)
        self.findings: list[Finding] = []

    def advance(self) -> int:
        """Consume the next token and return its number."""
        number = self.position
        if self.kind != END:
            self.position = number + 1
            self.kind = self.kinds[number + 1]
        return number

    def accept(self, kind: str) -> bool:
        """Consume the next token if it is of this kind."""
        if self.kind == kind:
            self.advance()
            return True
        return False

    def expect(self, kind: str, where: str = "") -> int:
        """Consume a token of this kind and return its number.

        Raises:
            XabslSyntaxError: The next token is of another kind.
        """
        if self.kind != kind:
            raise self.syntax_error((kind,), where)
        return self.advance()

    def expect_semicolon(self, where: str) -> None:
        """Consume a `;`. If it is missing before the start of the next construct, report it and continue.

        Raises:
            XabslSyntaxError: The next token starts no construct.
        """
        if self.accept(";"):
            return
        error = self.syntax_error((";",), where)
        if self.kind not in _RESUME_KINDS and not self._is_at_line_start():
            raise error

    def _is_at_line_start(self) -> bool:
        tokens = self.tokens
        return (
            self.kind == NAME and "\n" in tokens.text[tokens.starts[self.position - 1] : tokens.starts[self.position]]
        )

    def expect_text(self, kind: str, where: str = "") -> str:
        """Consume a token of this kind and return its text."""
        return self.tokens.texts[self.expect(kind, where)]

    def expect_name(self, where: str = "") -> NameNode:
        number = self.expect(NAME, where)
        return NameNode(self.tokens.texts[number], first_token=number, last_token=number)

    def accept_doc(self) -> str:
        """Consume a description if it is the next token, and return its text without the delimiters."""
        if self.kind != DOC:
            return ""
        return plain_line_ends(self.tokens.texts[self.advance()][3:-2]).strip()

    def increase_depth(self) -> None:
        """Count one more level of nesting; the caller decreases `depth`.

        Raises:
            XabslSyntaxError: The nesting is deeper than `max_depth`.
        """
        self.depth += 1
        if self.depth > self.max_depth:
            message = f"nested deeper than {self.max_depth} levels"
            self.add_finding("X604", message, "move parts of it into separate options")
            raise XabslSyntaxError

    def add_finding(self, code: str, message: str, fix: str = "", token: int = -1) -> None:
        """Report a problem with a token, by default the next one."""
        location = self.tokens.location(self.position if token < 0 else token)
        self.findings.append(Finding(rule=get_rule(code), message=message, fix=fix, location=location))

    def syntax_error(self, expected: Collection[str], where: str = "") -> XabslSyntaxError:
        """Report an unexpected token and return the exception to raise."""
        after = f" {where}" if where else ""
        if self.kind == END:
            if any(finding.rule.code == "X605" for finding in self.findings):
                return XabslSyntaxError()
            self.add_finding("X605", f"unexpected end of file: expected {_format_expected(expected)}{after}")
            return XabslSyntaxError()
        found = self.tokens.texts[self.position]
        fix = did_you_mean(found, [kind for kind in expected if kind in KEYWORDS]) if self.kind == NAME else ""
        if self.kind in (DOC, HEADER):
            message, fix = "a description is not allowed here", "write it as a comment: // …"
        elif self.kind in KEYWORDS and NAME in expected:
            message, fix = f"'{found}' is a keyword", "choose another name"
        else:
            message = f"expected {_format_expected(expected)}{after}, found '{found[:40]}'"
        self.add_finding("X604", message, fix)
        return XabslSyntaxError()

    def skip_to(self, *kinds: str, open_braces: int) -> None:
        """Skip to the next token of these kinds outside nested braces, and never past the `}` of the current block.

        Args:
            wanted: the kinds of tokens to stop at.
            open_braces: number of braces opened since the start of the current block and not yet closed.
        """
        depth = open_braces
        while self.kind != END:
            if self.kind == "{":
                depth += 1
            elif self.kind == "}":
                if depth <= 0:
                    return
                depth -= 1
                if depth <= 0 and "}" in kinds:
                    self.advance()
                    return
            elif depth <= 0 and self.kind in kinds:
                return
            self.advance()

    def open_braces_since(self, start: int) -> int:
        """Number of braces opened since a token that are still open."""
        kinds = self.kinds[start : self.position]
        return max(0, kinds.count("{") - kinds.count("}"))


def _format_expected(kinds: Collection[str]) -> str:
    names = [kind if kind in (NAME, END) or " " in kind or kind.isalpha() else f"'{kind}'" for kind in kinds]
    names = [f"a {kind}" if kind == NAME else kind for kind in names]
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} or {names[-1]}"
