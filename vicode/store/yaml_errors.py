"""What a YAML parser complains about, in the user's words."""

import yaml

# (part of the parser's message, message, mend, whether the place where it began helps)
_EXPLANATIONS = (
    ("tab character that violates", "a tab where blanks must indent", "indent with blanks", False),
    ("mapping values are not allowed", "a ':' where none can stand",
     "put a text that holds ': ' in quotes, or check the indentation", False),
    ("block sequence entries are not allowed", "a list cannot begin here", "begin '- ' on a line of its own", False),
    ("could not find expected ':'", "a key without ':'", "write 'key: value'", True),
    ("expected ',' or ']'", "the list in '[…]' is not closed, or a ',' is missing", "add ',' or ']'", True),
    ("expected ',' or '}'", "the mapping in '{…}' is not closed, or a ',' is missing",
     "add ',' or '}'; put a text that holds one of , [ ] { } in quotes", True),
    ("unexpected end of stream", "a quoted text is not closed", "add the closing quote", True),
    ("unexpected document", "a quoted text is not closed", "add the closing quote", True),
    ("unknown escape", "an escape that YAML does not know",
     "write '\\\\' for one backslash, or use single quotes", False),
    ("expected '-' indicator", "a line that does not belong to the list above", "check the indentation", True),
    ("expected <block end>", "the indentation does not fit the lines above",
     "indent keys of one mapping equally, and close every bracket and quote", True),
    ("did not find expected key", "the indentation does not fit the lines above",
     "indent keys of one mapping equally, and close every bracket and quote", True),
    ("node content", "a value is missing", "write one, or take the ',' away", False),
    ("undefined tag handle", "a tag; only plain values are read",
     "take the tag away, or put the text in quotes", False),
    ("undefined alias", "an alias to nothing", "put a text that begins with '*' in quotes", False),
    ("alphabetic or numeric", "a text cannot begin with '*' or '&'", "put it in quotes", False),
    ("incompatible YAML document", "a YAML version that is not known", "take the line '%YAML' away", False),
    ("block scalar", "the line that begins a text with '|' or '>' holds more than that",
     "begin the text on the next line", False),
)  # fmt: skip


def explain_yaml_error(error: yaml.YAMLError, char: str) -> tuple[str, str, bool]:
    """Message, mend, and whether the place where the broken thing began helps; `char` stands at the error."""
    problem = f"{getattr(error, 'context', None) or ''} {getattr(error, 'problem', None) or ''}"
    if "cannot start any token" in problem:
        return _explain_character(char)
    for part, message, mend, tells_opening in _EXPLANATIONS:
        if part in problem:
            return message, mend, tells_opening
    return problem.strip() or "the text is not YAML", "", False


def _explain_character(char: str) -> tuple[str, str, bool]:
    if char == "\t":
        return "a tab where blanks must indent", "indent with blanks", False
    return f"a value cannot begin with '{char}'", "put it in quotes", False
