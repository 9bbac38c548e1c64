"""A place among the tokens of a file, and what a parser does there: look, take, complain, go on after a mistake."""

from collections.abc import Collection

from vicode.findings import Finding, did_you_mean, rule
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.tokens import DOC, END, INITIAL, KEYWORDS, NAME
from vicode.xabsl.tree import Name

DEEPEST = 120
"""No behavior is nested deeper; what is read is walked by functions that call themselves."""

_GOES_ON = (KEYWORDS | {"}", DOC, END}) - {"true", "false"}


class SyntaxSlipError(Exception):
    """What was begun cannot be read on; it has been said why."""


class Cursor:
    """Reads tokens one by one; `kind` is the kind of the next, `at` its number."""

    __slots__ = ("at", "depth", "findings", "kind", "kinds", "tokens")

    def __init__(self, tokens: Tokens) -> None:
        self.tokens = tokens
        self.kinds = tokens.kinds
        self.at = 0
        self.kind = self.kinds[0]
        self.depth = 0
        self.findings: list[Finding] = []

    def skip(self) -> int:
        """Take the next token, whatever it is; returns its number."""
        number = self.at
        if self.kind != END:
            self.at = number + 1
            self.kind = self.kinds[number + 1]
        return number

    def take(self, kind: str) -> bool:
        """Take a token of this kind, if it is the next."""
        if self.kind == kind:
            self.skip()
            return True
        return False

    def expect(self, kind: str, where: str = "") -> int:
        """Take a token of this kind; returns its number.

        Raises:
            SyntaxSlipError: Another stands there.
        """
        if self.kind != kind:
            raise self.slip((kind,), where)
        return self.skip()

    def end(self, where: str) -> None:
        """Take the `;` that ends something; where the next thing begins without it, it is only told to be missing.

        Raises:
            SyntaxSlipError: Something else stands there.
        """
        if self.take(";"):
            return
        slip = self.slip((";",), where)
        if self.kind not in _GOES_ON and not self._begins_line():
            raise slip

    def _begins_line(self) -> bool:
        tokens = self.tokens
        return self.kind == NAME and "\n" in tokens.text[tokens.starts[self.at - 1] : tokens.starts[self.at]]

    def text(self, kind: str, where: str = "") -> str:
        """Take a token of this kind; returns its text."""
        return self.tokens.texts[self.expect(kind, where)]

    def name(self, where: str = "") -> Name:
        """Take a name."""
        number = self.expect(NAME, where)
        return Name(self.tokens.texts[number], at=number, to=number)

    def doc(self) -> str:
        """Take a description, if one stands here; returns what is between its signs."""
        if self.kind != DOC:
            return ""
        return self.tokens.texts[self.skip()][3:-2].replace("\r", "").strip()

    def enter(self) -> None:
        """Go one deeper; `depth` is counted down by who went up again."""
        self.depth += 1
        if self.depth > DEEPEST:
            self.complain("X604", f"nested deeper than {DEEPEST}", "take parts of it into options of their own")
            raise SyntaxSlipError

    def complain(self, code: str, message: str, mend: str = "", at: int = -1) -> None:
        """Tell what is wrong with a token, the next one by default."""
        place = self.tokens.place(self.at if at < 0 else at)
        self.findings.append(Finding(rule=rule(code), message=message, mend=mend, place=place))

    def slip(self, wanted: Collection[str], where: str = "") -> SyntaxSlipError:
        """Tell that something else was wanted; returns what is to be raised."""
        after = f" {where}" if where else ""
        if self.kind == END:
            if any(each.rule.code == "X605" for each in self.findings):
                return SyntaxSlipError()
            self.complain("X605", f"the file ends where {_listed(wanted)} is wanted{after}")
            return SyntaxSlipError()
        shown = self.tokens.texts[self.at]
        mend = did_you_mean(shown, [each for each in wanted if each in KEYWORDS]) if self.kind == NAME else ""
        if self.kind in (DOC, INITIAL):
            message, mend = "a description stands where none can", "write it as a comment: // …"
        elif self.kind in KEYWORDS and NAME in wanted:
            message, mend = f"'{shown}' is a word of the language", "take another name"
        else:
            message = f"{_listed(wanted)} wanted{after} instead of '{shown[:40]}'"
        self.complain("X604", message, mend)
        return SyntaxSlipError()

    def leave(self, *wanted: str, inside: int) -> None:
        """Go on after a mistake: to the next of these kinds that is not inside further braces; never past our own `}`.

        `inside` is how many braces are open since that of the block that is read; 0 where the mistake was in itself.
        """
        depth = inside
        while self.kind != END:
            if self.kind == "{":
                depth += 1
            elif self.kind == "}":
                if depth <= 0:
                    return
                depth -= 1
                if depth <= 0 and "}" in wanted:
                    self.skip()
                    return
            elif depth <= 0 and self.kind in wanted:
                return
            self.skip()

    def open_since(self, start: int) -> int:
        """How many braces opened since a token are still open here."""
        passed = self.kinds[start : self.at]
        return max(0, passed.count("{") - passed.count("}"))


def _listed(wanted: Collection[str]) -> str:
    shown = [each if each in (NAME, END) or " " in each or each.isalpha() else f"'{each}'" for each in wanted]
    shown = [f"a {each}" if each == NAME else each for each in shown]
    return shown[0] if len(shown) == 1 else f"{', '.join(shown[:-1])} or {shown[-1]}"
