"""The inputs of a simulation: a slider for a range, a switch for a bool, a list for an enumeration, a number field."""

import math
from collections.abc import Callable
from itertools import groupby
from typing import Any

from nicegui import ui

from vicode.editor.panels.simulation.controller import SimulationController
from vicode.editor.panels.simulation.range_input import RangeInput
from vicode.editor.view.guard_rows import find_read_outputs, list_guard_rows
from vicode.runs import DONE, PARAMETERS, RunStatus, Simulation, SimulationInput
from vicode.runs.guard_values import format_value

_MAX_CALLS = 8


class InputsForm:
    """The form of the inputs, rebuilt for each simulation; shows the inputs at the shown iteration."""

    def __init__(self, controller: SimulationController) -> None:
        self.controller = controller
        self._simulation: Simulation | None = None
        self._rows: list[_InputRow] = []
        self.body = ui.column().classes("inputs")

    def refresh(self) -> None:
        simulation = self.controller.simulation
        self.body.set_visibility(not self.controller.robot.is_shown)
        if self.controller.robot.is_shown:
            return
        if simulation is not self._simulation or not self._rows:
            self._simulation = simulation
            self.body.clear()
            with self.body:
                self._rows = self._build(simulation)
        if simulation is None:
            return
        values = simulation.inputs
        read = self._names_read(simulation)
        can_set = simulation.status is not RunStatus.ENDED and not simulation.is_view
        for row in self._rows:
            row.show(values.get(row.input.component, {}).get(row.input.name))
            row.mark(is_read=(row.input.component, row.input.name) in read, can_set=can_set)

    def _build(self, simulation: Simulation | None) -> list["_InputRow"]:
        if simulation is None:
            ui.label("Press F10 or the play button to start. Inputs appear here.").classes("empty")
            return []
        inputs = simulation.prepared.inputs
        if simulation.replay:
            ui.label("Viewing a recorded trace; nothing runs.").classes("empty")
            return []
        if not inputs:
            ui.label("No inputs: all components run.").classes("empty")
        rows = []
        for component, group in groupby(inputs, key=lambda each: each.component):
            title = component or f"Parameters of {simulation.prepared.design.component}"
            with ui.row().classes("heading inputs-heading"):
                ui.label(title)
            rows += [self._row(each, simulation) for each in group]
        return rows

    def _row(self, input_: SimulationInput, simulation: Simulation) -> "_InputRow":
        def set_value(value: Any) -> None:
            self.controller.context.run_in_background(simulation.set_input(input_.key, value), "set input")

        return (
            _FunctionRow(input_, set_value, simulation)
            if input_.arguments is not None
            else _InputRow(input_, set_value)
        )

    def _names_read(self, simulation: Simulation) -> set[tuple[str, str]]:
        """The outputs that the guards of the active state read, by component."""
        iteration = simulation.shown_iteration
        design = simulation.prepared.design
        rows = list_guard_rows(design, iteration.state if iteration else design.initial, simulation.guards)
        components = {use.alias: use.component for use in design.uses}
        found = set()
        for name in find_read_outputs(rows, simulation.guards):
            alias, _dot, output = name.partition("(")[0].rpartition(".")
            found.add((components.get(alias, PARAMETERS), output))
        return found


class _InputRow:
    def __init__(self, input_: SimulationInput, set_value: Callable[[Any], None]) -> None:
        self.input = input_
        self._set = set_value
        self._shown: Any = input_.initial
        label = "done" if input_.name == DONE else input_.name
        tip = " ".join(part for part in (input_.doc, f"in {input_.unit}" if input_.unit else "") if part)
        with ui.element("div").classes("input-row") as self.element:
            with ui.label(label).classes("input-name mono"):
                if tip:
                    ui.tooltip(tip)
            self.controls = input_controls(input_, f"{input_.component or 'Parameter'} {label}", self._changed)

    def show(self, value: Any) -> None:
        """Show a value without an event, rounded unless the user typed it."""
        if value is None or short_value(value) in (self._shown, short_value(self._shown)):
            return
        value = short_value(value)
        self._shown = value
        for control in self.controls:
            control.set_value(value)

    def mark(self, *, is_read: bool, can_set: bool) -> None:
        """Highlight an input that the guards of the active state read; disable one that cannot be set."""
        self.element.classes(add="is-read" if is_read else None, remove=None if is_read else "is-read")
        for control in self.controls:
            if control.enabled != can_set:
                control.set_enabled(can_set)

    def _changed(self, value: Any) -> None:
        accepted = self.input.accept(value)
        if accepted is None or accepted == self._shown:
            return
        self._shown = accepted
        for control in self.controls:
            if control.value != accepted:
                control.set_value(accepted)
        self._set(accepted)


