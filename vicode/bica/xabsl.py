"""Component with XABSL semantics: restart and completion follow the XABSL engine."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from .component import Component

if TYPE_CHECKING:
    from .base_root import BaseRoot


class XabslComponent(Component):
    """A component that behaves like an option in the XABSL engine, even if it is stepped twice in an iteration."""

    __slots__ = ("_cells", "_restarted_in")

    def __init__(self, root: BaseRoot) -> None:
        super().__init__(root)
        self._restarted_in = -1
        self._cells: dict[str, dict[str, Any]] = {}

    def step(self) -> None:
        """Activate the component; if it was inactive in the last iteration, each step in this one restarts it."""
        iteration = self.root.iteration
        if self._stepped_in == iteration and self._restarted_in == iteration:
            # Makes `Component.step` restart it, as after a missed iteration.
            self._stepped_in = iteration - 2
        super().step()

    @property
    def is_done(self) -> bool:
        """Whether the component was active in the previous iteration and is in a final state."""
        if not self._current.final:
            return False
        iteration = self.root.iteration
        if self._stepped_in == iteration:
            return self._restarted_in != iteration
        return self._stepped_in == iteration - 1

    def _ask(self, function: Callable[..., Any], **given: Callable[[], Any]) -> Any:
        """Call a function whose arguments may call it; as in XABSL, the inner call overwrites earlier arguments."""
        cells = self._cells.setdefault(function.__name__, {})
        for name, value in given.items():
            cells[name] = value()
        return function(**cells)

    def _start(self, *, is_first: bool) -> None:
        self._restarted_in = self.root.iteration
        super()._start(is_first=is_first)
