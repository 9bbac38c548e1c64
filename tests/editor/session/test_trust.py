"""Which folders are trusted, and which need no trust as they contain no code."""

from dataclasses import replace
from pathlib import Path

from vicode.editor.panels.simulation.trust_dialog import COMPARE
from vicode.editor.session import Workspace
from vicode.editor.session.trust import contains_code, is_trusted, trust_folder
from vicode.model.design import Code, Design, RunCode, State
from vicode.model.project import Project


def test_trust_is_remembered_outside_the_folder(tmp_path: Path) -> None:
    state, folder = tmp_path / "state", tmp_path / "project"
    (folder / "inner").mkdir(parents=True)
    assert not is_trusted(state, folder)
    trust_folder(state, folder)
    assert is_trusted(state, folder)
    assert is_trusted(state, folder / "inner")
    assert not is_trusted(state, tmp_path)
    assert not is_trusted(state, tmp_path / "project2")
    trust_folder(state, tmp_path / "project2")
    assert is_trusted(state, folder)
    assert [file.name for file in folder.iterdir()] == ["inner"]


def test_only_a_folder_with_code_needs_trust(tmp_path: Path, workspace: Workspace) -> None:
    assert contains_code(workspace.folder, workspace.project)
    empty = tmp_path / "empty"
    empty.mkdir()
    state = State(name="A")
    design = Design(component="P", initial="A", states=(state,))
    assert not contains_code(empty, Project(name="p", designs=(design,)))
    code = RunCode(code=Code(texts=(("python", "go()\n"),)))
    with_code = replace(design, states=(replace(state, enter=(code,)),))
    assert contains_code(empty, Project(name="p", designs=(with_code,)))
    in_cpp = RunCode(code=Code(texts=(("cpp", "go();\n"),)))
    with_cpp = Project(name="p", designs=(replace(design, states=(replace(state, enter=(in_cpp,)),)),))
    assert not contains_code(empty, with_cpp)
    assert contains_code(empty, with_cpp, COMPARE.languages)
    (empty / "math.py").write_text("")
    assert contains_code(empty, Project(name="p", designs=(design,)))
