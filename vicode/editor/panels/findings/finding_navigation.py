"""Navigation between findings, and their quick fixes."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from nicegui import ui

from vicode.editor.panels import texts
from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.project.writing import write_design_and_project
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.finding_list import next_finding
from vicode.editor.view import ItemRef, item_at_path
from vicode.findings import Finding

if TYPE_CHECKING:
    from vicode.editor.session.fixes import Fix


@dataclass(eq=False)
class FindingNavigator:
    """The current finding of one window."""

    context: WindowContext
    current: Finding | None = field(default=None, init=False)

    def commands(self) -> tuple[Command, ...]:
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
        findings = self.context.document.findings
        finding = next_finding(findings, self.current, step)
        if finding is None:
            self.context.show_toast(texts.NO_PROBLEMS, "positive")
            return
        self.select_finding(finding)

    def play(self, finding: Finding) -> None:
        """Show the run of a finding in Simulate, where it can be played and stepped through."""
        from vicode.runs.found_runs import write_found_run  # noqa: PLC0415 - not needed before a click
        from vicode.semantics import NotInterpretableError  # noqa: PLC0415

        assert finding.run is not None
        try:
            trace = write_found_run(self.context.workspace.project, finding.run)
        except (NotInterpretableError, KeyError):
            self.context.show_toast(texts.RUN_IS_OLD, "warning")
            return
        self.context.run_in_background(self.context.page.view_run(trace), "run of a finding")

    def select_finding(self, finding: Finding) -> None:
        self.current = finding
        items: tuple[ItemRef, ...] = ()
        if finding.subject is not None:
            item = item_at_path(finding.subject.path)
            items = () if item.kind == "design" else (item,)
            self.context.page.reveal(item)
        if self.context.selected != items:
            self.context.select(*items)
        else:
            self.context.notify_subscribers()


def fix_button(context: WindowContext, finding: Finding, accessible_name: str) -> ui.button:
    """Build a button with a menu of the fixes of a finding."""
    button = ui.button("Fix", icon="auto_fix_high", color=None).props("flat dense no-caps size=sm")
    button.classes("finding-fix").props["aria-label"] = accessible_name
    with button, ui.menu().props("auto-close") as menu:
        pass
    menu.on("before-show", lambda: _fill_fix_menu(context, menu, finding))
    return button


def _fill_fix_menu(context: WindowContext, menu: ui.menu, finding: Finding) -> None:
    """Fill the menu of a finding with its fixes. Computed when the menu opens, as each is tried on the design."""
    menu.clear()
    from vicode.editor.session.fixes import find_fixes  # noqa: PLC0415 - not needed before a menu opens

    fixes = find_fixes(context.workspace.project, context.design, finding)
    with menu:
        for fix in fixes:
            ui.menu_item(fix.label, on_click=lambda fix=fix: apply_fix(context, fix)).props("role=menuitem")
        if not fixes:
            ui.menu_item("No automatic fix available").props("disable role=menuitem")


def apply_fix(context: WindowContext, fix: "Fix") -> None:
    """Apply a fix as one edit, which can be undone."""
    label = f"fix: {fix.label}"
    error = ""
    if fix.edit_project is None:
        context.edit(label, fix.edit)
    else:
        error = write_design_and_project(context, label, fix.edit, fix.edit_project)
    context.show_toast(error or f"Applied: {fix.label}. Undo with Ctrl+Z.", "warning" if error else "positive")
