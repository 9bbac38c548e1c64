"""Who was active in an iteration, and what user code printed or did wrong."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.simulation.simulator import Simulator
from vicode.editor.view import Selected
from vicode.editor.view.activation import TreeRow, mistake_of, tree_rows, value_rows

_MOST_LINES = 200
_LOOK_BACK = 400


class ActivationTree:
    """The steps of the shown iteration, and the design's own values."""

    def __init__(self, simulator: Simulator) -> None:
        """Build the empty tree."""
        self.simulator = simulator
        self._shown: object = None
        self.body = (
            ui.column().classes("activation").props('tabindex=0 role=group aria-label="Steps of this iteration"')
        )

    def refresh(self) -> None:
        """Show the iteration."""
        simulation = self.simulator.simulation
        moment = simulation.moment if simulation else None
        rows = tree_rows(moment.tree) if moment else ()
        component = self.simulator.desk.design.component
        values = value_rows(moment.tree, component) if moment else ()
        if (rows, values) == self._shown:
            return
        self._shown = (rows, values)
        self.body.clear()
        with self.body:
            if not rows:
                ui.label("Who steps whom is shown here while it runs.").classes("empty")
            for row in rows:
                _tree_row(row)
            if values:
                ui.label(f"Values of {component}").classes("field-label")
            for name, value in values:
                ui.label(f"{name} = {value}").classes("mono")


class Output:
    """What user code printed up to the shown moment, and its errors; an error leads to its thing."""

    def __init__(self, simulator: Simulator) -> None:
        """Build the empty list."""
        self.simulator = simulator
        self._shown: object = None
        self.body = ui.column().classes("output").props('tabindex=0 role=group aria-label="What was printed"')

    def refresh(self) -> None:
        """Show the newest lines."""
        lines = self._lines()
        if lines == self._shown:
            return
        self._shown = lines
        self.body.clear()
        with self.body:
            if not lines:
                ui.label("What the code prints stands here, and its errors.").classes("empty")
            for kind, text, thing in lines[-_MOST_LINES:]:
                if kind == "error":
                    with ui.element("button").classes("output-line error").props('type="button"') as row:
                        ui.icon("error").props('aria-hidden="true"')
                        ui.label(text).classes("mono")
                    row.on("click", self._opener(thing))
                else:
                    ui.label(text).classes("output-line mono")

    def _lines(self) -> list[tuple[str, str, Selected | None]]:
        simulation = self.simulator.simulation
        if simulation is None:
            return []
        design = simulation.stage.design
        lines: list[tuple[str, str, Selected | None]] = []
        for number in simulation.recording.eventful(simulation.cursor, _LOOK_BACK):
            moment = simulation.recording.moment(number)
            assert moment is not None
            time = f"{moment.time_ns / 1e9:.2f} s  "
            lines += [("print", time + line, None) for line in moment.prints]
            if moment.unprinted:
                lines.append(("print", f"{time}… and {moment.unprinted} more lines", None))
            mistakes = (mistake_of(design, record) for record in moment.errors)
            lines += [("error", time + mistake.words, mistake.thing) for mistake in mistakes]
        failure = simulation.failure
        if failure is not None and not simulation.is_past:
            lines += [("print", line, None) for line in failure.prints]
            found = mistake_of(design, failure.error) if failure.error else None
            lines.append(("error", found.words if found else failure.message, found.thing if found else None))
        return lines

    def _opener(self, thing: Selected | None) -> Callable[[], None]:
        def select() -> None:
            if thing is not None:
                self.simulator.desk.select(thing)
                self.simulator.desk.reveal(thing)

        return select


def _tree_row(row: TreeRow) -> None:
    with ui.element("div").classes("tree-row").style(f"padding-left: {16 * row.depth}px"):
        if row.link:
            ui.label(row.link).classes("tree-link")
        ui.label(row.component).classes("tree-name" + ("" if row.worked else " is-idle"))
        if row.state:
            ui.label(row.state).classes("tree-state mono")
        if row.detail:
            ui.label(row.detail).classes("tree-detail mono")
