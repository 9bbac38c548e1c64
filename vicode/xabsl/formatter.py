"""Writes tokens in lines, with each comment before the token that it preceded in the source."""

from collections.abc import Collection, Mapping, Sequence

from vicode.xabsl.lexer import Comment

INDENT = "  "


class TokenFormatter:
    """Builds a text token by token; `depth` is the level of indentation.

    Args:
        comments: comments by the number of the token that follows them.
        blanks: numbers of the tokens that follow an empty line.
    """

    def __init__(self, comments: Mapping[int, Sequence[Comment]], blanks: Collection[int]) -> None:
        self._comments = {number: list(group) for number, group in comments.items()}
        self._after_blank_lines = blanks
        self._lines: list[str] = []
        self._line = ""
        self._count = 0
        self._must_break = False
        self._is_block_start = True
        self.depth = 0

    def text(self) -> str:
        """Finish the text and return it, with the comments at its end."""
        self._write_comments(self.depth)
        self._end_line()
        while self._lines and not self._lines[-1]:
            self._lines.pop()
        return "".join(f"{line}\n" for line in self._lines)

    @property
    def column(self) -> int:
        return len(self._line) or len(INDENT) * self.depth

    def write(self, text: str, gap: str = " ") -> None:
        """Write a token; `gap` separates it from the previous token in its line."""
        self._write_comments(self.depth)
        if self._must_break:
            self._end_line()
        if self._line:
            self._line += gap + text
        else:
            self._start_line(text)
        self._count += 1
        self._is_block_start = text == "{"

    def write_on_new_line(self, text: str) -> None:
        self.end_line()
        self.write(text)

    def end_line(self) -> None:
        """End the line after the trailing comments of its last token."""
        trailing = self._comments.get(self._count, [])
        while trailing and self._line and not trailing[0].own_line:
            self._write_trailing_comment(trailing.pop(0))
        self._end_line()

    def blank_line(self) -> None:
        """Write an empty line, except at the start of a block or of the text."""
        self.end_line()
        if self._lines and self._lines[-1] and not self._is_block_start:
            self._lines.append("")

    def close_block(self, text: str) -> None:
        """Write the token that ends a block on a new line, one level less indented."""
        self.end_line()
        self._write_comments(self.depth)
        self._end_line()
        self.depth -= 1
        self._line = INDENT * self.depth + text
        self._count += 1
        self._is_block_start = False

    def _start_line(self, text: str) -> None:
        if self._count in self._after_blank_lines and self._lines and self._lines[-1] and not self._is_block_start:
            self._lines.append("")
        first, *more_lines = text.split("\n")
        self._lines += [INDENT * self.depth + first, *more_lines][:-1] if more_lines else []
        self._line = more_lines[-1] if more_lines else INDENT * self.depth + first

    def _end_line(self) -> None:
        if self._line:
            self._lines.append(self._line.rstrip())
        self._line, self._must_break = "", False

    def _write_comments(self, depth: int) -> None:
        for comment in self._comments.pop(self._count, ()):
            if self._line and not comment.own_line:
                self._write_trailing_comment(comment)
                continue
            self._end_line()
            if comment.after_blank_line and self._lines and self._lines[-1] and not self._is_block_start:
                self._lines.append("")
            first, *more_lines = comment.text.split("\n")
            # Only the first line of a comment is indented; the other lines stay as written.
            self._lines += [INDENT * depth + first, *more_lines]
            self._is_block_start = False

    def _write_trailing_comment(self, comment: Comment) -> None:
        if self._must_break:
            self._end_line()
        self._line = f"{self._line} {comment.text}" if self._line else INDENT * self.depth + comment.text
        self._must_break = comment.text.startswith("//")
