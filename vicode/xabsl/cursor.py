"""A place among the tokens of a file, and what a parser does there: look, take, complain, go on after a mistake."""

from collections.abc import Collection

from vicode.findings import Finding, did_you_mean, get_rule
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.tokens import DOC, END, HEADER, KEYWORDS, NAME
from vicode.xabsl.tree import NameNode

MAX_DEPTH = 120
"""No behavior is nested deeper; what is read is walked by functions that call themselves."""

_RESUME_KINDS = (KEYWORDS | {"}", DOC, END}) - {"true", "false"}


class XabslSyntaxError(Exception):
    """What was begun cannot be read on; it has been said why."""


class TokenCursor:
    """Reads tokens one by one; `kind` is the kind of the next, `at` its number."""

    __slots__ = ("depth", "findings", "kind", "kinds", "position", "tokens")

    def __init__(self, tokens: Tokens) -> None:
        self.tokens = tokens
        self.kinds = tokens.kinds
        self.position = 0
        self.kind = self.kinds[0]
        self.depth = 0
        self.findings: list[Finding] = []

    def advance(self) -> int:
        """Take the next token, whatever it is; returns its number."""
        number = self.position
        if self.kind != END:
            self.position = number + 1
            self.kind = self.kinds[number + 1]
        return number

    def accept(self, kind: str) -> bool:
        """Take a token of this kind, if it is the next."""
        if self.kind == kind:
            self.advance()
            return True
        return False

    def expect(self, kind: str, where: str = "") -> int:
        """Take a token of this kind; returns its number.

        Raises:
            SyntaxSlipError: Another stands there.
        """
        if self.kind != kind:
            raise self.syntax_error((kind,), where)
        return self.advance()

    def expect_semicolon(self, where: str) -> None:
        """Take the `;` that ends something; where the next thing begins without it, it is only told to be missing.

        Raises:
            SyntaxSlipError: Something else stands there.
        """
        if self.accept(";"):
            return
        slip = self.syntax_error((";",), where)
        if self.kind not in _RESUME_KINDS and not self._is_at_line_start():
            raise slip

    def _is_at_line_start(self) -> bool:
        tokens = self.tokens
        return (
            self.kind == NAME and "\n" in tokens.text[tokens.starts[self.position - 1] : tokens.starts[self.position]]
        )

    def expect_text(self, kind: str, where: str = "") -> str:
        """Take a token of this kind; returns its text."""
        return self.tokens.texts[self.expect(kind, where)]

    def expect_name(self, where: str = "") -> NameNode:
        """Take a name."""
        number = self.expect(NAME, where)
        return NameNode(self.tokens.texts[number], first_token=number, last_token=number)

    def accept_doc(self) -> str:
        """Take a description, if one stands here; returns what is between its signs."""
        if self.kind != DOC:
            return ""
        return self.tokens.texts[self.advance()][3:-2].replace("\r", "").strip()

    def increase_depth(self) -> None:
        """Go one deeper; `depth` is counted down by who went up again."""
        self.depth += 1
        if self.depth > MAX_DEPTH:
            self.add_finding("X604", f"nested deeper than {MAX_DEPTH}", "take parts of it into options of their own")
            raise XabslSyntaxError

    def add_finding(self, code: str, message: str, fix: str = "", at: int = -1) -> None:
        """Tell what is wrong with a token, the next one by default."""
        place = self.tokens.location(self.position if at < 0 else at)
        self.findings.append(Finding(rule=get_rule(code), message=message, fix=fix, location=place))

    def syntax_error(self, expected: Collection[str], where: str = "") -> XabslSyntaxError:
        """Tell that something else was wanted; returns what is to be raised."""
        after = f" {where}" if where else ""
        if self.kind == END:
            if any(each.rule.code == "X605" for each in self.findings):
                return XabslSyntaxError()
            self.add_finding("X605", f"the file ends where {_format_expected(expected)} is wanted{after}")
            return XabslSyntaxError()
        shown = self.tokens.texts[self.position]
        mend = did_you_mean(shown, [each for each in expected if each in KEYWORDS]) if self.kind == NAME else ""
        if self.kind in (DOC, HEADER):
            message, mend = "a description stands where none can", "write it as a comment: // …"
        elif self.kind in KEYWORDS and NAME in expected:
            message, mend = f"'{shown}' is a word of the language", "take another name"
        else:
            message = f"{_format_expected(expected)} wanted{after} instead of '{shown[:40]}'"
        self.add_finding("X604", message, mend)
        return XabslSyntaxError()

    def skip_to(self, *wanted: str, open_braces: int) -> None:
        """Go on after a mistake: to the next of these kinds that is not inside further braces; never past our own `}`.

        `open_braces` is how many braces are open since that of the block that is read; 0 where the mistake was in itself.
        """
        depth = open_braces
        while self.kind != END:
            if self.kind == "{":
                depth += 1
            elif self.kind == "}":
                if depth <= 0:
                    return
                depth -= 1
                if depth <= 0 and "}" in wanted:
                    self.advance()
                    return
            elif depth <= 0 and self.kind in wanted:
                return
            self.advance()

    def open_braces_since(self, start: int) -> int:
        """How many braces opened since a token are still open here."""
        passed = self.kinds[start : self.position]
        return max(0, passed.count("{") - passed.count("}"))


def _format_expected(wanted: Collection[str]) -> str:
    shown = [each if each in (NAME, END) or " " in each or each.isalpha() else f"'{each}'" for each in wanted]
    shown = [f"a {each}" if each == NAME else each for each in shown]
    return shown[0] if len(shown) == 1 else f"{', '.join(shown[:-1])} or {shown[-1]}"
