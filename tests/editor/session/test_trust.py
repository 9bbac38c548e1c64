"""Which folders are trusted, and which need no trust as they contain no code."""

import os
import py_compile
import subprocess
import sys
import sysconfig
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

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


@given(
    name=st.binary(min_size=1)
    .map(lambda name: os.fsdecode(name.translate(None, b"/\0")))
    .filter(lambda n: n.strip("."))
)
@example(name="\n/victim")
@example(name="\x85")
@example(name="\udcff")
@example(name='"')
def test_each_name_trusts_its_own_folder_only(name: str) -> None:
    with TemporaryDirectory() as temporary:
        state, folder = Path(temporary, "state"), Path("/projects", name)
        trust_folder(state, folder)
        assert is_trusted(state, folder)
        assert not is_trusted(state, Path("/projects"))
        assert not is_trusted(state, Path("/victim"))
        trust_folder(state, Path("/other"))
        assert is_trusted(state, folder)


def test_the_plain_paths_of_earlier_versions_stay_trusted(tmp_path: Path) -> None:
    (tmp_path / "trusted").write_text("/first\n/second\n")
    trust_folder(tmp_path, Path("/third"))
    assert all(is_trusted(tmp_path, Path(f"/{name}")) for name in ("first", "second", "third"))
    assert not is_trusted(tmp_path, Path("/fourth"))


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


@pytest.mark.parametrize(
    "name",
    [
        *(
            "math.py",
            "evil.pyc",
            "evil.so",
            "evil.abi3.so",
            f"evil{sysconfig.get_config_var('EXT_SUFFIX')}",
            "evil.pyd",
        ),
        *("space/evil.pyc", "a/b/c/evil.py", "__pycache__/evil.cpython-311.pyc", ".hidden/evil.py"),
    ],
)
def test_each_kind_of_module_is_code(tmp_path: Path, name: str) -> None:
    assert not contains_code(tmp_path, Project(name="p"))
    file = tmp_path / name
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text("")
    assert contains_code(tmp_path, Project(name="p"))


def test_whatever_python_imports_is_code(tmp_path: Path) -> None:
    source, folder = tmp_path / "source.py", tmp_path / "project"
    source.write_text("print('ran')\n")
    folder.mkdir()
    (tmp_path / "elsewhere").mkdir()
    py_compile.compile(str(source), str(tmp_path / "elsewhere" / "inner.pyc"))
    (folder / "linked").symlink_to(tmp_path / "elsewhere")
    done = subprocess.run([sys.executable, "-c", "import linked.inner"], cwd=folder, capture_output=True, check=True)
    assert done.stdout == b"ran\n"
    assert contains_code(folder, Project(name="p"))
    (folder / "linked").unlink()
    (folder / "data").mkdir()
    (folder / "link").symlink_to("data")
    (folder / "notes.txt").write_text("")
    (folder / "map.py.yaml").write_text("")
    assert not contains_code(folder, Project(name="p"))
