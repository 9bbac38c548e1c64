"""The depth of recursion in Python: programs nest as deeply as the original allows."""

import sys

_FRAMES_PER_CALL = 3


def depth_limit(most: int, frames: int) -> int:
    """The number of levels that a recursive function may go down if each one takes this many frames of Python."""
    return min(most, sys.getrecursionlimit() // frames)


def allow_calls(calls: int) -> None:
    """Raise the limit of Python's recursion, if necessary, for a chain of so many calls of options."""
    needed = _FRAMES_PER_CALL * calls + 1000
    if needed > sys.getrecursionlimit() and calls > 100:
        sys.setrecursionlimit(needed)
