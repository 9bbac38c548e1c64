"""Designs that run on their pages, opened from files: the same as in the reference interpreter."""

import json
import math
import random
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from tests.docsite.test_incremental_build import subject_of_model
from tests.editor.hostile_project import PAYLOADS
from vicode.cli import main
from vicode.conformance.inputs import PARAMETERS, ConformanceRun, RunStep, list_inputs
from vicode.conformance.reference import run_reference
from vicode.docsite import build_site
from vicode.model.design import Code, Declaration, Design, Guard, State, Transition, Use
from vicode.model.project import Project
from vicode.store import open_project

DESIGNS = Path(__file__).parents[2] / "designs"
TRIED = (("forward", "FollowBall"), ("rescue", "walk_corridor"), ("soccer2d", "FieldPlayer"))
"""The player of `forward` contains code; these are the largest designs without."""
STEPS = 1000
MAX_BYTES = 60_000

RUN = """([steps, changes]) => {
  const fields = [...document.querySelectorAll(".try-inputs :is(input, select)")];
  const key = (field) => [
    field.closest("fieldset").querySelector("legend").textContent,
    document.querySelector(`label[for="${field.id}"]`).textContent,
  ];
  const read = (field) => {
    if (field.type === "checkbox") return field.checked;
    return field.tagName === "SELECT" ? field.value : field.valueAsNumber;
  };
  const change = (field, chance) => {
    if (field.type === "checkbox") field.checked = chance < 0.5;
    else if (field.tagName === "SELECT") field.selectedIndex = Math.floor(chance * field.options.length);
    else {
      const [low, high] = field.type === "range" ? [Number(field.min), Number(field.max)] : [-500, 500];
      field.value = low + chance ** 2 * (high - low);
    }
    field.dispatchEvent(new Event("input"));
    field.dispatchEvent(new Event("change"));
  };
  const step = [...document.querySelectorAll(".try-bar button")].find((button) => button.textContent === "Step");
  const found = [];
  for (let index = 0; index < steps; index += 1) {
    fields.forEach((field, number) => {
      const chance = changes[index % changes.length][number];
      if (index === 0 || chance < 0.3) change(field, index === 0 ? chance : chance / 0.3);
    });
    const inputs = fields.map((field) => [...key(field), read(field)]);
    step.click();
    const rows = [...document.querySelectorAll(".try tbody tr")].map((row) => [
      row.querySelector("th").textContent,
      row.querySelector("td span").textContent,
      row.querySelector(".try-reads").textContent,
    ]);
    const active = [...document.querySelectorAll(".diagram .is-active")].map((node) => node.dataset.key);
    found.push({ inputs, rows, active, time: document.querySelector(".try-time").textContent });
  }
  return found;
}"""


def open_page(page: Page, file: Path) -> None:
    page.goto(file.as_uri())
    page.get_by_role("button", name="Try it").click()


