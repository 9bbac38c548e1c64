"""Components whose outputs the user sets; they replace hand-written components."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from enum import Enum
from types import ModuleType
from typing import Any, cast

from vicode.bica import Component, Root, arithmetic
from vicode.bica.observer import to_json_value
from vicode.simulation.messages import Inputs, Stub, StubOutput

STUB_MODULE = "vicode_stubs"
DONE = "is_done"
"""The input that says whether a stubbed design is in a final state."""

Enumerations = Mapping[str, type[Enum]]


class StubComponent(Component):
    """Holds its outputs and ignores its parameters.

    As in a run, its outputs change only when it is stepped. The values that it will then have are shown in advance if
    it was stepped in the last iteration.
    """

    stub: Stub

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self._enumerations: Enumerations = {}
        self._calls: list[dict[str, Any]] = []
        initial = {output.name: output.value for output in self.stub.outputs}
        self._given: dict[str, Any] = {**initial, DONE: False}
        self._held = self._shown = self._given

    def modulate(self, **_parameters: Any) -> None:
        """Accept any parameters; they appear in the trace."""

    @property
    def is_done(self) -> bool:
        return self._shown[DONE] is True and self.root.iteration - self._stepped_in <= 1

    def work(self) -> None:
        """Apply the values that the user set."""
        self._held = self._given
        self._show(self._held)

    def set_initial_values(self, enumerations: Enumerations) -> None:
        """Set the initial values; enumerations are known only after the package is loaded."""
        self._enumerations = enumerations
        for output in self.stub.outputs:
            self._set(output, output.value)

    def set_outputs(self, values: Mapping[str, Any]) -> None:
        """Set outputs by name; unknown names are ignored."""
        self._given = {**self._given, **{name: value for name, value in values.items() if name in self._given}}
        live = {each.name: self._given[each.name] for each in self.stub.outputs if each.is_live}
        if live:
            self._held = {**self._held, **live}
            self._show({**self._shown, **live})
        if self.stub.is_live:
            self._held = self._given
        if self.stub.is_live or self._stepped_in >= self.root.iteration or not self.root.iteration:
            self._show(self._given)

    def hold_outputs(self) -> None:
        """Return to the values of the last step, before an iteration."""
        self._show(self._held)

    def _show(self, values: dict[str, Any]) -> None:
        if values is not self._shown:
            before, self._shown = self._shown, values
            for output in self.stub.outputs:
                # Not by `!=`, for which 0.0 and -0.0 are equal.
                if values[output.name] is not before[output.name]:
                    self._set(output, values[output.name])

    def drain_calls(self) -> list[dict[str, Any]]:
        """Return the calls of functions since the last call."""
        asked, self._calls = self._calls, []
        return asked

    def _set(self, output: StubOutput, value: Any) -> None:
        if output.is_function:
            self.__dict__[output.name] = _StubFunction(self, output, value)
        else:
            self.__dict__[output.name] = convert_value(value, output.type, self._enumerations)

    def convert(self, output: StubOutput, value: Any) -> Any:
        return convert_value(value, output.type, self._enumerations)

    def record_call(self, output: StubOutput, arguments: Mapping[str, Any], value: Any) -> None:
        """Record a call, once per iteration."""
        call = {
            "component": self.stub.component,
            "output": output.name,
            "arguments": to_json_value(dict(arguments)),
            "value": to_json_value(value),
        }
        if call not in self._calls:
            self._calls.append(call)


class _StubFunction:
    """An output with arguments: one value for some arguments and one for all others."""

    def __init__(self, owner: StubComponent, output: StubOutput, plain: Any) -> None:
        self._owner, self._output = owner, output
        self._else = plain.get("value") if isinstance(plain, dict) else plain
        self._table = plain.get("table", []) if isinstance(plain, dict) else []

    def __call__(self, *positional: Any, **arguments: Any) -> Any:
        named = {**{str(index): value for index, value in enumerate(positional)}, **arguments}
        plain = to_json_value(named)
        found = next((value for given, value in self._table if given == plain), self._else)
        value = self._owner.convert(self._output, found)
        self._owner.record_call(self._output, named, value)
        return value


class StubInputs:
    """Sets what a user can set: the outputs of all stubs and the parameters of the main component."""

    def __init__(self, root: Root, parameter_types: Mapping[str, str], enumerations: Enumerations) -> None:
        self._main = root.main
        self._types, self._enumerations = parameter_types, enumerations
        self.stubs = tuple(stub for stub in root.components if isinstance(stub, StubComponent))
        for stub in self.stubs:
            stub.set_initial_values(enumerations)

    def set(self, inputs: Inputs) -> None:
        """Set the values by component, "" for parameters; unknown names are ignored."""
        for stub in self.stubs:
            stub.set_outputs(inputs.get(stub.stub.component, {}))
        given = {name: value for name, value in inputs.get("", {}).items() if name in self._types}
        if given:
            now = {name: getattr(self._main, name) for name in self._types}
            new = {name: convert_value(value, self._types[name], self._enumerations) for name, value in given.items()}
            cast("Any", self._main).modulate(**{**now, **new})

    def begin_iteration(self) -> None:
        """Return to the values of the last step, and forget calls that were made between iterations."""
        for stub in self.stubs:
            stub.drain_calls()
            stub.hold_outputs()


def install_stub_module(stubs: tuple[Stub, ...]) -> None:
    """Create a module with a class for each stub, from which generated code imports them."""
    module = ModuleType(STUB_MODULE)
    for stub in stubs:
        attributes: dict[str, object] = {"stub": stub, "__module__": STUB_MODULE}
        if stub.is_live:
            # It only provides values, which a trace then has in each iteration.
            attributes["work"] = Component.work
        setattr(module, stub.component, type(stub.component, (StubComponent,), attributes))
    sys.modules[STUB_MODULE] = module


def convert_value(value: Any, type_: str, enumerations: Enumerations) -> Any:
    """Convert a JSON value to a design type; an unsuitable value becomes false, 0 or the first element."""
    if type_ == "bool":
        return bool(value)
    if type_ == "int":
        return arithmetic.limit(int(_number(value, int)))
    if type_ == "float":
        return _number(value, float)
    elements = enumerations.get(type_)
    if elements is None:
        return value
    name = str(value).rpartition(".")[2]
    return elements.__members__.get(name) or next(iter(elements))


def _number(value: Any, make: type[int] | type[float]) -> int | float:
    try:
        return make(value)
    except (TypeError, ValueError, OverflowError):
        return make(0)
