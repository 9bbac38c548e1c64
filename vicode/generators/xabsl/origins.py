"""Finds in the file of an option which lines come from which state, decision and actions."""

from collections.abc import Iterator

from vicode.generators.origins import Origin
from vicode.generators.plan import ComponentPlan
from vicode.generators.xabsl.options import OptionText, write_option
from vicode.generators.xabsl.printing import pairs, read_option
from vicode.xabsl import tree
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.tokens import DOC


def find_origins(plan: ComponentPlan, text: str) -> tuple[Origin, ...]:
    """The origins in the file of an option, the wider before those inside them; none in any other text."""
    return origins_in(text, write_option(plan))


def origins_in(text: str, written: OptionText) -> tuple[Origin, ...]:
    """The same of an option that is written already."""
    parsed, option = read_option(text)
    if option is None or option != written.option:
        return ()
    found = _origins(written, option, parsed.tokens)
    return tuple(sorted(found, key=lambda origin: (origin.first, -origin.last)))


def _origins(written: OptionText, option: tree.Option, tokens: Tokens) -> Iterator[Origin]:
    read = {id(made): found for made, found in pairs(written.option, option)}
    for made, path in written.places:
        node = read[id(made)]
        first, last = node.at, node.to
        if isinstance(node, tree.If) and path != ("common", "transitions"):
            # What goes on after `else` comes from another decision.
            last = node.then.to
        first = _with_words(first, tokens) if not isinstance(node, tree.State | tree.Actions) else first
        start = tokens.line_at(tokens.starts[first])
        yield Origin(first=_with_comments(start, tokens), last=_last_line(tokens, last), path=path)


def _with_words(first: int, tokens: Tokens) -> int:
    """The token that a decision begins with: the `else` before it, and what describes it, belong to it."""
    if first and tokens.kinds[first - 1] == "else":
        first -= 1
    return first - 1 if first and tokens.kinds[first - 1] == DOC else first


def _with_comments(line: int, tokens: Tokens) -> int:
    """The first line of the comment that ends right above a line."""
    lines = tokens.text.split("\n")
    while line > 2 and lines[line - 2].strip().startswith("//"):
        line -= 1
    return line


def _last_line(tokens: Tokens, last: int) -> int:
    return tokens.line_at(tokens.starts[last] + len(tokens.texts[last]) - 1)
