"""Compares the open design with its revisions in git, in words and as a diagram."""

from nicegui import run, ui

from vicode.diagram.diff_diagram import DARK_DIFF, LIGHT_DIFF, DiffColors, diff_variables
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.window_context import WindowContext
from vicode.git import Commit, GitError
from vicode.services.design_diff.revisions import compare_with_revision, list_revisions


async def show_revisions(context: WindowContext) -> None:
    """Open the dialog; the newest revision is selected first."""
    with titled_dialog(f"Revisions of {context.design.component}", "revisions"):
        message = ui.label("Reading the repository…").classes("small").props("role=status")
        with ui.element("div").classes("revisions-columns") as columns:
            rows = ui.element("div").classes("revision-list").props('role="group" aria-label="Revisions"')
            details = ui.column().classes("revision-details")
    columns.set_visibility(False)
    try:
        commits = await run.io_bound(list_revisions, context.document.file)
    except GitError as error:
        message.set_text(f"{str(error)[:1].upper()}{str(error)[1:]}")
        return
    if not commits:
        message.set_text("No commit contains this design yet")
        return
    message.set_text("The changes from a revision to the design as it is now")
    columns.set_visibility(True)
    view = _RevisionView(context, details)
    with rows:
        for commit in commits:
            view.add_row(commit)
    await view.show(commits[0])


class _RevisionView:
    """The rows of the list, and the comparison with the selected one."""

    def __init__(self, context: WindowContext, details: ui.column) -> None:
        self.context, self.details = context, details
        self.rows: dict[str, ui.element] = {}
        self.selected = ""

    def add_row(self, commit: Commit) -> None:
        with ui.element("button").classes("revision-row").props('type="button"') as row:
            ui.label(commit.subject).classes("history-label")
            ui.label(f"{commit.date[:10]} {commit.date[11:16]} · {commit.author}").classes("small")

        async def handle_click() -> None:
            await self.show(commit)

        self.rows[commit.revision] = row.on("click", handle_click)

    async def show(self, commit: Commit) -> None:
        self.selected = commit.revision
        for revision, row in self.rows.items():
            row.props(f'aria-pressed="{str(revision == commit.revision).lower()}"')
        document = self.context.document
        compared = await run.io_bound(compare_with_revision, document.file, commit, document.design)
        # Another row may have been selected in the meantime; the result is None when the server stops.
        if compared is None or self.selected != commit.revision:
            return
        self.details.clear()
        with self.details:
            for line in compared.lines or (compared.error or "No changes since this revision",):
                ui.label(line).classes("revision-change mono")
            if compared.picture:
                # All texts in the picture are escaped by its writer.
                style = f"<style>{_rule('', LIGHT_DIFF)}{_rule('body.body--dark ', DARK_DIFF)}</style>"
                ui.html(style + compared.picture, sanitize=False).classes("revision-picture")


def _rule(condition: str, colors: DiffColors) -> str:
    """The style rule that defines the colors of the picture."""
    variables = diff_variables(colors)
    return f"{condition}.revision-picture {{{''.join(f'--{name}:{value};' for name, value in variables.items())}}}"
