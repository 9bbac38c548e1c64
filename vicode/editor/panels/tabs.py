"""Panels behind tabs: built when first shown, brought up to date only while they are shown."""

from collections.abc import Callable, Mapping
from typing import Protocol

from nicegui import ui


class Panel(Protocol):
    """What stands behind a tab; building it fills the current slot."""

    def refresh(self) -> None:
        """Show the desk as it is now; called after every change while the panel is shown."""


class Tabs:
    """A bar of tabs with their panels; the first is shown.

    Args:
        panels: what builds each panel, by the word on its tab.
        place: the style class of bar and panels, such as "side".
        waits: nothing is built before `begin`, as something else is more important.
    """

    def __init__(self, panels: Mapping[str, Callable[[], Panel]], place: str, *, waits: bool = False) -> None:
        """Build the bar, and the first panel unless it waits."""
        self._builders = dict(panels)
        self._panels: dict[str, Panel] = {}
        self._slots: dict[str, ui.tab_panel] = {}
        first = next(iter(panels))
        with ui.tabs().props("dense no-caps align=left").classes(f"{place}-tabs") as self._bar:
            for name in panels:
                ui.tab(name)
        kept = ui.tab_panels(self._bar, value=first, keep_alive=True)
        with kept.props("animated=false").classes(f"{place}-panels"):
            for name in panels:
                self._slots[name] = ui.tab_panel(name)
        self._bar.on_value_change(lambda _event: self.refresh())
        self._waits = waits
        self.refresh()

    @property
    def shown(self) -> str:
        """The word on the tab that is open."""
        return str(self._bar.value)

    def show(self, name: str) -> None:
        """Open a tab."""
        self._bar.set_value(name)

    def begin(self) -> None:
        """Build what waited."""
        self._waits = False
        self.refresh()

    def refresh(self) -> None:
        """Bring the shown panel up to date."""
        if self._waits:
            return
        name = self.shown
        if name not in self._panels:
            with self._slots[name]:
                self._panels[name] = self._builders[name]()
        self._panels[name].refresh()
