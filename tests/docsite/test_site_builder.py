"""The site of designs and of behaviors: no link leads nowhere, nothing of a stranger runs, the same bytes twice."""

import json
import re
import shutil
from pathlib import Path
from typing import Any

import pytest

from tests.docsite.link_checker import find_broken_links, find_unsafe_content, read_page, read_pages
from tests.editor.hostile_project import PAYLOADS, write_hostile_project
from vicode.cli import main
from vicode.docsite import SiteInput, build_site
from vicode.docsite.doc_text import render_doc, summarize
from vicode.docsite.site_search import search_script
from vicode.docsite.views import SiteEntry
from vicode.model.design import Call, DecisionGroup, Declaration, Design, Guard, State, Stay, Transition, Use
from vicode.model.project import Project
from vicode.output import OutputFile

ROOT = Path(__file__).parents[2]
FORWARD = ROOT / "designs" / "forward"
BEHAVIOR = ROOT / "tests" / "xabsl" / "cases" / "programs" / "p1" / "agents.xabsl"


def site_of(path: Path, out: Path) -> tuple[OutputFile, ...]:
    """The files that the command writes."""
    assert main(["docs", str(path), "--out", str(out)]) == 0
    return files_in(out)


def files_in(out: Path) -> tuple[OutputFile, ...]:
    return tuple(OutputFile(path=file.name, text=file.read_text("utf-8")) for file in sorted(out.iterdir()))


@pytest.fixture(scope="module")
def forward(tmp_path_factory: pytest.TempPathFactory) -> tuple[OutputFile, ...]:
    return site_of(FORWARD, tmp_path_factory.mktemp("forward"))


@pytest.fixture(scope="module")
def behavior(tmp_path_factory: pytest.TempPathFactory) -> tuple[OutputFile, ...]:
    return site_of(BEHAVIOR, tmp_path_factory.mktemp("behavior"))


def index_in(script: str) -> dict[str, list[Any]]:
    """What the search looks through, as the page reads it."""
    index: dict[str, list[Any]] = json.loads(script.split("window.vicodeSearchIndex = ")[1].removesuffix(";\n"))
    return index


def unpacked(row: list[Any], index: dict[str, list[Any]]) -> list[str]:
    name, kind, where, page, anchor, doc, words = [*row, *(0, "", [])[len(row) - 4 :]]
    place = f"{index['kinds'][kind]}-{name}" if anchor == 0 else anchor
    href = index["pages"][page] + (f"#{place}" if place else "")
    code = " ".join(index["pieces"][each] for each in words)
    return [name, index["kinds"][kind], index["places"][where], href, doc, code]


def page(files: tuple[OutputFile, ...], path: str) -> str:
    return next(file.text for file in files if file.path == path)


def test_no_link_of_a_project_is_broken(forward: tuple[OutputFile, ...]) -> None:
    assert not find_broken_links(forward)
    assert sum(len(read.links) for read in read_pages(forward).values()) > 1000


def test_no_link_of_a_behavior_is_broken(behavior: tuple[OutputFile, ...]) -> None:
    assert not find_broken_links(behavior)
    assert len([file for file in behavior if file.path.startswith("component-")]) == 19
    source = read_page(page(behavior, "source-opt0.html"))
    assert "option opt0 {" in source.text
    assert "component-opt0.html#state-s1" in source.links
    assert 'href="source-opt0.html#L13"' in page(behavior, "component-opt0.html")


def test_every_decision_of_a_behavior_leads_to_its_line_and_back(behavior: tuple[OutputFile, ...]) -> None:
    option = (BEHAVIOR.parent / "Options" / "opt0.xabsl").read_text("utf-8").splitlines()
    described = read_page(page(behavior, "component-opt0.html"))
    tested = [number for number, line in enumerate(option, start=1) if re.search(r"\bif\b", line)]
    assert tested
    assert {f"source-opt0.html#L{number}" for number in tested} <= set(described.links)
    back = [link for link in read_page(page(behavior, "source-opt0.html")).links if re.search(r"#(state|common)", link)]
    assert len(back) >= len(tested)
    assert {link.partition("#")[2] for link in back} <= set(described.ids)


