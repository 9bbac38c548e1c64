"""Exchanges the code of running components between two iterations; states, times and values are kept by name."""

from __future__ import annotations

import importlib
import os
import sys
import time
from collections.abc import Iterable, Iterator
from enum import Enum
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from .component import Component, State
from .errors import USER_ERRORS, describe_exception
from .observer import ObservedFunction

if TYPE_CHECKING:
    from .base_root import BaseRoot

STAMP = ".reload"
"""A file whose modification asks for a reload; it is in the first folder of generated code."""

_CHECK_PERIOD_S = 0.2
_KEPT_SLOTS = ("_entered_ns", "_started_ns", "_stepped_in", "_transition", "_worked_ns")


class Reloader:
    """Reloads the changed modules below some folders.

    Generated components are initialized again and get their state, times and values back. Hand-written ones keep their
    attributes and only exchange their methods, since they may hold devices.

    Args:
        root: The root.
        folders: The folders of generated and hand-written code.
    """

    def __init__(self, root: BaseRoot, folders: Iterable[str]) -> None:
        self._root = root
        self._folders = tuple(f"{Path(folder).resolve()}{os.sep}" for folder in folders)
        self._stamp = Path(self._folders[0], STAMP)
        self._stamp_ns = self._read_stamp()
        self._times = dict(self._iter_times())
        self._next_check_s = 0.0

    def reload_if_asked(self) -> list[str]:
        """Reload if the stamp has changed, and say what was done; looks at the stamp at most five times a second."""
        now_s = time.monotonic()
        if now_s < self._next_check_s:
            return []
        self._next_check_s = now_s + _CHECK_PERIOD_S
        stamp_ns = self._read_stamp()
        if stamp_ns == self._stamp_ns:
            return []
        self._stamp_ns = stamp_ns
        return self.reload()

    def reload(self) -> list[str]:
        """Reload the modules that changed; on an error, everything stays as it was."""
        changed = self._find_changed()
        if not changed:
            return []
        for hook in self._root._before_reload:
            hook()
        old_modules = {name: sys.modules.pop(name) for name in changed}
        importlib.invalidate_caches()
        saved = [_Snapshot(component) for component in self._root.components]
        old_components = dict(self._root._components)
        try:
            for name in sorted(changed):
                importlib.import_module(name)
            words = list(self._exchange(changed, saved))
        except USER_ERRORS as error:
            for name in changed:
                sys.modules.pop(name, None)
            sys.modules.update(old_modules)
            for snapshot in saved:
                snapshot.restore()
            self._root._components = old_components
            return [f"not reloaded: {describe_exception(error)}; the old code keeps running"]
        finally:
            for snapshot in saved:
                self._root._instrument(snapshot.component)
            self._root._set_step(self._root._find_step())
            self._times = dict(self._iter_times())
        if type(self._root.world).__module__ in changed:
            words.append("the world keeps its old code; restart to exchange it")
        return [f"reloaded {', '.join(sorted(changed))}", *words]

    def _exchange(self, changed: set[str], saved: list[_Snapshot]) -> Iterator[str]:
        """Exchange the classes of all components of changed modules; yield what could not be kept."""
        classes = {type(each.component): _find_class(type(each.component), changed) for each in saved}
        self._root._components = {classes[kind]: component for kind, component in self._root._components.items()}
        for snapshot in saved:
            new = classes[snapshot.kind]
            if new is snapshot.kind:
                continue
            snapshot.component.__class__ = new
            if snapshot.component._states:
                new.__init__(snapshot.component, self._root)
                yield from snapshot.give_back()
            else:
                snapshot.component._initial = snapshot.component._current = State("", snapshot.component.work)
                if _code(new) != _code(snapshot.kind):
                    yield f"{new.__name__}.__init__ has changed and was not run; restart to run it"

    def _find_changed(self) -> set[str]:
        """Modules whose files have changed, with all modules that use them and the rest of a generated package."""
        now = dict(self._iter_times())
        changed = {name for name, times in now.items() if times != self._times.get(name, times)}
        while True:
            users = {name for name in now if name not in changed and _uses(sys.modules[name], changed)}
            if not users:
                return changed
            changed |= users

    def _iter_times(self) -> Iterator[tuple[str, tuple[int, int]]]:
        for name, module in list(sys.modules.items()):
            file = getattr(module, "__file__", None)
            if file and name != "__main__" and os.path.realpath(file).startswith(self._folders):
                try:
                    status = Path(file).stat()
                except OSError:
                    continue
                yield name, (status.st_mtime_ns, status.st_size)

    def _read_stamp(self) -> int:
        try:
            return self._stamp.stat().st_mtime_ns
        except OSError:
            return 0