@pytest.fixture(scope="module")
def sites(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("sites")
    projects = [str(DESIGNS / project) for project in ("forward", "rescue", "soccer2d")]
    assert main(["docs", *projects, "--out", str(folder)]) == 0
    return folder


@pytest.mark.parametrize(("name", "component"), TRIED)
def test_a_page_runs_its_design_as_the_reference_does(page: Page, sites: Path, name: str, component: str) -> None:
    project, rng = open_project(DESIGNS / name).project, random.Random(name)
    open_page(page, sites / name / f"component-{component}.html")
    changes = [[rng.random() for _field in range(40)] for _step in range(STEPS)]
    compare(project, component, page.evaluate(RUN, [STEPS, changes]), step_ns(sites / name / f"try-{component}.js"))


def step_ns(script: Path) -> int:
    text = script.read_text("utf-8")
    return int(text.partition('"stepNs": ')[2].partition(",")[0])


def compare(project: Project, component: str, found: list[dict[str, Any]], tick_ns: int) -> None:
    known = {each.key: each for each in list_inputs(project, component)}

    def values_of(inputs: list[tuple[str, str, Any]]) -> Mapping[tuple[str, str], Any]:
        values = {}
        for owner, label, value in inputs:
            each = known[PARAMETERS if owner == "Parameters" else owner, label.removesuffix("(…)")]
            typed = float(value) if each.type == "float" else value
            values[each.key] = typed if each.arguments is None else [({}, typed)]
        return values

    steps = tuple(
        RunStep(time_ns=index * tick_ns, inputs=(values_of(each["inputs"]),)) for index, each in enumerate(found)
    )
    states = set()
    for index, (got, iteration) in enumerate(
        zip(found, run_reference(ConformanceRun(project=project, root=component, steps=steps)), strict=True)
    ):
        expected = {step.component: step.fields for step in iteration.steps}
        stepped = {name: (state, values) for name, state, values in got["rows"] if state != "–"}
        assert set(stepped) == set(expected), index
        for name, (state, values) in stepped.items():
            assert state == expected[name].get("state", "stepped"), (index, name)
            check_values(values, expected[name])
        assert got["active"] == [f"s:{stepped[component][0]}"]
        assert got["time"] == f"{index * tick_ns / 1e9:.3f} s"
        states.add(stepped[component][0])
    assert len(states) > 1


def check_values(shown: str, fields: Mapping[str, str]) -> None:
    """The page shows five digits of numbers, and of the main component also its parameters, which are inputs."""
    pairs = dict(each.split(" = ") for each in shown.split(" · ") if each)
    for field, text in fields.items():
        section, _dot, name = field.partition(".")
        if section in ("parameters", "values"):
            try:
                assert math.isclose(float(pairs[name]), float(text), rel_tol=1e-4), field
            except ValueError:
                assert pairs[name] == text.rpartition(".")[2], field


PROJECT = """
vicode: 1
project: Guide
enumerations:
  Mood: {elements: [calm, wild]}
components:
  Eyes:
    implementation: eyes:Eyes
    outputs:
      seen: {type: bool, unit: %(evil)s, doc: %(evil)s}
      mood: {type: Mood, initial: Mood.calm}
      count: {type: int, range: [0, 9]}
      size: {type: float, unit: m}
      unread: {type: bool}
      bearing: {type: float, range: [-90, 90], arguments: {x: {type: float}}}
    variables: {told: {type: bool}}
"""
GUIDE = """
vicode: 1
component: Guide
uses: {eyes: {component: Eyes}}
variables: {steps: {type: int, initial: 0}}
initial: Wait
common:
  transitions: [{to: Stop, when: eyes.count > 7}]
states:
  Wait:
    doc: %(evil)s
    requires: [eyes]
    actions: [{set: {steps: steps + 1, eyes.told: true}}]
    transitions:
      - when: eyes.seen
        doc: %(evil)s
        then:
          - {to: Go, when: eyes.mood == Mood.wild and eyes.bearing(x=eyes.size) > 10}
          - {to: Stop, when: eyes.size > 20}
      - {to: Go, after: 0.1}
  Go:
    transitions: [{to: Wait, when: not eyes.seen}]
  Stop: {transitions: [{to: Wait, when: eyes.count < 3 and eyes.told}, {stay: true}]}
"""


@pytest.fixture(scope="module")
def guide(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a project, and in `site` its site; its texts try to run."""
    folder = tmp_path_factory.mktemp("guide")
    text = " ".join(PAYLOADS[each] for each in ("script", "image", "drawing", "script in a template"))
    evil = {"evil": json.dumps(text)}
    (folder / "project.yaml").write_text(PROJECT % evil, "utf-8")
    (folder / "guide.yaml").write_text(GUIDE % evil, "utf-8")
    assert main(["docs", str(folder), "--out", str(folder / "site")]) == 0
    return folder


def test_inputs_of_each_type_and_texts_of_strangers(page: Page, guide: Path) -> None:
    rng = random.Random(1)
    open_page(page, guide / "site" / "component-Guide.html")
    labels = page.locator(".try-inputs label").all_text_contents()
    expect(page.get_by_label("size")).to_have_accessible_description("m")
    assert labels == ["seen", "mood", "count", "size", "bearing(…)"]
    changes = [[rng.random() for _field in labels] for _step in range(200)]
    found = page.evaluate(RUN, [200, changes])
    compare(open_project(guide).project, "Guide", found, step_ns(guide / "site" / "try-Guide.js"))
    expect(page.locator(".try")).to_contain_text("<img src=x")
    assert page.evaluate("window.ran") is None
    for width in (390, 820, 1366):
        page.set_viewport_size({"width": width, "height": 768})
        assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_guards_show_their_truth_and_the_last_transition_is_marked(page: Page, guide: Path) -> None:
    open_page(page, guide / "site" / "component-Guide.html")
    guards = page.locator(".try-guards li")
    expect(guards).to_contain_text(["eyes.count", "eyes.seen", "Mood", "eyes.size > 20", "after 0.1 s"])
    expect(guards.nth(1)).to_contain_text("false")
    page.get_by_label("seen").check()
    expect(guards.nth(1)).to_contain_text("true")
    expect(guards.nth(1)).to_contain_text("eyes.seen = true")
    page.get_by_label("mood").select_option("wild")
    page.get_by_label("bearing(…)").focus()
    for _press in range(3):
        page.keyboard.press("PageUp")
    expect(guards.nth(2)).to_contain_text("eyes.mood = wild")
    expect(guards.nth(2)).to_contain_text("eyes.bearing(…) = ")
    expect(page.locator(".diagram .is-last")).to_have_count(0)
    page.get_by_role("button", name="Step").focus()
    page.keyboard.press("Enter")
    expect(page.locator(".try [role=status]")).to_have_text("Active state: Go. Last transition: Wait → Go at 0.000 s.")
    expect(page.locator(".diagram .is-last").first).to_have_attribute("href", "#state-Wait-0-then-0")
    expect(page.locator(".diagram .is-active")).to_have_attribute("data-key", "s:Go")
    page.get_by_label("count").press("End")
    page.get_by_role("button", name="Step").click()
    expect(page.locator(".try-mark")).to_have_text(["true", "false", "always"])
    expect(guards.nth(1)).to_contain_text("eyes.count = 9 · eyes.told = false")
    page.get_by_role("button", name="Reset").click()
    expect(page.locator(".try-time")).to_have_text("Not started")
    expect(page.locator(".diagram .is-active")).to_have_attribute("data-key", "s:Wait")


def test_it_runs_until_it_is_paused(page: Page, guide: Path) -> None:
    open_page(page, guide / "site" / "component-Guide.html")
    page.get_by_label("Rate", exact=True).select_option("16 ×")
    page.get_by_role("button", name="Run").click()
    expect(page.locator(".try-last")).to_contain_text("Last transition: Wait → Go")
    page.get_by_role("button", name="Pause").click()
    before = page.locator(".try-time").text_content()
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    assert page.locator(".try-time").text_content() == before
    expect(page.get_by_role("button", name="Run")).to_be_visible()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_everybody_can_use_it(page: Page, guide: Path, scheme: Literal["light", "dark"]) -> None:
    page.emulate_media(color_scheme=scheme)
    open_page(page, guide / "site" / "component-Guide.html")
    page.get_by_label("seen").check()
    page.get_by_role("button", name="Step").click()
    violations = Axe().run(page, options={"resultTypes": ["violations"], "preload": False}).response["violations"]
    assert not [(each["id"], node["html"][:120]) for each in violations for node in each["nodes"]]


def test_other_documentation_shows_it_with_one_line(page: Page, sites: Path, tmp_path: Path) -> None:
    script = (sites / "forward" / "try-FollowBall.js").as_uri()
    (tmp_path / "other.html").write_text(
        f'<!doctype html><title>Other</title><p>Before</p><script src="{script}" data-vicode-try></script>', "utf-8"
    )
    page.goto((tmp_path / "other.html").as_uri())
    frame = page.frame_locator('iframe[title="FollowBall: try it"]')
    frame.get_by_role("button", name="Step").click()
    expect(frame.locator(".try-time")).to_have_text("0.000 s")
    for hidden in (".menu", ".breadcrumbs", "h1", "#transitions"):
        expect(frame.locator(hidden)).to_be_hidden()
    height = frame.locator("body").evaluate("(body) => body.offsetHeight")
    expect(page.locator("iframe")).to_have_js_property("offsetHeight", height)
    with page.expect_popup() as opened:
        frame.get_by_role("link", name="GoStraight").click()
    assert opened.value.url.endswith("/component-GoStraight.html")
    opened.value.close()


def test_a_design_with_code_has_no_button_but_a_reason(page: Page, sites: Path) -> None:
    page.goto((sites / "forward" / "component-Player.html").as_uri())
    expect(page.get_by_role("button", name="Try it")).to_have_count(0)
    expect(page.locator("main")).to_contain_text(
        "This page cannot run the component: code has no counterpart in JavaScript."
    )
    assert not (sites / "forward" / "try-Player.js").exists()


def test_a_page_gets_at_most_60_kb_and_loads_nothing_else(sites: Path) -> None:
    scripts = sorted(sites.glob("*/try-*.js"))
    assert len(scripts) > 10
    for script in scripts:
        assert script.stat().st_size + (script.parent / "try.js").stat().st_size <= MAX_BYTES
        assert "http" not in script.read_text("utf-8")


def test_a_design_beyond_the_limit_has_no_script() -> None:
    leave = Transition(to="S0", guard=Guard(when="x > 1"))
    states = tuple(State(name=f"S{number}", transitions=(leave,)) for number in range(300))
    own = (Declaration(name="x", initial="1.0"),)
    files = build_pages(Design(component="Large", variables=own, initial="S0", states=states))
    assert "its code in JavaScript is larger than 40 kB" in files["component-Large.html"]
    assert "try-Large.js" not in files


def test_a_design_that_uses_a_design_with_code_names_it() -> None:
    code, states = Code(texts=(("python", "pass"),)), (State(name="A"),)
    inner = Design(component="Inner", module=code, initial="A", states=states)
    outer = Design(component="Outer", uses=(Use(alias="inner", component="Inner"),), initial="A", states=states)
    page = build_pages(inner, outer)["component-Outer.html"]
    assert 'in <a href="component-Inner.html#languages">Inner</a>, code has no counterpart' in page


def build_pages(*designs: Design) -> dict[str, str]:
    project = Project(name="Built", designs=designs)
    return {file.path: file.text for file in build_site(subject_of_model(project))}
