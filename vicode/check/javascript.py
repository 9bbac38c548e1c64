"""Rules for designs that are generated as JavaScript (L705)."""

from collections.abc import Iterator

from vicode.check.context import RuleContext
from vicode.findings import Finding
from vicode.model.expressions import OutputRef, walk

LANGUAGE = "javascript"


def find_unsupported_features(context: RuleContext) -> Iterator[Finding]:
    """L705: features of a design that generated JavaScript does not support."""
    for placed in context.code_blocks:
        if placed.code.texts:
            message, fix = "code has no counterpart in JavaScript", "use guards, `set` and calls"
            yield context.make_finding("L705", placed.path, message, fix, languages=(LANGUAGE,))
    for state in context.design.states:
        for key in ("capacity", "synchronized"):
            if getattr(state, key) is not None:
                message, path = f"'{key}' is not supported in JavaScript", ("states", state.name, key)
                fix = "leave it out, or use another language"
                yield context.make_finding("L705", path, message, fix, is_key=True, languages=(LANGUAGE,))


def find_nested_calls(context: RuleContext) -> Iterator[Finding]:
    """L705: calls of an output inside an argument of the same output, with the rules of XABSL."""
    for each in context.expressions if context.design.arithmetic == "xabsl" else ():
        for node in walk(each.tree) if each.tree is not None else ():
            if isinstance(node, OutputRef) and _calls_itself(node):
                message = f"a call of '{node.output}' inside its own arguments is not supported in JavaScript"
                fix = "store the inner result in a variable"
                yield context.make_finding("L705", each.path, message, fix, span=node.span, languages=(LANGUAGE,))


def _calls_itself(node: OutputRef) -> bool:
    inner = (part for _name, value in node.arguments or () for part in walk(value))
    return any(isinstance(part, OutputRef) and (part.alias, part.output) == (node.alias, node.output) for part in inner)


RULES = (find_unsupported_features, find_nested_calls)
