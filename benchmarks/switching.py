"""How long another design of a large folder takes to appear after a click on its name, beside a full load of its page.

`python -m benchmarks.switching [--rounds N] [--designs N]`; both are measured in turn in one browser, from the click or
the start of the load until the frame in which header, diagram and inspector show the design.
"""

import argparse
import re
import shutil
import sys
import tempfile
from pathlib import Path
from statistics import median

from playwright.sync_api import Page, sync_playwright

from benchmarks.startup import start_server

SAMPLE = Path(__file__).parents[1] / "designs" / "forward"
# Runs before the scripts of each page. The times are kept by the session, as a load starts with a new window object.
CLOCK = """
const now = () => performance.timeOrigin + performance.now();
const isShown = (name) => {
  if (document.querySelector(".crumb.here")?.textContent !== name) return false;
  const root = document.querySelector(".vicode-canvas[data-ready]")?.shadowRoot;
  return root?.querySelector(".stage").getAttribute("aria-label") === `State machine ${name}`
    && root.querySelector('g[data-kind="state"]')
    && document.querySelector(".inspector .panel-title")?.textContent.includes(name);
};
window.measure = (name) => {
  sessionStorage.wanted = name;
  sessionStorage.start = now();
  delete sessionStorage.end;
};
document.addEventListener("click", ({ target }) => {
  const link = target.closest?.(".design-link");
  if (link) measure(decodeURIComponent(link.pathname.split("/").at(-1)));
}, true);
requestAnimationFrame(function look() {
  // A channel's message arrives when the frame has been painted.
  if (sessionStorage.wanted && !sessionStorage.end && isShown(sessionStorage.wanted)) {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => (sessionStorage.end ??= now());
    port2.postMessage(0);
  }
  requestAnimationFrame(look);
});
"""


def main() -> None:
    """Measure and print the medians."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--designs", type=int, default=200)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        names = copy_designs(Path(folder) / "team", options.designs)
        command = [sys.executable, "-m", "vicode", "edit", folder, "--no-open", "--no-tour", "--port", "8497"]
        with start_server(command) as url, sync_playwright() as playwright:
            path = shutil.which("chromium") or shutil.which("google-chrome")
            browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox", "--disable-dev-shm-usage"])
            page = browser.new_context(viewport={"width": 1366, "height": 768}).new_page()
            page.add_init_script(CLOCK)
            show(*measure(page, url + "design/team/", names, options.rounds))


def copy_designs(folder: Path, count: int) -> list[str]:
    """Make a project of `count` designs, copies of the sample's with other names; return the names of the copies."""
    shutil.copytree(SAMPLE, folder, ignore=shutil.ignore_patterns("__pycache__"))
    files = sorted(file for file in folder.glob("*.yaml") if file.name != "project.yaml")
    names = []
    for number in range(count - len(files)):
        file = files[number % len(files)]
        text = file.read_text(encoding="utf-8")
        name = re.search(r"^component: (\w+)", text, re.MULTILINE)[1] + f"Variant{number}"  # type: ignore[index]
        text = re.sub(r"^component: \w+", f"component: {name}", text, count=1, flags=re.MULTILINE)
        (folder / f"{file.stem}_{number}.yaml").write_text(text, encoding="utf-8")
        names.append(name)
    return names


def measure(page: Page, base: str, names: list[str], rounds: int) -> tuple[list[float], list[float]]:
    """Milliseconds of full loads and of clicks, each of another design."""
    loads, clicks = [], []
    page.goto(base + names[-1])
    for number in range(rounds + 1):
        # The same design for both, neighbors of different sizes in turn.
        wanted, other = names[2 * number], names[2 * number + 1]
        page.evaluate("name => measure(name)", other)
        page.goto(base + other, wait_until="commit")
        loads.append(wait_for_end(page))
        page.wait_for_function("window.did_handshake")
        page.get_by_role("navigation", name="Designs").get_by_role("link", name=wanted, exact=True).click()
        clicks.append(wait_for_end(page))
        page.wait_for_timeout(300)
    # The first round fills the caches.
    return loads[1:], clicks[1:]


def wait_for_end(page: Page) -> float:
    page.wait_for_function("sessionStorage.end")
    return float(page.evaluate("sessionStorage.end - sessionStorage.start"))


def show(loads: list[float], clicks: list[float]) -> None:
    print(f"{'milliseconds':14} {'median':>8} {'worst':>8}")
    print(f"{'full load':14} {median(loads):8.0f} {max(loads):8.0f}")
    print(f"{'click':14} {median(clicks):8.0f} {max(clicks):8.0f}")
    print(f"{'ratio':14} {median(click / load for click, load in zip(clicks, loads, strict=True)):8.2f}")


if __name__ == "__main__":
    main()
