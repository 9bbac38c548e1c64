"""Building again after an edit: the same bytes as from nothing, and nothing touched that the edit does not concern."""

import random
import re
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.docsite.link_checker import find_broken_links
from tests.docsite.random_edits import EDITS, FORWARD, Edit
from vicode.check import check_project
from vicode.cli import main
from vicode.docsite import (
    ComponentFinding,
    Manifest,
    SiteBuilder,
    SiteInput,
    SourceText,
    build_site,
    code_pages,
    load_manifest,
    save_manifest,
    write_site,
)
from vicode.docsite.site_writer import tool_digest
from vicode.findings import Severity
from vicode.generators import ComponentCode
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.output import OutputFile
from vicode.services.docs.inputs import load_site_inputs

ROOT = Path(__file__).parents[2]


def subject_of_model(project: Project) -> SiteInput:
    """A project that stands in no file, with texts that say where its states are."""
    found = [
        ComponentFinding(component=each.subject.component if each.subject else "", line=0, finding=each)
        for each in check_project(project)
    ]
    errors = [each for each in found if each.finding.severity is Severity.ERROR]
    faulty = {
        language: frozenset(each.component for each in errors if each.finding.applies_to(language))
        for language in project.languages
    }
    return SiteInput(
        project=project,
        findings=tuple(found),
        sources={design.component: source_of(design) for design in project.designs},
        components_with_errors=faulty,
    )


def source_of(design: Design) -> SourceText:
    lines = [f"{state.name}: {len(state.transitions)}" for state in design.states]
    places = {("states", state.name): number for number, state in enumerate(design.states, start=1)}
    return SourceText(path=f"{design.component}.yaml", text="\n".join(lines), language="yaml", line_numbers=places)


class Folder:
    """Where a site is built again and again; every other time by a new process, which knows only what was kept."""

    def __init__(self, path: Path) -> None:
        self.out, self.kept = path / "site", path / "cache" / "manifest.json"
        self.builder = SiteBuilder()

    def build(self, project: Project, *, is_new_process: bool = False) -> tuple[str, ...]:
        if is_new_process:
            self.builder.close()
            self.builder = SiteBuilder()
        plan = self.builder.plan(subject_of_model(project))
        written = write_site(plan, self.out, load_manifest(self.kept), lambda _done, _of: None)
        save_manifest(written.manifest, self.kept)
        return written.changed

    def files(self) -> tuple[OutputFile, ...]:
        return tuple(OutputFile(path=each.name, text=each.read_text("utf-8")) for each in sorted(self.out.iterdir()))


@pytest.fixture
def folder(tmp_path: Path) -> Folder:
    return Folder(tmp_path)


