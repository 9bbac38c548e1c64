"""How well drawings read: what is hidden by something else, counted in the browser on shipped and random designs.

Run `python -m benchmarks.readability [RANDOM DESIGNS]`.
"""

import json
import sys
from dataclasses import asdict
from typing import Any
from urllib.request import Request, urlopen

from playwright.sync_api import Page, sync_playwright

from benchmarks.canvas import ARGUMENTS, open_page, serving
from tests.editor.canvas.legibility import forward_scenes, measure_legibility, random_scenes

RANDOM = 20


def main(count: int = RANDOM) -> None:
    """Print what is counted for every design, and the sums."""
    kinds = {"shipped": forward_scenes(), "random": random_scenes(count)}
    with sync_playwright() as playwright, serving(next(iter(kinds["shipped"].values()))) as address:
        browser = playwright.chromium.launch(executable_path="/usr/bin/chromium", args=list(ARGUMENTS))
        page, _seconds = open_page(browser, address)
        for kind, scenes in kinds.items():
            counts = {name: count_in(page, address, scene) for name, scene in scenes.items()}
            for name, each in counts.items():
                print(f"{name:14}", show(each))
            print(f"{kind:14}", show({key: sum(each[key] for each in counts.values()) for key in counts[name]}), "\n")
        browser.close()


def count_in(page: Page, address: str, scene: dict[str, Any]) -> dict[str, int]:
    """What `read` counts when a scene is shown."""
    page.evaluate("document.querySelector('.vicode-canvas').removeAttribute('data-ready')")
    for method, arguments in (("load", [scene]), ("fit", [])):
        headers = {"Content-Type": "application/json"}
        urlopen(Request(f"{address}call/{method}", data=json.dumps(arguments).encode(), headers=headers)).close()
        page.wait_for_selector(".vicode-canvas[data-ready]")
    page.wait_for_timeout(100)
    page.wait_for_function("document.querySelector('.vicode-canvas').vicode.view().resting")
    page.wait_for_timeout(100)
    return asdict(measure_legibility(page))


def show(counts: dict[str, int]) -> str:
    return "  ".join(f"{key} {value}" for key, value in counts.items())


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else RANDOM)
