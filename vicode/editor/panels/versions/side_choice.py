"""Two texts beside each other, of which a user chooses one; lines that differ are highlighted."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from nicegui import ui


@dataclass(frozen=True, slots=True, kw_only=True)
class ChoiceSide:
    """One side; a disabled one is shown, but cannot be chosen; one for comparison is no button at all."""

    title: str
    text: str
    is_disabled: bool = False
    is_for_comparison: bool = False


def side_choice(sides: Mapping[str, ChoiceSide], on_chosen: Callable[[str], None]) -> Callable[[str], None]:
    """Build the buttons; returns a function that shows which side is chosen."""
    buttons: dict[str, ui.element] = {}

    def show(chosen: str) -> None:
        for name, button in buttons.items():
            button.props(f'aria-pressed="{str(name == chosen).lower()}"')

    def choose(name: str) -> None:
        show(name)
        on_chosen(name)

    with ui.element("div").classes("conflict-sides").style(f"grid-template-columns: repeat({len(sides)}, 1fr)"):
        margin = _common_margin([line for side in sides.values() for line in side.text.splitlines()])
        for name, side in sides.items():
            others = {line for other, each in sides.items() if other != name for line in each.text.splitlines()}
            kind, properties = ("div", "") if side.is_for_comparison else ("button", 'type="button"')
            with ui.element(kind).classes("conflict-side").props(properties) as box:
                ui.label(side.title).classes("conflict-title")
                for line in side.text.splitlines():
                    shown = line[margin:] or " "
                    ui.label(shown).classes("conflict-line mono" + ("" if line in others else " differs"))
            if side.is_for_comparison:
                box.classes("is-text")
                continue
            if side.is_disabled:
                box.props("disabled")
            buttons[name] = box.on("click", lambda name=name: choose(name))
    show("")
    return show


def _common_margin(lines: Sequence[str]) -> int:
    return min((len(line) - len(line.lstrip()) for line in lines if line.strip()), default=0)
