"""Two texts beside each other, of which a user chooses one; lines that differ are highlighted."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from nicegui import ui


@dataclass(frozen=True, slots=True, kw_only=True)
class ChoiceSide:
    """One side; a disabled one is shown, but cannot be chosen."""

    title: str
    text: str
    is_disabled: bool = False


def side_choice(sides: Mapping[str, ChoiceSide], on_chosen: Callable[[str], None]) -> Callable[[str], None]:
    """Build the buttons; returns a function that shows which side is chosen."""
    buttons: dict[str, ui.element] = {}

    def show(chosen: str) -> None:
        for name, button in buttons.items():
            button.props(f'aria-pressed="{str(name == chosen).lower()}"')

    def choose(name: str) -> None:
        show(name)
        on_chosen(name)

    with ui.element("div").classes("conflict-sides"):
        for name, side in sides.items():
            others = {line for other, each in sides.items() if other != name for line in each.text.splitlines()}
            with ui.element("button").classes("conflict-side").props('type="button"') as button:
                ui.label(side.title).classes("conflict-title")
                for line in side.text.splitlines():
                    ui.label(line or " ").classes("conflict-line mono" + ("" if line in others else " differs"))
            if side.is_disabled:
                button.props("disabled")
            buttons[name] = button.on("click", lambda name=name: choose(name))
    show("")
    return show
