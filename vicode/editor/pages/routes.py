"""Registers the pages of the editor for one library of designs."""

import contextlib

from nicegui import ui
from nicegui.translations import translations
from starlette.requests import Request

from vicode.editor.pages.autosave_ui import run_autosave
from vicode.editor.pages.design_page import DesignPage, open_design_at
from vicode.editor.pages.docs_preview import serve_docs_preview
from vicode.editor.pages.theme import apply_theme
from vicode.editor.panels.designs.thumbnails import serve_thumbnails
from vicode.editor.panels.toasts import show_internal_error
from vicode.editor.session import Library, Workspace
from vicode.editor.session.recovery.autosave import AutosaveService
from vicode.editor.session.search.search_index import SearchIndex
from vicode.editor.view.page_urls import DesignAddress, broken_file_url, parse_selection

_CONNECTION_TEXTS = {
    "connection_lost": "No connection to the editor",
    "trying_to_reconnect": (
        "Trying to reconnect. The editor keeps what you changed so far, saved or not, also if it is restarted. "
        "What you change now may be lost."
    ),
}


def register_pages(library: Library, autosave: AutosaveService | None = None, *, tour: bool = False) -> None:
    """Register the pages: `/` is the home page, `/design/PROJECT/COMPONENT` edits a design."""
    index = SearchIndex(library)
    if autosave is not None:
        run_autosave(autosave)
    translations["en-US"].update(_CONNECTION_TEXTS)
    serve_thumbnails(library)
    serve_docs_preview(library)

    @ui.page("/", title="vicode")
    def home(request: Request) -> None:
        from vicode.editor.pages.home import HomePage

        ui.on_exception(show_internal_error)
        HomePage(library, index, request.query_params.get("gone", ""))

    @ui.page("/design/{key}/{component}", title="vicode")
    def design(key: str, component: str, request: Request) -> None:
        query = request.query_params
        selected = parse_selection(query.get("select", ""))
        address = DesignAddress(key=key, component=component, selected=selected, trail=query.get("from", ""))
        opened = open_design_at(library, address)
        if opened is None:
            title = f"Design {component[:80]} not found"
            _show_not_found(title, "It may have been renamed or removed.", library.workspace(key))
            return
        ui.on_exception(show_internal_error)
        DesignPage(library, index, autosave, opened, starts_tour=tour)

    @ui.page("/broken/{key}/{file:path}", title="vicode")
    def broken(key: str, file: str) -> None:
        from vicode.editor.pages.broken_page import BrokenPage

        workspace = library.workspace(key)
        with contextlib.suppress(OSError):
            if workspace:
                workspace.sync_from_disk()
        # Only files known to be unreadable are opened, so that a URL cannot name any other file.
        path = workspace.broken_files.get(file) if workspace else None
        if workspace is None or path is None:
            _show_not_found(f"Unreadable file {file[:80]} not found", "It may have been fixed or removed.")
            return
        ui.page_title(f"{file} – vicode")
        ui.on_exception(show_internal_error)
        BrokenPage(library, workspace, path, file)


def _show_not_found(title: str, hint: str, workspace: Workspace | None = None) -> None:
    """Show that nothing exists at the URL, with links to unreadable files of the project."""
    apply_theme()
    with ui.element("main").classes("nothing"):
        ui.label(title).classes("dialog-title").props("role=heading aria-level=1")
        ui.label(hint).classes("empty")
        if workspace is not None and workspace.broken_file_names:
            ui.label("It may be in a file that cannot be read:").classes("empty")
            for file in workspace.broken_file_names:
                ui.link(file, broken_file_url(workspace.key, file))
        ui.link("Show all designs", "/")