def test_a_language_that_cannot_say_a_design_says_why(tmp_path: Path, forward: tuple[OutputFile, ...]) -> None:
    body = page(forward, "component-Body.html")
    section = body[body.index('id="languages"') : body.index('id="findings"')]
    words = " ".join(read_page(section).text.split())
    assert "XABSL cannot be generated" in words
    assert "L701" in words
    assert "XABSL options have no frequency" in words
    assert not [file.path for file in forward if file.path.startswith("xabsl-")]
    assert "python-Body.html" in read_page(section).links


def test_languages_that_the_project_did_not_ask_for_are_shown(tmp_path: Path) -> None:
    design = Design(component="Calm", initial="A", states=(State(name="A", transitions=(Transition(to="A"),)),))
    files = build_site(SiteInput(project=Project(name="p", languages=("python",), designs=(design,))))
    assert "option calm" in read_page(page(files, "xabsl-Calm.html")).text.lower()
    assert "component-Calm.html#state-A-0" in read_page(page(files, "xabsl-Calm.html")).links
    assert not find_broken_links(files)


def test_properties_without_a_column_are_badges() -> None:
    design = Design(
        component="Team",
        initial="Wait",
        parameters=(Declaration(name="speed", initial="1", doc="How fast.", tunable=True),),
        states=(State(name="Wait", final=True, capacity=2), State(name="Go", disabled=True)),
    )
    text = page(build_site(SiteInput(project=Project(name="p", designs=(design,)))), "component-Team.html")
    assert 'How fast. <span class="badge">tunable</span>' in text
    badges = [
        set(re.findall(r'<span class="badge">([^<]+)</span>', line)) for line in text.splitlines() if "<h3 " in line
    ]
    assert badges[:2] == [{"initial", "final", "capacity 2"}, {"disabled"}]


def test_an_agent_has_a_page_with_what_it_may_activate(behavior: tuple[OutputFile, ...]) -> None:
    agents = page(behavior, "agents.html")
    assert "<svg" not in agents
    links = [link for link in read_page(agents).links if link.startswith("agent-")]
    assert {file.path for file in behavior if file.path.startswith("agent-")} == set(links)
    reached = {name: set(read_page(page(behavior, name)).links) for name in links}
    assert all("data-from" in page(behavior, name) for name in links)
    assert all(any(link.startswith("component-opt") for link in found) for found in reached.values())
    assert any(f'href="{links[0]}"' in file.text for file in behavior if file.path.startswith("component-"))


def test_a_state_machine_is_shown_among_its_neighbors(forward: tuple[OutputFile, ...]) -> None:
    text = page(forward, "component-SearchBall.html")
    around = text[text.index('id="around"') : text.index('id="uses"')]
    assert 'href="component-Player.html"' in around
    assert 'href="component-Player.html#uses"' in around
    assert 'href="component-SearchBall.html"' not in around


def test_what_is_found_has_its_own_address_whatever_is_empty() -> None:
    entries = [
        SiteEntry(name="A", kind="component", context="", href="component-A.html"),
        SiteEntry(name="B", kind="state", context="A", href="component-A.html#state-B"),
        SiteEntry(name="C", kind="agent", context="p", href="agent-C.html", doc="Plays."),
        SiteEntry(name="D", kind="state", context="A", href="component-A.html#state-D-2", search_text="x > 1\ny"),
    ]
    index = index_in(search_script(entries))
    rows = [unpacked(row, index) for row in index["entries"]]
    assert [(name, kind, where, href) for name, kind, where, href, _doc, _code in rows] == [
        (each.name, each.kind, each.context or "", each.href) for each in entries
    ]
    assert [row[4:] for row in rows] == [["", ""], ["", ""], ["Plays.", ""], ["", "x > 1 y"]]


