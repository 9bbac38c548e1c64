"""The Markdown of a site, read by a parser: links and headings hold, and strangers' words stay words."""

import re
from html import unescape
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from markdown_it import MarkdownIt
from markdown_it.token import Token

from tests.editor.hostile_project import PAYLOADS, write_hostile_project
from vicode.cli import main
from vicode.docsite.doc_text import render_doc
from vicode.docsite.markdown_text import (
    escape_text,
    fence,
    inline_code,
    inline_expression,
    markdown_from_html,
    markdown_href,
)
from vicode.docsite.views import TextSpan
from vicode.templating import template_files

ROOT = Path(__file__).parents[2]
FORWARD = ROOT / "designs" / "forward"
BEHAVIOR = ROOT / "tests" / "xabsl" / "cases" / "programs" / "p1" / "agents.xabsl"
READER = MarkdownIt("commonmark").enable("table")
FORMAT = ("--format", "markdown", "--out")
OUR_HTML = re.compile(r'<!-- vicode docs -->|<a id="[A-Za-z0-9_-]+">|</a>|</?code>|<br>')

LINES = st.text(st.characters(codec="utf-8", exclude_categories=("Cs", "Cc")), max_size=40)


def markdown_of(path: Path, out: Path) -> dict[str, str]:
    """The files that the command writes."""
    main(["docs", str(path), "--format", "markdown", "--out", str(out)])
    return {file.name: file.read_text("utf-8") for file in sorted(out.iterdir())}


