"""Serves the documentation of a project including unsaved edits; its pages reload after changes."""

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

from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import Library
from vicode.editor.view.page_urls import docs_url

if TYPE_CHECKING:
    from vicode.docsite import PlannedFile, SiteBuilder
    from vicode.editor.session.project.docs_snapshot import DocsSnapshot

_TYPES = {".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".svg": "image/svg+xml"}
_RELOAD_SCRIPT = Path(__file__).with_name("docs_reload.js")


@dataclass(eq=False)
class _ProjectDocs:
    """The site of one project, planned again when the project has changed."""

    builder: "SiteBuilder | None" = None
    shown: "DocsSnapshot | None" = None
    find: "Callable[[str], PlannedFile | None]" = lambda _path: None
    lock: threading.Lock = field(default_factory=threading.Lock)

    def find_file(self, snapshot: "DocsSnapshot", path: str, *, render: bool) -> tuple[str, str] | None:
        """Return the key of a file, and its text if `render`; None if there is no such file.

        Raises:
            OSError: The project cannot be read.
        """
        from vicode.docsite import SiteBuilder
        from vicode.editor.session.project.docs_snapshot import load_docs_subject

        with self.lock:
            self.builder = self.builder or SiteBuilder()
            if snapshot != self.shown:
                # Only the requested page is rendered.
                self.find = self.builder.make_file_lookup(load_docs_subject(snapshot))
                self.shown = snapshot
            file = self.find(path)
            return None if file is None else (file.key, file.render() if render else "")


def serve_docs_preview(library: Library) -> None:
    """Serve the URLs of `docs_url`."""
    sites: dict[str, _ProjectDocs] = {}

    @app.api_route("/docs/{key}/{path}", methods=["GET", "HEAD"])
    async def page(key: str, path: str, request: Request) -> Response:
        from vicode.editor.session.project.docs_snapshot import take_snapshot

        workspace = library.workspace(key)
        if workspace is None:
            return Response(status_code=404)
        if path == _RELOAD_SCRIPT.name:
            return _respond(path, _RELOAD_SCRIPT.read_text(encoding="utf-8"), "")
        with contextlib.suppress(OSError):
            workspace.poll_disk()
        if key not in sites:
            sites[key] = _ProjectDocs()
        file = None
        with contextlib.suppress(OSError):
            file = await run.io_bound(
                sites[key].find_file, take_snapshot(workspace), path, render=request.method == "GET"
            )
        if file is None:
            from vicode.docsite import not_found_page

            return _respond("missing.html", not_found_page(site_name=workspace.project.name), "missing", status=404)
        version, text = file
        return _respond(path, text, version)

    @app.on_shutdown
    def close() -> None:
        for site in sites.values():
            if site.builder:
                site.builder.close()


def docs_command(context: WindowContext) -> Command:
    """Return the command that opens the page of the design, at the selected state, in a new tab."""

    def show() -> None:
        from vicode.docsite import SiteUrls, state_anchor

        project, item = context.workspace.project, context.single_selection
        anchor = state_anchor(item.id) if item is not None and item.kind == "states" else ""
        file = SiteUrls(project).component(context.design.component)
        ui.navigate.to(docs_url(context.workspace.key, file, anchor), new_tab=True)

    return Command("page", "Open documentation", show, MenuGroup.VIEW, icon="menu_book")


def _respond(path: str, text: str, version: str, *, status: int = 200) -> Response:
    """Respond with a file, and with its version as ETag, which the reload script compares."""
    suffix = Path(path).suffix
    if suffix == ".html":
        script = f'<script src="{_RELOAD_SCRIPT.name}" data-version="{escape(version)}" defer></script>'
        text = text.replace("</head>", f"{script}\n</head>", 1)
    headers = {"etag": f'"{version}"', "cache-control": "no-store", "x-content-type-options": "nosniff"}
    return Response(text, status_code=status, media_type=_TYPES.get(suffix, "text/plain"), headers=headers)