@pytest.mark.parametrize("name", ["forward", "behavior"])
def test_no_place_of_a_page_has_two_things(name: str, request: pytest.FixtureRequest) -> None:
    pages = read_pages(request.getfixturevalue(name))
    doubled = [f"{path}#{id_}" for path, read in pages.items() for id_, count in read.ids.items() if count > 1]
    assert not doubled


def test_every_thing_is_found(forward: tuple[OutputFile, ...]) -> None:
    script = page(forward, "search.js")
    rows = [unpacked(row, index_in(script)) for row in index_in(script)["entries"]]
    found = {(name, kind, where) for name, kind, where, *_rest in rows}
    assert ("Kick", "state", "Player") in found
    assert ("Kick", "type", "Forward") in found
    assert ("net_bearing", "output", "Perception") in found
    words = next(row[5] for row in rows if row[:3] == ["Kick", "state", "Player"])
    assert "log.info" in words
    pages = read_pages(forward)
    assert all(row[3].partition("#")[2] in {"", *pages[row[3].partition("#")[0]].ids} for row in rows)


def test_a_state_says_what_it_does(forward: tuple[OutputFile, ...]) -> None:
    text = page(forward, "component-Player.html")
    section = text[text.index('id="state-Kick"') : text.index('id="state-WatchBall"')]
    words = " ".join(read_page(section).text.split())
    for expected in (
        "Kick, with the eyes on the ball.",
        "AlignFront (1), AlignDiagonal (1), AlignLateral (1)",
        "Requires",
        "kicks = kicks + 1",
        "log.info(",
        "kicker(kick=kick, side=side)",
        "if not kicker.busy and after 0.5 s kicked go to WatchBall else stay",
    ):
        assert expected in words
    for address in (
        "interface-Kicker.html#output-busy",
        "interface-Kicker.html#parameter-kick",
        "source-Player.html#L",
        "python-Player.html#L",
    ):
        assert f'href="{address}' in section


def test_a_component_shows_its_own_code_and_links_its_files(forward: tuple[OutputFile, ...]) -> None:
    text = page(forward, "component-Player.html")
    assert "getLogger" in read_page(text[text.index(">Custom code</h2>") :]).text
    assert '<a href="source-Player.html" title="player.yaml">Source</a>' in text


def test_lines_of_code_lead_back(forward: tuple[OutputFile, ...]) -> None:
    for path in ("python-Player.html", "source-Player.html"):
        links = read_page(page(forward, path)).links
        assert "component-Player.html#state-Kick" in links
        assert "component-Player.html#state-WatchBall-1" in links


def test_drawings_have_no_colors_of_their_own(forward: tuple[OutputFile, ...]) -> None:
    text = page(forward, "component-Player.html")
    drawing = text[text.index("<svg") : text.index("</svg>")]
    assert re.findall(r'(?:fill|stroke)="(?!none|var\(--drawn-)[^"]*"', drawing) == []
    assert 'href="#state-Kick"' in drawing
    assert 'href="#state-SearchNet-0-then-1"' in drawing


@pytest.mark.parametrize("payload", sorted(PAYLOADS))
def test_nothing_of_a_stranger_runs(payload: str, tmp_path: Path) -> None:
    write_hostile_project(tmp_path / "evil", PAYLOADS[payload])
    main(["docs", str(tmp_path / "evil"), "--out", str(tmp_path / "site")])
    files = files_in(tmp_path / "site")
    assert not find_unsafe_content(files)
    assert not find_broken_links(files)
    assert PAYLOADS[payload].split()[0] in read_page(page(files, "component-Player.html")).text


