"""Compares the languages of the open design in the background, and shows the first difference of their traces."""

from nicegui import ui

from vicode.conformance.process import ComparisonError, ComparisonProcess
from vicode.conformance.result import LANGUAGE_TITLES, LanguageComparison, verdict
from vicode.editor.panels import texts
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.simulation.trust_dialog import COMPARE, ask_for_trust
from vicode.editor.panels.versions.comparison_view import ComparisonView
from vicode.editor.panels.widgets import primary_button
from vicode.editor.panels.window_context import WindowContext

_LANGUAGES = tuple(LANGUAGE_TITLES)


class ComparisonDialog:
    """The comparison of one window; it continues while the dialog is closed, and the result stays."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._process: ComparisonProcess | None = None
        self._started: object = None
        self._language = ""
        self._result: LanguageComparison | None = None
        self._error = ""
        self._seed = 0
        self._rev = -1
        self._dialog: ui.dialog | None = None
        context.closings.subscribe(self.cancel)

    def open(self) -> None:
        """Show the dialog; start a comparison unless one is running or its result is current."""
        with self._context.client, titled_dialog(self._title, "comparison-dialog") as dialog:
            self._body = ui.column().classes("comparison-body")
            self._buttons = ui.row().classes("dialog-buttons")
        self._dialog = dialog
        dialog.on("hide", lambda: self._forget(dialog))
        if self._process is None and (self._result is None or self._rev != self._context.document.rev):
            self._start()
        else:
            self._show()

    @property
    def _title(self) -> str:
        return f"Compare languages of {self._context.design.component}"

    def cancel(self) -> None:
        """End the comparison."""
        process, self._process, self._started = self._process, None, None
        if process is not None:
            process.cancel()

    def _start(self, seed: int = 0) -> None:
        """Start, unless it is started already and may be waiting for an answer of the user."""
        if self._started is None:
            self._started, self._seed = object(), seed
            self._context.run_in_background(self._compare(self._started), "compare languages")

    async def _compare(self, started: object) -> None:
        try:
            await self._ask_and_run()
        finally:
            # After a cancellation, another one may be under way.
            if self._started is started:
                self._started = None

    async def _ask_and_run(self) -> None:
        if not await ask_for_trust(self._context, COMPARE):
            self._error = "The folder is not trusted, so its code does not run. Compare again to be asked again."
            self._result = None
            self._show()
            return
        context = self._context
        process = ComparisonProcess(
            project=context.workspace.project,
            design=context.design,
            folder=context.workspace.folder,
            seed=self._seed,
            on_language=self._show_progress,
        )
        self._process, self._rev, self._language = process, context.document.rev, ""
        self._result, self._error = None, ""
        self._show()
        try:
            result = await process.run()
        except ComparisonError as error:
            result, failure = None, str(error)
        else:
            failure = ""
        # It was cancelled, perhaps with the window.
        if self._process is not process:
            return
        self._process, self._result, self._error = None, result, failure
        self._finish()

    def _finish(self) -> None:
        self._show()
        if self._dialog is None:
            words = verdict(self._result) if self._result else f"The languages were not compared: {self._error}"
            is_good = self._result is not None and not (self._result.differences or self._result.failed)
            self._context.show_toast(words, "positive" if is_good else "warning")

    def _show_progress(self, language: str) -> None:
        self._language = language
        self._show()

    def _forget(self, dialog: ui.dialog) -> None:
        if self._dialog is dialog:
            self._dialog = None
        dialog.delete()

    def _close(self) -> None:
        if self._dialog is not None:
            self._dialog.close()

    def _cancel_and_close(self) -> None:
        self.cancel()
        self._close()

    def _show(self) -> None:
        if self._dialog is None or self._context.is_closed:
            return
        self._body.clear()
        self._buttons.clear()
        with self._context.client:
            if self._process is not None:
                self._build_progress()
            else:
                self._build_result()

    def _build_progress(self) -> None:
        at = _LANGUAGES.index(self._language) if self._language in _LANGUAGES else -1
        title = LANGUAGE_TITLES.get(self._language, "")
        with self._body:
            ui.label(texts.comparing(title, at + 1, len(_LANGUAGES))).props('role="status"')
            bar = ui.linear_progress(max(at, 0) / len(_LANGUAGES), show_value=False).props("instant-feedback")
            bar.props["aria-label"] = "Progress"
            ui.label("Edits made from now on are not part of this comparison.").classes("small")
        with self._buttons:
            ui.button("Cancel", on_click=self._cancel_and_close).props("flat no-caps")
            ui.button("Continue in the background", on_click=self._close).props("flat no-caps")

    def _build_result(self) -> None:
        with self._body:
            if self._result is None:
                ui.label(self._error).classes("field-finding comparison-error").props('role="status"')
            else:
                if self._rev != self._context.document.rev:
                    ui.label("The design has changed since this comparison.").classes("field-finding is-info")
                ComparisonView(self._context, self._result, self._seed, self._close).build()
        with self._buttons:
            ui.button("Close", on_click=self._close).props("flat no-caps")
            primary_button("Compare again", lambda: self._start(self._seed + 1)).props["aria-label"] = (
                "Compare again, with other inputs"
            )
