"""`vicode docs --watch` as a person sees it: pages follow the files, and mistakes are told where one looks."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

ROOT = Path(__file__).parents[2]


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = tmp_path / "Blink"
    shutil.copytree(ROOT / "designs" / "blink", folder)
    return folder


# In tests it comes before the page: a page that outlives its server complains of that.
@pytest.fixture
def address(project: Path, tmp_path: Path) -> Iterator[str]:
    command = [sys.executable, "-m", "vicode", "docs", str(project), "--out", str(tmp_path / "site")]
    process = subprocess.Popen(
        [*command, "--watch", "--no-open"],
        cwd=ROOT,
        env={**os.environ, "VICODE_CACHE": str(tmp_path / "cache")},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert process.stdout is not None
    try:
        found = (re.match(r"Serving (http://127\.0\.0\.1:\d+/);", line) for line in process.stdout)
        yield next(match[1] for match in found if match)
    finally:
        process.terminate()
        process.stdout.close()
        process.wait(timeout=20)


def edit(project: Path, old: str, new: str) -> None:
    file = project / "blink.yaml"
    text = file.read_text("utf-8")
    assert old in text
    file.write_text(text.replace(old, new), "utf-8")


def test_a_page_follows_its_design(project: Path, address: str, page: Page, tmp_path: Path) -> None:
    page.goto(address)
    page.get_by_role("navigation", name="Pages").get_by_role("link", name="Blink").click()
    first = page.locator("h3").get_by_role("link", name="Bright", exact=True)
    expect(first).to_be_visible()
    edit(project, "Bright", "Lit")
    expect(page.locator("h3").get_by_role("link", name="Lit", exact=True)).to_be_visible()
    expect(first).to_have_count(0)
    on_disk = (tmp_path / "site" / "component-Blink.html").read_text("utf-8")
    assert "state-Lit" in on_disk
    assert "live" not in on_disk


def test_a_page_follows_a_design_that_only_its_script_contains(project: Path, address: str, page: Page) -> None:
    states = "states: {Only: {requires: [blink]}}"
    outer = f"vicode: 1\ncomponent: Outer\nuses: {{blink: {{component: Blink}}}}\ninitial: Only\n{states}\n"
    (project / "outer.yaml").write_text(outer, "utf-8")
    page.goto(f"{address}index.html")
    page.get_by_role("navigation", name="Pages").get_by_role("link", name="Outer").click()
    expect(page.locator("h1")).to_have_text("Outer")
    page.wait_for_load_state()
    # A page that was loaded again has lost it.
    page.evaluate("document.body.id = 'old'")
    edit(project, "Bright", "Lit")
    expect(page.locator("body#old")).to_have_count(0)
    page.wait_for_load_state()
    page.get_by_role("button", name="Try it").click()
    page.get_by_role("button", name="Run").click()
    expect(page.locator(".try tbody")).to_contain_text("Lit")


def test_a_mistake_is_told_and_the_last_good_page_stays(project: Path, address: str, page: Page) -> None:
    page.goto(f"{address}component-Blink.html")
    good = (project / "blink.yaml").read_text("utf-8")
    edit(project, "states:", "states: [<i>,")
    alert = page.get_by_role("alert")
    expect(alert).to_contain_text("error Y101")
    expect(alert).to_contain_text("blink.yaml:")
    expect(page.locator("h1")).to_have_text("Blink")
    page.goto(f"{address}index.html")
    expect(alert).to_contain_text("error Y101")
    (project / "blink.yaml").write_text(good, "utf-8")
    expect(alert).to_have_count(0)
