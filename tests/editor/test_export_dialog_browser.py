"""Taking the drawing out: looked at, downloaded in every form, copied as text."""

import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.editor.player_page import open_player, select_state
from vicode.cli.entry_point import main


def ask(page: Page) -> Locator:
    page.keyboard.press("Control+Shift+E")
    dialog = page.get_by_role("dialog", name="Export Player")
    expect(dialog).to_be_visible()
    return dialog


def choose(page: Page, dialog: Locator, label: str, option: str) -> None:
    dialog.get_by_label(label).click()
    page.get_by_role("option", name=option).click()


def download(page: Page, dialog: Locator) -> tuple[str, bytes]:
    with page.expect_download() as found:
        dialog.get_by_role("button", name="Download").click()
    path = found.value.path()
    return found.value.suggested_filename, Path(path).read_bytes()


def test_a_picture_is_looked_at_and_downloaded(editor: str, page: Page) -> None:
    open_player(page, editor)
    dialog = ask(page)
    expect(dialog.get_by_role("img", name="Preview of the exported diagram")).to_have_js_property(
        "complete", value=True
    )
    name, svg = download(page, dialog)
    assert name == "player.svg"
    texts = {element.text for element in ElementTree.fromstring(svg).iter() if element.tag.endswith("}text")}
    assert {"Kick", "LookForBall", "perception"} <= texts
    dialog.get_by_text("Used components").click()
    choose(page, dialog, "Format", "PDF")
    name, pdf = download(page, dialog)
    assert (name, pdf[:5]) == ("player.pdf", b"%PDF-")


def test_what_is_selected_is_taken_out_alone_as_it_is_now(editor: str, page: Page) -> None:
    open_player(page, editor)
    select_state(page, "Kick")
    page.get_by_label("State", exact=True).fill("Shoot")
    page.get_by_label("State", exact=True).press("Enter")
    expect(page.get_by_text("Unsaved changes")).to_be_visible()
    dialog = ask(page)
    choose(page, dialog, "Format", "Mermaid")
    expect(dialog.get_by_label("Preview")).to_contain_text("Shoot")
    expect(dialog.get_by_label("Preview")).not_to_contain_text("LookForBall")
    choose(page, dialog, "Scope", "Whole diagram")
    expect(dialog.get_by_label("Preview")).to_contain_text("LookForBall --> FollowBall")


def test_a_text_is_copied_from_the_palette(editor: str, page: Page) -> None:
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    open_player(page, editor)
    page.keyboard.press("Control+k")
    page.keyboard.type("copy as plantuml")
    page.keyboard.press("Enter")
    expect(page.get_by_text("Copied Player as PlantUML")).to_be_visible()
    text = page.evaluate("navigator.clipboard.readText()")
    assert text.startswith("@startuml")
    assert "[*] --> LookForBall" in text


def test_what_the_browser_does_not_allow_is_told(editor: str, page: Page) -> None:
    page.add_init_script("navigator.clipboard.writeText = () => Promise.reject(new Error('not allowed'))")
    open_player(page, editor)
    page.keyboard.press("Control+k")
    page.keyboard.type("copy as plantuml")
    page.keyboard.press("Enter")
    expect(page.get_by_text("Clipboard access denied")).to_be_visible()


def test_the_dialog_has_the_formats_of_the_command_line(
    editor: str, page: Page, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit):
        main(["export", "--help"])
    found = re.search(r"--format \{([a-z,]+)\}", capsys.readouterr().out)
    assert found is not None
    open_player(page, editor)
    dialog = ask(page)
    dialog.get_by_label("Format").click()
    expect(page.get_by_role("option").first).to_be_visible()
    offered = [text.split()[0].lower() for text in page.get_by_role("option").all_inner_texts()]
    assert offered == found[1].split(",")


def test_scxml_says_what_it_cannot_express_and_writes_what_it_can(editor: str, page: Page) -> None:
    open_player(page, editor)
    dialog = ask(page)
    choose(page, dialog, "Format", "SCXML")
    expect(dialog.get_by_label("Preview")).to_contain_text("SCXML has no counterpart of frequency")
    dialog.get_by_role("button", name="Download").click()
    expect(page.get_by_role("alert").filter(has_text="SCXML has no counterpart of frequency")).to_be_visible()
