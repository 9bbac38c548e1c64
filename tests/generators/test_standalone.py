"""A package generated with --standalone needs only the standard library."""

import subprocess
import sys
from pathlib import Path

from tests.generators.code_tools import write_files
from vicode.generators import generate, list_outputs
from vicode.store import open_project

DESIGN = """\
vicode: 1
component: Halver
variables: {a: 1.0}
initial: S
states:
  S: {actions: [{set: {a: a / (a - a)}}], transitions: [{to: T, after: 0.1}]}
  T: {final: true}
"""


def test_standalone_package_runs_without_vicode(tmp_path: Path) -> None:
    (tmp_path / "halver.yaml").write_text(DESIGN, encoding="utf-8")
    project = open_project(tmp_path).project
    files = generate(project, standalone=True)
    assert {file.path for file in files} == set(list_outputs(project, standalone=True))
    write_files(files, tmp_path / "out")
    package = files[0].path.split("/")[1]
    command = [sys.executable, "-S", "-m", package, "Halver", "--until-done"]
    result = subprocess.run(command, cwd=tmp_path / "out" / "python", capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    assert "stopped: done" in result.stdout
