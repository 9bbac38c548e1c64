"""The jobs of docs/in-ci.md pass for a project that is in order, and fail for one that is not."""

import re
import shutil
from pathlib import Path

import pytest

from tests.cli.command_runner import vicode
from tests.manual.code_blocks import ROOT, code_blocks


@pytest.fixture
def designs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder `designs` of a repository, with its generated code."""
    monkeypatch.chdir(tmp_path)
    assert vicode("sample", "designs") == 0
    assert vicode("gen", "designs") == 0
    return tmp_path / "designs"


def jobs() -> list[list[str]]:
    """The commands of each job."""
    blocks = code_blocks(ROOT / "docs/in-ci.md", "yaml")
    return [re.findall(r"^ *- (?:run: )?vicode (.*)$", block.text, re.MULTILINE) for block in blocks]


def test_the_jobs_pass(designs: Path) -> None:
    first, *others = jobs()
    assert len(first) == 4
    assert [first] == others
    for command in first:
        assert vicode(*command.split()) == 0, command
    assert Path("site/index.html").exists()


def test_the_jobs_fail(designs: Path) -> None:
    (designs / "player.yaml").write_text((designs / "player.yaml").read_text().replace("ball_seen", "ball_seem", 1))
    assert vicode("check", "--strict", "designs") == 1
    shutil.rmtree(designs / "generated")
    assert vicode("gen", "--check", "designs") == 1
    assert vicode("check", "--strict", "design") == 2
