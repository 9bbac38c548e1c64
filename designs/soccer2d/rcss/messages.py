"""Messages of the server: S-expressions such as `(see 12 ((b) 10.2 -3))`."""

import re
from typing import Any

_TOKEN = re.compile(r'[()]|"[^"]*"|[^\s()"]+')


def parse(text: str) -> list[Any]:
    """Return a message as nested lists of strings.

    Raises:
        ValueError: The text is not one message in parentheses.
    """
    stack: list[list[Any]] = [[]]
    for word in _TOKEN.findall(text):
        if word == "(":
            stack.append([])
        elif word != ")":
            stack[-1].append(word.strip('"'))
        elif len(stack) > 1:
            complete = stack.pop()
            stack[-1].append(complete)
        else:
            raise ValueError(f"unexpected ) in {text!r}")
    match stack:
        case [[[*message]]]:
            return message
    raise ValueError(f"not a message: {text!r}")
