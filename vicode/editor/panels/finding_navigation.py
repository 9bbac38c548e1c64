"""Going from finding to finding, and the quick fixes of each."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from nicegui import ui

from vicode.editor.panels.command import Command, MenuGroup
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.finding_list import next_finding
from vicode.editor.view import ItemRef, item_at_path
from vicode.findings import Finding

if TYPE_CHECKING:
    from vicode.editor.session.fixes import Fix


@dataclass(eq=False)
class FindingNavigator:
    """The findings of one window's design: which one is at hand."""

    context: WindowContext
    current: Finding | None = field(default=None, init=False)

    def commands(self) -> tuple[Command, ...]:
        """Next and previous."""
        return (
            Command(
                name="next-finding",
                label="Next finding",
                handler=lambda: self.move_by(1),
                menu_group=MenuGroup.VIEW,
                icon="navigate_next",
                keys=("F8",),
                while_typing=True,
            ),
            Command(
                name="previous-finding",
                label="Previous finding",
                handler=lambda: self.move_by(-1),
                menu_group=MenuGroup.VIEW,
                icon="navigate_before",
                keys=("Shift+F8",),
                while_typing=True,
            ),
        )

    def move_by(self, step: int) -> None:
        """Select what the next, or the previous, finding is about."""
        findings = self.context.document.findings
        found = next_finding(findings, self.current, step)
        if found is None:
            self.context.show_toast("No findings: the design is sound", "positive")
            return
        self.select_finding(found)

    def select_finding(self, finding: Finding) -> None:
        """Select what a finding is about and bring it into view."""
        self.current = finding
        things: tuple[ItemRef, ...] = ()
        if finding.subject is not None:
            thing = item_at_path(finding.subject.path)
            things = () if thing.kind == "design" else (thing,)
            self.context.reveal(thing)
        if self.context.selected != things:
            self.context.select(*things)
        else:
            self.context.notify_listeners()

    def fill_fix_menu(self, menu: ui.menu, finding: Finding) -> None:
        """Put the fixes of a finding into a menu, found when it opens: each is tried on the whole design."""
        menu.clear()
        from vicode.editor.session.fixes import find_fixes  # noqa: PLC0415 - wanted when somebody looks at a finding

        fixes = find_fixes(self.context.workspace.project, self.context.design, finding)
        with menu:
            for fix in fixes:
                ui.menu_item(fix.label, on_click=lambda fix=fix: self.apply_fix(fix)).props("role=menuitem")
            if not fixes:
                ui.menu_item("No mend is certain here").props("disable role=menuitem")

    def apply_fix(self, fix: "Fix") -> None:
        """Mend; one edit, so that undo takes it back."""
        self.context.edit(f"fix: {fix.label}", fix.edit)
        self.context.show_toast(f"{fix.label}: done. Ctrl+Z takes it back.", "positive")
