"""How long a click on a state takes until its form is there, beside a field that a click on a bare page fills.

`python -m benchmarks.selection [--rounds N] [--states N …] [--latency MS …]`; all in one browser, in turn.
"""

import argparse
import shutil
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from statistics import median

from playwright.sync_api import Browser, Page, Playwright, sync_playwright

from benchmarks.startup import start_server
from tests.diagram.diagram_designs import ring_design
from vicode.store import save_design, write_text

# From the press of the mouse until the frame that shows the name in the field has been produced.
_OBSERVE = """([find, name]) => new Promise((done) => {
  let pressed;
  addEventListener("pointerdown", (event) => (pressed = event.timeStamp), { capture: true, once: true });
  const look = () => {
    const field = document.querySelector(find);
    if (pressed && field && field.value === name) setTimeout(() => done(performance.now() - pressed));
    else requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
})"""
_FORM = ".inspector input"
_BARE = """<button style="position: fixed; inset: 0; height: 50px">item</button>
<form style="margin-top: 60px"></form>
<script>
let count = 0;
document.querySelector("button").onclick = () => {
  document.forms[0].innerHTML = `<label>Name <input value="Item${++count}"></label>`;
};
</script>"""


def main() -> None:
    """Measure and print the medians."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=11)
    parser.add_argument("--states", type=int, nargs="+", default=[20, 1000])
    parser.add_argument("--latency", type=int, nargs="+", default=[0, 120], help="most ms of each message")
    options = parser.parse_args()
    with sync_playwright() as playwright:
        browser = _launch(playwright)
        for states in options.states:
            for latency_ms in options.latency:
                times = list(zip(*_measure(browser, states, latency_ms, options.rounds), strict=True))
                bare, form = (median(each) for each in times)
                print(f"{states:5} states, {latency_ms:4} ms: {form:5.0f} ms, bare page {bare:3.0f} ms")


def _launch(playwright: Playwright) -> Browser:
    path = shutil.which("chromium") or shutil.which("google-chrome")
    return playwright.chromium.launch(executable_path=path, args=["--no-sandbox", "--disable-dev-shm-usage"])


def _measure(browser: Browser, states: int, latency_ms: int, rounds: int) -> Iterator[tuple[float, float]]:
    """Yield per round the milliseconds of the bare page and of the editor; the first round is left out."""
    with tempfile.TemporaryDirectory() as folder:
        write_text(Path(folder, "ring.yaml"), save_design(ring_design(states), ""))
        command = [sys.executable, "-m", "vicode", "edit", folder, "--no-open", "--port", "8497"]
        with start_server(command) as url:
            bare, editor = (browser.new_context(viewport={"width": 1366, "height": 768}).new_page() for _ in range(2))
            bare.set_content(_BARE)
            if latency_ms:
                slow = Path("tests/slow_lines.js").read_text(encoding="utf-8")
                editor.add_init_script(slow.replace("MOST_MS", str(latency_ms)))
            editor.goto(f"{url}design/{Path(folder).name}/Ring")
            editor.wait_for_selector(".vicode-canvas[data-ready]")
            editor.wait_for_timeout(3000)
            for number in range(rounds + 1):
                name = f"State{number % states}"
                x, y = editor.evaluate(_SHOW, name)
                editor.wait_for_timeout(500)
                bare_ms = _click(bare, "input", f"Item{number + 1}", 20, 24)
                form_ms = _click(editor, _FORM, name, x, y)
                if number:
                    yield bare_ms, form_ms
            for page in (bare, editor):
                page.context.close()


_SHOW = """name => {
  const { vicode } = document.querySelector('.vicode-canvas');
  const place = vicode.positions()[`states/${name}`];
  vicode.setView({ x: 400 - place.x, y: 200 - place.y, k: 1 });
  const { x, y } = vicode.screen('states', name);
  return [x, y];
}"""


def _click(page: Page, find: str, name: str, x: float, y: float) -> float:
    page.evaluate(f"args => {{ window.measured = ({_OBSERVE})(args); }}", [find, name])
    page.mouse.click(x, y)
    return float(page.evaluate("window.measured"))


if __name__ == "__main__":
    main()
