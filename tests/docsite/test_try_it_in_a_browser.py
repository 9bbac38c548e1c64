"""Designs that run on their pages, opened from files: the same as in the reference interpreter."""

import math
import random
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page

from vicode.cli import main
from vicode.conformance.inputs import PARAMETERS, ConformanceRun, RunStep, list_inputs
from vicode.conformance.reference import run_reference
from vicode.docsite import SiteInput, build_site
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


def write_project(project: Project, folder: Path) -> Path:
    for file in build_site(SiteInput(project=project)):
        (folder / file.path).write_text(file.text, "utf-8")
    return folder


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
