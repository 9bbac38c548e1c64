"""Where a site may be written, and links into the repository of its sources."""

import shutil
from pathlib import Path

import pytest

from tests.docsite.link_checker import read_page
from vicode.cli import main

DESIGNS = Path(__file__).parents[2] / "designs"
BEHAVIOR = DESIGNS.parent / "tests" / "xabsl" / "cases" / "programs" / "p1"


@pytest.fixture
def project(tmp_path: Path) -> Path:
    (tmp_path / "repository" / ".git").mkdir(parents=True)
    shutil.copytree(DESIGNS / "blink", tmp_path / "repository" / "robot one" / "blink")
    return tmp_path / "repository" / "robot one" / "blink"


@pytest.mark.parametrize(
    ("out", "problem"),
    [
        ("repository/robot one/blink", "contains the designs; choose a folder of its own"),
        ("repository/robot one", "contains the designs; choose a folder of its own"),
        ("notes", "is not empty and was not written by vicode docs; choose another --out or an empty folder"),
        ("notes/mine.txt", "is not a folder"),
    ],
)
@pytest.mark.parametrize("file", ["", "blink.yaml"])
def test_a_folder_of_other_files_is_refused(
    project: Path, tmp_path: Path, out: str, problem: str, file: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "notes").mkdir()
    (tmp_path / "notes" / "mine.txt").write_text("mine")
    before = sorted(tmp_path.rglob("*"))
    assert main(["docs", str(project / file), "--out", str(tmp_path / out)]) == 2
    assert problem in capsys.readouterr().err
    assert sorted(tmp_path.rglob("*")) == before


def test_hidden_files_and_files_beside_a_site_are_allowed(project: Path, tmp_path: Path) -> None:
    out = tmp_path / "site"
    out.mkdir()
    (out / ".nojekyll").touch()
    assert main(["docs", str(project), "--out", str(out)]) == 0
    (out / "CNAME").write_text("robots.example")
    assert main(["docs", str(project), "--out", str(out), "--fresh"]) == 0
    assert (out / "CNAME").is_file()


def test_sources_lead_to_their_lines_in_the_repository(project: Path, tmp_path: Path) -> None:
    url = "https://example.org/team/{path}#L{line}"
    assert main(["docs", str(project), "--out", str(tmp_path / "site"), "--source-url", url]) == 0
    links = read_page((tmp_path / "site" / "component-Blink.html").read_text("utf-8")).links
    line = (project / "blink.yaml").read_text("utf-8").splitlines().index("  Bright:") + 1
    assert f"https://example.org/team/robot%20one/blink/blink.yaml#L{line}" in links
    assert "View in repository" in (tmp_path / "site" / "source-Blink.html").read_text("utf-8")
    assert main(["docs", str(project), "--out", str(tmp_path / "site")]) == 0
    assert "example.org" not in (tmp_path / "site" / "component-Blink.html").read_text("utf-8")


def test_sources_of_a_behavior_start_at_its_agents(tmp_path: Path) -> None:
    shutil.copytree(BEHAVIOR, tmp_path / "p1")
    command = ["docs", str(tmp_path / "p1" / "agents.xabsl"), "--source-url", "https://example.org/{path}?line={line}"]
    assert main([*command, "--out", str(tmp_path / "site")]) == 0
    links = read_page((tmp_path / "site" / "component-opt0.html").read_text("utf-8")).links
    assert "https://example.org/Options/opt0.xabsl?line=13" in links


@pytest.mark.parametrize("url", ["javascript:alert(1)", "https://example.org/", "{path}"])
def test_an_address_without_a_path_is_refused(
    project: Path, tmp_path: Path, url: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["docs", str(project), "--out", str(tmp_path / "site"), "--source-url", url]) == 2
    assert "--source-url must be an http or https address with {path}" in capsys.readouterr().err
    assert not (tmp_path / "site").exists()


@pytest.mark.parametrize("option", ["--title", "--source-url"])
def test_an_option_in_another_encoding_is_refused(
    project: Path, tmp_path: Path, option: str, capsys: pytest.CaptureFixture[str]
) -> None:
    text = "https://example.org/M\udcfcller/{path}"
    assert main(["docs", str(project), "--out", str(tmp_path / "site"), option, text]) == 2
    assert "must be encoded in UTF-8" in capsys.readouterr().err
