"""The site as a person opens it, from files: it complains of nothing, finds things, and its drawings can be moved."""

import re
from pathlib import Path
from typing import Literal

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from tests.editor.hostile_project import PAYLOADS, write_hostile_project
from vicode.cli import main
from vicode.docsite import SiteInput, build_site
from vicode.model.design import Decision, DecisionGroup, Design, Guard, State, Transition
from vicode.model.project import Project

FORWARD = Path(__file__).parents[2] / "designs" / "forward"
BEHAVIOR = FORWARD.parents[1] / "tests" / "xabsl" / "cases" / "programs" / "p1" / "agents.xabsl"

KINDS = (
    "index",
    "agents",
    "agent-forward",
    "all",
    "component-Player",
    "component-Body",
    "interface-Kicker",
    "interfaces",
    "python-Player",
    "source-Player",
    "symbols",
    "types",
)
"""A page of every kind."""


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    assert main(["docs", str(FORWARD), "--out", str(folder)]) == 0
    return folder


@pytest.fixture(scope="module")
def behavior_site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("behavior")
    assert main(["docs", str(BEHAVIOR), "--out", str(folder)]) == 0
    return folder


def test_a_link_to_a_symbol_opens_its_references(page: Page, behavior_site: Path) -> None:
    page.goto((behavior_site / "interface-act_2.html").as_uri() + "#parameter-arg_2")
    expect(page.locator("#parameter-arg_2 + tr details.references")).to_have_attribute("open", "")
    expect(page.locator("#parameter-p1 + tr details.references")).not_to_have_attribute("open", "")


def test_from_home_to_a_state(page: Page, site: Path) -> None:
    page.goto((site / "index.html").as_uri())
    page.locator(".diagram a.state", has_text="Player").click()
    expect(page.locator("h1")).to_have_text("Player")
    page.locator(".diagram a.state", has_text="WatchBall").click()
    expect(page.locator("#state-WatchBall h3")).to_be_in_viewport()
    page.locator("#state-WatchBall h3").get_by_text("Python").click()
    expect(page.locator("tr:target")).to_contain_text("_in_watch_ball")


@pytest.mark.parametrize("scheme", ["light", pytest.param("dark", marks=pytest.mark.nightly)])
def test_everybody_can_read_it(page: Page, site: Path, scheme: Literal["light", "dark"]) -> None:
    page.emulate_media(color_scheme=scheme)
    for name in KINDS:
        page.goto((site / f"{name}.html").as_uri())
        violations = Axe().run(page, options={"resultTypes": ["violations"], "preload": False}).response["violations"]
        assert not [(each["id"], node["html"][:120]) for each in violations for node in each["nodes"]], name


def test_searching_by_keys(page: Page, site: Path) -> None:
    page.goto((site / "component-Player.html").as_uri())
    page.keyboard.press("/")
    page.keyboard.type("rolls half second")
    expect(page.get_by_role("option").first).to_contain_text("WatchBall")
    page.keyboard.press("Enter")
    expect(page).to_have_url((site / "component-Player.html").as_uri() + "#state-WatchBall")
    page.keyboard.press("/")
    page.locator("#search").fill("net_bearing")
    expect(page.get_by_role("option").first).to_contain_text("output of Perception")
    page.keyboard.press("Enter")
    expect(page.locator("tr:target")).to_contain_text("net_bearing")
    page.keyboard.press("/")
    page.keyboard.type("nobody says this")
    expect(page.locator("#search-results")).to_contain_text("No results.")


def test_searching_with_typing_errors_and_parts_of_names(page: Page, site: Path) -> None:
    page.goto((site / "index.html").as_uri())
    results = page.get_by_role("option")
    for text, name in (("lokforbal", "LookForBall"), ("FOLLOW_ball", "FollowBall"), ("lfb", "LookForBall")):
        page.locator("#search").fill(text)
        expect(results.first).to_contain_text(name)
    page.locator("#search").fill("perceptoin")
    expect(page.locator("#search-results")).to_contain_text("No exact match. Similar names:")
    expect(results.first).to_contain_text("Perception")
    page.locator("#search").fill("pérCeption")
    expect(results.first.locator("mark")).to_have_text("Perception")


def test_more_results_are_counted_and_shown(page: Page, site: Path) -> None:
    page.goto((site / "index.html").as_uri())
    page.keyboard.press("/")
    page.keyboard.type("o")
    results = page.get_by_role("option")
    expect(results.last).to_have_text(re.compile(r"^30 of \d+ results. Show more$"))
    expect(page.get_by_role("status").filter(has_text="results")).to_have_text(re.compile(r"^\d+ results$"))
    page.keyboard.press("ArrowUp")
    page.keyboard.press("Enter")
    expect(page.locator("#search-result-30")).to_have_attribute("aria-selected", "true")
    assert results.count() > 40


