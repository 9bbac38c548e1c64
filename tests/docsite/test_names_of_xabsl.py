"""A site of a behavior in XABSL shows the names, operators and calls of its sources, with all places that use them."""

import json
import re
from pathlib import Path

import pytest

from tests.docsite.link_checker import find_broken_links, read_page
from tests.importers.differential_harness import import_checked
from tests.xabsl.xabsl_cases import load_texts
from vicode.cli import main
from vicode.docsite import SiteInput, build_site
from vicode.output import OutputFile

BEHAVIOR = Path(__file__).parent / "team_behavior" / "agents.xabsl"


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The site of the files of XABSL."""
    folder = tmp_path_factory.mktemp("site")
    assert main(["docs", str(BEHAVIOR), "--out", str(folder)]) == 0
    return folder


@pytest.fixture(scope="module")
def imported_site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The site of the designs that were imported from them."""
    project, folder = tmp_path_factory.mktemp("project"), tmp_path_factory.mktemp("imported")
    assert main(["import", str(BEHAVIOR), "--out", str(project)]) == 0
    assert main(["docs", str(project), "--out", str(folder)]) == 0
    return folder


def words_of(site: Path, page: str) -> str:
    return " ".join(read_page((site / page).read_text()).text.split())


@pytest.mark.parametrize("name", ["site", "imported_site"])
def test_expressions_are_those_of_the_sources(name: str, request: pytest.FixtureRequest) -> None:
    site = request.getfixturevalue(name)
    words = words_of(site, "component-play_soccer.html")
    assert "if !ball.known && state_time >= 4000 goto search" in words
    assert "if ball.distance < near && (ball.where == left || ball.where == right) goto shoot.now" in words
    assert "if action_done goto go" in words
    assert "head.control_mode = around" in words
    assert "approach(speed = 80)" in words
    assert "ball_symbols" not in words.partition("Transitions")[2].partition("Neighbors")[0]
    walk = words_of(site, "component-approach.html")
    assert "speed = ball.where == _none ? 20 : @speed)" in walk
    assert "@speedfloat" in walk


def test_nested_conditions_are_joined_as_in_xabsl() -> None:
    texts = {
        "agents.xabsl": 'include "n.xabsl"; include "o.xabsl"; agent a("A", o);',
        "n.xabsl": 'namespace n("N") { bool input x; bool input y; bool input z; }',
        "o.xabsl": """option o {
            initial state s { decision { if (x || y) { if (z) goto t; else stay; } else stay; } action { } }
            state t { decision { stay; } action { } } }""",
    }
    project = import_checked(load_texts(texts))[0].project
    page = next(each.text for each in build_site(SiteInput(project=project)) if each.path == "component-o.html")
    row = re.search(r'<td class="condition".*?</td>', page, re.DOTALL)
    assert row
    assert read_page(row[0]).text == "(x || y) && z"


def test_diagrams_have_the_names_of_the_sources(site: Path) -> None:
    text = (site / "component-play_soccer.html").read_text()
    drawing = text[text.index("<svg") : text.index("</svg>")]
    assert ">shoot.now<" in drawing
    assert ">shoot_now<" not in drawing
    assert 'href="#state-shoot_now"' in drawing
    assert "ball.known" in drawing


def test_an_element_leads_to_the_type_of_the_name_before_it(site: Path) -> None:
    wait = (site / "component-approach.html").read_text()
    assert 'href="types.html#enum-motion_kind-stand"' in wait
    assert 'href="types.html#enum-head_mode-stand"' not in wait
    assert 'href="types.html#enum-head_mode-stand"' in (site / "component-play_soccer.html").read_text()


def test_symbols_have_the_names_of_the_sources(site: Path) -> None:
    assert "ball.radius" in words_of(site, "symbols.html")
    assert "ball_radius" not in words_of(site, "symbols.html")
    assert "ball.side" in words_of(site, "types.html")
    assert "_none" in words_of(site, "types.html")


def test_a_symbol_names_the_places_that_read_and_set_it(site: Path) -> None:
    words = words_of(site, "interface-ball_symbols.html")
    assert "Read in 2 places approach › walk 7 12" in words
    motion = words_of(site, "interface-motion_symbols.html")
    assert "stand: approach › wait 21; play_soccer › search 33; shoot › done 14" in motion
    text = (site / "interface-motion_symbols.html").read_text()
    assert 'href="component-play_soccer.html#state-search"' in text
    assert 'href="source-play_soccer.html#L33"' in text


def test_an_element_and_a_parameter_name_their_places(site: Path) -> None:
    assert "aroundUsed in 3 places" in words_of(site, "types.html")
    assert "Set in 1 place play_soccer › go = 80 13" in words_of(site, "component-approach.html")
    assert "mm" in words_of(site, "interface-go_to_point.html")


def test_an_option_names_its_users_and_agents(site: Path) -> None:
    words = words_of(site, "component-shoot.html")
    assert "Activated by Field Player, Kick Tester" in words
    assert "play_soccershoot.now 24" in words
    assert "Options/Skills/shoot.xabsl:1" in words
    assert "Activated by Field Player" in words_of(site, "interface-go_to_point.html")


def test_a_state_says_how_it_is_entered_and_left(site: Path) -> None:
    text = (site / "component-approach.html").read_text()
    words = " ".join(read_page(text[text.index('id="state-wait"') :]).text.split())
    assert "Entered fromwalk (1)" in words
    assert "Leads towalk (1)" in words
    assert "Lasts at most700 ms" in words


@pytest.mark.parametrize("name", ["site", "imported_site"])
def test_all_links_lead_somewhere(name: str, request: pytest.FixtureRequest) -> None:
    site = request.getfixturevalue(name)
    assert not find_broken_links(
        tuple(OutputFile(path=each.name, text=each.read_text()) for each in sorted(site.iterdir()) if each.is_file())
    )


def search_rows(site: Path) -> list[list[object]]:
    text = (site / "search.js").read_text()
    rows: list[list[object]] = json.loads(text[text.index("= ") + 2 : text.rindex(";")])["entries"]
    return rows


def test_the_search_knows_the_names_of_the_team(site: Path) -> None:
    names = {str(row[0]) for row in search_rows(site)}
    assert {"ball.radius", "Field Player", "shoot.now", "head.control_mode", "@speed", "motion.kind"} <= names
    text = (site / "search.js").read_text()
    for words in (
        "ball_radius",
        "field_player",
        "motion.type = walk",
        "state_time >= 700 ms → walk",
        "state_time > 3000 ms → go",
    ):
        assert f'"{words}"' in text
