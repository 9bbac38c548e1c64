"""Texts of strangers stay texts: whatever a project says, on every view nothing of it runs and nothing breaks out."""

import json
import re
import urllib.request
from pathlib import Path
from urllib.error import HTTPError

import pytest
from playwright.sync_api import Page, expect

from tests.editor.hostile_project import PAYLOADS, write_hostile_names, write_hostile_project

expect.set_options(timeout=20_000)


# One text that tries everything at once; each by itself in the nightly run.
TOGETHER = "".join(text for name, text in PAYLOADS.items() if name != "other scripts")
SINGLY = [pytest.param(text, id=name, marks=pytest.mark.nightly) for name, text in PAYLOADS.items()]


@pytest.fixture(params=[pytest.param(TOGETHER, id="together"), *SINGLY])
def payload(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
def project(tmp_path: Path, payload: str) -> Path:
    folder = tmp_path / "designs"
    write_hostile_project(folder / "evil", payload)
    write_hostile_names(folder, payload)
    return folder


def assert_harmless(page: Page) -> None:
    """Nothing ran, and nothing is wider than the window."""
    assert page.evaluate("window.ran") is None
    assert page.locator("img[src=x]").count() == 0
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert page.locator("a[href^='javascript:' i]").count() == 0


def look_at_everything(page: Page) -> None:
    """Every tab of both panels, the table, the tip of every button, a dialog."""
    for name in page.get_by_role("tab").all_inner_texts():
        page.get_by_role("tab", name=name.strip(), exact=True).click()
        assert_harmless(page)
    page.keyboard.press("F4")
    expect(page.get_by_role("treegrid")).to_be_visible()
    for row in page.locator(".vicode-table .row").all()[:8]:
        row.locator(".c-name").click()
        assert_harmless(page)
    page.keyboard.press("F4")
    page.locator(".design-link.is-broken").first.hover()
    expect(page.get_by_role("tooltip")).to_be_visible()
    page.keyboard.press("Control+k")
    page.keyboard.type("e")
    expect(page.get_by_role("option").first).to_be_visible()
    assert_harmless(page)
    page.keyboard.press("Escape")


def look_at_names(page: Page, editor: str) -> None:
    """The design whose names are the payload, and the home."""
    page.goto(editor + "design/evil/Player")
    expect(page.locator(".design-link.is-broken").first).to_be_visible()
    assert_harmless(page)
    link = page.get_by_role("link", name="Wave")
    if link.count():
        link.click()
        expect(page.get_by_role("heading", name="Wave", exact=True)).to_be_visible()
        expect(page.locator(".vicode-canvas[data-ready]")).to_be_attached()
        assert_harmless(page)
    page.goto(editor)
    expect(page.get_by_role("heading", level=1).first).to_be_visible()
    assert_harmless(page)


def test_nothing_runs_and_nothing_breaks_out(editor: str, page: Page, payload: str) -> None:
    page.goto(editor + "design/evil/Player")
    seek = page.locator('g[data-kind="state"][data-id="Seek"]')
    expect(seek).to_be_visible()
    expect(page.get_by_label("Description").first).to_have_value(payload)
    expect(page.locator(".finding").first).to_be_visible()
    assert_harmless(page)
    seek.click()
    expect(page.get_by_label("State", exact=True)).to_have_value("Seek")
    assert_harmless(page)
    for decision in page.locator(".decision").all()[:3]:
        decision.hover()
    page.locator(".decision").first.click()
    expect(page.get_by_label("Description").first).to_have_value(payload)
    look_at_everything(page)
    page.get_by_role("button", name="Save", exact=True).click()
    page.get_by_role("button", name="Generate").click()
    expect(page.get_by_role("alert").first).to_be_visible()
    assert_harmless(page)

    look_at_names(page, editor)


def test_a_drawing_that_travels_with_its_page_stays_in_its_script(editor: str, page: Page, payload: str) -> None:
    address = editor + "design/evil/Player"
    with urllib.request.urlopen(address, timeout=60) as answer:
        text = answer.read().decode()
    found = re.search(r'<script type="application/json" id="scene-\d+">([^<]*)</script>', text)
    assert found is not None
    assert payload in [state["doc"] for state in json.loads(found[1])["states"]]
    page.goto(address)
    expect(page.locator('g[data-kind="state"][data-id="Seek"]')).to_be_visible()
    assert page.locator('script[type="application/json"]').count() == 0


OUTSIDE = (
    "design/..%2F..%2F..%2Fetc/passwd",
    "design/evil/..%2F..%2Fsecret",
    "design/%2e%2e/Player",
    "design/evil/%2Fetc%2Fpasswd",
    "design/evil/<script>window.ran=1<%2Fscript>",
    "design/evil/Player?select=<script>window.ran=1<%2Fscript>&from=javascript:alert(1)",
    "_nicegui/../../../../etc/passwd",
)


@pytest.mark.parametrize("payload", ["nothing"], indirect=False)
def test_addresses_lead_nowhere_outside(editor: str, page: Page, project: Path, console_errors: list[str]) -> None:
    (project.parent / "secret.yaml").write_text("vicode: 1\ncomponent: Secret\nstates: {Hidden: {}}\n")
    for address in OUTSIDE:
        try:
            with urllib.request.urlopen(editor + address, timeout=60) as answer:
                text = answer.read().decode()
        except HTTPError as error:
            text = error.read().decode()
        assert "root:x:" not in text
        assert "Hidden" not in text
        page.goto(editor + address)
        assert page.evaluate("window.ran") is None
    console_errors.clear()
