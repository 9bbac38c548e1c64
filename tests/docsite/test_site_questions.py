"""Ten questions of a team member are answered by one search by the names of the team, and at most two clicks.

The questions about NaoTHSoccer need its sources: set VICODE_NAOTH to the path of its agents.xabsl.
"""

import os
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.docsite.site_questions import Question, follow
from vicode.cli import main

TEAM = Path(__file__).parent / "team_behavior" / "agents.xabsl"
NAOTH = os.environ.get("VICODE_NAOTH", "")

QUESTIONS = (
    Question(
        text="When does this state leave?",
        search="shoot.now",
        answer="#state-shoot_now dl",
        words="Leads to go (1, 2)",
    ),
    Question(
        text="Who sets this symbol?",
        search="kicks.count",
        answer="tr:target + tr",
        words="Set in 1 place shoot › kick = kicks.count + 1 9",
    ),
    Question(
        text="Who reads this symbol?",
        search="ball.radius",
        answer="tr:target + tr",
        words="Read in 2 places approach › walk 7 12",
    ),
    Question(
        text="Where is this option used?",
        search="head_control",
        clicks=(".toc a[href='#used-by']",),
        answer="#used-by + .table",
        words="play_soccer search 35",
    ),
    Question(
        text="Which agents activate it?",
        search="shoot",
        answer="p.agents",
        words="Activated by Field Player, Kick Tester",
    ),
    Question(
        text="What does this parameter of a basic skill mean, and what is its unit?",
        search="go_to_point speed",
        answer="tr:target",
        words="speed float % 0 … 100 walking speed in percent",
    ),
    Question(
        text="Which states set this symbol to this value?",
        search="motion.type",
        answer="tr:target + tr",
        words="stand: approach › wait 21; play_soccer › search 33; shoot › done 14",
    ),
    Question(
        text="Where is this element used?",
        search="around",
        answer="tr:target",
        words="Used in 3 places head_control › look 4, turn 11 play_soccer › search 34",
    ),
    Question(
        text="How long does this state last at most?",
        search="approach wait",
        answer="#state-wait dl",
        words="Lasts at most 700 ms",
    ),
    Question(
        text="From which file and line does this option come?",
        search="approach",
        clicks=(".facts a",),
        answer="tr:target",
        words="1 /** Walks to the ball */",
    ),
)

NAOTH_QUESTIONS = (
    Question(
        text="When does this state leave?",
        search="fall_down_and_stand_up falling",
        answer="#state-falling dl",
        words="Leads to wait_before_stand_up (1), stand_up (2)",
    ),
    Question(
        text="Who sets this symbol?",
        search="body.ready_to_walk",
        answer="tr:target + tr",
        words="fall_down_and_stand_up › falling",
    ),
    Question(text="Who reads this symbol?", search="ball.radius", answer="tr:target + tr", words="Read in"),
    Question(
        text="Where is this option used?",
        search="arms_control",
        clicks=(".toc a[href='#used-by']",),
        answer="#used-by + .table",
        words="roles_spl_play_soccer start 10",
    ),
    Question(
        text="Which agents activate it?",
        search="go_to_point",
        answer="p.agents",
        words="Activated by Cool Soccer Agent, Role SPL Soccer, go_to_point_with_USOA_test_agent",
    ),
    Question(
        text="What does this parameter mean, and what is its unit?",
        search="go_to_point @rot",
        answer="tr:target",
        words="@rot float absolute rotation on field",
    ),
    Question(
        text="Which states set this symbol to this value?",
        search="motion.type",
        clicks=("tr:target + tr li summary:has-text('falling')",),
        answer="tr:target + tr li:has-text('falling')",
        words="falling 2 places fall_down_and_stand_up › falling 41",
    ),
    Question(
        text="Where is this element used?",
        search="head.control_mode search_for_ball_and_look_around",
        answer="tr:target",
        words="Used in",
    ),
    Question(
        text="How long does this state last at most?",
        search="fall_down_and_stand_up falling",
        answer="#state-falling dl",
        words="Lasts at most 2000 ms",
    ),
    Question(
        text="From which file and line does this option come?",
        search="role_goalie",
        clicks=(".facts a",),
        answer="tr:target",
        words="option role_goalie",
    ),
)


@pytest.fixture(scope="module")
def team_site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("team")
    assert main(["docs", str(TEAM), "--out", str(folder)]) == 0
    return folder


@pytest.fixture(scope="module")
def naoth_site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("naoth")
    assert main(["docs", NAOTH, "--out", str(folder)]) == 0
    return folder


@pytest.mark.parametrize("question", QUESTIONS, ids=lambda each: each.text)
def test_a_question_is_answered(page: Page, team_site: Path, question: Question) -> None:
    page.set_viewport_size({"width": 1366, "height": 768})
    assert len(question.clicks) <= 2
    follow(page, team_site, question)


def test_code_with_the_whole_phrase_is_first(page: Page, team_site: Path) -> None:
    page.goto((team_site / "index.html").as_uri())
    page.locator("#search").fill("head.control_mode = around")
    expect(page.get_by_role("option").first).to_contain_text("state of play_soccer")


if NAOTH:

    @pytest.mark.parametrize("question", NAOTH_QUESTIONS, ids=lambda each: each.text)
    def test_a_question_about_naoth_is_answered(page: Page, naoth_site: Path, question: Question) -> None:
        page.set_viewport_size({"width": 1366, "height": 768})
        assert len(question.clicks) <= 2
        follow(page, naoth_site, question)
