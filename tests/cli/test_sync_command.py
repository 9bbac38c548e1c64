"""vicode sync: edits of generated code reach the design, and nothing is lost on the way."""

import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.cli.command_runner import LAMP, lamps, vicode
from tests.cli.git_folder import init
from vicode.cli.gen import write_plan
from vicode.services.project_loader import LoadedProject
from vicode.sync import GenerationPlan

__all__ = ["lamps"]

FILE = Path("lamps/generated/python/lamps/lamp.py")
DESIGN = Path("lamps/lamp.yaml")
PLAIN = "vicode: 1\ncomponent: Lamp\ninitial: On\nstates:\n  On: {transitions: [{to: Off, after: 1}]}\n  Off: {}\n"


def edit(file: Path, old: str, new: str) -> None:
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))


@pytest.fixture
def generated(lamps: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    assert vicode("gen", "lamps") == 0
    capsys.readouterr()
    return lamps


@pytest.mark.parametrize("command", [["sync"], ["gen", "--apply"]])
def test_an_edited_region_goes_into_the_design(
    generated: Path, capsys: pytest.CaptureFixture[str], command: list[str]
) -> None:
    edit(FILE, "self.count = 1", "self.count = 2  # two\n        self.total = 0")
    assert vicode(*command, "lamps") == 0
    assert capsys.readouterr().out.startswith(f"applied Dark.enter from {FILE}:")
    assert DESIGN.read_text() == LAMP.replace("self.count = 1", "self.count = 2  # two\n      self.total = 0")
    assert "self.total = 0" in FILE.read_text()
    assert vicode("gen", "--check", "lamps") == 0
    assert vicode(*command, "lamps") == 0
    assert capsys.readouterr().out == ""


def test_check_reports_edits_and_writes_nothing(generated: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("sync", "--check", "lamps") == 0
    edit(FILE, "self.count = 1", "self.count = 2")
    assert vicode("sync", "--check", "lamps") == 1
    assert "region 'Dark.enter' was edited here" in capsys.readouterr().out
    assert DESIGN.read_text() == LAMP


def test_edits_of_different_lines_are_merged(generated: Path, capsys: pytest.CaptureFixture[str]) -> None:
    edit(DESIGN, "self.count = 1", "self.count = 1\n      pass\n      self.b = 1")
    vicode("gen", "lamps")
    edit(FILE, "self.count = 1", "self.count = 2")
    edit(DESIGN, "self.b = 1", "self.b = 3")
    capsys.readouterr()
    assert vicode("sync", "lamps") == 0
    assert "merged Dark.enter" in capsys.readouterr().out
    assert "self.count = 2\n      pass\n      self.b = 3\n" in DESIGN.read_text()


@pytest.mark.parametrize("command", ["sync", "gen"])
def test_an_edit_of_the_same_moment_is_not_overwritten(
    generated: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    def write_late(opened: LoadedProject, plan: GenerationPlan, *, is_forced: bool = False) -> bool:
        edit(FILE, "self.count = 1", "self.count = 5")
        return write_plan(opened, plan, is_forced=is_forced)

    edit(DESIGN, "self.count = 1", "self.count = 1\n      self.b = 3")
    design = DESIGN.read_text()
    monkeypatch.setattr(f"vicode.cli.{command}.write_plan", write_late)
    assert vicode(command, "lamps") == 2
    assert "changed at the same time" in capsys.readouterr().err
    assert "self.count = 5" in FILE.read_text()
    assert DESIGN.read_text() == design


@pytest.mark.parametrize(("side", "kept", "lost"), [("file", 2, 3), ("design", 3, 2)])
def test_a_conflict_waits_for_a_choice(
    generated: Path, capsys: pytest.CaptureFixture[str], side: str, kept: int, lost: int
) -> None:
    edit(FILE, "self.count = 1", "self.count = 2")
    edit(DESIGN, "self.count = 1", "self.count = 3")
    before = (FILE.read_text(), DESIGN.read_text())
    assert vicode("sync", "lamps") == 1
    err = capsys.readouterr().err
    assert f"{FILE}:" in err
    assert "error G504" in err
    assert "lamps/lamp.yaml:7:12: note: the design" in err
    assert "-self.count = 3\n+self.count = 2\n" in err
    assert (FILE.read_text(), DESIGN.read_text()) == before
    assert vicode("sync", "lamps", "--take", side) == 0
    for file in (FILE, DESIGN):
        assert f"self.count = {kept}" in file.read_text()
        assert f"self.count = {lost}" not in file.read_text()


def test_an_edit_with_an_error_stays_in_the_file(generated: Path, capsys: pytest.CaptureFixture[str]) -> None:
    edit(FILE, "self.count = 1", "self.count = 1\n        self.b = = 2")
    text = FILE.read_text()
    line = text[: text.index("= = 2")].count("\n") + 1
    assert vicode("sync", "lamps") == 1
    assert f"{FILE}:{line}:18: error D412" in capsys.readouterr().err
    assert (FILE.read_text(), DESIGN.read_text()) == (text, LAMP)


def test_nothing_is_written_while_one_file_has_an_edit(generated: Path) -> None:
    edit(FILE, "self.count = 1", "self.count = 2")
    edit(Path("lamps/bulb.yaml"), "On", "Shining")
    before = {path: path.read_text() for path in FILE.parent.iterdir()}
    assert vicode("gen", "lamps") == 1
    assert {path: path.read_text() for path in FILE.parent.iterdir()} == before


def test_a_run_needs_the_edits_in_the_design(generated: Path, capsys: pytest.CaptureFixture[str]) -> None:
    edit(FILE, "self.count = 1", "self.count = 2")
    assert vicode("run", "lamps/lamp.yaml", "--ticks", "2", "--plain") == 1
    assert "'vicode sync'" in capsys.readouterr().err
    assert vicode("sync", "lamps") == 0
    assert vicode("run", "lamps/lamp.yaml", "--ticks", "2", "--plain") == 0


@pytest.mark.parametrize("setting", ['indent-style="tab"', 'quote-style="single"'])
def test_formatters_make_no_edits(generated: Path, setting: str) -> None:
    edit(DESIGN, "self.count = 1", 'self.note = dict(one="first", two="second", three="third")')
    vicode("gen", "lamps")
    formatter = [sys.executable, "-m", "ruff", "format", "-q", "--isolated", "--line-length", "50"]
    subprocess.run([*formatter, "--config", f"format.{setting}", "lamps/generated"], check=True)
    assert vicode("sync", "--check", "lamps") == 0
    edit(FILE, "three=", "four=")
    assert vicode("sync", "lamps") == 0
    assert "four=" in DESIGN.read_text()


@pytest.mark.nightly
def test_kill_9_loses_no_edit(generated: Path) -> None:
    """Whenever a sync is killed, the edit is in the file or in the design, and the next one completes it."""
    for attempt in range(200):
        edit(FILE, "self.count = ", f"self.line_{attempt} = 0\n        self.count = ")
        sync = subprocess.Popen([sys.executable, "-m", "vicode", "sync", "lamps"], stdout=subprocess.DEVNULL)
        time.sleep(0.25 + 0.005 * (attempt % 60))
        sync.kill()
        sync.wait()
        assert f"self.line_{attempt} = 0" in FILE.read_text() + DESIGN.read_text()
        assert vicode("sync", "lamps") == 0
        assert f"self.line_{attempt} = 0" in DESIGN.read_text()
        edit(DESIGN, f"self.line_{attempt} = 0\n      ", "")
        assert vicode("gen", "lamps") == 0
        assert vicode("gen", "--check", "lamps") == 0


def wait_until(condition: Callable[[], bool]) -> None:
    for _attempt in range(600):
        if condition():
            return
        time.sleep(0.05)
    raise AssertionError("nothing happened")


def test_watching_applies_edits_and_generates(generated: Path) -> None:
    command = [sys.executable, "-m", "vicode", "sync", "lamps", "--watch"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as watching:
        try:
            assert watching.stdout is not None
            assert watching.stdout.readline() == "Watching; press Ctrl-C to stop.\n"
            edit(FILE, "self.count = 1", "self.count = 2")
            wait_until(lambda: "self.count = 2" in DESIGN.read_text())
            edit(DESIGN, "after: 0.2", "after: 0.3")
            wait_until(lambda: "300_000_000" in FILE.read_text())
        finally:
            watching.kill()


def git(*arguments: str) -> None:
    identity = ["-c", "user.name=a", "-c", "user.email=a@example.org"]
    subprocess.run(["git", *identity, *arguments], check=True, capture_output=True)


def test_a_fresh_clone_finds_what_was_generated_in_git(generated: Path, capsys: pytest.CaptureFixture[str]) -> None:
    git("init", "-q")
    git("add", ".")
    git("commit", "-qm", "first")
    shutil.rmtree("lamps/generated/.vicode")
    edit(DESIGN, "after: 0.2", "after: 0.3")
    assert vicode("gen", "lamps") == 0
    shutil.rmtree("lamps/generated/.vicode")
    edit(FILE, "300_000_000", "400_000_000")
    edit(DESIGN, "after: 0.3", "after: 0.1")
    capsys.readouterr()
    assert vicode("gen", "lamps") == 1
    assert "edited outside regions" in capsys.readouterr().err


def test_generated_code_of_two_branches_merges(generated: Path, capsys: pytest.CaptureFixture[str]) -> None:
    git("init", "-q", "-b", "main")
    git("add", ".")
    git("commit", "-qm", "first")
    git("checkout", "-qb", "other")
    edit(DESIGN, "after: 0.2", "after: 0.3")
    vicode("gen", "lamps")
    git("commit", "-qam", "timer")
    git("checkout", "-q", "main")
    edit(DESIGN, "self.count = 1", "self.count = 5")
    vicode("gen", "lamps")
    git("commit", "-qam", "count")
    git("merge", "-q", "other")
    assert vicode("gen", "--check", "lamps") == 0
    edit(DESIGN, "after: 0.3", "after: 0.4")
    assert vicode("gen", "lamps") == 0


def test_edits_of_statements_are_shown_and_taken_over_on_request(
    generated: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    edit(FILE, "200_000_000", "400_000_000")
    FILE.write_text(FILE.read_text() + "\nif __name__ == '__main__':\n    Lamp.demo()\n")
    before = FILE.read_text()
    assert vicode("sync", "lamps") == 1
    err = capsys.readouterr().err
    assert "the design can express: time of Lit → Dark: 0.4" in err
    assert "+    Lamp.demo()" in err
    assert f"{FILE}: the module: no edit of the design produces 'if __name__ == '__main__':'" in err
    assert (FILE.read_text(), DESIGN.read_text()) == (before, LAMP)
    assert vicode("sync", "--outside-regions", "lamps") == 1
    assert DESIGN.read_text() == LAMP.replace("after: 0.2", "after: 0.4")
    assert "+    Lamp.demo()" in FILE.with_name("lamp.py.patch").read_text()
    assert f"{FILE}: the module: no edit of the design produces 'if __name__ == '__main__':'" in capsys.readouterr().out
    capsys.readouterr()
    assert vicode("gen", "--check", "lamps") == 1
    out = capsys.readouterr().out
    assert f"{FILE}.patch:1:1: error G506" in out
    assert out.count("error") == 1


def test_methods_in_another_order_are_no_edit(generated: Path) -> None:
    before = FILE.read_text()
    head, *methods = re.split(r"^(?=    def _[a-z])", f"{before}\n", flags=re.MULTILINE)
    FILE.write_text(f"{head}{''.join(reversed(methods)).rstrip()}\n")
    assert FILE.read_text() != before
    assert vicode("sync", "lamps") == 0
    assert (FILE.read_text(), DESIGN.read_text()) == (before, LAMP)


def test_an_edited_constant_belongs_to_the_project_file(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("gen", "lamps") == 0
    edit(FILE.with_name("declarations.py"), "pause: Final = 0.1", "pause: Final = 0.2")
    assert vicode("sync", "--outside-regions", "lamps") == 1
    err = capsys.readouterr().err
    assert "declarations.py:6:1: error G501" in err
    assert "the constant 'pause' was edited here, but is declared in project.yaml" in err
    assert "project.yaml:4:" in err


def test_git_tells_what_a_design_without_project_file_generated(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("plain").mkdir()
    Path("plain/lamp.yaml").write_text(PLAIN)
    assert vicode("gen", "plain", "--out", "out") == 0
    init(tmp_path)
    shutil.rmtree("out/.vicode")
    edit(Path("plain/lamp.yaml"), "after: 1", "after: 2")
    assert vicode("gen", "plain", "--out", "out") == 0
