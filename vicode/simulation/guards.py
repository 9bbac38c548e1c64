"""Evaluates guards between iterations without running code that could change the component."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from types import ModuleType
from typing import Any

from vicode.bica import Component
from vicode.bica.observer import to_json_value

_COMMON = "@common"


class NotCalledError(Exception):
    """A function of a hand-written component was not called with these arguments in this iteration."""


class CachedFunction:
    """Caches what a function returned in this iteration, so that guards are evaluated without calling it again."""

    def __init__(self, function: Callable[..., Any], watch: GuardEvaluator) -> None:
        self._function, self._watch = function, watch
        self._given: dict[str, Any] = {}

    def __call__(self, *positional: Any, **named: Any) -> Any:
        """Call the function, or return the cached value while guards are evaluated."""
        key = repr((positional, sorted(named.items())))
        if not self._watch.is_evaluating:
            self._given[key] = self._function(*positional, **named)
        elif key not in self._given:
            raise NotCalledError
        return self._given[key]

    @property
    def latest(self) -> Any:
        """The last value returned in this iteration, or None."""
        return next(reversed(self._given.values()), None) if self._given else None

    def clear(self) -> None:
        self._given.clear()


class GuardEvaluator:
    """Evaluates the guards of one component with its generated probes.

    Args:
        component: the component.
        probes: the module generated for it.
        functions: outputs with arguments of hand-written components, by alias.
    """

    def __init__(
        self, component: Component, probes: ModuleType, functions: Iterable[tuple[str, tuple[str, ...]]]
    ) -> None:
        self.is_evaluating = False
        self._component = component
        self._guards: Mapping[str, Mapping[str, list[Any]]] = probes.GUARDS
        self._reads: Mapping[str, Mapping[str, Callable[[Component], Any]]] = probes.READS
        self._functions = [
            self._remember(getattr(component, alias), name) for alias, names in functions for name in names
        ]
        named = (each for guards in self._guards.values() for parts in guards.values() for each in parts)
        self._predicates = {
            name: self._remember(component, name) for name in {each for each in named if isinstance(each, str)}
        }

    def begin_iteration(self) -> None:
        """Clear the values cached in the previous iteration."""
        for answers in (*self._functions, *self._predicates.values()):
            answers.clear()

    def evaluate(self) -> dict[str, dict[str, Any]]:
        """Evaluate the common guards and those of the active state; returns the results by decision."""
        self.is_evaluating = True
        try:
            sources = (self._guards.get(name, {}) for name in (_COMMON, self._component.state))
            return {key: self._evaluate_guard(key, parts) for guards in sources for key, parts in guards.items()}
        finally:
            self.is_evaluating = False

    def _remember(self, owner: Component, name: str) -> CachedFunction:
        known = vars(owner).get(name)
        if isinstance(known, CachedFunction):
            return known
        answers = CachedFunction(getattr(owner, name), self)
        vars(owner)[name] = answers
        return answers

    def _evaluate_guard(self, key: str, parts: list[Any]) -> dict[str, Any]:
        held = [self._evaluate_part(part) for part in parts]
        holds = False if False in held else None if None in held else True
        reads = {name: self._read_or_none(read) for name, read in self._reads.get(key, {}).items()}
        return {"holds": holds, "parts": held, "reads": reads}

    def _evaluate_part(self, part: Any) -> bool | None:
        answer = self._predicates[part].latest if isinstance(part, str) else self._read_or_none(part)
        return answer if answer is None else bool(answer)

    def _read_or_none(self, read: Callable[[Component], Any]) -> Any:
        try:
            return to_json_value(read(self._component))
        except Exception:
            return None
