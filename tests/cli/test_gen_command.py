"""vicode gen: writes, checks, shows, refuses, keeps."""

from pathlib import Path

import pytest

from tests.cli.command_runner import BULB, LAMP, lamps, vicode

__all__ = ["lamps"]

PACKAGE = "lamps/generated/python/lamps"


def test_it_writes_what_is_then_up_to_date(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("gen", "--check", "lamps") == 1
    out = capsys.readouterr().out
    assert [line.split(": ")[-1] for line in out.splitlines()] == ["no such file; run 'vicode gen'"] * 5
    assert vicode("gen", "lamps") == 0
    assert f"wrote {PACKAGE}/lamp.py\n" in capsys.readouterr().out
    assert sorted(path.name for path in Path(PACKAGE).iterdir()) == [
        "__init__.py",
        "__main__.py",
        "bulb.py",
        "declarations.py",
        "lamp.py",
    ]
    assert vicode("gen", "lamps", "--check") == 0
    assert vicode("gen", "lamps") == 0
    assert capsys.readouterr().out == ""


def test_a_design_brings_what_it_uses(lamps: Path) -> None:
    assert vicode("gen", "lamps/bulb.yaml", "--out", "one") == 0
    assert not Path("one/python/lamps/lamp.py").exists()
    assert vicode("gen", "lamps/lamp.yaml", "--out", "two") == 0
    assert Path("two/python/lamps/bulb.py").exists()
    assert vicode("gen", "lamps/bulb.yaml", "--out", "two", "--check") == 0


def test_changed_and_stale_files_are_told_and_mended(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    vicode("gen", "lamps")
    (lamps / "lamp.yaml").write_text(LAMP.replace("0.2", "0.3").replace("Bulb}", "Globe}"), encoding="utf-8")
    (lamps / "bulb.yaml").write_text(BULB.replace("Bulb", "Globe"), encoding="utf-8")
    capsys.readouterr()
    assert vicode("gen", ".", "--check", "--diff") == 1
    out = capsys.readouterr().out
    assert "bulb.py:1:1: error G502 stale-output: stale" in out
    assert "globe.py:1:1: error G502 stale-output: missing" in out
    assert "lamp.py:1:1: error G502 stale-output: changed" in out
    assert "+        if decide and self.root.now_ns - self._entered_ns >= 300_000_000:  # after 0.3 s\n" in out
    assert Path(PACKAGE, "bulb.py").exists()
    assert vicode("gen", ".") == 0
    assert not Path(PACKAGE, "bulb.py").exists()


def test_edited_code_is_refused_then_kept(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    vicode("gen", "lamps")
    file = Path(PACKAGE, "lamp.py")
    edited = file.read_text().replace("self.count = 1", "self.count = 2")
    file.write_text(edited)
    capsys.readouterr()
    assert vicode("gen", "lamps") == 1
    assert "error G501 edited-generated: the code of region 'Dark.enter' was edited" in capsys.readouterr().err
    assert file.read_text() == edited
    assert vicode("gen", "lamps", "--force") == 0
    assert "self.count = 1" in file.read_text()
    assert Path(PACKAGE, "lamp.py.edited").read_text() == edited
    file.write_text(edited)
    assert vicode("gen", "lamps", "--force") == 0
    assert Path(PACKAGE, "lamp.py.edited2").read_text() == edited


def test_a_design_with_mistakes_is_left_out(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (lamps / "bulb.yaml").write_text(BULB.replace("initial: On", "initial: Off"), encoding="utf-8")
    assert vicode("gen", "lamps") == 1
    assert "lamps/bulb.yaml:3:10: error D401" in capsys.readouterr().err
    assert Path(PACKAGE, "lamp.py").exists()
    assert not Path(PACKAGE, "bulb.py").exists()


def test_nothing_is_stale_while_a_design_cannot_be_read(lamps: Path) -> None:
    vicode("gen", "lamps")
    (lamps / "bulb.yaml").write_text("vicode: 1\nstates: [", encoding="utf-8")
    assert vicode("gen", "lamps") == 1
    assert Path(PACKAGE, "bulb.py").exists()


def test_mistakes_in_the_project_stop_all_of_it(lamps: Path) -> None:
    (lamps / "project.yaml").write_text("vicode: 1\nproject: Lamps\nconstants: {pause: 1 +}\n", encoding="utf-8")
    assert vicode("gen", "lamps") == 1
    assert not Path(PACKAGE).exists()


@pytest.mark.parametrize("arguments", [["gen", "nowhere"], ["gen", "lamps", "--language", "cobol"], ["fly"]])
def test_what_cannot_run_says_so(lamps: Path, arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode(*arguments) == 2
    captured = capsys.readouterr()
    assert captured.err
    assert "Traceback" not in captured.err


def test_a_folder_without_designs_says_so(lamps: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "empty").mkdir()
    assert vicode("gen", "empty") == 2
    assert "no designs" in capsys.readouterr().err


def test_nothing_is_called_written_that_was_not(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (lamps / "generated").write_text("in the way")
    other = lamps.parent / "other"
    other.mkdir()
    (other / "project.yaml").write_text("vicode: 1\nproject: Other\n", encoding="utf-8")
    (other / "bulb.yaml").write_text(BULB, encoding="utf-8")
    assert vicode("gen", "lamps", "other") == 2
    captured = capsys.readouterr()
    assert "lamps/generated" not in captured.out
    assert captured.err.startswith("vicode: lamps/generated")
    assert captured.err.count("\n") == 1
    assert "wrote other/generated/python/other/bulb.py\n" in captured.out
    assert Path("other/generated/python/other/bulb.py").exists()


def test_a_file_is_no_folder_to_write_to(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("a_file").write_text("mine")
    assert vicode("gen", "lamps", "--out", "a_file") == 2
    captured = capsys.readouterr()
    assert (captured.out, captured.err.count("\n")) == ("", 1)
    assert Path("a_file").read_text() == "mine"


def test_a_check_tells_of_an_edit_what_to_do_about_it(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    vicode("gen", "lamps")
    file = Path(PACKAGE, "lamp.py")
    file.write_text(file.read_text().replace("self.count = 1", "self.count = 2"))
    capsys.readouterr()
    assert vicode("gen", "--check", "lamps") == 1
    out = capsys.readouterr().out
    assert "error G501 edited-generated" in out
    assert "region 'Dark.enter' was edited here" in out
    assert "'vicode sync'" in out
    assert "run 'vicode gen'" not in out


BOTH = "vicode: 1\nproject: Both\nlanguages: [python, xabsl]\n"
ONE = "vicode: 1\ncomponent: One\ninitial: A\nstates: {A: {transitions: [{to: B, after: 1}]}, B: {final: true}}\n"


def write_both(folder: Path) -> None:
    folder.mkdir()
    (folder / "project.yaml").write_text(BOTH, encoding="utf-8")
    (folder / "one.yaml").write_text(ONE, encoding="utf-8")


def test_two_languages_are_written_and_kept_apart(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    write_both(Path("both"))
    assert vicode("gen", "both") == 0
    option = Path("both/generated/xabsl/both/Options/One.xabsl")
    assert "state_time >= 1000" in option.read_text()
    assert Path("both/generated/python/both/one.py").exists()
    assert vicode("gen", "both", "--check") == 0
    assert vicode("xabsl", "check", "both/generated/xabsl/both/agents.xabsl") == 0
    option.write_text(option.read_text().replace("1000", "2000"))
    assert vicode("gen", "both", "--check") == 1
    assert "One.xabsl:1:1: error G501 edited-generated" in capsys.readouterr().out
    assert vicode("gen", "both", "--language", "python") == 0
    assert vicode("gen", "both", "--force") == 0
    assert "state_time >= 1000" in option.read_text()


def test_what_one_language_cannot_say_stops_that_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    write_both(Path("both"))
    Path("both/one.yaml").write_text(ONE + "resume: true\n", encoding="utf-8")
    assert vicode("gen", "both") == 1
    assert "both/one.yaml:5:9: error L701 not-in-xabsl" in capsys.readouterr().err
    assert Path("both/generated/python/both/one.py").exists()
    assert not Path("both/generated/xabsl").exists()
    assert vicode("run", "both/one.yaml", "--ticks", "2", "--plain") == 0


@pytest.mark.parametrize("language", ["python", "cpp", "xabsl", "javascript"])
def test_projects_with_one_output_folder_keep_the_files_of_each_other(
    tmp_path: Path, language: str, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("one", "two"):
        folder = tmp_path / name
        folder.mkdir()
        (folder / "project.yaml").write_text(
            f"vicode: 1\nproject: {name.title()}\nlanguages: [{language}]\ngenerated: ../generated\n"
        )
        (folder / "blinker.yaml").write_text(
            f"vicode: 1\ncomponent: {name.title()}Blinker\ninitial: Off\nstates: {{Off: {{}}}}\n"
        )
    for name in ("one", "two", "one"):
        assert vicode("gen", str(tmp_path / name)) == 0
    assert "deleted" not in capsys.readouterr().out
    for name in ("one", "two"):
        assert vicode("gen", "--check", str(tmp_path / name)) == 0
