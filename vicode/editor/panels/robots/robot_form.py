"""The robots that the editor is attached to: address, connection, and a card for each robot."""

import time
from functools import partial

from nicegui import ui

from vicode.editor.panels.robots.robot_tuning import RobotTuning
from vicode.editor.panels.robots.robot_values import RobotValues
from vicode.editor.panels.robots.robot_view import RobotView
from vicode.robots import AttachError
from vicode.services.running_robots.robot_link import NO_CONTROL, LinkStatus
from vicode.services.running_robots.watched_robot import WatchedRobot

_STALE_S = 1.0


class RobotForm:
    """Connects, and selects the robot that is shown; hidden while the source is a simulation."""

    def __init__(self, view: RobotView) -> None:
        self.view = view
        self._cards: dict[str, _RobotCard] = {}
        with ui.column().classes("robot-form") as self.body:
            with ui.row().classes("robot-address") as self.entry:
                self.address = ui.input("Address", value=view.link.address, placeholder="7070 or robot:7070")
                self.token = ui.input("Token", value=view.link.token, password=True)
                for field in (self.address, self.token):
                    field.props("dense outlined stack-label").classes("field mono").on("keydown.enter", self._attach)
            with ui.row().classes("robot-buttons"):
                self.connect = ui.button("Attach", icon="sensors", on_click=self._attach, color=None)
                self.leave = ui.button("Disconnect", icon="link_off", on_click=view.link.close, color=None)
                for button in (self.connect, self.leave):
                    button.props("outline dense no-caps no-wrap size=sm")
            self.strip = ui.element("div").classes("robot-cards").props('role="group" aria-label="Robots"')
            self.hint = ui.label(NO_CONTROL).classes("small")
            self.tuning = RobotTuning(view)
            self.values = RobotValues(view)

    def refresh(self) -> None:
        self.body.set_visibility(self.view.is_shown)
        if not self.view.is_shown:
            return
        link = self.view.link
        is_attached = link.status not in (LinkStatus.CLOSED, LinkStatus.REFUSED)
        self.entry.set_visibility(not is_attached)
        self.connect.set_visibility(not is_attached)
        self.leave.set_visibility(is_attached)
        self.hint.set_visibility(link.status is LinkStatus.CONNECTED and not link.control)
        if list(self._cards) != list(link.robots):
            self.strip.clear()
            with self.strip:
                self._cards = {name: _RobotCard(name, partial(link.follow, name)) for name in link.robots}
        for name, card in self._cards.items():
            card.show(link.robots[name], is_followed=name == link.followed, is_connected=is_attached)
        self.tuning.refresh()
        self.values.refresh()

    def _attach(self) -> None:
        try:
            self.view.attach(str(self.address.value or ""), str(self.token.value or ""))
        except AttachError as error:
            self.view.context.show_toast(str(error), "warning")


class _RobotCard:
    """Name, state of the root, errors and age of one robot; a click follows it."""

    def __init__(self, name: str, follow: partial[None]) -> None:
        with ui.element("button").classes("robot-card").props('type="button"') as self.element:
            ui.label(name).classes("robot-name")
            self.state = ui.label().classes("robot-state mono")
            self.detail = ui.label().classes("robot-detail")
        self.element.on("click", follow)
        self._shown: object = None

    def show(self, robot: WatchedRobot, *, is_followed: bool, is_connected: bool) -> None:
        age_s = time.monotonic() - robot.received_s if robot.received_s else 0.0
        parts = ["paused"] if robot.is_paused else []
        parts += [f"{robot.error_count} error{'s' * (robot.error_count != 1)}"] if robot.error_count else []
        parts += [f"{age_s:.0f} s ago"] if age_s >= _STALE_S and not robot.is_paused else []
        shown = (robot.root_state, ", ".join(parts), is_followed, is_connected)
        if shown == self._shown:
            return
        self._shown = shown
        self.state.set_text(robot.root_state or "…")
        self.detail.set_text(", ".join(parts))
        is_pressed = "true" if is_followed else "false"
        self.element.props(f'aria-pressed="{is_pressed}"')
        self.element.classes(
            add=" ".join(name for name, flag in _flags(robot, is_followed) if flag),
            remove=" ".join(name for name, flag in _flags(robot, is_followed) if not flag),
        )


def _flags(robot: WatchedRobot, is_followed: bool) -> tuple[tuple[str, bool], ...]:
    return (("is-followed", is_followed), ("has-errors", robot.error_count > 0))
