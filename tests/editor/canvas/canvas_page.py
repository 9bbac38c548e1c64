"""A page that contains only the canvas, for browser tests and the benchmark: `python canvas_page.py PORT SCENE.json`.

It behaves like a small editor: it applies moves, deletions and renames. GET /gestures returns the reported gestures,
POST /clear deletes them, and POST /call/METHOD calls a method of the element.
"""

import json
import sys
from pathlib import Path
from typing import Any, cast

from nicegui import app, ui
from nicegui.events import GenericEventArguments

from vicode.decoding import decode
from vicode.editor.canvas import Canvas
from vicode.editor.session.gestures.canvas_gestures import NodePosition
from vicode.editor.view import SCENE_LISTS, ItemRef, SceneChanges

ARGUMENT_TYPES: dict[str, Any] = {
    "select": tuple[ItemRef, ...],
    "set_breakpoints": tuple[ItemRef, ...],
    "show_preview": tuple[NodePosition, ...],
}


def main(port: int, scene_file: Path, theme: str) -> None:
    """Serve the scene until the process is killed."""
    gestures: list[dict[str, Any]] = []
    canvases: list[Canvas] = []

    @app.get("/gestures")
    def list_gestures() -> list[dict[str, Any]]:
        return gestures

    @app.post("/clear")
    def clear() -> None:
        gestures.clear()

    @app.post("/call/{method}")
    def call(method: str, arguments: list[Any]) -> None:
        with canvases[-1]:
            if method == "apply":
                apply(canvases[-1], arguments[0])
            else:
                getattr(canvases[-1], method)(*decode_arguments(method, arguments))

    @ui.page("/")
    def page() -> None:
        ui.dark_mode({"dark": True, "light": False}.get(theme))
        ui.context.client.content.style("padding: 0")

        def record(event: GenericEventArguments) -> None:
            gestures.append(event.args)
            if changes := changes_after(event.args, canvas._scene):
                apply(canvas, {"rev": event.args["rev"] + 1, **changes})

        canvas = Canvas(
            lambda _report: None,
            on_malformed=lambda reason: gestures.append({"kind": "malformed", "reason": reason}),
        )
        canvas.on("gesture", record)
        canvas.style("width: 100vw; height: 100vh")
        canvases.append(canvas)
        canvas.load(json.loads(scene_file.read_text(encoding="utf-8")))

    run(port)


def run(port: int) -> None:
    # No compression and no generated styles, as in the editor.
    ui.run(
        host="127.0.0.1",
        port=port,
        reload=False,
        show=False,
        title="canvas",
        reconnect_timeout=30,
        tailwind=False,
        gzip_middleware_factory=None,
        ws_per_message_deflate=False,
    )


def decode_arguments(method: str, arguments: list[Any]) -> list[Any]:
    """Decode the arguments of a method of the canvas, which takes items and positions."""
    if method not in ARGUMENT_TYPES:
        return arguments
    return [decode(arguments[0], ARGUMENT_TYPES[method], method)]


def apply(canvas: Canvas, changes: dict[str, Any]) -> None:
    """Show changes, which may leave out lists, with the scene that they lead to."""
    scene: Any = {**(canvas._scene or {}), **{key: changes[key] for key in ("rev", "common") if key in changes}}
    for name in SCENE_LISTS:
        removed = changes.get("remove", {}).get(name, ())
        items = {item["id"]: item for item in scene.get(name, ()) if item["id"] not in removed}
        items.update({item["id"]: item for item in changes.get("upsert", {}).get(name, ())})
        scene[name] = list(items.values())
    canvas.apply(scene, cast("SceneChanges", changes))


def changes_after(gesture: dict[str, Any], shown: Any) -> dict[str, Any]:
    """Return the scene changes that an editor would make after a gesture."""
    scene = {name: {item["id"]: item for item in shown.get(name, ())} for name in SCENE_LISTS}
    if gesture["kind"] == "move":
        moved: dict[str, list[Any]] = {}
        for item in gesture["items"]:
            if item["of"] != "common":
                moved.setdefault(item["of"], []).append(
                    {**scene[item["of"]][item["id"]], "x": item["x"], "y": item["y"]}
                )
        return {"upsert": moved}
    if gesture["kind"] == "delete":
        removed: dict[str, list[str]] = {}
        for item in gesture["items"]:
            removed.setdefault(item["of"], []).append(item["id"])
        return {"remove": removed}
    if gesture["kind"] == "rename":
        of, identity = gesture["item"]["of"], gesture["item"]["id"]
        return {"upsert": {of: [{**scene[of][identity], "name": gesture["name"]}]}}
    return {}


if __name__ in {"__main__", "__mp_main__"}:
    main(int(sys.argv[1]), Path(sys.argv[2]), sys.argv[3] if len(sys.argv) > 3 else "auto")
