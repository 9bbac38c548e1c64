"""Thumbnails of designs. The URL contains a hash of the design, so that browsers can cache them."""

from functools import lru_cache
from urllib.parse import quote

from nicegui import app
from starlette.responses import Response

from vicode.editor.session import Library, Workspace
from vicode.model.design import Design

_HEADERS = {
    "cache-control": "private, max-age=86400",
    # Prevent scripts in the image.
    "content-security-policy": "default-src 'none'; style-src 'unsafe-inline'",
    "x-content-type-options": "nosniff",
}


def serve_thumbnails(library: Library) -> None:
    """Serve the URLs of `thumbnail_address`."""

    @app.get("/thumbnail/{key}/{component}/{_version}.svg")
    def picture(key: str, component: str, _version: str, dark: bool = False) -> Response:
        workspace = library.workspace(key)
        design = workspace.project.design(component) if workspace else None
        if design is None:
            return Response(status_code=404)
        return Response(_render(design, dark), media_type="image/svg+xml", headers=_HEADERS)


def thumbnail_address(workspace: Workspace, component: str, *, dark: bool) -> str:
    """Return the URL of the thumbnail of the current design."""
    design = workspace.project.design(component)
    # The hash changes with each process, which only costs a cached image.
    version = f"{hash(design) & 0xFFFFFFFFFFFFFFFF:016x}"
    path = f"/thumbnail/{quote(workspace.key, safe='')}/{quote(component, safe='')}/{version}.svg"
    return f"{path}?dark=true" if dark else path


@lru_cache(maxsize=512)
def _render(design: Design, dark: bool) -> str:
    from vicode.diagram.thumbnail import render_thumbnail  # noqa: PLC0415 - not needed for the first page

    return render_thumbnail(design, dark=dark)
