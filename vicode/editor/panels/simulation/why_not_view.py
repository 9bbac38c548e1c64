"""Why the selected state is not active: the conditions that fail on the way to it."""

from dataclasses import replace
from functools import partial

from nicegui import ui

from vicode.editor.panels.simulation.controller import SimulationController
from vicode.editor.view import ItemRef
from vicode.runs.guard_values import latest_steps
from vicode.runs.why_not import Condition, PastConditions, TransitionState, WhyNot, explain

_LOOKBACK = 2000
_LOOKBACK_WHILE_MOVING = 300
"""While new iterations arrive, the first search must not delay them; later ones read the new iterations only."""
_ICONS = {True: ("check_circle", "true"), False: ("cancel", "false"), None: ("help", "unknown")}


class WhyNotView:
    """The section below the guards, shown while one state that is not active is selected."""

    def __init__(self, controller: SimulationController) -> None:
        self.controller = controller
        self._shape: WhyNot | None = None
        self._rows: list[_ConditionRow] = []
        self._past = PastConditions()
        self._past_of: tuple[object, ...] = ()
        self.body = ui.column().classes("guards why-not")

    def refresh(self) -> None:
        target = self.target
        found = self._explain(target) if target else None
        self.body.set_visibility(found is not None)
        if found is None:
            return
        shape = _without_values(found)
        if shape != self._shape:
            self._shape, self._rows = shape, []
            self.body.clear()
            with self.body:
                self._show(found)
        # While it runs, only texts change, so that a transition can be clicked.
        conditions = [each for transition in (*found.first, *found.later) for each in transition.conditions]
        for row, condition in zip(self._rows, conditions, strict=True):
            row.refresh(condition)

    def _explain(self, target: str) -> WhyNot | None:
        """None if the state is active, or no iteration is shown."""
        controller, simulation = self.controller, self.controller.simulation
        iteration = simulation.shown_iteration if simulation is not None else None
        if simulation is None or iteration is None or iteration.state in ("", target):
            return None
        recording, number = simulation.recording, simulation.cursor
        is_live = simulation.live is not None and not simulation.is_past
        is_moving = controller.is_playing or controller.is_running or is_live
        project, design = controller.context.workspace.project, simulation.prepared.design
        robot = controller.robot.robot if controller.robot.is_shown else None
        self._keep_past((recording, project, design, dict(robot.tuned) if robot is not None else {}, is_moving))
        if controller.robot.is_shown:
            return controller.robot.why_not(recording, number, target, self._past)
        steps = latest_steps(recording, number, frozenset(use.component for use in design.uses))
        return explain(project, design, recording, number, target=target, latest=steps, past=self._past)

    def _keep_past(self, of: tuple[object, ...]) -> None:
        """Forget what was found for another recording or other guards."""
        # Designs are compared by identity: equal ones have other objects only after an edit.
        if len(of) != len(self._past_of) or any(
            new is not old and not (isinstance(new, dict | bool) and new == old)
            for new, old in zip(of, self._past_of, strict=True)
        ):
            is_moving = of[-1] is True
            self._past = PastConditions(_LOOKBACK_WHILE_MOVING if is_moving else _LOOKBACK)
            self._past_of = of

    @property
    def target(self) -> str:
        """The selected state, "" if none or several items are selected."""
        selected = self.controller.context.single_selection
        return selected.id if selected is not None and selected.kind == "states" else ""

    def _show(self, found: WhyNot) -> None:
        with ui.row().classes("heading guards-heading"):
            ui.label(f"Why not {found.target}?")
        if not found.first:
            ui.label(f"No transitions lead to {found.target} from here.").classes("empty")
        for each in found.first:
            self._transition(each)
            if each.earlier:
                ui.label(f"{', '.join(each.earlier)} comes first").classes("why-not-note")
        for each in found.later:
            ui.label("then").classes("why-not-note")
            self._transition(each)

    def _transition(self, each: TransitionState) -> None:
        item = ItemRef(kind="transitions", id=each.key)
        button = ui.element("button").classes("why-not-transition").props('type="button"')
        with button.on("click", partial(self.controller.context.show, item)):
            ui.label(f"{each.source} → {each.target}").classes("guard-outcome")
        if not each.conditions:
            ui.label("always").classes("why-not-note")
        self._rows += [_ConditionRow(condition) for condition in each.conditions]


class _ConditionRow:
    def __init__(self, condition: Condition) -> None:
        self._shown: Condition | None = None
        with ui.element("div").classes("why-not-condition"):
            self.icon = ui.icon("help").props('aria-hidden="true"')
            self.word = ui.label()
            ui.label(condition.text).classes("mono")
            self.detail = ui.label().classes("why-not-detail")

    def refresh(self, condition: Condition) -> None:
        if condition == self._shown:
            return
        self._shown = condition
        icon, word = _ICONS[condition.holds]
        self.icon.set_name(icon)
        self.icon.classes(replace=f"guard-icon is-{word}")
        self.word.set_text(word)
        self.word.classes(replace=f"guard-truth is-{word}")
        detail = ", ".join(part for part in (condition.detail, _describe_since(condition)) if part)
        self.detail.set_text(detail)
        self.detail.set_visibility(bool(detail))


def _without_values(found: WhyNot) -> WhyNot:
    """What decides about the elements that are shown, and not about their texts."""

    def strip(each: TransitionState) -> TransitionState:
        return replace(each, conditions=tuple(Condition(text=part.text, holds=None) for part in each.conditions))

    return replace(found, first=tuple(map(strip, found.first)), later=tuple(map(strip, found.later)))


def _describe_since(condition: Condition) -> str:
    if condition.false_for_s is None:
        return ""
    return f"for {'more than ' * condition.was_false_before}{condition.false_for_s:.2f} s"
