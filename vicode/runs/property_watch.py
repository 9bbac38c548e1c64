"""Watches the properties of designs during a run in the foreground."""

from vicode.findings import escape_text
from vicode.model.design import InvariantProperty
from vicode.model.project import Project
from vicode.runs.foreground import TracePrinter
from vicode.runs.property_check import PropertyCheck
from vicode.simulation.messages import decode_iteration
from vicode.traces.descriptions import TraceRecord


class PropertyWatch:
    """Passes on what a printer shows, and says when a property is broken.

    Attributes:
        broken: How often properties were broken.
    """

    def __init__(self, project: Project, printer: TracePrinter) -> None:
        self._check, self._printer, self.broken = PropertyCheck(project), printer, 0

    def show_iteration(self, record: TraceRecord, changes: list[str], /) -> None:
        """Show it, and the properties that are broken in it."""
        self._printer.show_iteration(record, changes)
        iteration = decode_iteration(dict(record))
        for result in self._check.observe(iteration):
            self.broken += 1
            text = f"{iteration.time_ns / 1e9:8.2f} s  {result.component}: broken: {result.phrase}"
            self._printer.show_text(escape_text(text))

    def show_text(self, text: str) -> None:
        """Show it."""
        self._printer.show_text(text)

    def show_notice(self, text: str) -> None:
        """Show it."""
        self._printer.show_notice(text)

    def close(self) -> None:
        """Stop displaying."""
        self._printer.close()


def watch_properties(project: Project, printer: TracePrinter) -> PropertyWatch | None:
    """Watch the properties of a project; None if it has none, and assumes nothing."""
    has_any = any(design.properties for design in project.designs) or any(each.assume for each in project.components)
    return PropertyWatch(project, printer) if has_any else None


def reads_values(project: Project) -> bool:
    """Whether conditions of properties, or assumptions, can only be watched with the values of each iteration."""
    has_conditions = any(
        isinstance(each, InvariantProperty) for design in project.designs for each in design.properties
    )
    return has_conditions or any(each.assume for each in project.components)
