"""Panels behind tabs: built when first shown, brought up to date only while they are shown."""

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

from nicegui import ui


class Panel(Protocol):
    """What stands behind a tab; building it fills the current slot."""

    def refresh(self) -> None:
        """Show the desk as it is now; called after every change while the panel is shown."""


class Tabs:
    """A bar of tabs; their panels come with `build`, so that the page is there before what is behind its tabs.

    Args:
        names: the word on each tab; the first is shown.
        css_prefix: the style class of bar and panels, such as "side".
        label: what the tabs are of, for the ear.
    """

    def __init__(self, names: Sequence[str], css_prefix: str, label: str) -> None:
        """Build the bar, with room for the panels."""
        self._builders: Mapping[str, Callable[[], Panel]] = {}
        self._panels: dict[str, Panel] = {}
        self._slots: dict[str, ui.tab_panel] = {}
        with ui.tabs().props("dense no-caps align=left").classes(f"{css_prefix}-tabs") as self._bar:
            self._bar.props["aria-label"] = label
            for name in names:
                ui.tab(name)
        kept = ui.tab_panels(self._bar, value=names[0], keep_alive=True)
        with kept.props("animated=false").classes(f"{css_prefix}-panels"):
            for name in names:
                self._slots[name] = ui.tab_panel(name)
                self._slots[name].props["aria-label"] = name
        self._bar.on_value_change(lambda _event: self.refresh())

    @property
    def shown(self) -> str:
        """The word on the tab that is open."""
        return str(self._bar.value)

    def show(self, name: str) -> None:
        """Open a tab."""
        self._bar.set_value(name)

    def build(self, builders: Mapping[str, Callable[[], Panel]]) -> None:
        """Build the panel that is shown, and the others once they are; `builders` are by the words on the tabs."""
        if not self._builders:
            self._builders = builders
            self.refresh()

    def refresh(self) -> None:
        """Bring the shown panel up to date."""
        if not self._builders:
            return
        name = self.shown
        if name not in self._panels:
            with self._slots[name]:
                self._panels[name] = self._builders[name]()
        self._panels[name].refresh()
