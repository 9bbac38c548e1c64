"""100 robots at 50 Hz in one window: processor time of their process and of the editor, and the age of what is shown.

`python -m benchmarks.attach_window [--robots N] [--seconds S]` runs the robots in one process, first alone, then with
`vicode attach` and a window in Chromium. The age is the newest iteration of the robot minus the one in the window.
"""

from __future__ import annotations

import argparse
import os
import re
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median, quantiles

from playwright.sync_api import CDPSession, Page, sync_playwright

PORT, EDITOR_PORT, TOKEN = 8498, 8499, "benchmark"
DESIGN = """\
vicode: 1
component: Robot
uses: {eye: Eye}
variables: {steps: {type: int, initial: 0}, gain: {type: float, initial: 0.5}}
initial: A
states:
  A: {requires: [eye], transitions: [{to: B, when: eye.light > 0.8}]}
  B: {requires: [eye], actions: [{set: {steps: steps + 1}}], transitions: [{to: C, after: 0.3}]}
  C: {requires: [eye], transitions: [{to: D, when: eye.near and eye.light < gain}, {to: A, after: 1}]}
  D: {requires: [eye], actions: [{set: {gain: gain + 0.001}}], transitions: [{to: E, after: 0.2}]}
  E: {requires: [eye], transitions: [{to: F, when: eye.light > 0.5}]}
  F: {requires: [eye], transitions: [{to: A, after: 0.1}]}
"""
PROJECT = """\
vicode: 1
project: Swarm
components:
  Eye: {implementation: swarm_eye:Eye, outputs: {light: float, near: bool, angle: float, size: float}}
"""
EYE = """\
import random
from vicode.bica import Component


class Eye(Component):
    def __init__(self, root):
        super().__init__(root)
        self.light = self.angle = self.size = 0.0
        self.near = False

    def work(self):
        self.light, self.angle, self.near = random.random(), random.random(), random.random() > 0.5
"""
ROBOTS = """\
import os, struct, sys, time
from swarm.robot import Robot
from vicode.bica import Root

count, port, token, file, period_s = int(sys.argv[1]), sys.argv[2], sys.argv[3], sys.argv[4], 0.02
roots = [Root(Robot) for _robot in range(count)]
if port != "0":
    for number, root in enumerate(roots):
        root.watch(port, token=token, name=f"robot {number:03}")
out = os.open(file, os.O_RDWR | os.O_CREAT)
due, late = time.monotonic(), 0
while True:
    for root in roots:
        root.step()
    due += period_s
    now = time.monotonic()
    late += now > due + period_s
    os.pwrite(out, struct.pack("qq", roots[0].iteration, late), 0)
    time.sleep(max(0.0, due - now))
"""
COUNT_CHANGES = """
() => {
  window.counted = { frames: 0, changes: 0 };
  const count = () => { counted.frames += 1; requestAnimationFrame(count); };
  requestAnimationFrame(count);
  new MutationObserver(() => (counted.changes += 1)).observe(
    document.querySelector(".simulation-where"), { childList: true, subtree: true, characterData: true });
}
"""
WHERE = "document.querySelector('.simulation-where')?.textContent"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=100)
    parser.add_argument("--seconds", type=float, default=10.0)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = write_project(Path(name))
        with running(folder, options.robots, port=0) as robots:
            alone = measure_cpu([robots.pid], options.seconds)[0]
        print(f"{options.robots} robots at 50 Hz alone: {alone:.0%} of a processor")
        with running(folder, options.robots, port=PORT) as robots:
            watch(folder, robots, options.seconds, alone)


