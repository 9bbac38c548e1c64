"""The findings of the open design, updated while the user edits: by severity and item, with filter and quick fixes."""

from collections.abc import Iterator
from itertools import islice
from pathlib import PurePath

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.findings.deep_check import DeepCheck
from vicode.editor.panels.findings.finding_navigation import FindingNavigator, fix_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.finding_list import filter_findings, group_by_severity
from vicode.editor.session.fixes import is_fixable
from vicode.editor.view import item_label
from vicode.editor.view.unfinished import is_unfinished
from vicode.findings import Finding, Severity

_ICONS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "info"}
_MAX_SHOWN = 200
_Row = tuple[Finding, str, bool, bool, bool]
"""A finding, the label of its item, and whether it is the first of that item, the current one, on an unfinished one."""


class FindingsPanel:
    """The list of findings in the dock."""

    def __init__(self, context: WindowContext, navigator: FindingNavigator) -> None:
        self.context, self.navigator = context, navigator
        self.hidden_severities: set[Severity] = set()
        self.shown: object = None
        self.rows: dict[_Row, ui.element] = {}
        with ui.row().classes("findings-head"):
            self.summary = ui.label().classes("findings-summary").props('role="status"')
            self.deep_check = DeepCheck(context)
            ui.element("div").classes("spacer")
            self.toggles = {severity: self._toggle(severity) for severity in Severity}
            self.filter = ui.input(placeholder="Filter", on_change=self.refresh)
            self.filter.props('dense borderless clearable debounce=150 aria-label="Filter findings"')
            self.filter.classes("findings-filter")
        self.list = ui.column().classes("findings-list").props('role="list" aria-label="List of findings"')
        self.more = ui.label().classes("empty findings-more")
        self.more.set_visibility(False)

    def refresh(self) -> None:
        self.deep_check.refresh()
        findings = self.context.document.findings
        matching = filter_findings(findings, self.filter.value or "", self.hidden_severities)
        shown = (findings, matching, self.navigator.current, self.context.document.shared.unfinished_states)
        if shown == self.shown:
            return
        self.shown = shown
        self.summary.set_text(summarize_findings(findings, len(matching)))
        for severity, button in self.toggles.items():
            count = sum(each.severity is severity for each in findings)
            button.set_visibility(bool(count))
            button.set_text(str(count))
        self._fill(matching)

    def _fill(self, matching: tuple[Finding, ...]) -> None:
        """Add new rows and remove obsolete ones; all other rows stay."""
        rows = dict.fromkeys(islice(self._rows_of(matching), _MAX_SHOWN))
        for row in [row for row in self.rows if row not in rows]:
            self.rows.pop(row).delete()
        for index, row in enumerate(rows):
            if row not in self.rows:
                with self.list:
                    self.rows[row] = self._build(row)
            if self.list.default_slot.children[index] is not self.rows[row]:
                self.rows[row].move(target_index=index)
        hidden_count = len(matching) - _MAX_SHOWN
        self.more.set_text(texts.more_findings(hidden_count))
        self.more.set_visibility(hidden_count > 0)

    def _rows_of(self, matching: tuple[Finding, ...]) -> Iterator[_Row]:
        unfinished = self.context.document.shared.unfinished_states
        for _severity, findings in group_by_severity(matching):
            before = ""
            for finding in findings:
                label = item_label(self.context.design, finding.subject.path) if finding.subject else ""
                is_current = finding == self.navigator.current
                yield finding, label, label != before, is_current, is_unfinished(finding, unfinished)
                before = label

    def _build(self, row_: _Row) -> ui.element:
        finding, label, is_first, is_current, is_gray = row_
        severity = finding.severity
        here = " is-current" if is_current else ""
        with ui.element("div").classes(f"finding-row{here}").props('role="listitem"') as element:
            gray = " is-unfinished" if is_gray else ""
            with ui.element("button").classes(f"finding {severity}{gray}").props('type="button"') as row:
                ui.icon(_ICONS[severity]).props('aria-hidden="true"')
                ui.label(f"{severity} {finding.rule.code}").classes("finding-code mono")
                ui.label(label).classes("finding-thing" + ("" if is_first else " is-same"))
                # A finding from reading the file has a line instead of an item.
                line = (
                    f"{PurePath(finding.location.file).name}, line {finding.location.line}: "
                    if finding.location
                    else ""
                )
                ui.label(line + finding.message).classes("finding-message")
                notes = (f"note: {note.message}" for note in finding.notes)
                ui.label(" · ".join(part for part in (finding.fix, *notes) if part)).classes("finding-hint")
            row.on("click", lambda: self.navigator.select_finding(finding))
            if finding.run is not None:
                play = ui.button("Play", icon="play_arrow", on_click=lambda: self.navigator.play(finding), color=None)
                play.props("flat dense no-caps size=sm").classes("finding-fix")
                play.props["aria-label"] = f"Play: {finding.message}"
            if is_fixable(finding):
                fix_button(self.context, finding, f"Fix: {finding.message}")
        return element

    def _toggle(self, severity: Severity) -> ui.button:
        button = ui.button("0", icon=_ICONS[severity], on_click=lambda: self._toggle_severity(severity), color=None)
        button.props(f'flat dense no-caps size=sm aria-label="Show {severity}s" aria-pressed="true"')
        button.classes(f"severity-toggle {severity}")
        with button:
            ui.tooltip(f"Show or hide {severity}s")
        return button

    def _toggle_severity(self, severity: Severity) -> None:
        self.hidden_severities ^= {severity}
        is_shown = severity not in self.hidden_severities
        self.toggles[severity].props(f'aria-pressed="{str(is_shown).lower()}"')
        self.refresh()


def summarize_findings(findings: tuple[Finding, ...], shown: int | None = None) -> str:
    """Summarize the findings: "1 error, 2 warnings; 2 shown"."""
    if not findings:
        return texts.NO_PROBLEMS
    counts = [(sum(each.severity == severity for each in findings), severity) for severity in Severity]
    label = ", ".join(texts.pluralize(count, severity) for count, severity in counts if count)
    return label if shown in (None, len(findings)) else f"{label}; {shown} shown"
