"""The tour for new users: cards that point at parts of the page and advance when the user has done a step."""

from collections.abc import Callable
from dataclasses import asdict, dataclass

from nicegui import ui

from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.window_context import WindowContext
from vicode.model.traversal import iter_transitions


@dataclass(frozen=True, slots=True, kw_only=True)
class TourStep:
    """One card.

    `target` is a CSS selector of the highlighted element. `completed_by` is the event that completes the step: "" (the
    button Next), "selected", "state-added", "transition-added", "restored" or "table".
    """

    title: str
    text: str
    target: str = ""
    completed_by: str = ""


STEPS = (
    TourStep(
        title="A state machine",
        text="Boxes are states; arrows are transitions, labeled with their guards. This tour takes two minutes. "
        "You can undo all changes; what you edit is saved by itself.",
        target=".design-view",
    ),
    TourStep(
        title="Select a state",
        text="Click a box. Its properties open on the right: components, actions and transitions.",
        target=".side",
        completed_by="selected",
    ),
    TourStep(
        title="Add a state",
        text="Double-click an empty place, or press S. Type a name, then press Enter.",
        target=".design-view",
        completed_by="state-added",
    ),
    TourStep(
        title="Add a transition",
        text="Select a state and drag from one of its round handles to another state. "
        "Or press T, then choose the target. Type the guard on the line, or nothing, then press Enter.",
        target=".design-view",
        completed_by="transition-added",
    ),
    TourStep(
        title="Undo",
        text="Press Ctrl+Z (or the arrow above) until your changes are undone.",
        target=".head",
        completed_by="restored",
    ),
    TourStep(
        title="Findings",
        text="Errors and warnings appear here while you work. Click one to go to its item; some have a quick fix.",
        target=".dock",
    ),
    TourStep(
        title="Inputs and commands",
        text="Press Escape to select nothing: the inspector then lists the inputs, which guards read by name, and the "
        "commands, which states give. Each list has a button that adds one.",
        target=".side",
    ),
    TourStep(
        title="Simulate",
        text="In the tab Simulate, set the inputs by hand. F10 runs one step, F6 plays and pauses; "
        "the active state is highlighted.",
        target=".dock",
    ),
    TourStep(
        title="Table view",
        text="Press F4 or this switch: all states and transitions as rows, edited with the keyboard.",
        target=".view-switch",
        completed_by="table",
    ),
    TourStep(
        title="Generate code",
        text="Generate writes the code; the tab 'Generated code' previews it. Ctrl+K finds everything, "
        "? lists all keyboard shortcuts, and the command 'Start tour' shows this tour again.",
        target=".head",
    ),
)


class Tour(ui.element, component="vicode_tour.js"):
    """The tour; opens once per browser, and with `start`.

    Args:
        context: the open design.
        shows_table: whether the table is shown.
        starts_automatically: whether the tour may open automatically.
    """

    def __init__(self, context: WindowContext, shows_table: Callable[[], bool], *, starts_automatically: bool) -> None:
        super().__init__()
        self._context, self._shows_table = context, shows_table
        self.props["steps"] = [asdict(step) for step in STEPS]
        self.props["startsAutomatically"] = starts_automatically
        self.props["facts"] = self._facts()

    def refresh(self) -> None:
        facts = self._facts()
        if facts != self.props["facts"]:
            self.props["facts"] = facts

    def commands(self) -> tuple[Command, ...]:
        return (Command("tour", "Start tour", self.start, MenuGroup.VIEW, icon="school"),)

    def start(self) -> None:
        self.run_method("start")

    def _facts(self) -> dict[str, object]:
        design, item = self._context.design, self._context.single_selection
        names = [state.name for state in design.states]
        return {
            "states": len(design.states),
            "transitions": sum(1 for _each in iter_transitions(design)),
            # The index, as a new state is renamed later; new states are last.
            "selected": names.index(item.id) if item is not None and item.kind == "states" and item.id in names else -1,
            "table": self._shows_table(),
        }
