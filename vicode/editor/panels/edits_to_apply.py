"""Edits of generated files in the Generate dialog: those that are applied to the designs, and the rest."""

from pathlib import PurePath

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.code_choices import CodeChoices
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import DiskConflictError, DocumentSession
from vicode.editor.session.code_generation import FileReading, PendingOutput
from vicode.editor.session.code_sync import apply_to_design
from vicode.editor.session.descriptions import error_reason


class EditsToApply:
    """The list of edits; regions that need no choice are applied as they are."""

    def __init__(self, context: WindowContext, prepared: PendingOutput) -> None:
        self._context = context
        self._button: ui.button | None = None
        self._edits = edits = prepared.plan.edits if prepared.plan else ()
        components = sorted({file.component for file in edits if file.component})
        opened = (context.workspace.open_document(name) for name in components)
        self._documents = [document for document in opened if document is not None]
        self._readings: list[tuple[FileReading, ui.checkbox]] = []
        ui.label(texts.edited_files([PurePath(file.path).name for file in edits])).classes("conflict-place")
        with ui.column().classes("conflict-list edits-to-apply"):
            waiting = {edit.version[:2] for document in self._documents for edit in document.shared.outside.waiting}
            for file in edits:
                for region in file.regions:
                    if (file.path, region.id) not in waiting:
                        ui.label(texts.applied_to(region.target or region.id, file.component)).classes("small")
                for problem in file.problems:
                    ui.label(f"{file.path}: {problem.message}").classes("field-finding")
            self._choices = CodeChoices(context, self._documents, self._show_choice)
            for reading in prepared.readings:
                self._add_reading(reading)

    def enable(self, button: ui.button) -> None:
        """Enable a button while there is something to apply, and each choice is made."""
        self._button = button
        self._show_choice()

    def _show_choice(self) -> None:
        is_useful = any(file.regions for file in self._edits) or any(box.value for _reading, box in self._readings)
        if self._button is not None:
            self._button.set_enabled(is_useful and self._choices.is_complete)

    @property
    def has_rest(self) -> bool:
        """Whether edits remain that no design contains, so that the files must be kept."""
        read = {reading.file.path for reading, box in self._readings if box.value and not reading.leftover}
        return any(file.problems or (file.is_edited_outside and file.path not in read) for file in self._edits)

    def apply(self) -> bool:
        """Edit the designs and save them; return whether that worked."""
        if not self._choices.apply():
            return False
        for reading, box in self._readings:
            document = self._document_of(reading.file.component)
            if box.value and not apply_to_design(document, reading.base, reading.design, reading.words):
                self._context.show_toast(texts.DESIGN_CHANGED_GENERATE_AGAIN, "warning")
                return False
        return all(map(self._save, self._documents))

    def _add_reading(self, reading: FileReading) -> None:
        name = PurePath(reading.file.path).name
        ui.label(texts.edited_outside_regions(name, known=reading.file.is_origin_known)).classes("conflict-place")
        if reading.words:
            label = texts.apply_edits_label(len(reading.words))
            # Without a base, changes of the design look like edits that revert them.
            is_certain = reading.file.is_origin_known
            box = ui.checkbox(label, value=is_certain, on_change=self._show_choice).props("dense")
            self._readings.append((reading, box))
            with ui.element("ul").classes("edits-to-apply-words"):
                for words in reading.words:
                    with ui.element("li"):
                        ui.label(words)
        if reading.leftover:
            with ui.row().classes("conflict-head"):
                ui.label(texts.NOT_UNDERSTOOD if reading.words else texts.NOTHING_UNDERSTOOD).classes("small")
                ui.button(
                    "Save as patch",
                    icon="download",
                    on_click=lambda: ui.download.content(reading.leftover, f"{name}.patch"),
                    color=None,
                ).props("flat dense no-caps size=sm")

    def _document_of(self, component: str) -> DocumentSession:
        document = next(each for each in self._documents if each.design.component == component)
        return DocumentSession(document.shared, self._context.document.user_id)

    def _save(self, document: DocumentSession) -> bool:
        try:
            self._context.workspace.save(document)
        except DiskConflictError:
            self._context.show_toast(texts.changed_by_another_program(document.file.name), "negative")
            return False
        except (OSError, ValueError) as error:
            self._context.show_toast(texts.not_saved(document.file.name, error_reason(error)), "negative")
            return False
        document.shared.outside.unmark()
        return True
