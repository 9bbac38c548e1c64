"""A choice between the text of a generated file and that of the design, or a third one, which can be edited."""

from collections.abc import Callable
from dataclasses import dataclass

from nicegui import ui

from vicode.editor.panels.versions.side_choice import ChoiceSide, side_choice
from vicode.editor.panels.window_context import WindowContext

_FILE, _BASE, _DESIGN, _TEXT = "file", "base", "design", "text"


@dataclass(frozen=True, slots=True, kw_only=True)
class OfferedTexts:
    """The texts of one edit.

    Attributes:
        name: The name of the code.
        place: Its place in the file.
        reason: Why a user must choose.
        base: The text that was generated before both were edited, which cannot be chosen; None hides it.
        in_file: The text in the file.
        in_design: The text of the design.
        merged: The text with the edits of both; None if they are in conflict.
        is_file_disabled: Whether the text of the file cannot be chosen.
        is_editable: Whether a third text may be written.
    """

    name: str
    place: str
    reason: str
    base: str | None = None
    in_file: str
    in_design: str
    merged: str | None = None
    is_file_disabled: bool = False
    is_editable: bool = True


class TextChoice:
    """The choice for one edit."""

    def __init__(self, context: WindowContext, offered: OfferedTexts, on_change: Callable[[], object]) -> None:
        self.offered, self._on_change = offered, on_change
        self._chosen = ""
        with ui.row().classes("conflict-head"):
            ui.label(offered.name).classes("conflict-place mono")
            ui.label(offered.place).classes("small")
        ui.label(offered.reason).classes("small")
        sides = {
            _FILE: ChoiceSide(
                title="In the generated file", text=offered.in_file, is_disabled=offered.is_file_disabled
            ),
            _DESIGN: ChoiceSide(title="In the design", text=offered.in_design),
        }
        if offered.base is not None:
            sides[_BASE] = ChoiceSide(title="Generated before", text=offered.base, is_for_comparison=True)
        self._show = side_choice(sides, self._choose)
        self._editor: ui.codemirror | None = None
        if offered.is_editable:
            with ui.column().classes("conflict-merged"):
                ui.button("Edit merged text", icon="edit", on_click=self._edit, color=None).props(
                    "flat dense no-caps size=sm"
                )
                self._editor = context.code_editors.create()
                self._editor.classes("code-field").props(f'aria-label="Merged text of {offered.name}"')
                self._editor.set_value(offered.in_file if offered.merged is None else offered.merged)
                self._editor.set_visibility(False)

    @property
    def is_chosen(self) -> bool:
        return bool(self._chosen)

    @property
    def text(self) -> str | None:
        """The chosen text, None for that of the design."""
        if self._chosen == _DESIGN:
            return None
        if self._chosen == _TEXT and self._editor is not None:
            return str(self._editor.value or "")
        return self.offered.in_file if self.offered.merged is None else self.offered.merged

    def _choose(self, side: str) -> None:
        self._chosen = side
        if self._editor is not None:
            self._editor.set_visibility(side == _TEXT)
        self._on_change()

    def _edit(self) -> None:
        self._show("")
        self._choose(_TEXT)
        if self._editor is not None:
            ui.run_javascript(f'getElement({self._editor.id}).$el.scrollIntoView({{block: "nearest"}})')