class _FunctionRow(_InputRow):
    """An output with arguments: a value for all arguments, and one for each combination it was called with."""

    def __init__(self, input_: SimulationInput, set_value: Callable[[Any], None], simulation: Simulation) -> None:
        super().__init__(input_, set_value)
        self._simulation = simulation
        self._table: list[list[Any]] = []
        self._called_arguments: list[dict[str, Any]] = []
        self.rows = ui.column().classes("input-table")

    def show(self, value: Any) -> None:
        """Show the value for all arguments, and the rows of the table."""
        if isinstance(value, dict):
            self._table = [list(row) for row in value.get("table", ())]
            super().show(value.get("value"))
        iteration = self._simulation.shown_iteration
        calls = iteration.calls if iteration else []
        key = (self.input.component, self.input.name)
        asked = [call["arguments"] for call in calls if (call.get("component"), call.get("output")) == key]
        new = [arguments for arguments in asked if arguments not in self._called_arguments][:_MAX_CALLS]
        for arguments in new:
            if len(self._called_arguments) < _MAX_CALLS:
                self._called_arguments.append(arguments)
                self._add_row(arguments)

    def _changed(self, value: Any) -> None:
        accepted = self.input.accept(value)
        if accepted is not None and accepted != self._shown:
            self._shown = accepted
            self._set({"value": accepted, "table": self._table})

    def _add_row(self, arguments: dict[str, Any]) -> None:
        words = ", ".join(f"{name} = {format_value(value)}" for name, value in arguments.items())
        with self.rows, ui.element("div").classes("input-row"):
            ui.label(f"if {words}").classes("input-name mono")
            input_controls(self.input, f"{self.input.name} if {words}", lambda value: self._set_for(arguments, value))

    def _set_for(self, arguments: dict[str, Any], value: Any) -> None:
        accepted = self.input.accept(value)
        if accepted is None:
            return
        others = [row for row in self._table if row[0] != arguments]
        self._table = [*others, [arguments, accepted]]
        self._set({"value": self._shown, "table": self._table})


def input_controls(input_: SimulationInput, name: str, changed: Callable[[Any], None]) -> list[Any]:
    """Build the controls of an input: a switch, a select, or a number field with a slider if the input has a range."""
    if input_.type == "bool":
        switch = ui.switch(value=input_.initial, on_change=lambda event: changed(event.value))
        return [_with_aria_label(switch.props("dense"), name)]
    if input_.options:
        options = {option: option.rpartition(".")[2] for option in input_.options}
        choice = ui.select(options, value=input_.initial, on_change=lambda event: changed(event.value))
        return [_with_aria_label(choice.props("dense outlined options-dense").classes("input-choice"), name)]
    controls: list[Any] = []
    if input_.range is not None and input_.range[0] < input_.range[1]:
        low, high = input_.range
        slider = RangeInput(name, low=low, high=high, step=_step(input_), value=input_.initial, on_move=changed)
        controls.append(slider.classes("input-slider"))
    number = ui.number(value=input_.initial, step=_step(input_), suffix=input_.unit or None)
    number.on_value_change(lambda event: changed(event.value))
    number.props("dense outlined debounce=150").classes("input-number mono")
    return [*controls, _with_aria_label(number, f"{name}, number" if controls else name)]


def short_value(value: Any) -> Any:
    if not isinstance(value, float) or not math.isfinite(value):
        return value
    return float(f"{value:.4g}") if abs(value) < 1000 else float(round(value))


def _with_aria_label(control: Any, name: str) -> Any:
    """Set the accessible name as an attribute: quotes in a name would end the text of `props`."""
    control.props["aria-label"] = name
    return control


def _step(input_: SimulationInput) -> float:
    """A hundredth of the range, rounded."""
    if input_.type == "int":
        return 1
    if input_.range is None:
        return 0.1
    width = (input_.range[1] - input_.range[0]) / 100
    return next((step for step in (0.001, 0.01, 0.1, 0.5, 1, 5, 10, 50) if step >= width / 2), 100)
