"""The values and step times of the shown component of a robot and of those that it uses."""

import time
from collections.abc import Callable
from functools import partial

from nicegui import ui

from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.robots.robot_view import RobotView
from vicode.editor.panels.widgets import icon_button, primary_button
from vicode.editor.view.robot_values import RobotComponentRow, RobotValueRow, component_row, input_row, parse_value
from vicode.services.running_robots.watched_robot import WatchedRobot


class RobotValues:
    """A section for each component; rebuilt when names change, otherwise only texts are updated."""

    def __init__(self, view: RobotView) -> None:
        self.view = view
        self._shape: object = None
        self._updates: list[Callable[[RobotComponentRow], None]] = []
        self._rows: tuple[RobotComponentRow, ...] = ()
        self.body = ui.column().classes("inputs robot-values")

    def refresh(self) -> None:
        robot = self.view.robot
        self._rows = self._list_rows(robot) if robot is not None else ()
        can_control = not self.view.problem_of_control
        shape = (
            robot and robot.name,
            can_control,
            tuple((row.component, tuple((each.name, each.is_held) for each in row.values)) for row in self._rows),
        )
        if shape != self._shape:
            self._shape = shape
            self.body.clear()
            with self.body:
                self._updates = [self._section(row, can_control=can_control) for row in self._rows]
        for update, row in zip(self._updates, self._rows, strict=True):
            update(row)

    def _list_rows(self, robot: WatchedRobot) -> tuple[RobotComponentRow, ...]:
        design = self.view.design
        known = robot.description.components
        names = dict.fromkeys((design.component, *(use.component for use in design.uses)))
        inputs = robot.iteration.inputs if robot.iteration else {}
        rows = []
        for name in names:
            seen = robot.steps.get(name)
            if name in inputs and not robot.is_active(name):
                # The inputs are newer than the last step.
                rows.append(input_row(name, inputs[name]))
                continue
            if seen is None or name not in known:
                continue
            rows.append(
                component_row(
                    name,
                    seen.step,
                    age_s=0.0 if robot.is_active(name) else time.monotonic() - seen.received_s,
                    frequency_hz=robot.frequency_hz(name),
                    iteration_hz=robot.iteration_hz,
                    held=robot.held,
                )
            )
        return tuple(rows)

    def _section(self, row: RobotComponentRow, *, can_control: bool) -> Callable[[RobotComponentRow], None]:
        with ui.row().classes("heading inputs-heading robot-component"):
            ui.label(row.component)
            warning = ui.icon("warning").classes("robot-warning").props('role="img"')
            with warning:
                tip = ui.tooltip()
            timing = ui.label().classes("heading-hint")
            if can_control and not row.is_input:
                self._menu(row.component)
        labels = []
        for each in row.values:
            with ui.element("div").classes("robot-value" + (" is-held" if each.is_held else "")):
                ui.label(each.name).classes("input-name mono")
                labels.append(ui.label().classes("mono"))
                if can_control and not row.is_input:
                    act = partial(self._ask_value, each.component, each.name)
                    button = icon_button("lock" if each.is_held else "edit", f"Set {each.component}.{each.name}", act)
                    button.props("size=xs")

        def update(new: RobotComponentRow) -> None:
            words = " · ".join(part for part in (new.timing, new.age) if part)
            if timing.text != words:
                timing.set_text(words)
            if tip.text != new.warning:
                tip.set_text(new.warning)
                warning.props["aria-label"] = new.warning
                warning.update()
            warning.set_visibility(bool(new.warning))
            for label, value in zip(labels, new.values, strict=True):
                if label.text != value.text:
                    label.set_text(value.text)

        return update

    def _menu(self, component: str) -> None:
        with (
            ui.button(icon="more_vert", color=None).props("flat dense round size=xs").classes("icon-button") as button,
            ui.menu(),
        ):
            ui.menu_item("Change frequency…", lambda: self._ask_frequency(component))
            ui.menu_item("Inject an exception…", lambda: self._ask_exception(component))
        button.props["aria-label"] = f"Control {component}"

    def _find(self, component: str, name: str) -> RobotValueRow | None:
        values = (each for row in self._rows if row.component == component for each in row.values)
        return next((each for each in values if each.name == name), None)

    def _ask_value(self, component: str, name: str) -> None:
        row = self._find(component, name)
        if row is None:
            return

        def apply(*, hold: bool) -> None:
            value = parse_value(str(field.value), row.raw)
            if value is None:
                field.error = f"Not a value like {row.text}"
                return
            self.view.ask("set", component=component, name=name, value=value, hold=hold)
            dialog.close()

        def release() -> None:
            self.view.ask("unset", component=component, name=name)
            dialog.close()

        with titled_dialog(f"Set {component}.{name}") as dialog:
            field = ui.input("Value", value=str(row.raw)).props("dense outlined autofocus").classes("field mono")
            field.on("keydown.enter", lambda: apply(hold=False))
            ui.label("Held values are set in each iteration, until they are released or you disconnect.").classes(
                "small"
            )
            with ui.row().classes("dialog-buttons"):
                ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
                if row.is_held:
                    ui.button("Release", on_click=release).props("flat no-caps")
                ui.button("Hold", on_click=lambda: apply(hold=True)).props("flat no-caps")
                primary_button("Set once", lambda: apply(hold=False))

    def _ask_frequency(self, component: str) -> None:
        robot = self.view.robot

        def apply() -> None:
            hertz = field.value
            if not isinstance(hertz, int | float):
                return
            self.view.ask("frequency", component=component, hz=float(hertz))
            dialog.close()

        with titled_dialog(f"Frequency of {component}") as dialog:
            field = ui.number(
                "Frequency", value=robot.frequency_hz(component) if robot else None, min=0.001, max=10_000, suffix="Hz"
            )
            field.props("dense outlined autofocus").classes("field mono").on("keydown.enter", apply)
            with ui.row().classes("dialog-buttons"):
                ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
                primary_button("Change", apply)

    def _ask_exception(self, component: str) -> None:
        def apply() -> None:
            self.view.ask("raise", component=component, message=str(field.value or ""))
            dialog.close()

        with titled_dialog(f"Inject an exception into {component}") as dialog:
            field = ui.input("Message", value="injected error").props("dense outlined autofocus").classes("field")
            field.on("keydown.enter", apply)
            ui.label("The next step of the component raises it.").classes("small")
            with ui.row().classes("dialog-buttons"):
                ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
                primary_button("Inject", apply)
