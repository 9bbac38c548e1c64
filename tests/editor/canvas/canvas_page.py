"""A page that contains only the canvas, for browser tests and the benchmark: `python canvas_page.py PORT SCENE.json`.

It behaves like a small editor: it applies moves, deletions and renames. GET /gestures returns the reported gestures,
POST /clear deletes them, and POST /call/METHOD calls a method of the element.
"""

import json
import sys
from pathlib import Path
from typing import Any

from nicegui import app, ui

from vicode.editor.canvas import Canvas
from vicode.editor.canvas.protocol import Gesture, gesture_payload


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
            getattr(canvases[-1], method)(*arguments)

    @ui.page("/")
    def page() -> None:
        ui.dark_mode({"dark": True, "light": False}.get(theme))
        ui.context.client.content.style("padding: 0")

        def on_gesture(event: Gesture) -> None:
            gesture = gesture_payload(event)
            gestures.append(gesture)
            changes = changes_after(gesture, canvas._scene or {})
            if changes:
                canvas.apply({"rev": gesture["rev"] + 1, **changes})

        def on_malformed(reason: str) -> None:
            gestures.append({"kind": "malformed", "reason": reason})

        canvas = Canvas(on_gesture, on_malformed=on_malformed)
        canvas.style("width: 100vw; height: 100vh")
        canvases.append(canvas)
        canvas.load(json.loads(scene_file.read_text(encoding="utf-8")))

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


def changes_after(gesture: dict[str, Any], scene: dict[str, Any]) -> dict[str, Any]:
    """Return the scene changes that an editor would make after a gesture."""
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
        return {"upsert": {gesture["of"]: [{**scene[gesture["of"]][gesture["id"]], "name": gesture["name"]}]}}
    return {}


if __name__ in {"__main__", "__mp_main__"}:
    main(int(sys.argv[1]), Path(sys.argv[2]), sys.argv[3] if len(sys.argv) > 3 else "auto")
