"""Small pictures of designs by address; the address names what is drawn, so that browsers may keep it."""

from functools import lru_cache
from urllib.parse import quote

from nicegui import app
from starlette.responses import Response

from vicode.editor.session import Library, Workspace
from vicode.model.design import Design

_HEADERS = {
    "cache-control": "private, max-age=86400",
    # It is a picture and nothing else, wherever it is opened.
    "content-security-policy": "default-src 'none'; style-src 'unsafe-inline'",
    "x-content-type-options": "nosniff",
}


def serve_thumbnails(library: Library) -> None:
    """Answer the addresses of `thumbnail_address`."""

    @app.get("/thumbnail/{key}/{component}/{_version}.svg")
    def picture(key: str, component: str, _version: str, dark: bool = False) -> Response:
        workspace = library.workspace(key)
        design = workspace.project.design(component) if workspace else None
        if design is None:
            return Response(status_code=404)
        return Response(_drawn(design, dark), media_type="image/svg+xml", headers=_HEADERS)


def thumbnail_address(workspace: Workspace, component: str, *, dark: bool) -> str:
    """Where the picture of a design as it is now is found."""
    design = workspace.project.design(component)
    # Equal designs are drawn equally; the number lives as long as this process, and so do the pictures here.
    version = f"{hash(design) & 0xFFFFFFFFFFFFFFFF:016x}"
    path = f"/thumbnail/{quote(workspace.key, safe='')}/{quote(component, safe='')}/{version}.svg"
    return f"{path}?dark=true" if dark else path


@lru_cache(maxsize=512)
def _drawn(design: Design, dark: bool) -> str:
    from vicode.diagram.thumbnail import render_thumbnail  # noqa: PLC0415 - the first page shows none

    return render_thumbnail(design, dark=dark)
