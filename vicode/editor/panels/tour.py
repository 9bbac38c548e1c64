"""The tour of the first run: a card that points at one thing after the other and goes on when it was done."""

from collections.abc import Callable
from dataclasses import asdict, dataclass

from nicegui import ui

from vicode.editor.panels.command import Command, MenuGroup
from vicode.editor.panels.window_context import WindowContext
from vicode.model.traversal import iter_transitions


@dataclass(frozen=True, slots=True, kw_only=True)
class TourStep:
    """One card. `at` selects what it points at (empty: nothing); `completed_by` says which deed ends the step.

    `completed_by` is "" (Next does), "selected", "state-added", "transition-added", "restored" or "table".
    """

    title: str
    text: str
    target: str = ""
    completed_by: str = ""


STEPS = (
    TourStep(
        title="A state machine",
        text="Boxes are states, arrows are transitions with what must hold for them. Eight cards, two minutes; "
        "what you change here can be undone, and nothing is saved unless you say so.",
        target=".design-view",
    ),
    TourStep(
        title="Select a state",
        text="Click a box. Its form opens on the right: what it requires, does, and where it leads.",
        target=".side",
        completed_by="selected",
    ),
    TourStep(
        title="Add a state",
        text="Double click where nothing is, or press S. Type a name, then Enter.",
        target=".design-view",
        completed_by="state-added",
    ),
    TourStep(
        title="Connect it",
        text="Select a state and drag from one of its round handles to another state. By keys: T, then the target.",
        target=".design-view",
        completed_by="transition-added",
    ),
    TourStep(
        title="Take it back",
        text="Press Ctrl+Z (or the arrow above) until the drawing is as it was.",
        target=".head",
        completed_by="restored",
    ),
    TourStep(
        title="Findings",
        text="What is wrong or left over stands here while you work. A click leads to the place; some mend themselves.",
        target=".dock",
    ),
    TourStep(
        title="The same as a table",
        text="Press F4, or this switch: every state and transition in a row, edited by keys alone.",
        target=".view-switch",
        completed_by="table",
    ),
    TourStep(
        title="Out comes code",
        text="Generate writes it; the tab 'Generated code' shows it while you draw. Ctrl+K finds anything, "
        "? lists all keys, and 'Tour' among the commands begins this again.",
        target=".head",
    ),
)


class Tour(ui.element, component="vicode_tour.js"):
    """Shows itself once to each browser; `start` shows it again.

    Args:
        context: what is worked on.
        shows_table: whether the table is shown now.
        starts_automatically: whether it may begin by itself.
    """

    def __init__(self, context: WindowContext, shows_table: Callable[[], bool], *, starts_automatically: bool) -> None:
        super().__init__()
        self._context, self._shows_table = context, shows_table
        self.props["steps"] = [asdict(step) for step in STEPS]
        self.props["startsAutomatically"] = starts_automatically
        self.props["facts"] = self._facts()

    def refresh(self) -> None:
        """Tell the cards what stands there now."""
        facts = self._facts()
        if facts != self.props["facts"]:
            self.props["facts"] = facts

    def commands(self) -> tuple[Command, ...]:
        """What can be asked of it."""
        return (Command("tour", "Tour: what is where, in two minutes", self.start, MenuGroup.VIEW, icon="school"),)

    def start(self) -> None:
        """Begin from the first card."""
        self.run_method("start")

    def _facts(self) -> dict[str, object]:
        design, only = self._context.design, self._context.single_selection
        names = [state.name for state in design.states]
        return {
            "states": len(design.states),
            "transitions": sum(1 for _each in iter_transitions(design)),
            # Its number in the list: one that is made comes last, and is called otherwise a moment later.
            "selected": names.index(only.id) if only is not None and only.kind == "states" and only.id in names else -1,
            "table": self._shows_table(),
        }
