"""What keeps the site of many state machines small and readable: one menu for all pages, and folders."""

import json
import re
from pathlib import Path

from tests.docsite.link_checker import find_broken_links
from vicode.cli import main
from vicode.docsite import SiteInput, SourceText, build_site
from vicode.model.design import Design, Use
from vicode.model.project import Project
from vicode.output import OutputFile

FORWARD = Path(__file__).parents[2] / "designs" / "forward"


def text_of(files: tuple[OutputFile, ...], path: str) -> str:
    return next(file.text for file in files if file.path == path)


def test_the_menu_of_state_machines_is_in_one_file(tmp_path: Path) -> None:
    assert main(["docs", str(FORWARD), "--out", str(tmp_path)]) == 0
    assert "SearchNet" not in (tmp_path / "component-Turn.html").read_text("utf-8")
    rows = json.loads((tmp_path / "menu.js").read_text("utf-8").split("window.vicodeMenu = ")[1].removesuffix(";\n"))
    assert [name for name, _entries in rows] == [""]
    assert ["SearchNet", "component-SearchNet.html"] in [entry[:2] for entry in rows[0][1]]


def test_the_menu_has_the_folders_that_not_all_designs_share() -> None:
    names = ("Wait", "Walk10", "Walk2")
    places = ("src/wait.yaml", "src/legs/walk10.yaml", "src/legs/walk2.yaml")
    project = Project(name="walker", designs=tuple(Design(component=name) for name in names))
    sources = {name: SourceText(path=path, text="", language="yaml") for name, path in zip(names, places, strict=True)}
    script = text_of(build_site(SiteInput(project=project, sources=sources)), "menu.js")
    rows = json.loads(script.split("window.vicodeMenu = ")[1].removesuffix(";\n"))
    assert [(folder, [name for name, *_rest in entries]) for folder, entries in rows] == [
        ("", ["Wait"]),
        ("legs", ["Walk2", "Walk10"]),
    ]


def test_the_home_page_of_a_large_project_is_by_folders() -> None:
    names = [f"Machine{number}" for number in range(42)]
    designs = tuple(
        Design(component=name, uses=(Use(alias="next", component=names[number + 20]),) if number < 20 else ())
        for number, name in enumerate(names)
    )
    folders = {name: "attack" if number < 20 else "goal/keeper" for number, name in enumerate(names)}
    sources = {name: SourceText(path=f"{folders[name]}/{name}.yaml", text="", language="yaml") for name in names}
    files = build_site(SiteInput(project=Project(name="squad", designs=designs), sources=sources))
    assert not find_broken_links(files)
    home = text_of(files, "index.html")
    drawing = home[home.index("<svg") : home.index("</svg>")]
    assert re.findall(r'data-key="([^"]*)" href="([^"]*)"', drawing) == [
        ("attack", "#folder-attack"),
        ("goal/keeper", "#folder-goal-keeper"),
    ]
    assert "22 state machines" in drawing
    assert home.count('<details class="folder"') == 2