@pytest.fixture(scope="module")
def forward(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    return markdown_of(FORWARD, tmp_path_factory.mktemp("forward"))


@pytest.fixture(scope="module")
def behavior(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    return markdown_of(BEHAVIOR, tmp_path_factory.mktemp("behavior"))


def tokens_of(text: str) -> list[Token]:
    """All tokens, those in lines as well."""
    return [inner for token in READER.parse(text) for inner in (token, *(token.children or ()))]


def headings_of(text: str) -> list[tuple[str, str]]:
    """Level and text of each heading."""
    tokens = READER.parse(text)
    return [
        (token.tag, "".join(each.content for each in tokens[at + 1].children or ()))
        for at, token in enumerate(tokens)
        if token.type == "heading_open"
    ]


def faults_of(files: dict[str, str]) -> list[str]:
    """Addresses that lead nowhere, strange HTML, pages without one title."""
    pages = {name: tokens_of(text) for name, text in files.items() if name.endswith(".md")}
    ids = {name: re.findall(r'<a id="([^"]+)">', files[name]) for name in pages}
    faults = []
    for name, tokens in pages.items():
        levels = [int(token.tag[1]) for token in tokens if token.type == "heading_open"]
        if levels.count(1) != 1 or levels[0] != 1 or any(b > a + 1 for a, b in pairwise(levels)):
            faults.append(f"{name}: headings {levels}")
        if len(ids[name]) != len(set(ids[name])):
            faults.append(f"{name}: an anchor twice")
        for token in tokens:
            if token.type in ("html_inline", "html_block") and OUR_HTML.sub("", token.content).strip():
                faults.append(f"{name}: {token.content}")
            target = str(token.attrGet("href") or token.attrGet("src") or "")
            if target and not target.startswith("https://"):
                file, _, place = target.partition("#")
                file = file or name
                if file not in files or (place and place not in ids[file]):
                    faults.append(f"{name}: {target}")
    return faults


@pytest.mark.parametrize("name", ["forward", "behavior"])
def test_links_and_headings_hold(name: str, request: pytest.FixtureRequest) -> None:
    files = request.getfixturevalue(name)
    assert not faults_of(files)
    assert sum(text.count("](") for text in files.values()) > 300


def test_a_page_says_what_its_page_in_html_says(forward: dict[str, str]) -> None:
    headings = headings_of(forward["component-Player.md"])
    assert headings[0] == ("h1", "Player")
    assert {
        "State machine",
        "Transitions",
        "States",
        "Uses",
        "Used by",
        "Declarations",
        "Generated code",
        "Findings",
    } <= {text for tag, text in headings if tag == "h2"}
    assert {"Every state", "LookForBall", "SearchNet", "Kick"} <= {text for tag, text in headings if tag == "h3"}
    words = "".join(token.content for token in tokens_of(forward["component-Player.md"]) if not token.children)
    assert "if not kicker.busy and after 0.5 s – kicked" in words
    assert "log.info(" in words
    assert "XABSL options have no frequency" in words
    assert "class Player" in forward["python-Player.md"]


def test_pictures_stand_alone(forward: dict[str, str]) -> None:
    pictures = {name: text for name, text in forward.items() if name.endswith(".svg")}
    assert {"index-map.svg", "component-Player.svg", "component-Player-state-SearchNet.svg"} <= set(pictures)
    for name, text in pictures.items():
        root = ElementTree.fromstring(text)
        assert not [each for each in root.iter() if any(key.endswith("href") for key in each.attrib)], name
        assert "var(" not in text, name


def test_the_order_of_pages_has_each_once(forward: dict[str, str]) -> None:
    pages = sorted(name for name in forward if name.endswith(".md"))
    nav = yaml.safe_load(forward["nav.yml"])["nav"]
    listed = [
        each for entry in nav for value in entry.values() for each in (value if isinstance(value, list) else [entry])
    ]
    files = [file for entry in listed for file in entry.values()]
    assert files[0] == "index.md"
    assert sorted(files) == pages
    assert sorted(line.strip() + ".md" for line in forward["contents.rst"].splitlines()[8:]) == pages


def test_the_same_project_gives_the_same_bytes(forward: dict[str, str], tmp_path: Path) -> None:
    assert markdown_of(FORWARD, tmp_path) == forward


def test_files_of_others_stay_and_stale_ones_go(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    files = markdown_of(FORWARD, tmp_path)
    (tmp_path / "component-Gone.md").write_text(files["index.md"], "utf-8")
    (tmp_path / "component-Gone.svg").write_text(files["component-Player.svg"], "utf-8")
    (tmp_path / "mine.md").write_text("# Mine\n", "utf-8")
    assert markdown_of(FORWARD, tmp_path) == {**files, "mine.md": "# Mine\n"}
    (tmp_path / "index.md").write_text("# Mine\n", "utf-8")
    assert main(["docs", str(FORWARD), "--format", "markdown", "--out", str(tmp_path)]) == 2
    assert "was not written by vicode docs" in capsys.readouterr().err


@pytest.mark.parametrize("payload", sorted(PAYLOADS))
def test_nothing_of_a_stranger_is_a_sign(payload: str, tmp_path: Path) -> None:
    write_hostile_project(tmp_path / "evil", PAYLOADS[payload])
    files = markdown_of(tmp_path / "evil", tmp_path / "site")
    assert not faults_of(files)
    assert headings_of(files["component-Player.md"])[0] == ("h1", "Player")


@given(LINES)
def test_words_stay_words(text: str) -> None:
    words = " ".join(text.split())
    html = READER.render(escape_text(text)).strip()
    assert unescape(html.removeprefix("<p>").removesuffix("</p>")) == words
    assert re.findall("<[^>]*>", html) == (["<p>", "</p>"] if words else [])
    cell = READER.render(f"| a | b |\n| --- | --- |\n| {escape_text(text)} | {inline_code(text)} |\n")
    assert cell.count("<td>") == 2


@given(LINES)
def test_code_stays_code(text: str) -> None:
    html = READER.renderInline(inline_code(text))
    assert unescape(re.sub("</?code>", "", html)) == " ".join(text.split())


def test_spaces_between_code_and_a_link_stay() -> None:
    parts = (TextSpan(text="1 + "), TextSpan(text="eye.x", href="eye.html"), TextSpan(text=" > "), TextSpan(text="n"))
    assert inline_expression(parts) == "`1 +` [`eye.x`](eye.md) `> n`"


@given(st.lists(LINES.filter(lambda each: each.isprintable())))
def test_a_fence_is_closed_by_nothing_in_it(lines: list[str]) -> None:
    text = "\n".join(lines).strip("\n")
    (token,) = READER.parse(fence(text))
    assert token.content.removesuffix("\n") == text.removesuffix("\n")


@pytest.mark.parametrize(
    "doc",
    [
        "Plain.",
        "# Title\n\n*soft* **hard** [w](https://example.org) `a | b`",
        "- a\n- b\n\n  second\n    - deep\n\n1. x\n2. y",
        "> said\n> twice",
        "```\ncode ``` | <b>\n\n\nend\n```",
        "| a | b |\n|---|---|\n| 1 | <i> |",
        "1986\\. was a year\n\n\\- no list\n\n<b>no tag</b> {: .class } $x$ {math}`x`",
        "one\n\n---\n\ntwo",
    ],
)
def test_docs_are_the_same_in_markdown(doc: str) -> None:
    def shape(html: str) -> str:
        plain = re.sub(r"<(/?)(?:h\d|strong|p)>", "", html)
        return re.sub(r"\s+", "", plain.replace("&#124;", "|"))

    reader = MarkdownIt("commonmark", {"html": True}).enable("table")
    assert shape(reader.render(markdown_from_html(render_doc(doc)))) == shape(render_doc(doc))


def test_addresses_lead_to_pages_in_markdown() -> None:
    assert markdown_href("component-A.html#state-B") == "component-A.md#state-B"
    assert markdown_href("python-A.html#L12") == "python-A.md"
    assert markdown_href("https://example.org/a b.html") == "https://example.org/a%20b.html"


def test_several_projects_have_a_common_home(tmp_path: Path) -> None:
    out = tmp_path / "all"
    assert main(["docs", str(ROOT / "designs" / "blink"), str(ROOT / "designs" / "rescue"), *FORMAT, str(out)]) == 0
    home = (out / "index.md").read_text("utf-8")
    assert [text for _tag, text in headings_of(home)] == ["Projects", "blink", "Rescue"]
    links = [str(token.attrGet("href")) for token in tokens_of(home) if token.type == "link_open"]
    assert len(links) == 2
    assert all((out / link).is_file() for link in links)


def test_markdown_is_not_watched(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["docs", str(FORWARD), "--watch", *FORMAT, str(tmp_path / "site")]) == 2
    assert "--watch cannot be combined with --format markdown" in capsys.readouterr().err
    assert not (tmp_path / "site").exists()


def test_pages_are_made_anew_when_their_templates_change() -> None:
    digested = {file.relative_to(ROOT / "templates").as_posix() for file in template_files("docsite")}
    assert {"docsite/site.css", "docsite/layout.html.jinja", "docsite/markdown/layout.md.jinja"} <= digested
