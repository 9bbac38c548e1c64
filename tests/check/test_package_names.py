"""P208: the project name is a valid package name and hides no other module."""

from pathlib import Path

import pytest

from vicode.check import check_project
from vicode.generators.plan import plan_package
from vicode.model.project import Interface, Project
from vicode.store import open_project

BLINKER = "vicode: 1\ncomponent: Blinker\ninitial: On\nstates: {On: {final: true}}\n"
HEAD = Interface(component="Head", implementation="field.head:Head")


def _problem(project: Project) -> str:
    return "; ".join(finding.message for finding in check_project(project) if finding.rule.code == "P208")


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("class", "is a Python keyword"),
        ("Types", "would hide a module of Python's standard library"),
        ("json", "would hide a module of Python's standard library"),
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
def test_package_name_problems(name: str, reason: str) -> None:
    project = Project(name=name, world="world:World", components=(HEAD,))
    package = plan_package(project, frozenset()).name
    assert _problem(project) == (f"the package '{package}' of this project {reason}" if reason else "")


def test_other_languages_have_no_package() -> None:
    assert _problem(Project(name="types", languages=("cpp", "xabsl"))) == ""
    assert _problem(Project(name="types", languages=("cpp", "python"))) != ""


def test_folder_name_is_the_default_project_name(tmp_path: Path) -> None:
    for name in ("types", "blinking"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "blinker.yaml").write_text(BLINKER, encoding="utf-8")
    (finding,) = check_project(open_project(tmp_path / "types").project)
    assert (finding.rule.code, finding.fix) == ("P208", "set another name with 'project:' in project.yaml")
    assert check_project(open_project(tmp_path / "blinking").project) == ()
