"""Functions to call after every change of something."""

from collections.abc import Callable
from typing import Generic, ParamSpec

_P = ParamSpec("_P")


class Subscribers(Generic[_P]):
    """A list of functions; `notify` calls all of them with its arguments."""

    def __init__(self) -> None:
        self._functions: list[Callable[_P, object]] = []

    def subscribe(self, function: Callable[_P, object]) -> Callable[[], None]:
        """Add a function; return a function that removes it, which may be called again."""
        self._functions.append(function)

        def unsubscribe() -> None:
            if function in self._functions:
                self._functions.remove(function)

        return unsubscribe

    def __bool__(self) -> bool:
        return bool(self._functions)

    def notify(self, *args: _P.args, **kwargs: _P.kwargs) -> None:
        for function in tuple(self._functions):
            function(*args, **kwargs)
