"""The machines of used components that one window shows in place on its canvas."""

from dataclasses import dataclass, field
from typing import Any

from vicode.editor.canvas import Canvas
from vicode.editor.canvas.protocol import InsideGesture
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.view import ItemRef, make_scene
from vicode.model.design import Call, Design


@dataclass(eq=False)
class InsideViews:
    """Answers the canvas, and keeps what it shows up to date while the designs change."""

    context: WindowContext
    canvas: Canvas
    _shown: dict[ItemRef, dict[str, Design]] = field(default_factory=dict)

    def show(self, gesture: InsideGesture) -> None:
        item = gesture.item
        designs = self._designs(item) if gesture.shown else {}
        if gesture.shown and not designs:
            self.context.show_toast(f"No component that {item.id} uses has a design", "info")
        self._send(item, designs)

    def refresh(self) -> None:
        for item, shown in list(self._shown.items()):
            designs = self._designs(item)
            if designs != shown:
                self._send(item, designs)

    def _send(self, item: ItemRef, designs: dict[str, Design]) -> None:
        self._shown.pop(item, None)
        if designs:
            self._shown[item] = designs
        self.canvas.show_inside(item, [self._machine(alias, design) for alias, design in designs.items()])

    def _machine(self, alias: str, design: Design) -> dict[str, Any]:
        scene = make_scene(self.context.workspace.project, design, (), 0)
        return {"alias": alias, "component": design.component, "scene": scene}

    def _designs(self, item: ItemRef) -> dict[str, Design]:
        """The designs of a used component, or of the components that a state requires, modulates or calls, by alias."""
        design, project = self.context.design, self.context.workspace.project
        aliases: tuple[str, ...] = (item.id,) if item.kind == "components" else ()
        state = design.state(item.id) if item.kind == "states" else None
        if state is not None:
            aliases = (*state.requires, *(action.alias for action in state.all_actions if isinstance(action, Call)))
        uses = [use for alias in dict.fromkeys(aliases) if (use := design.use(alias)) is not None]
        found = ((use.alias, project.design(use.component)) for use in uses)
        return {alias: inner for alias, inner in found if inner is not None}
