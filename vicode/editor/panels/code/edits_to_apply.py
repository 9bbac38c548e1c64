"""Edits of generated files in the Generate dialog: those that are applied to the designs, and the rest."""

from collections.abc import Callable
from pathlib import PurePath

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.code.code_choices import CodeChoices
from vicode.editor.panels.code.text_choice import OfferedTexts, TextChoice
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import DiskConflictError, DocumentSession
from vicode.editor.session.code.code_sync import apply_to_design
from vicode.editor.session.descriptions import error_reason
from vicode.services.generation.design_output import FileReading, PendingOutput, choose_texts
from vicode.sync import OutsideConflict, describe_problems


class EditsToApply:
    """The list of edits; regions that need no choice are applied as they are."""

    def __init__(self, context: WindowContext, prepared: PendingOutput) -> None:
        self._context = context
        self._button: ui.button | None = None
        self._edits = edits = prepared.plan.edits if prepared.plan else ()
        components = sorted({file.component for file in edits if file.component})
        opened = (context.workspace.open_document(name) for name in components)
        self._documents = [document for document in opened if document is not None]
        self._readings: list[_ReadingChoice] = []
        files = ", ".join(PurePath(file.path).name for file in edits)
        ui.label(f"Edited by hand: {files}. 'Overwrite' keeps a copy as NAME.edited.").classes("conflict-place")
        with ui.column().classes("conflict-list edits-to-apply"):
            waiting = {edit.version[:2] for document in self._documents for edit in document.shared.outside.waiting}
            for file in edits:
                for region in file.regions:
                    if (file.path, region.id) not in waiting:
                        ui.label(f"{region.target or region.id}: the edit is applied to {file.component}").classes(
                            "small"
                        )
                for problem in describe_problems(file):
                    ui.label(f"{file.path}: {problem.message}").classes("field-finding")
            self._choices = CodeChoices(context, self._documents, self._show_choice)
            for reading in prepared.readings:
                self._readings.append(_ReadingChoice(context, reading, self._show_choice))

    def enable(self, button: ui.button) -> None:
        """Enable a button while there is something to apply, and each choice is made."""
        self._button = button
        self._show_choice()

    def _show_choice(self) -> None:
        is_useful = any(file.regions for file in self._edits) or any(each.is_wanted for each in self._readings)
        is_complete = self._choices.is_complete and all(each.is_complete for each in self._readings)
        if self._button is not None:
            self._button.set_enabled(is_useful and is_complete)

    @property
    def has_rest(self) -> bool:
        """Whether edits remain that no design contains, so that the files must be kept."""
        read = {each.file.path for each in self._readings if each.is_taken_whole}
        return any(
            file.problems or file.merge_conflicts or (file.is_edited_outside and file.path not in read)
            for file in self._edits
        )

    def apply(self) -> bool:
        """Edit the designs and save them; return whether that worked."""
        if not self._choices.apply():
            return False
        for each in self._readings:
            if not each.is_wanted:
                continue
            reading = each.read()
            document = self._document_of(reading.file.component)
            if not apply_to_design(document, reading.base, reading.design, reading.words):
                self._context.show_toast("The design has changed. Generate again.", "warning")
                return False
        return all(map(self._save, self._documents))

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


class _ReadingChoice:
    """The edits outside regions of one file: whether they are applied, and a text for each conflict."""

    def __init__(self, context: WindowContext, reading: FileReading, on_change: Callable[[], object]) -> None:
        self._reading, self.file = reading, reading.file
        self._box: ui.checkbox | None = None
        self._choices: list[tuple[OutsideConflict, TextChoice]] = []
        name = PurePath(reading.file.path).name
        ui.label(texts.edited_outside_regions(name, known=reading.file.is_origin_known)).classes("conflict-place")
        conflicts = reading.rebased.conflicts
        if reading.words or conflicts:
            label = texts.apply_edits_label(len(reading.words) + len(conflicts))
            # Without a base, changes of the design look like edits that revert them.
            is_certain = reading.file.is_origin_known
            self._box = ui.checkbox(label, value=is_certain, on_change=on_change).props("dense")
            with ui.element("ul").classes("edits-to-apply-words"):
                for words in reading.words:
                    with ui.element("li"):
                        ui.label(words)
        for conflict in conflicts:
            offered = OfferedTexts(
                name=f"{name}:{conflict.line}",
                place=reading.file.component,
                reason="The file and the design changed the same lines.",
                base=conflict.base,
                in_file=conflict.file_text,
                in_design=conflict.design_text,
            )
            self._choices.append((conflict, TextChoice(context, offered, on_change)))
        if reading.leftover:
            with ui.row().classes("conflict-head"):
                is_partly_read = bool(reading.words or conflicts)
                ui.label(
                    "The rest cannot be expressed in the design. It stays in the copy of the file."
                    if is_partly_read
                    else "The design cannot express these edits. They stay in the copy of the file."
                ).classes("small")
                ui.button(
                    "Save as patch",
                    icon="download",
                    on_click=lambda: ui.download.content(reading.leftover, f"{name}.patch"),
                    color=None,
                ).props("flat dense no-caps size=sm")

    @property
    def is_wanted(self) -> bool:
        return self._box is not None and bool(self._box.value)

    @property
    def is_complete(self) -> bool:
        return not self.is_wanted or all(choice.is_chosen for _conflict, choice in self._choices)

    @property
    def is_taken_whole(self) -> bool:
        """Whether the design has all edits of the file then."""
        is_file_taken = all(choice.text == conflict.file_text for conflict, choice in self._choices)
        return self.is_wanted and is_file_taken and not self._reading.leftover

    def read(self) -> FileReading:
        """The edits with the chosen texts."""
        if self._choices:
            chosen = {
                conflict: conflict.design_text if choice.text is None else choice.text
                for conflict, choice in self._choices
            }
            self._reading = choose_texts(self._reading, chosen)
        return self._reading
