"""The History panel compares the open design with a revision in git."""

from pathlib import Path

from playwright.sync_api import Page, expect

from tests.cli.git_folder import commit, init
from tests.editor.player_page import open_player


def test_the_design_is_compared_with_a_revision(editor: str, page: Page, project: Path) -> None:
    file = project / "forward" / "player.yaml"
    init(project)
    file.write_text(file.read_text().replace("initial: LookForBall", "initial: FollowBall"))
    commit(project, "follow first")
    open_player(page, editor)
    page.get_by_role("tab", name="History").click()
    page.get_by_role("button", name="Compare with git revision").click()
    rows = page.get_by_role("group", name="Revisions").get_by_role("button")
    expect(rows).to_have_count(2)
    expect(page.get_by_text("No changes since this revision")).to_be_visible()
    rows.last.click()
    expect(page.get_by_text("~ initial state: LookForBall → FollowBall")).to_be_visible()
    expect(page.locator(".revision-picture svg")).to_be_visible()
