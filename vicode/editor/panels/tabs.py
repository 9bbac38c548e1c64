"""Tabs whose panels are built when first shown, and refreshed only while shown."""

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

from nicegui import ui


class Panel(Protocol):
    """The content of a tab; its constructor fills the current slot."""

    def refresh(self) -> None:
        """Show the current state; called after each change while the panel is shown."""


class Tabs:
    """A tab bar. `build` adds the panels later, so that the page appears first.

    Args:
        names: the tab titles; the first tab is shown.
        css_prefix: prefix of the style classes of bar and panels, such as "side".
        label: accessible name of the tab bar.
    """

    def __init__(self, names: Sequence[str], css_prefix: str, label: str) -> None:
        self._builders: Mapping[str, Callable[[], Panel]] = {}
        self._panels: dict[str, Panel] = {}
        self._slots: dict[str, ui.tab_panel] = {}
        with ui.tabs().props("dense no-caps align=left").classes(f"{css_prefix}-tabs") as self._bar:
            self._bar.props["aria-label"] = label
            for name in names:
                ui.tab(name)
        tab_panels = ui.tab_panels(self._bar, value=names[0], keep_alive=True)
        with tab_panels.props("animated=false").classes(f"{css_prefix}-panels"):
            for name in names:
                self._slots[name] = ui.tab_panel(name)
                self._slots[name].props["aria-label"] = name
        self._bar.on_value_change(lambda _event: self.refresh())

    @property
    def shown(self) -> str:
        """Title of the open tab."""
        return str(self._bar.value)

    def show(self, name: str) -> None:
        self._bar.set_value(name)

    def build(self, builders: Mapping[str, Callable[[], Panel]]) -> None:
        """Build the shown panel; the others when they are first shown. Keys of `builders` are tab titles."""
        if not self._builders:
            self._builders = builders
            self.refresh()

    def clear(self) -> None:
        """Remove the content of each panel; the same tab stays open, and `build` fills it again."""
        self._builders, self._panels = {}, {}
        for slot in self._slots.values():
            slot.clear()

    def refresh(self) -> None:
        if not self._builders:
            return
        name = self.shown
        if name not in self._panels:
            with self._slots[name]:
                self._panels[name] = self._builders[name]()
        self._panels[name].refresh()
