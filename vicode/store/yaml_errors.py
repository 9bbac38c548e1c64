"""Translates errors of the YAML parser into messages and fixes."""

import yaml

# Part of the parser message, message, fix, and whether to report the start of the construct.
_EXPLANATIONS = (
    ("tab character that violates", "tab used for indentation", "indent with spaces", False),
    ("mapping values are not allowed", "unexpected ':'",
     "quote a text that contains ': ', or check the indentation", False),
    ("block sequence entries are not allowed", "a list cannot start here", "put '- ' on a separate line", False),
    ("could not find expected ':'", "missing ':' after a key", "write 'key: value'", True),
    ("expected ',' or ']'", "unclosed list '[…]', or missing ','", "add ',' or ']'", True),
    ("expected ',' or '}'", "unclosed mapping '{…}', or missing ','",
     "add ',' or '}'; quote a text that contains one of , [ ] { }", True),
    ("unexpected end of stream", "unclosed quoted text", "add the closing quote", True),
    ("unexpected document", "unclosed quoted text", "add the closing quote", True),
    ("unknown escape", "invalid escape sequence",
     "write '\\\\' for a backslash, or use single quotes", False),
    ("expected '-' indicator", "unexpected line after a list", "check the indentation", True),
    ("expected <block end>", "the indentation does not match the lines above",
     "indent all keys of a mapping equally, and close all brackets and quotes", True),
    ("did not find expected key", "the indentation does not match the lines above",
     "indent all keys of a mapping equally, and close all brackets and quotes", True),
    ("node content", "a value is missing", "add the value, or remove the ','", False),
    ("undefined tag handle", "YAML tags are not supported",
     "remove the tag, or quote the text", False),
    ("undefined alias", "undefined YAML alias", "quote a text that starts with '*'", False),
    ("alphabetic or numeric", "a text cannot start with '*' or '&'", "quote the text", False),
    ("incompatible YAML document", "unsupported YAML version", "remove the line '%YAML'", False),
    ("block scalar", "unexpected text after '|' or '>'",
     "start the text on the next line", False),
)  # fmt: skip


def explain_yaml_error(error: yaml.YAMLError, char: str) -> tuple[str, str, bool]:
    """Return message, fix, and whether to report the start of the construct; `char` is the character at the error."""
    problem = f"{getattr(error, 'context', None) or ''} {getattr(error, 'problem', None) or ''}"
    if "cannot start any token" in problem:
        return _explain_character(char)
    for part, message, fix, tells_opening in _EXPLANATIONS:
        if part in problem:
            return message, fix, tells_opening
    return problem.strip() or "the text is not YAML", "", False


def _explain_character(char: str) -> tuple[str, str, bool]:
    if char == "\t":
        return "tab used for indentation", "indent with spaces", False
    return f"a value cannot start with '{char}'", "quote the value", False
