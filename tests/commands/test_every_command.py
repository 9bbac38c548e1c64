"""Every project through every command.

The test command takes each command with a project of each kind; the nightly run takes all pairs.
"""

from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.commands.projects import PROJECTS, TableProject
from tests.commands.table_commands import COMMANDS, TableCommand, Workplace


def _pairs() -> Iterator[tuple[TableCommand, TableProject, bool]]:
    """All pairs, each with whether the test command takes it: of each kind, the small project taken least often."""
    times = Counter[str]()
    for command in COMMANDS:
        for kind in dict.fromkeys(project.kind for project in PROJECTS):
            fitting = [project for project in PROJECTS if project.kind == kind and command.fits(project)]
            small = (project for project in fitting if not project.is_large)
            least = min(small, key=lambda project: times[project.name], default=None)
            times.update([least.name] if least else [])
            yield from ((command, project, project is least) for project in fitting)


def _parameters() -> Iterator[object]:
    for command, project, is_quick in _pairs():
        marks = () if is_quick else pytest.mark.nightly
        yield pytest.param(command, project, marks=marks, id=f"{command.name}-{project.name}".replace(" ", "_"))


@pytest.mark.parametrize(("command", "project"), tuple(_parameters()))
def test_command(
    command: TableCommand,
    project: TableProject,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    place = Workplace(project=project, root=tmp_path, capfd=capfd)
    place.folder.parent.mkdir()
    project.write(place.folder)
    monkeypatch.chdir(tmp_path)
    command.run(place)


def test_each_project_and_command_is_taken() -> None:
    taken = [(command, project) for command, project, is_quick in _pairs() if is_quick]
    assert {command.name for command, _project in taken} == {command.name for command in COMMANDS}
    assert {project.name for _command, project in taken} == {
        project.name for project in PROJECTS if not project.is_large
    }
