"""P208: a project's name gives a package that Python can import and that hides no other module."""

from pathlib import Path

import pytest

from vicode.check import check_project
from vicode.generators.plan import plan_package
from vicode.model.project import Interface, Project
from vicode.store import open_project

BLINKER = "vicode: 1\ncomponent: Blinker\ninitial: On\nstates: {On: {final: true}}\n"
HEAD = Interface(component="Head", implementation="field.head:Head")


def _problem(project: Project) -> str:
    return "; ".join(each.message for each in check_project(project) if each.rule.code == "P208")


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("class", "is a keyword of Python"),
        ("Types", "would hide a module of Python's library"),
        ("json", "would hide a module of Python's library"),
        ("Zip File!", ""),
        ("zipFile", ""),
        ("ViCode", ""),
        ("vicode", "would hide the runtime"),
        ("(bica)", "would hide the runtime"),
        ("Field", "would hide the module of 'Head'"),
        ("World", "would hide the module of 'world'"),
        ("head", ""),
        ("2 types", ""),
    ],
)
def test_the_package_must_not_hide_anything(name: str, reason: str) -> None:
    project = Project(name=name, world="world:World", components=(HEAD,))
    package = plan_package(project, frozenset()).name
    assert _problem(project) == (f"the package '{package}' of this project {reason}" if reason else "")


def test_other_languages_do_not_mind() -> None:
    assert _problem(Project(name="types", languages=("cpp", "xabsl"))) == ""
    assert _problem(Project(name="types", languages=("cpp", "python"))) != ""


def test_a_folder_without_a_project_file_gives_its_own_name(tmp_path: Path) -> None:
    for name in ("types", "blinking"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "blinker.yaml").write_text(BLINKER, encoding="utf-8")
    (finding,) = check_project(open_project(tmp_path / "types").project)
    assert (finding.rule.code, finding.fix) == ("P208", "give another name with 'project:' in project.yaml")
    assert check_project(open_project(tmp_path / "blinking").project) == ()
