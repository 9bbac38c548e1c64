"""How long `vicode edit` takes until a design is drawn, beside a NiceGUI page that says hello.

`python -m benchmarks.startup [--rounds N]`; both are started in turn as fresh processes, and opened in one browser.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from statistics import median

from playwright.sync_api import Browser, sync_playwright

HELLO = """
import asyncio
from nicegui import app, background_tasks, ui

@ui.page("/")
def hello():
    ui.label("hello").props("data-id=hello")

async def announce():
    while True:
        try:
            await asyncio.open_connection("127.0.0.1", PORT)
            break
        except OSError:
            await asyncio.sleep(0.02)
    print(f"http://127.0.0.1:{PORT}/", flush=True)

app.on_startup(lambda: background_tasks.create(announce()))
ui.run(host="127.0.0.1", port=PORT, reload=False, show=False, show_welcome_message=False, tailwind=False)
"""


def main() -> None:
    """Measure and print the medians."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=5)
    rounds = parser.parse_args().rounds
    commands = {
        "hello": ([sys.executable, "-c", HELLO.replace("PORT", "8499")], '[data-id="hello"]', ""),
        "vicode edit": (
            [sys.executable, "-m", "vicode", "edit", "designs", "--no-open", "--port", "8498"],
            '[data-id="Kick"]',
            # Where the browser is sent that `vicode edit` opens.
            "design/forward/Player",
        ),
    }
    times: dict[str, list[tuple[float, float]]] = {name: [] for name in commands}
    with sync_playwright() as playwright:
        path = shutil.which("chromium") or shutil.which("google-chrome")
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox", "--disable-dev-shm-usage"])
        for _round in range(rounds + 1):
            for name, (command, sign, path) in commands.items():
                times[name].append(measure_once(browser, command, sign, path))
    print(f"{'seconds':14} {'listening':>10} {'drawn':>10}")
    for name, all_measured in times.items():
        # The first round fills the disk's cache.
        measured = all_measured[1:]
        print(f"{name:14} {median(m[0] for m in measured):10.2f} {median(m[1] for m in measured):10.2f}")
    ratios = [ours[1] / base[1] for ours, base in zip(times["vicode edit"][1:], times["hello"][1:], strict=True)]
    print(f"{'ratio':14} {'':10} {median(ratios):10.2f}")


def measure_once(browser: Browser, command: list[str], sign: str, path: str) -> tuple[float, float]:
    """Seconds from starting a server until it answers, and until what `sign` selects is drawn at `path`."""
    start = time.perf_counter()
    with start_server(command) as url:
        listening = time.perf_counter() - start
        context = browser.new_context(viewport={"width": 1366, "height": 768})
        page = context.new_page()
        page.goto(url + path, wait_until="commit")
        page.locator(sign).first.wait_for()
        drawn = time.perf_counter() - start
        context.close()
    return listening, drawn


@contextmanager
def start_server(command: list[str]) -> Iterator[str]:
    """A server process, and the address that it prints."""
    environment = {**os.environ, "NICEGUI_STORAGE_PATH": "/tmp/vicode-benchmark"}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as process:
        assert process.stdout is not None
        try:
            yield re.search(r"http://\S+", process.stdout.readline())[0]  # type: ignore[index]
        finally:
            process.kill()


if __name__ == "__main__":
    main()
