"""Why the selected state is not active: the conditions that fail on the way to it."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.simulation.controller import SimulationController
from vicode.editor.view import ItemRef
from vicode.runs.guard_values import latest_steps
from vicode.runs.why_not import Condition, TransitionState, WhyNot, explain

_LOOKBACK = 2000
_ICONS = {True: ("check_circle", "true"), False: ("cancel", "false"), None: ("help", "unknown")}


class WhyNotView:
    """The section below the guards, shown while one state that is not active is selected."""

    def __init__(self, controller: SimulationController) -> None:
        self.controller = controller
        self._shown: WhyNot | None = None
        self.body = ui.column().classes("guards why-not")

    def refresh(self) -> None:
        target = self.target
        found = _explain(self.controller, target) if target else None
        self.body.set_visibility(found is not None)
        if found is None or found == self._shown:
            return
        self._shown = found
        self.body.clear()
        with self.body:
            self._show(found)

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
        with button.on("click", self._opener(item)):
            ui.label(f"{each.source} → {each.target}").classes("guard-outcome")
        if not each.conditions:
            ui.label("always").classes("why-not-note")
        for condition in each.conditions:
            _show_condition(condition)

    def _opener(self, item: ItemRef) -> Callable[[], None]:
        def select() -> None:
            self.controller.context.select(item)
            self.controller.context.page.reveal(item)

        return select


def _show_condition(condition: Condition) -> None:
    icon, word = _ICONS[condition.holds]
    with ui.element("div").classes("why-not-condition"):
        ui.icon(icon).props('aria-hidden="true"').classes(f"guard-icon is-{word}")
        ui.label(word).classes(f"guard-truth is-{word}")
        ui.label(condition.text).classes("mono")
        since = f"for {condition.false_for_s:.2f} s" if condition.false_for_s is not None else ""
        if detail := ", ".join(part for part in (condition.detail, since) if part):
            ui.label(detail).classes("why-not-detail")


def _explain(controller: SimulationController, target: str) -> WhyNot | None:
    """None if the state is active, or no iteration is shown."""
    simulation = controller.simulation
    iteration = simulation.shown_iteration if simulation is not None else None
    if simulation is None or iteration is None or iteration.state in ("", target):
        return None
    recording, number = simulation.recording, simulation.cursor
    # Reading many iterations takes too long while new ones arrive.
    is_moving = (
        controller.is_playing or controller.is_running or (simulation.live is not None and not simulation.is_past)
    )
    lookback = 0 if is_moving else _LOOKBACK
    if controller.robot.is_shown:
        return controller.robot.why_not(recording, number, target, lookback)
    project, design = controller.context.workspace.project, simulation.prepared.design
    steps = latest_steps(recording, number, frozenset(use.component for use in design.uses))
    return explain(project, design, recording, number, target=target, latest=steps, lookback=lookback)
