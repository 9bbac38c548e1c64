"""Map the lines of an option file to states, decisions and actions."""

from collections.abc import Iterator

from vicode.generators.origins import Origin
from vicode.generators.plan import ComponentPlan
from vicode.generators.xabsl.option_printer import pair_nodes, parse_option
from vicode.generators.xabsl.options import GeneratedOption, build_option
from vicode.xabsl import tree
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.tokens import DOC


def find_origins(plan: ComponentPlan, text: str) -> tuple[Origin, ...]:
    """Return the origins, outer before inner; empty if the text is not the generated file."""
    return option_origins(text, build_option(plan))


def option_origins(text: str, generated: GeneratedOption) -> tuple[Origin, ...]:
    """Return the origins of an option that is already built."""
    parsed, option = parse_option(text)
    if option is None or option != generated.option:
        return ()
    origins = _origins(generated, option, parsed.tokens)
    return tuple(sorted(origins, key=lambda origin: (origin.first, -origin.last)))


def _origins(generated: GeneratedOption, option: tree.OptionNode, tokens: Tokens) -> Iterator[Origin]:
    parsed_nodes = {id(built): node for built, node in pair_nodes(generated.option, option)}
    for built, path in generated.node_paths:
        node = parsed_nodes[id(built)]
        first, last = node.first_token, node.last_token
        if isinstance(node, tree.IfNode) and path != ("common", "transitions"):
            # The part after `else` comes from another decision.
            last = node.then.last_token
        first = (
            _include_else_and_doc(first, tokens)
            if not isinstance(node, tree.StateNode | tree.ActionBlockNode)
            else first
        )
        start = tokens.line_at(tokens.starts[first])
        yield Origin(first=_include_comments(start, tokens), last=_last_line(tokens, last), path=path)


def _include_else_and_doc(first: int, tokens: Tokens) -> int:
    """Return the first token of a decision, including a preceding `else` and description."""
    if first and tokens.kinds[first - 1] == "else":
        first -= 1
    return first - 1 if first and tokens.kinds[first - 1] == DOC else first


def _include_comments(line: int, tokens: Tokens) -> int:
    """Return the first line of the comment directly above a line."""
    lines = tokens.text.split("\n")
    while line > 2 and lines[line - 2].strip().startswith("//"):
        line -= 1
    return line


def _last_line(tokens: Tokens, last: int) -> int:
    return tokens.line_at(tokens.starts[last] + len(tokens.texts[last]) - 1)
