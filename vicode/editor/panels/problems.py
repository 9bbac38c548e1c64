"""Going from finding to finding, and the quick fixes of each."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from nicegui import ui

from vicode.editor.panels.command import Command, Place
from vicode.editor.panels.desk import Desk
from vicode.editor.session.problems import following
from vicode.editor.view import Selected, thing_of_path
from vicode.findings import Finding

if TYPE_CHECKING:
    from vicode.editor.session.fixes import Fix


@dataclass(eq=False)
class Problems:
    """The findings of one window's design: which one is at hand."""

    desk: Desk
    current: Finding | None = field(default=None, init=False)

    def commands(self) -> tuple[Command, ...]:
        """Next and previous."""
        return (
            Command(
                name="next-finding",
                label="Next finding",
                act=lambda: self.go(1),
                place=Place.VIEW,
                icon="navigate_next",
                keys=("F8",),
                while_typing=True,
            ),
            Command(
                name="previous-finding",
                label="Previous finding",
                act=lambda: self.go(-1),
                place=Place.VIEW,
                icon="navigate_before",
                keys=("Shift+F8",),
                while_typing=True,
            ),
        )

    def go(self, step: int) -> None:
        """Select what the next, or the previous, finding is about."""
        findings = self.desk.document.findings
        found = following(findings, self.current, step)
        if found is None:
            self.desk.say("No findings: the design is sound", "positive")
            return
        self.open(found)

    def open(self, finding: Finding) -> None:
        """Select what a finding is about and bring it into view."""
        self.current = finding
        things: tuple[Selected, ...] = ()
        if finding.thing is not None:
            thing = thing_of_path(finding.thing.path)
            things = () if thing.of == "design" else (thing,)
            self.desk.reveal(thing)
        if self.desk.selected != things:
            self.desk.select(*things)
        else:
            self.desk.tell()

    def fill_menu(self, menu: ui.menu, finding: Finding) -> None:
        """Put the fixes of a finding into a menu, found when it opens: each is tried on the whole design."""
        menu.clear()
        from vicode.editor.session.fixes import fixes_of  # noqa: PLC0415 - wanted when somebody looks at a finding

        fixes = fixes_of(self.desk.workspace.project, self.desk.design, finding)
        with menu:
            for fix in fixes:
                ui.menu_item(fix.label, on_click=lambda fix=fix: self.apply(fix)).props("role=menuitem")
            if not fixes:
                ui.menu_item("No mend is certain here").props("disable role=menuitem")

    def apply(self, fix: "Fix") -> None:
        """Mend; one edit, so that undo takes it back."""
        self.desk.edit(f"fix: {fix.label}", fix.change)
        self.desk.say(f"{fix.label}: done. Ctrl+Z takes it back.", "positive")
