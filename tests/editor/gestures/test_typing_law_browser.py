"""What is typed at any speed, over a line that is slow and breaks, is the design that is saved."""

import random
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
import yaml
from playwright.sync_api import Page, expect

from tests.editor.slow_connection import SlowConnection

_WORDS = ("seen", "lost", "near", "far", "din", "sit", "find", "mind", "tools")


@dataclass
class _Typist:
    """A user who types without waiting, and what the keys stand for: states with their descriptions and transitions."""

    page: Page
    line: SlowConnection
    chance: random.Random
    key_ms: int
    design: dict[str, dict[str, Any]] = field(default_factory=dict)
    selected: str = ""

    def act(self) -> None:
        if self.chance.random() < 0.5:
            self.line.hold()
        actions = [self.add_state] if len(self.design) < 2 else [self.add_transition, self.rename, self.describe]
        self.chance.choice([*actions, self.add_state, self.add_transition] if self.design else actions)()
        if self.chance.random() < 0.2:
            self.cut()
        self.line.release()

    def add_state(self) -> None:
        name = self.new_name()
        self.page.keyboard.press("s")
        self.type(name, "Enter")
        self.add(name)

    def add_transition(self) -> None:
        source = self.select()
        name = self.chance.choice([*self.design, self.new_name()])
        guard = f"state_time > {self.chance.randrange(9)}"
        self.page.keyboard.press("n")
        self.type(name, self.chance.choice(["Enter", "Tab"]))
        self.type(guard, "Enter")
        self.design[source]["transitions"].append((name, guard))
        if name in self.design:
            # The new transition is selected.
            self.selected = ""
        else:
            self.add(name)

    def rename(self) -> None:
        old, name = self.select(), self.new_name()
        self.page.keyboard.press("F2")
        self.type(name, "Enter")
        self.design = {name if each == old else each: state for each, state in self.design.items()}
        for state in self.design.values():
            state["transitions"] = [(name if to == old else to, guard) for to, guard in state["transitions"]]
        # The name of a state is its identity: the line brings the new one.
        self.line.release()
        self.page.wait_for_function(_IS_DRAWN, arg=name)
        self.selected = name

    def describe(self) -> None:
        name, text = self.select(), " ".join(self.chance.choices(_WORDS, k=4))
        # Nobody clicks into a form that is not there.
        self.line.release()
        expect(self.page.locator(".inspector [data-path=name] input")).to_have_value(name)
        self.page.locator(".inspector [data-path=doc] textarea").click()
        self.page.keyboard.press("Control+a")
        self.type(text[:9])
        if self.chance.random() < 0.5:
            self.cut()
        self.type(text[9:], "Escape")
        self.design[name]["doc"] = text

    def cut(self) -> None:
        # A connection that breaks while it is being made is given up after 20 s only.
        if self.page.evaluate("window.socket.connected"):
            self.line.cut()

    def new_name(self) -> str:
        return f"{self.chance.choice(_WORDS).title()}{self.chance.randrange(10_000)}"

    def add(self, name: str) -> None:
        self.design[name] = {"doc": "", "transitions": []}
        self.selected = name

    def select(self) -> str:
        """Click a state unless one is selected already."""
        if not self.selected:
            self.selected = self.chance.choice([*self.design])
            self.page.wait_for_function(_IS_DRAWN, arg=self.selected)
            self.page.keyboard.press("1")
            spot = self.page.evaluate(_PLACE, self.selected)
            self.page.mouse.click(spot["x"], spot["y"])
        return self.selected

    def type(self, text: str, end: str = "") -> None:
        self.page.keyboard.type(text, delay=self.key_ms)
        if end:
            self.page.keyboard.press(end)


_IS_DRAWN = "name => `states/${name}` in document.querySelector('.vicode-canvas').vicode.positions()"
# Where a state stands once the view has come to rest.
_PLACE = """async name => {
  const find = () => document.querySelector('.vicode-canvas').vicode.screen('states', name);
  let [place, frames] = [find(), 0];
  while (frames < 5) {
    await new Promise(requestAnimationFrame);
    const next = find();
    frames = next.x === place.x && next.y === place.y ? frames + 1 : 0;
    place = next;
  }
  return place;
}"""


def _read(file: Path) -> dict[str, dict[str, Any]]:
    states = yaml.safe_load(file.read_text(encoding="utf-8")).get("states") or {}
    return {
        name: {
            "doc": (state or {}).get("doc", ""),
            "transitions": [(each["to"], each["when"]) for each in (state or {}).get("transitions", [])],
        }
        for name, state in states.items()
    }


@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.nightly) for seed in range(1, 9))])
@pytest.mark.parametrize("key_ms", [0, 30, 120])
def test_the_saved_design_is_the_one_that_was_typed(
    editor: str, page: Page, project: Path, line: SlowConnection, console_errors: list[str], key_ms: int, seed: int
) -> None:
    file = project / "forward" / "quick.yaml"
    file.write_text("vicode: 1\ncomponent: Quick\n", encoding="utf-8")
    page.set_viewport_size({"width": 1366, "height": 768})
    page.goto(f"{editor}design/forward/Quick")
    page.wait_for_selector(".vicode-canvas[data-ready]")
    page.wait_for_function("window.did_handshake")
    typist = _Typist(page, line, random.Random(f"{key_ms} {seed}"), key_ms)
    for _number in range(16):
        typist.act()
    page.keyboard.press("Control+s")
    expect(page.locator(".saved")).to_have_text(re.compile("^Saved"), timeout=60_000)
    assert _read(file) == typist.design
    console_errors.clear()