def test_what_is_found_in_a_transition_shows_it(page: Page, site: Path) -> None:
    page.goto((site / "index.html").as_uri())
    page.keyboard.press("/")
    page.keyboard.type("net ahead AlignFront")
    found = page.get_by_role("option").first
    expect(found).to_contain_text("state of Player")
    expect(found.locator("code.about")).to_contain_text("→ AlignFront")
    expect(found.locator("mark").first).to_be_visible()
    page.locator("#search").fill("( [a .*")
    expect(page.locator("#search-results")).to_contain_text("No results.")
    page.locator("#search").fill("AlignFront")
    expect(page.get_by_role("option").first.locator("bdi mark")).to_have_text("AlignFront")


@pytest.fixture(scope="module")
def deep_site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A machine with more tests than a drawing has room for, and one whose tests are a long row."""
    folder = tmp_path_factory.mktemp("deep")
    states = (State(name="Many", transitions=nested(5, 3)), State(name="Row", transitions=nested(6, 1)))
    design = Design(component="Deep", initial="Many", states=states)
    for file in build_site(SiteInput(project=Project(name="deep", designs=(design,)))):
        (folder / file.path).write_text(file.text, "utf-8")
    return folder


def nested(depth: int, wide: int) -> tuple[Decision, ...]:
    if not depth:
        return (Transition(to="Row", guard=Guard(when="last_of_them > 3")),)
    guards = (Guard(when=f"something.seen and distance < {index}") for index in range(wide))
    return tuple(DecisionGroup(guard=guard, then=nested(depth - 1, wide)) for guard in guards)


def test_a_box_stands_for_tests_that_are_not_drawn(page: Page, deep_site: Path) -> None:
    page.goto((deep_site / "component-Deep.html").as_uri())
    expect(page.locator("#state-Many").get_by_text("does not show all conditions")).to_be_visible()
    expect(page.locator("#state-Row").get_by_text("does not show all conditions")).to_have_count(0)
    page.locator("#state-Many a.folded").nth(4).click()
    expect(page.locator("li:target")).to_be_in_viewport()
    expect(page.locator("li:target")).to_contain_text("something.seen and distance < 0")


def test_a_wide_tree_is_moved_as_a_drawing(page: Page, deep_site: Path) -> None:
    page.goto((deep_site / "component-Deep.html").as_uri())
    tree = page.locator("#state-Row .tree")
    drawing = tree.locator("svg[role=group]")
    expect(tree.get_by_role("group", name="Decision tree of Row. The pseudocode below is equivalent.")).to_be_visible()
    # It begins in its own size: letters of 12 pixels are 12 pixels high.
    scale = drawing.evaluate("(svg) => svg.getScreenCTM().a")
    assert scale == pytest.approx(1, abs=0.05)
    begun = drawing.get_attribute("viewBox")
    tree.get_by_role("button", name="Zoom to fit (0)").click()
    whole = drawing.get_attribute("viewBox")
    assert whole != begun
    expect(drawing.locator("a.target")).to_be_in_viewport()
    tree.get_by_role("button", name="Zoom in (+)").click()
    assert drawing.get_attribute("viewBox") != whole
    expect(page.locator("#state-Many .tree").get_by_role("button")).to_have_count(0)


def test_a_drawing_zooms_and_tells_what_belongs_together(page: Page, site: Path) -> None:
    page.goto((site / "component-Player.html").as_uri())
    drawing = page.locator(".diagram svg[role=group]").first
    whole = drawing.get_attribute("viewBox")
    page.locator(".viewport").first.focus()
    page.keyboard.press("+")
    assert drawing.get_attribute("viewBox") != whole
    page.keyboard.press("ArrowRight")
    page.keyboard.press("0")
    assert drawing.get_attribute("viewBox") == whole
    page.locator("a.state[data-key='s:LookForBall']").hover()
    expect(page.locator("a.state.is-highlighted", has_text="FollowBall")).to_have_count(1)
    expect(page.locator("a.state:not(.is-highlighted)", has_text="AlignFront")).to_have_count(1)


def test_a_box_of_a_large_map_is_found_with_its_neighbors(page: Page, behavior_site: Path) -> None:
    page.goto((behavior_site / "index.html").as_uri())
    drawing = page.locator(".diagram svg[role=group]")
    whole = drawing.get_attribute("viewBox")
    field = page.get_by_label("Find in diagram")
    field.press_sequentially("opt1")
    expect(drawing).to_have_class("has-highlight")
    assert drawing.get_attribute("viewBox") != whole
    found = drawing.locator("a[data-key='opt1']")
    expect(found).to_have_class("state is-highlighted")
    expect(found).to_be_in_viewport()
    assert 1 < drawing.locator("[data-key].is-highlighted").count() < drawing.locator("[data-key]").count()
    # The pointer asks for another one only as long as it is there.
    found.hover()
    page.locator("h1").hover()
    expect(found).to_have_class("state is-highlighted")
    field.fill("no such thing")
    field.press("Enter")
    expect(found).to_have_class("state is-highlighted")
    field.press("Escape")
    expect(field).to_have_value("")
    expect(drawing).not_to_have_class("has-highlight")
    assert drawing.get_attribute("viewBox") == whole


def test_a_small_drawing_needs_no_finding(page: Page, site: Path) -> None:
    page.goto((site / "component-Turn.html").as_uri())
    expect(page.get_by_role("button", name="Zoom to fit (0)").first).to_be_visible()
    expect(page.get_by_label("Find in diagram")).to_have_count(0)


def test_a_drawing_is_dragged_without_selecting_its_texts(page: Page, behavior_site: Path) -> None:
    page.goto((behavior_site / "index.html").as_uri())
    drawing = page.locator(".diagram svg[role=group]")
    whole = drawing.get_attribute("viewBox")
    box = drawing.bounding_box()
    assert box
    page.mouse.move(box["x"] + 2, box["y"] + 2)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] * 0.8, box["y"] + box["height"] * 0.8, steps=6)
    page.mouse.up()
    assert drawing.get_attribute("viewBox") != whole
    assert page.evaluate("getSelection().toString()") == ""


def test_a_decision_and_its_line_are_shown_together(page: Page, site: Path) -> None:
    page.goto((site / "source-Player.html").as_uri())
    page.locator("a[href='component-Player.html#state-SearchNet-0-then-1']").click()
    expect(page.locator("li:target")).to_contain_text("diagonal_limit")
    expect(page.locator("li:target")).to_be_in_viewport()
    tree = page.locator("#state-SearchNet .tree")
    expect(tree.locator(".condition.is-target", has_text="net ahead to a side")).to_have_count(1)
    expect(tree.locator(".target.is-target", has_text="AlignDiagonal")).to_have_count(1)
    tree.locator("a.condition", has_text="net beside").hover()
    expect(page.locator("#state-SearchNet-0-then-2")).to_have_class("depth-1 is-highlighted")
    page.locator("#state-SearchNet-1").hover()
    expect(tree.locator("a.condition.is-highlighted", has_text="no net, or behind")).to_have_count(1)
    page.locator("li:target").get_by_text("Python").click()
    expect(page.locator("tr:target")).to_contain_text("net ahead to a side")


def test_it_fits_a_telephone_and_follows_the_system(page: Page, site: Path) -> None:
    page.set_viewport_size({"width": 390, "height": 800})
    for name in KINDS:
        page.goto((site / f"{name}.html").as_uri())
        assert page.evaluate("document.documentElement.scrollWidth") <= 390, name
    light = page.evaluate("getComputedStyle(document.body).backgroundColor")
    page.emulate_media(color_scheme="dark")
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") != light


def test_the_menu_waits_to_be_opened_on_a_telephone(page: Page, site: Path) -> None:
    page.goto((site / "component-Player.html").as_uri())
    link = page.get_by_label("Pages").get_by_role("link", name="Symbols")
    expect(link).to_be_visible()
    expect(page.get_by_text("Pages", exact=True)).not_to_be_visible()
    page.set_viewport_size({"width": 390, "height": 800})
    expect(link).not_to_be_visible()
    page.get_by_text("Pages", exact=True).click()
    link.click()
    expect(page.locator("h1")).to_have_text("Symbols")


def test_on_paper_nothing_is_cut_off(page: Page, behavior_site: Path) -> None:
    page.set_viewport_size({"width": 700, "height": 990})
    page.emulate_media(media="print")
    for name in ("index", "symbols", "agents", "component-opt0", "interfaces", "types"):
        page.goto((behavior_site / f"{name}.html").as_uri())
        assert page.evaluate("document.documentElement.scrollWidth") <= 700, name
    page.goto((behavior_site / "index.html").as_uri())
    # Groups of findings are closed on the screen.
    expect(page.locator("details.finding-group:not([open]) .findings li").first).to_be_visible()
    page.emulate_media(media="screen")
    expect(page.locator("details.finding-group:not([open]) .findings li").first).not_to_be_visible()


def test_a_long_menu_shows_where_one_is(page: Page, behavior_site: Path) -> None:
    page.set_viewport_size({"width": 1366, "height": 500})
    page.goto((behavior_site / "component-opt18.html").as_uri())
    expect(page.locator(".menu [aria-current]")).to_be_in_viewport()
    assert page.evaluate("scrollY") == 0
    page.goto((behavior_site / "index.html").as_uri())
    expect(page.locator(".menu [aria-current]")).to_be_in_viewport()


def test_the_menu_is_filtered(page: Page, behavior_site: Path) -> None:
    page.goto((behavior_site / "index.html").as_uri())
    menu = page.get_by_label("Pages")
    menu.get_by_label("Filter options").fill("opt18")
    expect(menu.locator(".menu-machines a:visible")).to_have_text(["opt18"])
    expect(menu.get_by_role("status")).to_have_text("1 of 19")
    page.keyboard.press("Escape")
    expect(menu.locator(".menu-machines a:visible")).to_have_count(19)


def test_headings_have_links_and_code_is_copied(page: Page, site: Path) -> None:
    page.add_init_script("navigator.clipboard.writeText = async (text) => { window.copied = text; };")
    page.goto((site / "component-Player.html").as_uri())
    page.get_by_role("heading", name="Used by").hover()
    page.get_by_role("link", name="Link to Used by").click()
    assert page.url.endswith("#used-by")
    page.locator("figure.code").first.get_by_role("button", name="Copy").click()
    expect(page.get_by_role("button", name="Copied")).to_be_visible()
    assert page.evaluate("copied") == page.locator("figure.code code").first.text_content()
    page.goto((site / "source-Player.html").as_uri())
    page.get_by_role("button", name="Copy").click()
    expect(page.get_by_role("button", name="Copied")).to_be_visible()
    assert page.evaluate("copied") == (FORWARD / "player.yaml").read_text("utf-8")


def test_long_names_and_many_transitions_stay_on_the_page(page: Page, tmp_path: Path) -> None:
    long = "Very" * 40
    many = tuple(Transition(to=f"{long}B", guard=Guard(when=f"{long.lower()} > {limit}")) for limit in range(1000))
    states = (State(name=f"{long}A", transitions=many, doc=f"`{long}`"), State(name=f"{long}B"))
    design = Design(component=f"{long}Machine", initial=f"{long}A", states=states)
    for file in build_site(SiteInput(project=Project(name=long, designs=(design,)))):
        (tmp_path / file.path).write_text(file.text, "utf-8")
    for width in (390, 1366):
        page.set_viewport_size({"width": width, "height": 768})
        for file in (*tmp_path.glob("component-*.html"), tmp_path / "index.html"):
            page.goto(file.as_uri())
            assert page.evaluate("document.documentElement.scrollWidth") <= width, file.name


def test_fingers_find_every_link_on_a_telephone(page: Page, site: Path) -> None:
    page.set_viewport_size({"width": 390, "height": 800})
    for name in KINDS:
        page.goto((site / f"{name}.html").as_uri())
        options = {"runOnly": ["target-size"], "resultTypes": ["violations"], "preload": False}
        violations = Axe().run(page, options=options).response["violations"]
        assert not [node["html"][:120] for each in violations for node in each["nodes"]], name


@pytest.mark.parametrize("payload", ["script", "image", "drawing", "prop"])
def test_nothing_of_a_stranger_runs(page: Page, tmp_path: Path, payload: str) -> None:
    write_hostile_project(tmp_path / "evil", PAYLOADS[payload])
    main(["docs", str(tmp_path / "evil"), "--out", str(tmp_path / "site")])
    for file in sorted((tmp_path / "site").glob("*.html")):
        page.goto(file.as_uri())
        page.keyboard.press("/")
        page.keyboard.type("p")
        expect(page.get_by_role("option").first).to_be_visible()
        assert page.evaluate("window.ran") is None


def test_brackets_accents_and_repeated_names_do_not_stop_the_search(page: Page, tmp_path: Path) -> None:
    states = {name: State(name=name, doc="The pairs [a],[b].") for name in ("ΟΔΟΣ", "_".join("a" * 40))}
    project = Project(
        name="Pairs", designs=(Design(component="Lists", doc="Has [x],[y].", states=tuple(states.values())),)
    )
    for file in build_site(SiteInput(project=project)):
        (tmp_path / file.path).write_text(file.text, "utf-8")
    # An address that was cut off.
    page.goto((tmp_path / "index.html").as_uri() + "#%")
    expect(page.locator(".menu-machines")).to_contain_text("Lists")
    for text, result in (("[a],[b]", "ΟΔΟΣ"), ("οδος", "ΟΔΟΣ"), ("a" * 24 + "b", "No results.")):
        page.locator("#search").fill(text)
        expect(page.locator("#search-results")).to_contain_text(result)