class _Snapshot:
    """What a component is before a reload."""

    def __init__(self, component: Component) -> None:
        self.component, self.kind = component, type(component)
        # The functions of observers are removed, and added again after the reload.
        observed = [name for name, value in component.__dict__.items() if isinstance(value, ObservedFunction)]
        for name in ("step", "modulate", *observed):
            component.__dict__.pop(name, None)
        self._attributes = dict(component.__dict__)
        names = (name for name in Component.__slots__ if name != "__dict__")
        self._slots = {name: getattr(component, name) for name in names if hasattr(component, name)}

    def restore(self) -> None:
        self.component.__class__ = self.kind
        self.component.__dict__.clear()
        self.component.__dict__.update(self._attributes)
        for name, value in self._slots.items():
            setattr(self.component, name, value)

    def give_back(self) -> Iterator[str]:
        """Restore state, times and values by name in the initialized component; yield what is lost."""
        component, kind = self.component, type(self.component).__name__
        for name in _KEPT_SLOTS:
            setattr(component, name, self._slots[name])
        # Without these calls, the called components would restart when the component works again.
        component._called = [
            (called, {name: _renew(value) for name, value in parameters.items()})
            for called, parameters in self._slots["_called"]
        ]
        state = component._states.get(self._slots["state"])
        if state is None:
            yield f"{kind} has no state {self._slots['state']} any more; it starts in {component.state}"
            component._entered_ns = component.root.now_ns
        else:
            component._current, component.state = state, state.name
        for name, value in self._attributes.items():
            if not isinstance(value, Component):
                yield from self._give_back_value(name, value)

    def _give_back_value(self, name: str, value: Any) -> Iterator[str]:
        attributes = self.component.__dict__
        new = attributes.get(name)
        if isinstance(value, Enum) and isinstance(new, Enum):
            if value.name in type(new).__members__:
                attributes[name] = type(new)[value.name]
            else:
                yield f"{type(self.component).__name__}.{name} is reset: {type(new).__name__} has no {value.name}"
        elif name in attributes or name.startswith("_"):
            attributes[name] = value


def _find_class(old: type[Component], changed: set[str]) -> type[Component]:
    """The class with the name of an old one in its module, which may have been imported again.

    Raises:
        AttributeError: The module has no such class any more.
    """
    if old.__module__ not in changed:
        return old
    found: type[Component] = getattr(sys.modules[old.__module__], old.__qualname__)
    return found


def _renew(value: Any) -> Any:
    """The element of an enumeration that was imported again; other values, and elements that are gone, as they are."""
    if not isinstance(value, Enum):
        return value
    kind = getattr(sys.modules.get(type(value).__module__), type(value).__qualname__, type(value))
    return getattr(kind, value.name, value)


def _uses(module: ModuleType, changed: set[str]) -> bool:
    """Whether a module has names that it imported from other modules."""
    for value in vars(module).values():
        if isinstance(value, ModuleType):
            if value.__name__ in changed:
                return True
        elif getattr(value, "__module__", None) in changed:
            return True
    package = module.__name__.partition(".")[0]
    return f"{package}.declarations" in changed and module.__name__.startswith(f"{package}.")


def _code(component_class: type[Component]) -> object:
    """What the constructor of a class does, without its place in the file."""
    code = getattr(component_class.__init__, "__code__", None)
    return None if code is None else (code.co_code, code.co_consts, code.co_names)
