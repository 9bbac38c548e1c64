"""Where the inputs come from: set by hand, the project's own components in their world, or a recorded trace."""

from dataclasses import replace

from nicegui import ui
from nicegui.events import UploadEventArguments

from vicode.editor.guard import MAXIMUM_BODY
from vicode.editor.panels.simulation.simulator import Simulator
from vicode.editor.session.simulation import stood_in_of, used_components
from vicode.editor.session.simulation.traces import TraceError

# The file travels in a body with some words around it.
_LARGEST = MAXIMUM_BODY - 65_536
_TOO_LARGE = f"That file is too large for a trace, which may have {_LARGEST / 1e6:.1f} MB: record fewer seconds"
_PICK = "Choose a trace …"
_HAND, _OWN, _DRIVE, _REPLAY = "Inputs by hand", "All components run", "Inputs from a trace", "Look at a trace"


class Ways:
    """A choice, and below it which components are stood in."""

    def __init__(self, simulator: Simulator) -> None:
        """Build it."""
        self.simulator = simulator
        self.way = _HAND
        world = simulator.desk.workspace.project.world
        labels = {_HAND: _HAND, _OWN: f"All in {world}" if world else _OWN, _DRIVE: _DRIVE, _REPLAY: _REPLAY}
        self.choice = ui.select(labels, value=_HAND, label="Simulate with", on_change=self._choose)
        self.choice.props("dense outlined options-dense stack-label").classes("field")
        self.pick = ui.button(_PICK, icon="upload_file", color=None).props("outline dense no-caps no-wrap align=left")
        self.hint = ui.label("recorded with vicode run DESIGN --trace FILE --values").classes("small trace-hint")
        self.upload = ui.upload(
            auto_upload=True,
            max_file_size=_LARGEST,
            on_upload=self._take,
            on_rejected=lambda: simulator.desk.say(_TOO_LARGE, "warning"),
        )
        self.upload.props('accept=".jsonl,.json,.txt,*"').classes("hidden")
        # The browser opens its dialog only for a press, which must not travel to the server and back.
        self.pick.classes("trace-pick").on("click", js_handler=f"() => runMethod({self.upload.id}, 'pickFiles', [])")
        with ui.expansion("How to run").classes("section ways").props("dense dense-toggle"):
            self.seed = ui.number("Seed of the world", value=0, precision=0, on_change=self._set_numbers)
            self.tick = ui.number(
                "Time between iterations", value=20, min=1, max=3_600_000, on_change=self._set_numbers
            )
            self.tick.props("suffix=ms")
            for box in (self.seed, self.tick):
                box.props("dense outlined stack-label").classes("field")
            ui.label("Stood in for, instead of running").classes("field-label")
            self.rows = ui.column().classes("ways-rows")
        self._listed: object = None
        self._stood_in: frozenset[str] = frozenset()

    def refresh(self) -> None:
        """List the components that the design uses now."""
        has_trace = bool(self.simulator.trace)
        self.pick.set_visibility(self.way in (_DRIVE, _REPLAY))
        self.hint.set_visibility(self.way in (_DRIVE, _REPLAY) and not has_trace)
        if not has_trace:
            self.pick.set_text(_PICK)
        desk = self.simulator.desk
        used = used_components(desk.workspace.project, desk.design)
        self._stood_in = stood_in_of(desk.workspace.project, desk.design, self.simulator.wish)
        listed = (used, self._stood_in)
        if listed == self._listed:
            return
        self._listed = listed
        self.rows.clear()
        with self.rows:
            if not used:
                ui.label("It uses no components.").classes("empty")
            for name in used:
                self._row(name)

    def _row(self, name: str) -> None:
        is_design = self.simulator.desk.workspace.project.design(name) is not None
        box = ui.checkbox(name + (" (design)" if is_design else ""), value=name in self._stood_in)
        box.props("dense size=xs").classes("mono")
        box.on_value_change(lambda event: self._stand_in(name, flag=bool(event.value)))

    def _stand_in(self, name: str, *, flag: bool) -> None:
        stood_in = self._stood_in | {name} if flag else self._stood_in - {name}
        self.simulator.set_wish(replace(self.simulator.wish, stood_in=stood_in))

    def _choose(self) -> None:
        self.way = str(self.choice.value)
        self.simulator.forget_trace()
        stood_in: frozenset[str] | None = frozenset() if self.way == _OWN else None
        self.simulator.set_wish(replace(self.simulator.wish, stood_in=stood_in))

    def _set_numbers(self) -> None:
        seed, tick = self.seed.value, self.tick.value
        if not isinstance(seed, int | float) or not isinstance(tick, int | float) or not 1 <= tick <= 3_600_000:
            return
        self.simulator.set_wish(replace(self.simulator.wish, seed=int(seed), tick_ms=float(tick)))

    async def _take(self, event: UploadEventArguments) -> None:
        # What the browser promised of the size binds nobody.
        if event.file.size() > _LARGEST:
            self.simulator.desk.say(_TOO_LARGE, "warning")
            return
        try:
            text = await event.file.text()
            self.simulator.take_trace(text, replays=self.way == _REPLAY)
            self.pick.set_text(event.file.name)
        except (TraceError, UnicodeDecodeError) as error:
            self.simulator.desk.say(f"{event.file.name[:60]}: {error}", "warning")
            return
        finally:
            self.upload.reset()
        await self.simulator.restart()
