"""Questions of a team member, and the way to their answers: one search and clicks."""

import re
from dataclasses import dataclass
from pathlib import Path

from playwright.sync_api import Page, expect


@dataclass(frozen=True, slots=True, kw_only=True)
class Question:
    """A question with the way to its answer.

    Attributes:
        search: The words to search for; the first result is opened.
        clicks: CSS selectors of what is clicked then.
        answer: The CSS selector of the element with the answer.
        words: The answer.
    """

    text: str
    search: str
    clicks: tuple[str, ...] = ()
    answer: str
    words: str


def follow(page: Page, site: Path, question: Question) -> None:
    """Find the answer from the home page; it must be in view at the end.

    Raises:
        AssertionError: The way does not lead to the answer.
    """
    page.goto((site / "index.html").as_uri())
    page.keyboard.press("/")
    page.locator("#search").fill(question.search)
    expect(page.get_by_role("option").first).to_be_visible()
    page.keyboard.press("Enter")
    for each in question.clicks:
        page.locator(each).first.click()
    answer = page.locator(question.answer).first
    words = re.compile(r"\s+".join(map(re.escape, question.words.split())))
    expect(answer).to_contain_text(words, use_inner_text=True)
    expect(answer).to_be_in_viewport()
