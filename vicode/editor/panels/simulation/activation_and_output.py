"""The activation tree of an iteration, and the output and errors of user code."""

from functools import partial

from nicegui import ui

from vicode.editor.panels.simulation.controller import SimulationController
from vicode.editor.view import ItemRef
from vicode.editor.view.activation import ActivationRow, activation_rows, code_error_view, value_rows

_MAX_LINES = 200
_MAX_ITERATIONS = 400


class ActivationTree:
    """The components stepped in the shown iteration, and the values of the design."""

    def __init__(self, controller: SimulationController) -> None:
        self.controller = controller
        self._shown: object = None
        self.body = ui.column().classes("activation").props('tabindex=0 role=group aria-label="Activation tree"')

    def refresh(self) -> None:
        simulation = self.controller.simulation
        iteration = simulation.shown_iteration if simulation else None
        rows = activation_rows(iteration.tree) if iteration else ()
        component = self.controller.context.design.component
        values = value_rows(iteration.tree, component) if iteration else ()
        if (rows, values) == self._shown:
            return
        self._shown = (rows, values)
        self.body.clear()
        with self.body:
            if not rows:
                ui.label("The activation tree appears here while the simulation runs.").classes("empty")
            for row in rows:
                _tree_row(row)
            if values:
                ui.label(f"Values of {component}").classes("field-label")
            for name, value in values:
                ui.label(f"{name} = {value}").classes("mono")


class ConsoleOutput:
    """Output of user code up to the shown iteration, and its errors; an error links to its element."""

    def __init__(self, controller: SimulationController) -> None:
        self.controller = controller
        self._shown: object = None
        self.body = ui.column().classes("output").props('tabindex=0 role=group aria-label="Output"')

    def refresh(self) -> None:
        lines = self._lines()
        if lines == self._shown:
            return
        self._shown = lines
        self.body.clear()
        with self.body:
            if not lines:
                ui.label("Output and errors of your code appear here.").classes("empty")
            for kind, text, item in lines[-_MAX_LINES:]:
                if kind == "error":
                    with ui.element("button").classes("output-line error").props('type="button"') as row:
                        ui.icon("error").props('aria-hidden="true"')
                        ui.label(text).classes("mono")
                    if item is not None:
                        row.on("click", partial(self.controller.context.show, item))
                else:
                    ui.label(text).classes("output-line mono")

    def _lines(self) -> list[tuple[str, str, ItemRef | None]]:
        simulation = self.controller.simulation
        if simulation is None:
            return []
        design = simulation.prepared.design
        lines: list[tuple[str, str, ItemRef | None]] = []
        for number in simulation.recording.iterations_with_output(simulation.cursor, _MAX_ITERATIONS):
            iteration = simulation.recording.iteration(number)
            assert iteration is not None
            time = f"{iteration.time_ns / 1e9:.2f} s  "
            lines += [("print", time + line, None) for line in iteration.prints]
            if iteration.omitted_lines:
                lines.append(("print", f"{time}… and {iteration.omitted_lines} more lines", None))
            mistakes = (code_error_view(design, record) for record in iteration.errors)
            lines += [("error", time + mistake.text, mistake.item) for mistake in mistakes]
        failure = simulation.failure
        if failure is not None and not simulation.is_past:
            lines += [("print", line, None) for line in failure.prints]
            found = code_error_view(design, failure.error) if failure.error else None
            lines.append(("error", found.text if found else failure.message, found.item if found else None))
        return lines


def _tree_row(row: ActivationRow) -> None:
    with ui.element("div").classes("tree-row").style(f"padding-left: {16 * row.depth}px"):
        if row.link:
            ui.label(row.link).classes("tree-link")
        ui.label(row.component).classes("tree-name" + ("" if row.has_run else " is-idle"))
        if row.state:
            ui.label(row.state).classes("tree-state mono")
        if row.detail:
            ui.label(row.detail).classes("tree-detail mono")
