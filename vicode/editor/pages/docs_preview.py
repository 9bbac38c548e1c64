"""The documentation of a project as it would be now, beside the editor; its pages follow what is edited."""

import contextlib
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

from nicegui import app, run, ui
from starlette.requests import Request
from starlette.responses import Response

from vicode.editor.panels.command import Command, MenuGroup
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import Library
from vicode.editor.view.page_urls import docs_url

if TYPE_CHECKING:
    from vicode.docsite import PlannedFile, SiteBuilder
    from vicode.editor.session.docs_snapshot import DocsSnapshot

_TYPES = {".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".svg": "image/svg+xml"}
_RELOAD_SCRIPT = Path(__file__).with_name("docs_reload.js")


@dataclass(eq=False)
class _ProjectDocs:
    """The site of one project, planned anew when the project is another one."""

    builder: "SiteBuilder | None" = None
    shown: "DocsSnapshot | None" = None
    find: "Callable[[str], PlannedFile | None]" = lambda _path: None
    lock: threading.Lock = field(default_factory=threading.Lock)

    def find_file(self, snapshot: "DocsSnapshot", path: str, *, is_made: bool) -> tuple[str, str] | None:
        """The key of a file, and its text if it is to be made; None where there is none.

        Raises:
            OSError: The project is gone.
        """
        from vicode.docsite import SiteBuilder
        from vicode.editor.session.docs_snapshot import load_docs_subject

        with self.lock:
            self.builder = self.builder or SiteBuilder()
            if snapshot != self.shown:
                # Only the page that is asked for is drawn: nobody waits for those of all the others.
                self.find = self.builder.make_file_lookup(load_docs_subject(snapshot))
                self.shown = snapshot
            found = self.find(path)
            return None if found is None else (found.key, found.render() if is_made else "")


def serve_docs_preview(library: Library) -> None:
    """Answer the addresses of `page_address`."""
    sites: dict[str, _ProjectDocs] = {}

    @app.api_route("/docs/{key}/{path}", methods=["GET", "HEAD"])
    async def page(key: str, path: str, request: Request) -> Response:
        from vicode.editor.session.docs_snapshot import take_snapshot

        workspace = library.workspace(key)
        if workspace is None:
            return Response(status_code=404)
        if path == _RELOAD_SCRIPT.name:
            return _answer(path, _RELOAD_SCRIPT.read_text(encoding="utf-8"), "")
        with contextlib.suppress(OSError):
            workspace.poll_disk()
        if key not in sites:
            sites[key] = _ProjectDocs()
        found = None
        with contextlib.suppress(OSError):
            found = await run.io_bound(
                sites[key].find_file, take_snapshot(workspace), path, is_made=request.method == "GET"
            )
        if found is None:
            from vicode.docsite import not_found_page

            return _answer("missing.html", not_found_page(site_name=workspace.project.name), "missing", status=404)
        mark, text = found
        return _answer(path, text, mark)

    @app.on_shutdown
    def close() -> None:
        for site in sites.values():
            if site.builder:
                site.builder.close()


def docs_command(context: WindowContext) -> Command:
    """Show the page of the open design, at the selected state, in a tab of its own."""

    def show() -> None:
        from vicode.docsite import SiteUrls, state_anchor

        project, only = context.workspace.project, context.single_selection
        place = state_anchor(only.id) if only is not None and only.kind == "states" else ""
        file = SiteUrls(project).component(context.design.component)
        ui.navigate.to(docs_url(context.workspace.key, file, place), new_tab=True)

    return Command("page", "Show its page beside the editor", show, MenuGroup.VIEW, icon="menu_book")


def _answer(path: str, text: str, mark: str, *, status: int = 200) -> Response:
    """A file, with the mark by which a page learns that it has become another one."""
    suffix = Path(path).suffix
    if suffix == ".html":
        script = f'<script src="{_RELOAD_SCRIPT.name}" data-version="{escape(mark)}" defer></script>'
        text = text.replace("</head>", f"{script}\n</head>", 1)
    headers = {"etag": f'"{mark}"', "cache-control": "no-store", "x-content-type-options": "nosniff"}
    return Response(text, status_code=status, media_type=_TYPES.get(suffix, "text/plain"), headers=headers)