@settings(max_examples=max(6, settings.default.max_examples // 20))
@given(edits=st.lists(st.tuples(st.sampled_from(EDITS), st.integers(0, 99), st.booleans()), min_size=3, max_size=6))
def test_after_any_edits_the_site_is_the_one_built_from_nothing(
    tmp_path_factory: pytest.TempPathFactory, edits: list[tuple[Edit, int, bool]]
) -> None:
    folder, project = Folder(tmp_path_factory.mktemp("edited")), FORWARD
    folder.build(project)
    for edit, seed, is_new_process in edits:
        project = edit(project, random.Random(seed))
        folder.build(project, is_new_process=is_new_process)
        expected = {file.path: file.text for file in build_site(subject_of_model(project))}
        assert {file.path: file.text for file in folder.files()} == expected
    folder.builder.close()


@pytest.mark.parametrize("is_new_process", [False, True])
def test_an_edit_touches_what_it_concerns_alone(folder: Folder, is_new_process: bool) -> None:
    folder.build(FORWARD)
    times = {file.name: file.stat().st_mtime_ns for file in folder.out.iterdir()}
    player = next(design for design in FORWARD.designs if design.component == "Player")
    kick = replace(player.states[0], doc="Xylographic.")
    edited = replace(player, states=(kick, *player.states[1:]))
    project = replace(FORWARD, designs=tuple(edited if each is player else each for each in FORWARD.designs))
    touched = folder.build(project, is_new_process=is_new_process)
    assert set(touched) == {file.path for file in folder.files() if "Xylographic." in file.text}
    assert {"component-Player.html", "python-Player.html", "search.js"} <= set(touched) < set(times)
    now = {file.name: file.stat().st_mtime_ns for file in folder.out.iterdir()}
    assert {name for name in now if now[name] != times[name]} == set(touched)
    assert folder.build(project, is_new_process=is_new_process) == ()


def test_pages_that_are_known_are_not_even_made(folder: Folder) -> None:
    folder.build(FORWARD)
    made: list[str] = []
    plan = [
        replace(each, render=lambda each=each: made.append(each.path) or each.render())
        for each in folder.builder.plan(subject_of_model(FORWARD))
    ]
    write_site(plan, folder.out, load_manifest(folder.kept), lambda _done, _of: None)
    assert made == []
    of_another_tool = replace(load_manifest(folder.kept), tool="another")
    written = write_site(plan, folder.out, of_another_tool, lambda _done, _of: None)
    assert made == [each.path for each in plan]
    assert written.changed == ()
    assert written.manifest.tool == tool_digest()


def test_a_page_that_somebody_changed_is_written_again(folder: Folder) -> None:
    folder.build(FORWARD)
    page = folder.out / "component-Player.html"
    whole = page.read_text("utf-8")
    page.write_text(whole.replace("Player", "Prayer"), "utf-8")
    (folder.out / "agents.html").unlink()
    assert set(folder.build(FORWARD)) == {"component-Player.html", "agents.html"}
    assert page.read_text("utf-8") == whole


@pytest.mark.parametrize("text", ["", "[]", '{"tool": 1}', '{"tool": "", "files": {"a": "b"}}', "\xff{"])
def test_a_manifest_that_cannot_be_read_is_an_empty_one(tmp_path: Path, text: str) -> None:
    file = tmp_path / "manifest.json"
    file.write_text(text, "latin-1")
    assert load_manifest(file) == Manifest()


def test_what_is_known_lies_outside_of_the_site(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("VICODE_CACHE", str(tmp_path / "cache"))
    command = ["docs", str(ROOT / "designs" / "blink"), "--out", str(tmp_path / "site")]
    assert main(command) == 0
    before = {file.name: file.read_bytes() for file in (tmp_path / "site").iterdir()}
    assert all(name.endswith((".html", ".css", ".js")) for name in before)
    assert sorted(file.parent.name for file in (tmp_path / "cache").rglob("*.json")) == [
        "docs",
        "docs-builds",
        "docs-results",
    ]
    assert main([*command, "--fresh"]) == 0
    after = {file.name: file.read_bytes() for file in (tmp_path / "site").iterdir()}
    assert [name for name in before if after[name] != before[name]] == []
    assert after.keys() == before.keys()


def test_several_projects_have_a_common_home(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for place in ("left", "right"):
        (tmp_path / place / "Blink").mkdir(parents=True)
        design = (ROOT / "designs" / "blink" / "blink.yaml").read_text("utf-8")
        (tmp_path / place / "Blink" / "blink.yaml").write_text(design, "utf-8")
        doc = f"vicode: 1\nproject: <{place}>\ndoc: From the *{place}* & back.\n"
        (tmp_path / place / "Blink" / "project.yaml").write_text(doc, "utf-8")
    behavior = ROOT / "tests" / "xabsl" / "cases" / "programs" / "p1" / "agents.xabsl"
    out = tmp_path / "site"
    assert main(["docs", str(tmp_path / "left"), str(tmp_path / "right"), str(behavior), "--out", str(out)]) == 0
    assert sorted(each.name for each in out.iterdir()) == ["Blink", "Blink-2", "index.html", "p1", "site.css"]
    home = OutputFile(path="index.html", text=(out / "index.html").read_text("utf-8"))
    for name in ("Blink/index.html", "Blink-2/index.html", "p1/index.html"):
        assert f'href="{name}"' in home.text
    assert "&lt;left&gt;" in home.text
    assert "<em>right</em> &amp; back" in home.text
    style = OutputFile(path="site.css", text="")
    inner = tuple(OutputFile(path=f"{name}/index.html", text="") for name in ("Blink", "Blink-2", "p1"))
    assert not find_broken_links((home, style, *inner))
    assert main(["docs", str(tmp_path / "left"), str(tmp_path / "right"), str(behavior), "--out", str(out)]) == 0
    assert "0 changed" in capsys.readouterr().out


@pytest.mark.parametrize("name", ["notes.md", "Makefile", "picture.svg"])
def test_a_file_that_is_something_else_is_told_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    (tmp_path / name).write_text("# Notes\n", "utf-8")
    assert main(["docs", str(tmp_path / name), "--out", str(tmp_path / "site")]) == 2
    told = capsys.readouterr().err
    assert f"{name} is neither a design nor an XABSL behavior; specify a design (.yaml)" in told
    assert "Y1" not in told
    assert not (tmp_path / "site").exists()


def test_a_site_has_the_title_it_is_given(tmp_path: Path) -> None:
    out = tmp_path / "site"
    program = ROOT / "tests" / "xabsl" / "cases" / "programs" / "p1" / "agents.xabsl"
    command = ["docs", str(program), "--out", str(out)]
    assert main([*command, "--title", "Red <b>team</b>"]) == 0
    pages = {file.name: file.read_text("utf-8") for file in out.glob("*.html")}
    assert "<h1><bdi>Red &lt;b&gt;team&lt;/b&gt;</bdi></h1>" in pages["index.html"]
    assert all("Red &lt;b&gt;team&lt;/b&gt;</bdi></a>" in text for text in pages.values())
    assert not [name for name, text in pages.items() if "<b>team" in text]
    assert main(command) == 0
    # What is generated is not called so.
    listing = pages["python-opt0.html"].partition('class="listing"')[2]
    assert listing
    assert listing in (out / "python-opt0.html").read_text("utf-8")
    assert "<h1><bdi>p1</bdi></h1>" in (out / "index.html").read_text("utf-8")
    both = ["docs", str(ROOT / "designs" / "blink"), str(program), "--out", str(tmp_path / "both"), "--title", "League"]
    assert main(both) == 0
    assert "<h1><bdi>League</bdi></h1>" in (tmp_path / "both" / "index.html").read_text("utf-8")
    assert "<h1><bdi>p1</bdi></h1>" in (tmp_path / "both" / "p1" / "index.html").read_text("utf-8")


def test_a_behavior_of_one_agent_is_called_as_that(tmp_path: Path) -> None:
    behavior = tmp_path / "folder"
    shutil.copytree(ROOT / "tests" / "xabsl" / "cases" / "programs" / "drive_circle", behavior)
    (agents,) = [file for file in behavior.glob("*.xabsl") if "agent " in file.read_text("utf-8")]
    (title,) = re.findall(r'agent \w+\("([^"]+)"', agents.read_text("utf-8"))
    assert main(["docs", str(agents), "--out", str(tmp_path / "site")]) == 0
    assert f"<h1><bdi>{title}</bdi></h1>" in (tmp_path / "site" / "index.html").read_text("utf-8")


@pytest.mark.parametrize("name", ["forward", "p1"])
def test_a_single_file_is_the_one_of_the_whole_site(name: str) -> None:
    program = ROOT / "tests" / "xabsl" / "cases" / "programs" / "p1" / "agents.xabsl"
    (reading,) = load_site_inputs([program])
    subject = subject_of_model(FORWARD) if name == "forward" else reading.site_input
    assert subject is not None
    with SiteBuilder() as builder, SiteBuilder() as other:
        find = builder.make_file_lookup(subject)
        for planned in other.plan(subject):
            found = find(planned.path)
            assert found is not None, planned.path
            assert (found.path, found.key, found.render()) == (planned.path, planned.key, planned.render())
        assert [find(path) for path in ("nothing.html", "component-Nobody.html", "python-Nobody.html", "")] == [
            None
        ] * 4


def test_a_single_page_is_made_without_the_texts_of_others(monkeypatch: pytest.MonkeyPatch) -> None:
    written: list[str] = []
    begin = code_pages.component_generator

    def listening(*given: Any) -> Callable[[Design], ComponentCode | None]:
        write = begin(*given)
        return lambda design: written.append(design.component) or write(design)

    monkeypatch.setattr(code_pages, "component_generator", listening)
    with SiteBuilder() as builder:
        find = builder.make_file_lookup(subject_of_model(FORWARD))
        assert find("index.html") is not None
        assert written == []
        page = find("component-Player.html")
        assert page is not None
        assert "python-Player.html" in page.render()
        assert set(written) == {"Player"}
        # A page that was found before is not looked for again, and what it was made from is still known later.
        assert find("component-Player.html") is page
        count = len(written)
        assert builder.make_file_lookup(subject_of_model(FORWARD))("component-Player.html") is not None
        assert len(written) == count