def test_names_of_a_stranger_are_only_names() -> None:
    evil = '"><script>alert(1)</script>'
    design = Design(
        component=evil,
        uses=(Use(alias=evil, component=evil), Use(alias="b", component="gone")),
        parameters=(Declaration(name=evil, type=evil, unit=evil, doc=evil),),
        initial=evil,
        states=(
            State(
                name=evil,
                doc=evil,
                requires=(evil, "nobody"),
                modulates=(Call(alias=evil, arguments=((evil, evil),)),),
                transitions=(
                    Transition(to=evil, guard=Guard(when=evil), doc=evil),
                    DecisionGroup(guard=Guard(when="a"), then=(Stay(),), otherwise=(Transition(to="nowhere"),)),
                ),
            ),
        ),
    )
    files = build_site(SiteInput(project=Project(name=evil, doc=evil, languages=(), designs=(design,))))
    assert not find_unsafe_content(files)
    assert not find_broken_links(files)


def test_names_that_differ_in_case_alone_keep_their_pages() -> None:
    designs = tuple(Design(component=name, states=(State(name="A"),)) for name in ("Walk", "walk"))
    files = build_site(SiteInput(project=Project(name="p", languages=(), designs=designs)))
    paths = [file.path.casefold() for file in files]
    assert len(paths) == len(set(paths))
    assert len([path for path in paths if path.startswith("component-")]) == 2


def test_the_same_project_gives_the_same_bytes(forward: tuple[OutputFile, ...], tmp_path: Path) -> None:
    assert site_of(FORWARD, tmp_path / "again") == forward


def test_docs_are_markdown_without_danger() -> None:
    html = render_doc("# Title\n\n*soft* [evil](javascript:x) [page](gone.html) ![p](http://x/y.png) <b>x</b>\n\n- `a`")
    assert "<h2>Title</h2>" in html
    inner = render_doc("## One\n\n### Two\n\n###### Last", parent_level=3)
    assert [inner.count(f"<h{level}>") for level in (4, 5, 6)] == [1, 1, 1]
    assert "<em>soft</em>" in html
    assert "<li>" in html
    assert re.findall(r'href="([^"]*)"', html) == ["http://x/y.png"]
    assert "<img" not in html
    assert "<b>" not in html
    assert '<a href="https://example.org">w</a>' in render_doc("[w](https://example.org)")
    assert summarize("Looks around. Then it goes.\n\nMore.") == "Looks around."
    assert summarize("Reads `a_b` of *one* [site](https://example.org)\nor <i>two</i>.") == (
        "Reads a_b of one site or <i>two</i>."
    )


def test_a_second_run_changes_only_what_is_new(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    count = len(site_of(FORWARD, tmp_path))
    (tmp_path / "component-Gone.html").write_text((tmp_path / "index.html").read_text("utf-8"))
    (tmp_path / "mine.html").write_text("<p>mine")
    capsys.readouterr()
    site_of(FORWARD, tmp_path)
    assert f"{count} files, 1 changed" in capsys.readouterr().out
    assert not (tmp_path / "component-Gone.html").exists()
    assert (tmp_path / "mine.html").exists()


def test_pages_of_others_are_not_written_over(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "index.html").write_text("<p>mine")
    assert main(["docs", str(FORWARD), "--out", str(tmp_path)]) == 2
    assert "was not written by vicode docs" in capsys.readouterr().err
    assert [file.name for file in tmp_path.iterdir()] == ["index.html"]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("vicode.md", "# How to use vicode\n\n    vicode docs designs --out site\n"),
        ("start.md", "# vicode docs: how it is used\n"),
        ("talk.html", "<!doctype html>\n<p>vicode docs"),
        ("style.css", "/* the look of what vicode docs writes */\n"),
        ("mkdocs.yml", "# vicode docs: see INHERIT\nINHERIT: nav.yml\n"),
    ],
)
@pytest.mark.parametrize("form", ["html", "markdown"])
def test_pages_of_others_that_speak_of_us_stay(form: str, name: str, text: str, tmp_path: Path) -> None:
    command = ["docs", str(FORWARD), "--format", form, "--out", str(tmp_path)]
    # Only Markdown is written beside files of others from the start.
    assert form == "markdown" or main(command) == 0
    (tmp_path / name).write_text(text, "utf-8")
    assert main(command) == 0
    assert (tmp_path / name).read_text("utf-8") == text


