"""`vicode show`: finds the design of a trace in git."""

import json
import re
from pathlib import Path

import pytest

from tests.cli.command_runner import LAMP, lamps, vicode
from tests.cli.git_folder import commit, git, init
from vicode.traces.reader import read_trace

__all__ = ["lamps"]


@pytest.fixture
def repository(lamps: Path) -> Path:
    init(lamps.parent)
    return lamps


def record(folder: Path) -> dict[str, str]:
    """The header of the trace `run.trace`, of a run of the lamp."""
    assert vicode("run", "lamps/lamp.yaml", "--ticks", "1", "--trace", "run.trace") == 0
    text = (folder.parent / "run.trace").read_text(encoding="utf-8")
    assert read_trace(text)
    header = json.loads(text.splitlines()[0])
    assert isinstance(header, dict)
    return header


def test_the_design_of_a_trace_is_found(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    header = record(repository)
    revision = git(repository, "rev-parse", "HEAD").strip()
    assert header["revision"] == revision
    lamp = repository / "lamp.yaml"
    lamp.write_text(LAMP.replace("after: pause", "after: 3"), encoding="utf-8")
    assert record(repository) == {**header, "design": record(repository)["design"], "revision": f"{revision}-dirty"}
    commit(repository, "slower")
    capsys.readouterr()
    assert vicode("show", header["design"]) == 0
    output = capsys.readouterr()
    assert output.out == LAMP
    assert re.fullmatch(rf"Lamp, lamps/lamp.yaml in {revision[:12]}, \d{{4}}-\d\d-\d\d, Ana: begin\n", output.err)


def test_the_project_is_written(repository: Path) -> None:
    header = record(repository)
    assert vicode("show", "run.trace", "-o", "found.yaml") == 0
    assert (repository.parent / "found.yaml").read_text(encoding="utf-8") == LAMP
    assert vicode("show", header["design"][:6], "lamps", "-o", "replay") == 0
    names = sorted(file.name for file in (repository.parent / "replay").iterdir())
    assert names == ["bulb.yaml", "lamp.yaml", "project.yaml"]
    assert vicode("run", "replay/lamp.yaml", "--ticks", "1") == 0


def test_a_design_that_is_not_committed(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (repository / "lamp.yaml").write_text(LAMP.replace("after: pause", "after: 3"), encoding="utf-8")
    header = record(repository)
    capsys.readouterr()
    assert vicode("show", header["design"]) == 0
    assert capsys.readouterr().err == "Lamp, lamps/lamp.yaml in the work tree, not committed\n"


def test_a_run_outside_of_a_repository_has_a_hash(lamps: Path) -> None:
    assert set(record(lamps)) == {"vicode-trace", "runtime", "design"}


@pytest.mark.parametrize(
    ("hash_", "code", "message"),
    [
        ("abcdef", 1, "vicode: no revision has a design with the hash abcdef in .\n"),
        ("xyz", 2, "vicode: 'xyz' is neither a file nor a hash of 6 to 12 hexadecimal digits\n"),
        (
            "lamps/lamp.yaml",
            2,
            "vicode: lamps/lamp.yaml is not a trace with the hash of a design; 'vicode run --trace FILE' records one\n",
        ),
    ],
)
def test_mistakes(repository: Path, capsys: pytest.CaptureFixture[str], hash_: str, code: int, message: str) -> None:
    assert vicode("show", hash_) == code
    assert capsys.readouterr().err == message
