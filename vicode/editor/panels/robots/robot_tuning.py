"""Sliders for the tunable constants and parameters of a running robot, and a button that keeps their values."""

from dataclasses import replace
from typing import Any

from nicegui import ui

from vicode.editor.panels.project.writing import write_project
from vicode.editor.panels.robots.robot_view import RobotView
from vicode.editor.panels.robots.write_back_dialog import WriteBackDialog
from vicode.editor.panels.simulation.inputs_form import input_controls, short_value
from vicode.editor.panels.widgets import icon_button
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.runs import PARAMETERS, SimulationInput, collect_tunable
from vicode.runs.changed_values import ChangedValue, change_text, format_value_text


class RobotTuning:
    """The list of sliders; absent unless the robot allows control."""

    def __init__(self, view: RobotView) -> None:
        self.view = view
        self._shape: object = None
        self._rows: list[_TuningRow] = []
        self.body = ui.column().classes("inputs robot-tuning")

    def refresh(self) -> None:
        robot = self.view.robot
        can_tune = robot is not None and not self.view.problem_of_control
        inputs = self._list_inputs() if can_tune else ()
        shape = (robot and robot.name, inputs)
        if shape != self._shape:
            self._shape = shape
            self.body.clear()
            self._rows = []
            if inputs:
                with self.body:
                    with ui.row().classes("heading inputs-heading"):
                        ui.label("Tuning")
                    self._rows = [_TuningRow(self.view, each) for each in inputs]
        for row in self._rows:
            row.refresh()

    def _list_inputs(self) -> tuple[SimulationInput, ...]:
        inputs = collect_tunable(self.view.project, self.view.design)
        known = self.view.robot.description.components if self.view.robot else {}
        return tuple(each for each in inputs if each.component == PARAMETERS or each.component in known)


class _TuningRow:
    """A slider and a number, and a button that writes the value into the file."""

    def __init__(self, view: RobotView, input_: SimulationInput) -> None:
        self.view, self.input = view, input_
        self._shown = input_.initial
        with ui.element("div").classes("tuning-row"):
            with ui.element("div").classes("input-row"):
                with ui.label(input_.name).classes("input-name mono"):
                    if input_.doc:
                        ui.tooltip(input_.doc)
                self.controls = input_controls(input_, f"Tune {input_.name}", self._tune)
            self.keep = icon_button("save_alt", f"Write {input_.name} back", self._ask_to_write)
            with self.keep:
                ui.tooltip("Write the value into the file; shows first what it changes in recorded runs")

    def refresh(self) -> None:
        value = self._value
        if short_value(value) != short_value(self._shown):
            self._shown = value
            for control in self.controls:
                control.set_value(short_value(value))
        # The button keeps its place, so that the slider does not move below the pointer.
        self.keep.style(f"visibility: {'hidden' if value == self.input.initial else 'visible'}")

    @property
    def _value(self) -> Any:
        """The value that was tuned from here, else that of the file."""
        robot, input_ = self.view.robot, self.input
        if robot is None:
            return input_.initial
        if input_.component == PARAMETERS:
            return robot.tuned.get(input_.name, input_.initial)
        return robot.held.get((input_.component, input_.name), input_.initial)

    def _tune(self, value: Any) -> None:
        accepted = self.input.accept(value)
        if accepted is None or accepted == self._shown:
            return
        self._shown = accepted
        for control in self.controls:
            if control.value != accepted:
                control.set_value(accepted)
        if self.input.component == PARAMETERS:
            self.view.ask("tune", name=self.input.name, value=accepted)
        else:
            self.view.ask("set", component=self.input.component, name=self.input.name, value=accepted, hold=True)

    def _ask_to_write(self) -> None:
        """Show what the value changes in recorded runs, and write it if the user agrees."""
        component = "" if self.input.component == PARAMETERS else self.input.component
        value = ChangedValue(component=component, name=self.input.name, text=format_value_text(self._value))
        dialog = WriteBackDialog(self.view, value, lambda: self._write(value))
        self.view.context.run_in_background(dialog.replay(), "replay with a tuned value")

    def _write(self, value: ChangedValue) -> None:
        """Write a value into the file, as one undo step."""
        name, text, robot = value.name, value.text, self.view.robot
        if robot is not None:
            robot.remember_written((self.input.component, name), value.text_in(self.view.project), text)

        def change_project(project: Project) -> Project:
            return replace(project, constants=change_text(project.constants, name, text))

        def change_design(design: Design) -> Design:
            return replace(design, parameters=change_text(design.parameters, name, text))

        if value.component:
            self.view.context.edit(f"Set {name} to {text}", change_design)
            return
        error = write_project(self.view.context, change_project, f"set {name} to {text}")
        if error:
            self.view.context.show_toast(error, "warning")
