"""`vicode diff`: files, folders and git revisions, in words and as JSON."""

import json
from pathlib import Path

import pytest

from tests.cli.command_runner import BULB, LAMP, lamps, vicode
from tests.cli.git_folder import commit, git, init

__all__ = ["lamps"]

BRIGHT = LAMP.replace("after: pause", "after: pause, when: bulb.on").replace("Lit:", "Lit:\n    doc: bright\n   ", 1)
FASTER = LAMP.replace("after: pause", "after: 0.05")
EXPECTED = "  ~ time Dark → Lit: pause → 0.05\n"


@pytest.fixture
def repository(lamps: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The project in a repository with one commit."""
    init(lamps)
    monkeypatch.chdir(lamps)
    return lamps


def write(folder: Path, name: str, text: str) -> None:
    (folder / f"{name}.yaml").write_text(text, encoding="utf-8")


def test_two_files(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(lamps, "other", FASTER)
    assert vicode("diff", "lamps/lamp.yaml", "lamps/other.yaml") == 1
    assert capsys.readouterr().out == f"lamps/lamp.yaml → lamps/other.yaml:\n{EXPECTED}"
    assert vicode("diff", "lamps/lamp.yaml", "lamps/lamp.yaml") == 0


def test_texts_do_not_reach_the_terminal_as_commands(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(lamps, "other", LAMP.replace("initial:", 'doc: "\\e]0;title\\a\\e[2Jbright"\ninitial:'))
    assert vicode("diff", "lamps/lamp.yaml", "lamps/other.yaml") == 1
    shown = capsys.readouterr().out
    assert "bright" in shown
    assert not {each for each in shown if not each.isprintable()} - {"\n"}


def test_two_folders(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    other = lamps.parent / "other"
    other.mkdir()
    write(other, "lamp", FASTER)
    write(other, "switch", BULB.replace("Bulb", "Switch"))
    assert vicode("diff", "lamps", "other") == 1
    assert capsys.readouterr().out == (
        "lamps/bulb.yaml:\n  - design Bulb: 1 state\n"
        f"lamps/lamp.yaml → other/lamp.yaml:\n{EXPECTED}"
        "lamps/project.yaml:\n  - project.yaml\n"
        "other/switch.yaml:\n  + design Switch: 1 state\n"
    )


def test_the_work_tree_and_head(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("diff") == 0
    write(repository, "lamp", FASTER)
    assert vicode("diff") == 1
    assert capsys.readouterr().out == f"lamp.yaml:\n{EXPECTED}"
    assert vicode("diff", "bulb.yaml") == 0


def test_revisions_and_paths(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(repository, "lamp", FASTER)
    commit(repository, "faster")
    git(repository, "rm", "-q", "bulb.yaml")
    commit(repository, "no bulb")
    for arguments in (("HEAD~2", "HEAD", "lamp.yaml"), ("HEAD~2..HEAD~1",), ("HEAD~2", "--", "lamp.yaml")):
        assert vicode("diff", *arguments) == 1
        assert capsys.readouterr().out == f"lamp.yaml:\n{EXPECTED}"
    assert vicode("diff", "HEAD~1", "HEAD", "bulb.yaml") == 1
    assert capsys.readouterr().out == "bulb.yaml:\n  - design Bulb: 1 state\n"
    assert vicode("diff", "HEAD~1", "HEAD", "lamp.yaml") == 0


def test_comments_are_no_differences(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(repository, "lamp", f"# A lamp.\n{LAMP}")
    assert vicode("diff") == 0
    assert capsys.readouterr().out == "lamp.yaml:\n  only comments or the form of the file differ\n"


def test_what_is_not_understood_is_a_difference(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(repository, "lamp", LAMP.replace("after: pause", "after: pause, guard: bulb.on").replace("initial", "inital"))
    project = (repository / "project.yaml").read_text(encoding="utf-8")
    write(repository, "project", f"{project}langauges: [cpp]\n")
    assert vicode("diff", "--html", "diff.html") == 1
    assert capsys.readouterr().out == (
        "lamp.yaml:\n"
        "  ~ initial state: Dark → (none)\n"
        "  + 'inital: Dark', which is not understood\n"
        "  + 'guard: bulb.on', which is not understood, in states.Dark.transitions.0\n"
        "project.yaml:\n"
        "  + 'langauges: [cpp]', which is not understood\n"
    )
    assert "guard: bulb.on" in (repository / "diff.html").read_text(encoding="utf-8")
    commit(repository, "misspelled")
    assert vicode("diff") == 0
    write(repository, "lamp", LAMP)
    assert vicode("diff", "lamp.yaml") == 1
    assert "  - 'inital: Dark', which is not understood\n" in capsys.readouterr().out


def test_changed_lines_of_code_are_shown(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code = "self.count = 1\n      self.on = True"
    write(repository, "lamp", LAMP.replace("self.count = 1", code))
    assert vicode("diff", "--html", "diff.html", "--svg", "diff.svg") == 1
    lines = "    + self.on = True\n"
    shown = capsys.readouterr().out
    assert shown.startswith("lamp.yaml:\n  ~ enter action of state Dark: 1 line → 2 lines (+1 -0)\n")
    assert lines in shown
    assert "+ self.on = True" in (repository / "diff.html").read_text(encoding="utf-8")
    assert "+ self.on = True" in (repository / "diff.svg").read_text(encoding="utf-8")
    assert vicode("diff", "--json") == 1
    (file,) = json.loads(capsys.readouterr().out)["files"]
    assert file["changes"][0]["lines"] == ["+ self.on = True"]


def test_declarations_and_renamed_files(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    git(repository, "mv", "bulb.yaml", "light.yaml")
    project = (repository / "project.yaml").read_text(encoding="utf-8")
    write(repository, "project", project.replace("0.1", "0.2"))
    (repository / "notes.yaml").write_text("unrelated: true\n", encoding="utf-8")
    git(repository, "add", "--all")
    assert vicode("diff") == 1
    assert capsys.readouterr().out == "bulb.yaml → light.yaml:\nproject.yaml:\n  ~ value of constant pause: 0.1 → 0.2\n"


def test_json(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(repository, "lamp", FASTER)
    assert vicode("diff", "--json") == 1
    (file,) = json.loads(capsys.readouterr().out)["files"]
    assert (file["path"], file["status"], file["readable"]) == ("lamp.yaml", "changed", True)
    assert file["changes"] == [
        {
            "kind": "changed",
            "subject": "transition Dark → Lit",
            "path": ["states", "Dark", "transitions", 0, "after"],
            "attribute": "time",
            "old": "pause",
            "new": "0.05",
            "text": EXPECTED.strip(),
            "lines": [],
        }
    ]


def test_a_diagram_and_a_page(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(repository, "lamp", FASTER)
    assert vicode("diff", "--svg", "diff.svg", "--html", "diff.html") == 1
    assert capsys.readouterr().out == f"lamp.yaml:\n{EXPECTED}"
    svg, page = ((repository / name).read_text(encoding="utf-8") for name in ("diff.svg", "diff.html"))
    assert EXPECTED.strip() in svg
    assert "<svg" in page
    assert '<li><b class="changed">~</b> time Dark → Lit: pause → 0.05</li>' in page
    assert vicode("diff", "--svg", "dark.svg", "--dark") == 1
    assert (repository / "dark.svg").read_text(encoding="utf-8") != svg


def test_a_diagram_shows_one_design(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("diff", "--svg", "diff.svg") == 2
    write(repository, "lamp", FASTER)
    write(repository, "bulb", BULB.replace("final", "disabled"))
    assert vicode("diff", "--svg", "diff.svg") == 2
    assert capsys.readouterr().err.endswith("2 designs differ: bulb.yaml, lamp.yaml\n")
    assert vicode("diff", "--html", "diff.html") == 1


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("nonsense",), "vicode: 'nonsense' is neither a path nor a revision\n"),
        (("HEAD", "HEAD", "HEAD"), "vicode: more than two revisions: HEAD, HEAD, HEAD\n"),
        (("lamp.yaml", "."), "vicode: . is a folder, and lamp.yaml a file; compare two files or two folders\n"),
        (("lamp.yaml", "project.yaml"), "vicode: project.yaml: a design cannot be compared with a project.yaml\n"),
    ],
)
def test_mistakes(
    repository: Path, capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], message: str
) -> None:
    assert vicode("diff", *arguments) == 2
    assert capsys.readouterr().err == message


def test_no_repository(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("diff", "lamps/lamp.yaml") == 2
    assert capsys.readouterr().err == "vicode: lamps is not in a git repository\n"


def test_git_is_not_installed(lamps: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    assert vicode("diff") == 2
    assert capsys.readouterr().err == "vicode: the program git is not installed\n"


def test_an_unreadable_version_is_reported(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(repository, "lamp", "component: [")
    assert vicode("diff") == 2
    assert "lamp.yaml:1:12: error Y101 not-yaml" in capsys.readouterr().err
