"""Frames are drawn around states, renamed, dragged with their states, deleted, and kept in the file."""

from pathlib import Path

from playwright.sync_api import Page, expect

from tests.editor.player_page import center_of, open_player, save, select_state, state


def test_a_frame_is_made_renamed_dragged_and_deleted(editor: str, page: Page, project: Path) -> None:
    open_player(page, editor)
    select_state(page, "LookForBall")
    state(page, "FollowBall").click(modifiers=["Shift"])
    page.keyboard.press("g")
    page.keyboard.type("Find it")
    page.keyboard.press("Enter")
    frame = page.locator('g[data-kind="frame"]')
    expect(frame).to_have_attribute("aria-label", "Frame Find it: LookForBall, FollowBall")
    expect(page.get_by_label("Title", exact=True)).to_have_value("Find it")
    expect(frame).to_have_class("item frame selected")
    # The frame shows who belongs to it.
    members = page.locator('g[data-kind="state"].member')
    assert set(members.evaluate_all("all => all.map((each) => each.dataset.id)")) == {"LookForBall", "FollowBall"}
    title = frame.locator(".handle-bar").bounding_box()
    assert title is not None
    grip = (title["x"] + title["width"] * 0.6, title["y"] + title["height"] / 2)
    page.mouse.dblclick(*grip)
    page.keyboard.type("Find the ball")
    page.keyboard.press("Enter")
    expect(page.get_by_label("Title", exact=True)).to_have_value("Find the ball")
    before = [center_of(page, name) for name in ("LookForBall", "FollowBall", "SearchNet")]
    page.mouse.move(*grip)
    page.mouse.down()
    page.mouse.move(grip[0] - 5, grip[1] + 60, steps=4)
    page.mouse.up()
    after = [center_of(page, name) for name in ("LookForBall", "FollowBall", "SearchNet")]
    assert [old != new for old, new in zip(before, after, strict=True)] == [True, True, False]
    assert "frames:\n  Find the ball: [LookForBall, FollowBall]\n" in save(page, project / "forward" / "player.yaml")
    expect(members).to_have_count(2)
    page.keyboard.press("Delete")
    expect(members).to_have_count(0)
    expect(frame).to_have_count(0)
    expect(state(page, "LookForBall")).to_be_visible()
    page.keyboard.press("Control+z")
    expect(frame).to_have_count(1)


def test_frame_states_takes_the_states_of_a_rectangle(editor: str, page: Page) -> None:
    open_player(page, editor)
    stage = page.locator("main.design-view").bounding_box()
    assert stage is not None
    first, last = center_of(page, "AlignFront"), center_of(page, "AlignLateral")
    page.mouse.click(stage["x"] + 30, stage["y"] + stage["height"] - 40, button="right")
    page.get_by_role("menuitem", name="Frame states…").click()
    page.mouse.move(last[0], first[1])
    page.mouse.down()
    page.mouse.move(first[0], last[1], steps=4)
    page.mouse.up()
    page.keyboard.press("Enter")
    expect(page.locator('g[data-kind="frame"]')).to_have_attribute(
        "aria-label", "Frame Frame: AlignFront, AlignDiagonal, AlignLateral"
    )
