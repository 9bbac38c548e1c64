"""The source: manual inputs, the project's components in their world, a recorded trace, or a running robot."""

from dataclasses import replace

from nicegui import ui
from nicegui.events import UploadEventArguments

from vicode.editor.access import MAX_BODY_BYTES
from vicode.editor.panels.robots.robot_form import RobotForm
from vicode.editor.panels.simulation.controller import SimulationController
from vicode.editor.panels.simulation.trace_files import TraceFileChoice
from vicode.editor.panels.simulation.trace_overlays import TraceOverlays
from vicode.runs import stubbed_components, used_components
from vicode.traces.reader import TraceError

# The file is sent in a multipart body.
_MAX_BYTES = MAX_BODY_BYTES - 65_536
_TOO_LARGE = f"The file is too large for a trace (at most {_MAX_BYTES / 1e6:.1f} MB): place it in the project folder"
_PICK = "Choose a trace…"
_MANUAL, _ALL_COMPONENTS, _FROM_TRACE, _REPLAY, _ROBOT = (
    "Manual inputs",
    "All components run",
    "Inputs from a trace",
    "View a trace",
    "Robot",
)


class InputSourceForm:
    """Selects the source of the inputs and the components that are replaced by stubs."""

    def __init__(self, controller: SimulationController) -> None:
        self.controller = controller
        self.source = _ROBOT if controller.robot.is_shown else _MANUAL
        world = controller.context.workspace.project.world
        labels = {
            _MANUAL: _MANUAL,
            _ALL_COMPONENTS: f"All components run in {world}" if world else _ALL_COMPONENTS,
            _FROM_TRACE: _FROM_TRACE,
            _REPLAY: _REPLAY,
            _ROBOT: _ROBOT,
        }
        self.choice = ui.select(labels, value=self.source, label="Simulate with", on_change=self._choose)
        self.choice.props("dense outlined options-dense stack-label").classes("field")
        self.pick = ui.button(_PICK, icon="upload_file", color=None).props("outline dense no-caps no-wrap align=left")
        self.hint = ui.label("Record one with: vicode run DESIGN --trace FILE --values").classes("small trace-hint")
        self.upload = ui.upload(
            auto_upload=True,
            max_file_size=_MAX_BYTES,
            on_upload=self._handle_upload,
            on_rejected=lambda: controller.context.show_toast(_TOO_LARGE, "warning"),
        )
        self.upload.props('accept=".jsonl,.json,.txt,*"').classes("hidden")
        # The browser opens its file dialog only within the click event, without a round trip to the server.
        self.pick.classes("trace-pick").on("click", js_handler=f"() => runMethod({self.upload.id}, 'pickFiles', [])")
        self.files = TraceFileChoice(controller, lambda: self.source == _REPLAY)
        self.overlays = TraceOverlays(controller)
        self.robot_form = RobotForm(controller.robot)
        self.options = ui.expansion("Run options").classes("section run-options").props("dense dense-toggle")
        with self.options:
            self.seed = ui.number("Seed of the world", value=0, precision=0, on_change=self._set_numbers)
            self.tick = ui.number(
                "Period", placeholder="fits the frequencies", min=1, max=3_600_000, on_change=self._set_numbers
            )
            self.tick.props("suffix=ms")
            for box in (self.seed, self.tick):
                box.props("dense outlined stack-label").classes("field")
            ui.label("Components with manual inputs").classes("field-label")
            self.rows = ui.column().classes("stub-rows")
        self._listed: object = None
        self._stubbed: frozenset[str] = frozenset()

    def refresh(self) -> None:
        if self.controller.trace and self.controller.is_replay and self.source != _REPLAY:
            # The run of a finding.
            self.source = self.choice.value = _REPLAY
        self.robot_form.refresh()
        self.overlays.refresh()
        self.options.set_visibility(self.source != _ROBOT)
        has_trace = bool(self.controller.trace)
        self.files.set_visibility(self.source in (_FROM_TRACE, _REPLAY))
        self.pick.set_visibility(self.source in (_FROM_TRACE, _REPLAY))
        self.hint.set_visibility(self.source in (_FROM_TRACE, _REPLAY) and not has_trace)
        if not has_trace:
            self.pick.set_text(_PICK)
        context = self.controller.context
        used = used_components(context.workspace.project, context.design)
        self._stubbed = stubbed_components(context.workspace.project, context.design, self.controller.config)
        listed = (used, self._stubbed)
        if listed == self._listed:
            return
        self._listed = listed
        self.rows.clear()
        with self.rows:
            if not used:
                ui.label("No components used.").classes("empty")
            for name in used:
                self._row(name)

    def _row(self, name: str) -> None:
        is_design = self.controller.context.workspace.project.design(name) is not None
        box = ui.checkbox(name + (" (design)" if is_design else ""), value=name in self._stubbed)
        box.props("dense size=xs").classes("mono")
        box.on_value_change(lambda event: self._set_stubbed(name, flag=bool(event.value)))

    def _set_stubbed(self, name: str, *, flag: bool) -> None:
        stubbed = self._stubbed | {name} if flag else self._stubbed - {name}
        self.controller.set_config(replace(self.controller.config, stubbed=stubbed))

    def _choose(self) -> None:
        if self.source == str(self.choice.value):
            return
        self.source = str(self.choice.value)
        self.controller.clear_trace()
        if self.source == _ROBOT:
            self.controller.stop()
            self.controller.robot.show()
            return
        if self.controller.robot.is_shown:
            self.controller.robot.hide()
        stubbed: frozenset[str] | None = frozenset() if self.source == _ALL_COMPONENTS else None
        self.controller.set_config(replace(self.controller.config, stubbed=stubbed))

    def _set_numbers(self) -> None:
        seed, tick = self.seed.value, self.tick.value
        if not isinstance(seed, int | float) or (tick is not None and not 1 <= tick <= 3_600_000):
            return
        self.controller.set_config(replace(self.controller.config, seed=int(seed), tick_ms=tick))

    async def _handle_upload(self, event: UploadEventArguments) -> None:
        # The browser may send more than it announced.
        if event.file.size() > _MAX_BYTES:
            self.controller.context.show_toast(_TOO_LARGE, "warning")
            return
        try:
            text = await event.file.text()
            self.controller.use_trace(text, is_replay=self.source == _REPLAY)
            self.pick.set_text(event.file.name)
        except (TraceError, UnicodeDecodeError) as error:
            self.controller.context.show_toast(f"{event.file.name[:60]}: {error}", "warning")
            return
        finally:
            self.upload.reset()
        await self.controller.restart()