def test_a_folder_holds_one_format_and_line_ends_of_git_do_not_matter(tmp_path: Path) -> None:
    once, again = tmp_path / "once", tmp_path / "again"
    assert main(["docs", str(FORWARD), "--format", "markdown", "--out", str(once)]) == 0
    for form in ("markdown", "html", "markdown"):
        assert main(["docs", str(FORWARD), "--format", form, "--out", str(again)]) == 0
        for file in again.iterdir():
            file.write_bytes(file.read_bytes().replace(b"\n", b"\r\n"))
    assert main(["docs", str(FORWARD), "--format", "markdown", "--out", str(again)]) == 0
    assert {file.name: file.read_bytes() for file in again.iterdir()} == {
        file.name: file.read_bytes() for file in once.iterdir()
    }


def test_strict_fails_on_findings(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["docs", str(BEHAVIOR), "--out", str(tmp_path), "--strict"]) == 1
    assert (tmp_path / "index.html").exists()
    assert "warnings" in capsys.readouterr().out


def test_a_behavior_with_errors_gives_no_site(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "agents.xabsl"
    file.write_text('agent a("A", nobody);\n')
    assert main(["docs", str(file), "--out", str(tmp_path / "site")]) == 1
    assert "nobody" in capsys.readouterr().err
    assert not (tmp_path / "site").exists()


def test_a_site_stays_where_nothing_can_be_read_any_more(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    design, out = tmp_path / "Blink.yaml", tmp_path / "site"
    design.write_bytes((ROOT / "designs" / "blink" / "blink.yaml").read_bytes())
    before = site_of(design, out)
    design.write_text(design.read_text("utf-8") + "  broken: [\n", "utf-8")
    capsys.readouterr()
    assert main(["docs", str(design), "--out", str(out)]) == 1
    said = capsys.readouterr()
    assert "error Y101" in said.err
    assert said.out == ""
    assert files_in(out) == before


def test_a_mistake_is_told_with_the_file_that_it_is_in(tmp_path: Path) -> None:
    project, out = tmp_path / "Forward", tmp_path / "site"
    shutil.copytree(FORWARD, project)
    with (project / "turn.yaml").open("a", encoding="utf-8") as file:
        file.write("  broken: [\n")
    assert main(["docs", str(project), "--out", str(out)]) == 1
    home = read_page((out / "index.html").read_text("utf-8"))
    text = " ".join(home.text.split())
    assert "turn.yaml:14" in text
    assert "project.yaml:14" not in text
    assert "2 findings" in text
    assert "1 agent " in text
    assert "#findings" in home.links


def test_a_site_without_findings_does_not_count_them(tmp_path: Path) -> None:
    site_of(FORWARD, tmp_path)
    assert "#findings" not in read_page((tmp_path / "index.html").read_text("utf-8")).links


@pytest.mark.parametrize(("said", "shown"), [("", "s"), ("time_unit: s\n", "s"), ("time_unit: ms\n", "ms")])
def test_times_have_the_unit_of_their_design(said: str, shown: str, tmp_path: Path) -> None:
    text = (ROOT / "designs" / "blink" / "blink.yaml").read_text("utf-8").replace("after: 1", "after: 4321")
    (tmp_path / "blink.yaml").write_text(text.replace("initial:", f"{said}initial:"), "utf-8")
    site_of(tmp_path / "blink.yaml", tmp_path / "site")
    page = re.sub("<[^>]*>", " ", (tmp_path / "site" / "component-Blink.html").read_text("utf-8"))
    times = re.findall(r"4321\s+(\w+)", page)
    # In the table, the pseudo code, on an arrow and in a tree, for each of two transitions.
    assert len(times) >= 8
    assert set(times) == {shown}
