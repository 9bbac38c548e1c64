"""Everybody can use it: axe finds nothing on any view of the pages, and what axe cannot see is tried by hand."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from tests.editor.player_page import select_state, state

PLAYER = "design/forward/Player"
AXE = Axe()
OPTIONS = {"resultTypes": ["violations"]}

expect.set_options(timeout=20_000)


def complaints(page: Page, within: str | None = None) -> list[str]:
    """What axe finds, one line a thing."""
    # A color on its way to another is neither.
    page.wait_for_function("document.getAnimations().every((each) => each.playState !== 'running')")
    violations = AXE.run(page, context=within, options=OPTIONS).response["violations"]
    nodes = ((each["id"], node) for each in violations for node in each["nodes"])
    return [f"{rule}: {node['html'][:120]} {node['failureSummary'][-240:]}" for rule, node in nodes]


def tabs(page: Page) -> Iterator[str]:
    """Every tab of the page in turn, opened."""
    for name in page.get_by_role("tab").all_inner_texts():
        tab = page.get_by_role("tab", name=name.strip(), exact=True)
        # Tabs of the inspector are gone when another tab shows another element.
        if not tab.is_visible():
            continue
        tab.click()
        expect(tab).to_have_attribute("aria-selected", "true")
        yield name


def open_player(page: Page, url: str) -> None:
    page.set_viewport_size({"width": 1366, "height": 768})
    page.goto(url + PLAYER)
    expect(page.locator('g[data-kind="state"]').first).to_be_visible()
    expect(page.get_by_label("Description").first).to_be_visible()


@pytest.mark.parametrize("colors", ["light", pytest.param("dark", marks=pytest.mark.nightly)])
def test_axe_finds_nothing(editor: str, page: Page, colors: str) -> None:
    page.emulate_media(color_scheme="dark" if colors == "dark" else "light", reduced_motion="reduce")
    open_player(page, editor)
    found = {"design": complaints(page)}
    page.get_by_label("Inspector").get_by_text("Project Forward").click()
    expect(page.get_by_label("Project name")).to_be_visible()
    found["project"] = complaints(page, ".inspector")
    select_state(page, "WatchBall")
    found["state"] = complaints(page)
    page.get_by_role("button", name="New design").first.click()
    expect(page.get_by_role("dialog")).to_be_visible()
    # What lies under a dialog is out of reach, and dimmed.
    found["dialog"] = complaints(page, ".q-dialog")
    page.keyboard.press("Escape")
    expect(page.get_by_role("dialog")).to_have_count(0)
    page.keyboard.press("F4")
    expect(page.get_by_role("treegrid")).to_be_visible()
    page.locator('.row[data-id="transitions/WatchBall/1"] .c-when').click()
    expect(page.get_by_label("When").first).to_be_visible()
    page.keyboard.press("F2")
    page.keyboard.type("x +")
    page.keyboard.press("Enter")
    expect(page.locator(".finding").first).to_be_visible()
    found["table and transition"] = complaints(page)
    found |= {f"tab {name}": complaints(page) for name in tabs(page)}
    page.goto(editor + "design/forward/Nobody")
    expect(page.get_by_role("heading", level=1)).to_be_visible()
    found["no such design"] = complaints(page)
    page.goto(editor)
    expect(page.get_by_role("heading", level=1)).to_be_visible()
    found["home"] = complaints(page)
    text = "\n".join(f"{where}: {line}" for where, lines in found.items() for line in lines)
    assert not text, text


@pytest.mark.parametrize("colors", ["light", pytest.param("dark", marks=pytest.mark.nightly)])
def test_axe_finds_nothing_in_what_opens_over_the_page(editor: str, page: Page, project: Path, colors: str) -> None:
    page.emulate_media(color_scheme="dark" if colors == "dark" else "light", reduced_motion="reduce")
    open_player(page, editor)
    found: dict[str, list[str]] = {}

    def look(name: str) -> None:
        dialog = page.get_by_role("dialog", name=name)
        expect(dialog).to_be_visible()
        expect(dialog.get_by_role("heading", name=name)).to_be_visible()
        # A dialog that still opens does not hear Escape.
        page.wait_for_function("document.activeElement.closest('.q-dialog')")
        found[name] = complaints(page, ".q-dialog")
        page.keyboard.press("Escape")
        expect(page.get_by_role("dialog")).to_have_count(0)

    # Dialogs made of the same parts are left to the nightly run.
    if colors == "dark":
        _look_at_the_plain_ones(page, look)
    page.keyboard.press("Control+k")
    page.keyboard.type("ball")
    expect(page.get_by_role("option").first).to_be_visible()
    found["palette"] = complaints(page, ".palette")
    page.keyboard.press("Escape")
    page.get_by_role("button", name="Generate").click()
    look("Write the generated code?")
    select_state(page, "Kick")
    page.get_by_label("Description").fill("mine")
    page.get_by_label("Description").blur()
    expect(page.get_by_text("Unsaved changes")).to_be_visible()
    file = project / "forward" / "player.yaml"
    file.write_text(file.read_text().replace("Kick, with the eyes on the ball.", "theirs"))
    page.get_by_role("button", name="Resolve…").click()
    look("player.yaml was changed by another program")
    text = "\n".join(f"{where}: {line}" for where, lines in found.items() for line in lines)
    assert not text, text


def _look_at_the_plain_ones(page: Page, look: Callable[[str], None]) -> None:
    page.keyboard.press("?")
    look("Keyboard shortcuts and gestures")
    page.keyboard.press("u")
    look("Add component")
    page.keyboard.press("Control+Shift+E")
    look("Export Player")
    for item, name in (("Rename everywhere", "Rename Turn"), ("Move to trash", "Move Turn to the trash?")):
        page.get_by_role("button", name="More for Turn").focus()
        page.keyboard.press("Enter")
        page.get_by_role("menuitem", name=item).click()
        look(name)


def test_names_of_buttons_contain_the_words_that_they_show(editor: str, page: Page) -> None:
    """The caption of a section describes it; it is no part of its name."""
    open_player(page, editor)
    unspoken = page.evaluate(
        """() => [...document.querySelectorAll(":is(button, a, [role=button])[aria-label]")].flatMap((each) => {
          const shown = each.cloneNode(true);
          for (const icon of shown.querySelectorAll(".q-icon, .q-item__label--caption")) icon.remove();
          const leaves = [shown, ...shown.querySelectorAll("*")].filter((part) => !part.children.length);
          const words = leaves.flatMap((part) => part.textContent.match(/[A-Za-z_]{2,}/g) ?? []);
          const name = each.getAttribute("aria-label");
          return words.filter((word) => !name.includes(word)).map((word) => `${name}: ${word}`);
        })"""
    )
    assert unspoken == []


def test_names_of_nodes_contain_what_they_show(editor: str, page: Page) -> None:
    """Speech control selects a node by its visible name."""
    open_player(page, editor)
    nodes = page.locator("g.node").all()
    assert len(nodes) > 10
    for node in nodes:
        visible = node.locator(".name").text_content() or "?"
        assert visible.lower() in (node.get_attribute("aria-label") or "").lower()


@pytest.mark.parametrize(("width", "height"), [(820, 1180), (683, 384)])
def test_a_narrow_window_has_a_header_of_one_row_and_a_list_of_designs(
    editor: str, page: Page, width: int, height: int
) -> None:
    page.set_viewport_size({"width": width, "height": height})
    page.goto(editor + PLAYER)
    expect(page.locator('g[data-kind="state"]').first).to_be_visible()
    expect(page.get_by_label("Description").first).to_be_visible()
    tops = [
        box["y"] + box["height"] / 2
        for button in page.locator(".head button").all()
        if (box := button.bounding_box()) is not None
    ]
    assert len(tops) > 6
    assert max(tops) - min(tops) < 8
    listed = page.locator(".designs")
    box = listed.bounding_box()
    assert box is not None
    assert box["height"] > 70
    expect(listed.get_by_role("link", name="Player", exact=True)).to_be_in_viewport(ratio=0.9)


def test_marks_are_told_apart_in_forced_colors_and_by_ear(editor: str, page: Page) -> None:
    page.emulate_media(forced_colors="active")
    open_player(page, editor)
    # States are heard before the arrows between them, though they are painted after them.
    spoken = page.context.new_cdp_session(page).send("Accessibility.getFullAXTree")["nodes"]
    names = [each.get("name", {}).get("value", "") for each in spoken if each.get("role", {}).get("value") == "group"]
    assert names.index("Diagram") < names.index("States and components") < names.index("Transitions")
    box = page.locator('g[data-id="Kick"] rect.box')
    look = "(each) => [getComputedStyle(each).stroke, getComputedStyle(each).strokeWidth].join()"
    before = box.evaluate(look)
    state(page, "Kick").click()
    expect(state(page, "Kick")).to_have_attribute("aria-description", "selected")
    assert box.evaluate(look) != before
    # The focus of a button is a frame, and what is pressed has one.
    page.get_by_role("button", name="Find anything").focus()
    page.keyboard.press("Tab")
    frame = "(each) => getComputedStyle(each).outlineStyle"
    assert page.locator(":focus").evaluate(frame) == "solid"
    assert page.get_by_role("button", name="Diagram").evaluate(frame) == "solid"
    assert page.get_by_role("button", name="Table").evaluate(frame) == "none"


def test_a_link_leads_past_everything_to_the_design(editor: str, page: Page) -> None:
    open_player(page, editor)
    link = page.get_by_role("link", name="Skip to the design")
    link.focus()
    expect(link).to_be_in_viewport()
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    expect(page.get_by_role("button", name="Diagram")).to_be_focused()


def test_a_page_is_dark_before_anything_has_loaded(editor: str, page: Page, console_errors: list[str]) -> None:
    page.emulate_media(color_scheme="dark")
    for kind in ("**/*.js", "**/*.css"):
        page.route(kind, lambda route: route.abort())
    page.goto(editor + PLAYER, wait_until="commit")
    page.wait_for_function("document.body !== null")
    assert page.evaluate("getComputedStyle(document.documentElement).backgroundColor") == "rgb(17, 22, 30)"
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgba(0, 0, 0, 0)"
    # The browser complains of each file that did not come, until there is another page.
    page.wait_for_load_state("load")
    page.goto("about:blank")
    console_errors.clear()


def test_chosen_colors_are_kept(editor: str, page: Page) -> None:
    page.emulate_media(color_scheme="light")
    open_player(page, editor)
    page.get_by_role("button", name="View", exact=True).click()
    page.get_by_role("menuitem", name="Theme").click()
    expect(page.locator("body.body--dark")).to_be_attached()
    page.wait_for_function("document.cookie.includes('vicode_colors=dark')")
    page.reload()
    expect(page.locator("body.body--dark")).to_be_attached()
    assert page.evaluate("getComputedStyle(document.documentElement).backgroundColor") == "rgb(17, 22, 30)"


def test_at_twice_the_size_nothing_is_out_of_reach(editor: str, page: Page) -> None:
    open_player(page, editor)
    # A window of 1366 × 768 at 200 %.
    page.set_viewport_size({"width": 683, "height": 384})
    for name in ("Save", "Generate", "Table"):
        button = page.get_by_role("button", name=name, exact=name != "Generate").first
        button.scroll_into_view_if_needed()
        expect(button).to_be_in_viewport(ratio=1)
    page.get_by_label("Description").first.scroll_into_view_if_needed()
    expect(page.get_by_label("Description").first).to_be_in_viewport()
    assert page.evaluate("document.querySelector('.shell').scrollWidth <= innerWidth")
