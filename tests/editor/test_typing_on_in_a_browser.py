"""What is typed into a form that the server has built anew, before the browser has heard of it."""

from pathlib import Path

import pytest
from playwright.sync_api import Page, WebSocketRoute, expect

from tests.editor.player_page import save

expect.set_options(timeout=20_000)


class SlowLine:
    """What the server says to a page can be held back; what the page says arrives at once."""

    def __init__(self, page: Page) -> None:
        self.is_held = False
        self.waiting: list[tuple[WebSocketRoute, str | bytes]] = []
        page.route_web_socket("**/*", self._connect)

    def hold(self) -> None:
        self.is_held = True

    def let_go(self) -> None:
        self.is_held = False
        for route, message in self.waiting:
            route.send(message)
        self.waiting.clear()

    def _connect(self, route: WebSocketRoute) -> None:
        server = route.connect_to_server()

        def pass_on(message: str | bytes) -> None:
            if self.is_held:
                self.waiting.append((route, message))
            else:
                route.send(message)

        server.on_message(pass_on)


@pytest.fixture
def line(page: Page) -> SlowLine:
    return SlowLine(page)


def rename_kick(page: Page, url: str, line: SlowLine) -> None:
    """Begin to type into the doc of a state that was renamed, while the browser still shows the form before."""
    page.set_viewport_size({"width": 1366, "height": 768})
    page.goto(url + "design/forward/Player?select=Kick")
    expect(page.get_by_label("State", exact=True)).to_have_value("Kick")
    expect(page.get_by_role("textbox", name="Doc")).to_have_value("Kick, with the eyes on the ball.")
    line.hold()
    page.get_by_label("State", exact=True).fill("Shoot")
    page.keyboard.press("Tab")
    expect(page.get_by_role("textbox", name="Doc")).to_be_focused()
    page.keyboard.press("End")
    page.keyboard.type(" Defend now.")


def doc_in(file: Path) -> str:
    return next(line for line in file.read_text().splitlines() if "Kick, with the eyes" in line).strip()


@pytest.mark.parametrize("way", ["to the next field", "to another panel", "saving"])
def test_what_was_left_before_the_new_form_came_is_kept(
    editor: str, page: Page, project: Path, line: SlowLine, way: str
) -> None:
    rename_kick(page, editor, line)
    match way:
        case "to the next field":
            page.keyboard.press("Tab")
        case "to another panel":
            page.get_by_role("tab", name="History").click()
        case _:
            page.keyboard.press("Control+s")
    line.let_go()
    expect(page.get_by_label("State", exact=True)).to_have_value("Shoot")
    expect(page.get_by_role("textbox", name="Doc")).to_have_value("Kick, with the eyes on the ball. Defend now.")
    file = project / "forward" / "player.yaml"
    if way != "saving":
        save(page, file)
    expect(page.get_by_text("Saved", exact=True).first).to_be_visible()
    assert doc_in(file).endswith("Defend now.")
    assert "  Shoot:" in file.read_text()


def test_who_stays_in_the_field_types_on_in_the_new_one(editor: str, page: Page, project: Path, line: SlowLine) -> None:
    rename_kick(page, editor, line)
    line.let_go()
    page.keyboard.type(" And then.")
    expect(page.get_by_role("textbox", name="Doc")).to_have_value(
        "Kick, with the eyes on the ball. Defend now. And then."
    )
    expect(page.get_by_role("textbox", name="Doc")).to_be_focused()
    expect(page.get_by_label("State", exact=True)).to_have_value("Shoot")
    file = project / "forward" / "player.yaml"
    save(page, file)
    assert doc_in(file).endswith("And then.")