def write_project(folder: Path) -> Path:
    designs = folder / "designs" / "swarm"
    designs.mkdir(parents=True)
    for file, text in (("project.yaml", PROJECT), ("robot.yaml", DESIGN), ("swarm_eye.py", EYE)):
        (designs / file).write_text(text, encoding="utf-8")
    (folder / "robots.py").write_text(ROBOTS, encoding="utf-8")
    command = [sys.executable, "-m", "vicode", "gen", "--out", str(folder / "generated"), str(designs)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return folder


@contextmanager
def running(folder: Path, count: int, *, port: int) -> Iterator[subprocess.Popen[bytes]]:
    paths = (str(folder / "generated" / "python"), str(folder / "designs" / "swarm"), os.environ.get("PYTHONPATH", ""))
    command = [sys.executable, str(folder / "robots.py"), str(count), str(port), TOKEN, str(folder / "newest")]
    environment = {**os.environ, "PYTHONPATH": ":".join(filter(None, paths))}
    process = subprocess.Popen(command, env=environment, stderr=subprocess.DEVNULL)
    try:
        time.sleep(3)
        yield process
    finally:
        process.kill()
        process.wait()


def watch(folder: Path, robots: subprocess.Popen[bytes], seconds: float, alone: float) -> None:
    attach = [sys.executable, "-m", "vicode", "attach", str(PORT), str(folder / "designs"), "--token", TOKEN]
    command = [*attach, "--no-open", "--port", str(EDITOR_PORT)]
    with attached(command) as (editor, url), sync_playwright() as playwright:
        path = "/usr/bin/chromium" if Path("/usr/bin/chromium").exists() else None
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox", "--disable-dev-shm-usage"])
        page = browser.new_page(viewport={"width": 1366, "height": 768})
        page.goto(f"{url}/design/swarm/Robot")
        page.wait_for_function(f"{WHERE}?.includes('iteration')", timeout=60_000)
        page.wait_for_timeout(3000)
        page.evaluate(COUNT_CHANGES)
        session = page.context.new_cdp_session(page)
        session.send("Performance.enable")
        busy = read_busy_s(session)
        ages: list[int] = []
        before = read_newest(folder)
        cpu = measure_cpu([robots.pid, editor], seconds, lambda: ages.append(read_age(page, folder)))
        counted = page.evaluate("counted")
        busy = {name: each - busy[name] for name, each in read_busy_s(session).items()}
        now = read_newest(folder)
        browser.close()
    print(f"watched in a window: robots {cpu[0]:.0%} ({cpu[0] / alone:.2f} x), editor {cpu[1]:.0%} of a processor")
    print(f"  iterations {(now[0] - before[0]) / seconds:.1f} per second, {now[1] - before[1]} more than a period late")
    print(
        f"  browser: {counted['frames'] / seconds:.0f} frames and {counted['changes'] / seconds:.1f} updates per second"
    )
    print("  of each second:", ", ".join(f"{name} {each / seconds * 1000:.0f} ms" for name, each in busy.items()))
    print(f"  age of what is shown: {median(ages):g} iterations, 95 %: {quantiles(ages, n=20)[-1]:g}, most {max(ages)}")


@contextmanager
def attached(command: list[str]) -> Iterator[tuple[int, str]]:
    """The editor: its process and its address."""
    environment = {**os.environ, "NICEGUI_STORAGE_PATH": "/tmp/vicode-benchmark"}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as process:
        assert process.stdout is not None
        try:
            yield (
                process.pid,
                next(found[0] for line in process.stdout if (found := re.search(r"http://[^/\s]+", line))),
            )
        finally:
            process.kill()


def measure_cpu(processes: list[int], seconds: float, act: Callable[[], object] = lambda: None) -> list[float]:
    """The parts of a processor that processes use, while `act` is called ten times per second."""
    before = [read_cpu_s(process) for process in processes]
    begin = time.monotonic()
    while time.monotonic() - begin < seconds:
        act()
        time.sleep(0.1)
    passed = time.monotonic() - begin
    return [(read_cpu_s(process) - start) / passed for process, start in zip(processes, before, strict=True)]


def read_cpu_s(process: int) -> float:
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def read_busy_s(session: CDPSession) -> dict[str, float]:
    """What the page did so far, in seconds."""
    metrics = {each["name"]: each["value"] for each in session.send("Performance.getMetrics")["metrics"]}
    names = {"scripts": "ScriptDuration", "styles": "RecalcStyleDuration", "layout": "LayoutDuration"}
    return {words: float(metrics[name]) for words, name in names.items()}


def read_age(page: Page, folder: Path) -> int:
    shown = str(page.evaluate(WHERE))
    newest = read_newest(folder)[0]
    return newest - int(shown.split("iteration ")[1].split(maxsplit=1)[0])


def read_newest(folder: Path) -> tuple[int, int]:
    """The iteration of the first robot, and how many were late."""
    iteration, late = struct.unpack("qq", (folder / "newest").read_bytes())
    return iteration, late


if __name__ == "__main__":
    main()
