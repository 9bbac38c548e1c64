"""Finds in the file of an option which lines come from which state, decision and actions."""

from collections.abc import Iterator

from vicode.generators.origins import Origin
from vicode.generators.plan import ComponentPlan
from vicode.generators.xabsl.option_printer import pair_nodes, parse_option
from vicode.generators.xabsl.options import GeneratedOption, build_option
from vicode.xabsl import tree
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.tokens import DOC


def find_origins(plan: ComponentPlan, text: str) -> tuple[Origin, ...]:
    """The origins in the file of an option, the wider before those inside them; none in any other text."""
    return option_origins(text, build_option(plan))


def option_origins(text: str, written: GeneratedOption) -> tuple[Origin, ...]:
    """The same of an option that is written already."""
    parsed, option = parse_option(text)
    if option is None or option != written.option:
        return ()
    found = _origins(written, option, parsed.tokens)
    return tuple(sorted(found, key=lambda origin: (origin.first, -origin.last)))


def _origins(written: GeneratedOption, option: tree.OptionNode, tokens: Tokens) -> Iterator[Origin]:
    read = {id(made): found for made, found in pair_nodes(written.option, option)}
    for made, path in written.node_paths:
        node = read[id(made)]
        first, last = node.first_token, node.last_token
        if isinstance(node, tree.IfNode) and path != ("common", "transitions"):
            # What goes on after `else` comes from another decision.
            last = node.then.last_token
        first = (
            _include_else_and_doc(first, tokens)
            if not isinstance(node, tree.StateNode | tree.ActionBlockNode)
            else first
        )
        start = tokens.line_at(tokens.starts[first])
        yield Origin(first=_include_comments(start, tokens), last=_last_line(tokens, last), path=path)


def _include_else_and_doc(first: int, tokens: Tokens) -> int:
    """The token that a decision begins with: the `else` before it, and what describes it, belong to it."""
    if first and tokens.kinds[first - 1] == "else":
        first -= 1
    return first - 1 if first and tokens.kinds[first - 1] == DOC else first


def _include_comments(line: int, tokens: Tokens) -> int:
    """The first line of the comment that ends right above a line."""
    lines = tokens.text.split("\n")
    while line > 2 and lines[line - 2].strip().startswith("//"):
        line -= 1
    return line


def _last_line(tokens: Tokens, last: int) -> int:
    return tokens.line_at(tokens.starts[last] + len(tokens.texts[last]) - 1)
