"""What is wrong with the open design, as it is typed; a click selects the thing and brings it into view."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.desk import Desk
from vicode.editor.view import thing_of_path
from vicode.findings import Finding, Severity

_ICONS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "info"}


class FindingsPanel:
    """The list below the canvas."""

    def __init__(self, desk: Desk) -> None:
        """Build it; `refresh` fills it."""
        self.desk = desk
        self.shown: tuple[Finding, ...] | None = None
        with ui.row().classes("findings-head"):
            self.summary = ui.label().classes("findings-summary").props('role="status"')
        self.list = ui.column().classes("findings-list")

    def refresh(self) -> None:
        """Show the findings of the design as it is now."""
        findings = self.desk.document.findings
        if findings == self.shown:
            return
        self.shown = findings
        self.summary.set_text(summary_of(findings))
        self.list.clear()
        with self.list:
            for finding in sorted(findings, key=lambda each: list(Severity).index(each.severity)):
                self._row(finding)

    def _row(self, finding: Finding) -> None:
        severity = finding.severity
        with ui.element("button").classes(f"finding {severity}").props('type="button"') as row:
            ui.icon(_ICONS[severity]).props('aria-hidden="true"')
            ui.label(f"{severity} {finding.rule.code}").classes("finding-code mono")
            # What was wrong when the file was read stands in the file, not in the drawing.
            line = f"{finding.place.file}, line {finding.place.line}: " if finding.place else ""
            ui.label(line + finding.message).classes("finding-message")
            ui.label(finding.mend).classes("finding-mend")
        row.on("click", self._opener(finding))

    def _opener(self, finding: Finding) -> Callable[[], None]:
        def select() -> None:
            if finding.thing is not None:
                thing = thing_of_path(finding.thing.path)
                self.desk.select(*(() if thing.of == "design" else (thing,)))
                self.desk.reveal(thing)

        return select


def summary_of(findings: tuple[Finding, ...]) -> str:
    """The number of findings in words."""
    if not findings:
        return "No findings: the design is sound"
    counts = [(sum(each.severity == severity for each in findings), severity) for severity in Severity]
    return ", ".join(f"{count} {severity}{'s' * (count != 1)}" for count, severity in counts if count)
