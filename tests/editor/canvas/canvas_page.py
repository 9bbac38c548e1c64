"""A page with nothing but the canvas, for browser tests and the benchmark: `python canvas_page.py PORT SCENE.json`.

It behaves like a small editor: moves are echoed, deletions and renames applied. /heard tells the gestures, /call/METHOD
calls the element.
"""

import json
import sys
from pathlib import Path
from typing import Any

from nicegui import app, ui

from vicode.editor.canvas import Canvas


def main(port: int, scene_file: Path, theme: str) -> None:
    """Serve the scene until the process is ended."""
    heard: list[dict[str, Any]] = []
    canvases: list[Canvas] = []

    @app.get("/heard")
    def tell() -> list[dict[str, Any]]:
        return heard

    @app.post("/forget")
    def forget() -> None:
        heard.clear()

    @app.post("/call/{method}")
    def call(method: str, arguments: list[Any]) -> None:
        with canvases[-1]:
            getattr(canvases[-1], method)(*arguments)

    @ui.page("/")
    def page() -> None:
        ui.dark_mode({"dark": True, "light": False}.get(theme))
        ui.context.client.content.style("padding: 0")

        def hear(gesture: Any) -> None:
            heard.append(gesture)
            changes = answer_to(gesture, canvas._scene or {})
            if changes:
                canvas.apply({"rev": gesture["rev"] + 1, **changes})

        canvas = Canvas(on_gesture=hear)
        canvas.style("width: 100vw; height: 100vh")
        canvases.append(canvas)
        canvas.load(json.loads(scene_file.read_text(encoding="utf-8")))

    # Nothing is packed and no styles are made up by a script, as in the editor.
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


def answer_to(gesture: dict[str, Any], scene: dict[str, Any]) -> dict[str, Any]:
    """What an editor would change after a gesture."""
    if gesture["kind"] == "move":
        moved: dict[str, list[Any]] = {}
        for item in gesture["items"]:
            if item["of"] != "common":
                moved.setdefault(item["of"], []).append(
                    {**scene[item["of"]][item["id"]], "x": item["x"], "y": item["y"]}
                )
        return {"upsert": moved}
    if gesture["kind"] == "delete":
        gone: dict[str, list[str]] = {}
        for item in gesture["items"]:
            gone.setdefault(item["of"], []).append(item["id"])
        return {"remove": gone}
    if gesture["kind"] == "rename":
        return {"upsert": {gesture["of"]: [{**scene[gesture["of"]][gesture["id"]], "name": gesture["name"]}]}}
    return {}


if __name__ in {"__main__", "__mp_main__"}:
    main(int(sys.argv[1]), Path(sys.argv[2]), sys.argv[3] if len(sys.argv) > 3 else "auto")
