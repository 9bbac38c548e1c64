"""Each command reads XABSL files in their encoding and writes them back in it."""

import codecs
from dataclasses import dataclass
from pathlib import Path

import pytest

from vicode.cli.entry_point import main
from vicode.store import open_project

AGENTS = """\
/***
Title: Player ~
*/
include "symbols.xabsl";
include "acts.xabsl"; // ~
include "play.xabsl";
/** ~ */
agent player("Player ~", play);
"""
SYMBOLS = 'namespace ball("Ball ~") {\n/** ~ */\nfloat input ball.x; // ~\nbool input ball.seen;\n}\n'
ACTS = 'namespace acts("Acts") { behavior walk { float speed; } }\n'
PLAY = """\
/** ~ */
option play {
   /* ~
      ~ */
  initial state wait {
    decision {
      // ~
      if (ball.seen) { goto go; }
      else { stay; }
    }
    action { walk(speed = 0); }
  }
  /* ~ */
  state go {
    decision { if (ball.x > 100) { goto wait; } else { stay; } }
    action { walk(speed = 1); } // ~
  }
}
"""
FILES = {"agents.xabsl": AGENTS, "symbols.xabsl": SYMBOLS, "acts.xabsl": ACTS, "play.xabsl": PLAY}


@dataclass(frozen=True)
class Sample:
    """Text as people write it in an encoding; `option` is what must be specified."""

    encoding: str
    text: str
    newline: str
    option: str = ""

    @property
    def options(self) -> list[str]:
        return ["--encoding", self.option] if self.option else []


SAMPLES = (
    Sample("latin-1", "größte Nähe, café", "\n"),
    Sample("latin-1", "größte Nähe, café", "\r\n", "ISO-8859-1"),
    Sample("cp1252", "„immer“ – schön", "\r\n"),
    Sample("gbk", "等待球的状态", "\n", "gbk"),
    Sample("gbk", "等待球的状态", "\r\n", "cp936"),
    Sample("shift_jis", "ボールを待つ 表示", "\r\n", "shift_jis"),
    Sample("koi8-r", "ждать мяч", "\n", "koi8-r"),
    Sample("utf-8", "ждать 球 ö 😀", "\r\n"),
    Sample("utf-8-sig", "ждать 球 ö 😀", "\n"),
    Sample("utf-8-sig", "ждать 球 ö 😀", "\r\n", "gbk"),
)


@pytest.fixture(params=SAMPLES, ids=lambda each: f"{each.encoding}-{len(each.newline)}-{each.option}")
def sample(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Sample:
    """The behavior in `behavior/` below the current folder, in one encoding."""
    monkeypatch.chdir(tmp_path)
    write_behavior(tmp_path, request.param)
    return request.param  # type: ignore[no-any-return]


def write_behavior(folder: Path, sample: Sample) -> None:
    (folder / "behavior").mkdir()
    for name, text in FILES.items():
        content = text.replace("~", sample.text).replace("\n", sample.newline).encode(sample.encoding)
        (folder / "behavior" / name).write_bytes(content)


def contents() -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in Path("behavior").glob("*.xabsl")}


def read_tree(folder: str) -> str:
    return "".join(path.read_text("utf-8") for path in Path(folder).rglob("*") if path.is_file())


def test_format_changes_only_layout(sample: Sample, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["xabsl", "format", "behavior", *sample.options]) == 0
    first = contents()
    assert capsys.readouterr().err == ""
    for name, text in FILES.items():
        written = first[name].decode(sample.encoding)
        assert "".join(written.split()) == "".join(text.replace("~", sample.text).split())
        assert written.count("\n") == written.count(sample.newline)
    assert first["play.xabsl"].startswith(codecs.BOM_UTF8) == (sample.encoding == "utf-8-sig")
    assert main(["xabsl", "format", "behavior", "--check", *sample.options]) == 0
    assert contents() == first


def test_the_program_is_that_of_the_behavior_without_comments(sample: Sample, tmp_path: Path) -> None:
    (tmp_path / "plain").mkdir()
    write_behavior(tmp_path / "plain", Sample("ascii", "", "\n"))
    assert main(["xabsl", "check", "behavior/agents.xabsl", *sample.options]) == 0
    assert main(["xabsl", "compile", "behavior/agents.xabsl", "-o", "a", "--symbols", "s", *sample.options]) == 0
    assert main(["xabsl", "compile", "plain/behavior/agents.xabsl", "-o", "b"]) == 0
    code, plain = (Path(name).read_text("utf-8").splitlines() for name in ("a", "b"))
    assert sample.text in code[0]
    assert code[1:] == plain[1:]
    # The original compiler writes the title in the encoding of the behavior.
    Path("a").write_bytes("\r\n".join(code).encode(sample.encoding.removesuffix("-sig")))
    Path("inputs.csv").write_text("time,ball.x,ball.seen\n0,1,1\n40,1,1\n", encoding="utf-8")
    assert main(["xabsl", "run", "a", "--symbols", "s", "--inputs", "inputs.csv", "--trace", "trace"]) == 0


def test_designs_pages_and_pictures_show_the_comments(sample: Sample) -> None:
    assert main(["import", "behavior/agents.xabsl", "--out", "designs", *sample.options]) == 0
    design = Path("designs/play.yaml").read_text("utf-8")
    assert design.count(sample.text) == FILES["play.xabsl"].count("~")
    assert open_project(Path("designs")).project.xabsl_encoding == {"ISO-8859-1": "latin-1", "cp936": "gbk"}.get(
        sample.option, sample.option
    )
    assert main(["check", "designs"]) == 0
    assert main(["docs", "behavior", "--out", "site", "--format", "markdown", *sample.options]) == 0
    assert sample.text in read_tree("site")
    assert main(["docs", "designs", "--out", "site2", "--format", "markdown"]) == 0
    assert sample.text in read_tree("site2")
    assert main(["export", "behavior/play.xabsl", "-o", "play.svg", *sample.options]) == 0
    assert sample.text in Path("play.svg").read_text("utf-8")


def test_update_changes_only_the_edited_line(sample: Sample, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", "behavior/agents.xabsl", "--out", "designs", *sample.options]) == 0
    before = contents()
    # The project knows the encoding.
    assert main(["xabsl", "update", "designs"]) == 0
    assert main(["import", "behavior/agents.xabsl", "--out", "designs"]) == 0
    assert contents() == before
    file = Path("designs/play.yaml")
    file.write_text(file.read_text("utf-8").replace("> 100", "> 150"), encoding="utf-8")
    assert main(["xabsl", "update", "designs"]) == 0
    assert contents() == {**before, "play.xabsl": before["play.xabsl"].replace(b"> 100", b"> 150")}
    assert capsys.readouterr().err == ""
    assert main(["xabsl", "update", "designs", "--check"]) == 0


def test_the_encoding_of_the_project_above_is_used(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    write_behavior(tmp_path, Sample("gbk", "等待球的状态", "\n"))
    Path("project.yaml").write_text("vicode: 1\nproject: P\nxabsl_encoding: gbk\n", encoding="utf-8")
    assert main(["xabsl", "format", "behavior"]) == 0
    assert "等待球的状态" in contents()["play.xabsl"].decode("gbk")
    assert main(["docs", "behavior", "--out", "site", "--format", "markdown"]) == 0
    assert "等待球的状态" in read_tree("site")
    Path("project.yaml").write_text("vicode: 1\nproject: P\nxabsl_encoding: koi8-r\n", encoding="utf-8")
    assert main(["docs", "behavior", "--out", "site", "--format", "markdown"]) == 0
    assert "等待球的状态" not in read_tree("site")


@pytest.mark.parametrize(
    ("encoding", "text"), [("gbk", "等待球的状态"), ("koi8-r", "ждать мяч"), ("shift_jis", "球を待つ")]
)
@pytest.mark.parametrize(
    "command",
    [
        ("xabsl", "check", "behavior/agents.xabsl"),
        ("xabsl", "compile", "behavior/agents.xabsl", "-o", "code"),
        ("xabsl", "format", "behavior"),
        ("import", "behavior/agents.xabsl", "--out", "designs"),
        ("docs", "behavior", "--out", "site", "--format", "markdown"),
        ("export", "behavior/play.xabsl", "-o", "play.svg"),
    ],
    ids=" ".join,
)
def test_bytes_that_do_not_look_like_the_assumed_encoding_are_a_warning(
    command: tuple[str, ...],
    encoding: str,
    text: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    write_behavior(tmp_path, Sample(encoding, text, "\n"))
    assert main(command) == 0
    printed = capsys.readouterr()
    assert "warning X611 doubtful-encoding" in printed.out + printed.err
    assert text in contents()["play.xabsl"].decode(encoding)


@pytest.mark.parametrize(
    "command",
    [
        ("xabsl", "check", "behavior/agents.xabsl"),
        ("xabsl", "compile", "behavior/agents.xabsl", "-o", "code"),
        ("xabsl", "format", "behavior"),
        ("import", "behavior/agents.xabsl", "--out", "designs"),
        ("docs", "behavior", "--out", "site", "--format", "markdown"),
        ("export", "behavior/play.xabsl", "-o", "play.svg"),
    ],
    ids=" ".join,
)
@pytest.mark.parametrize("option", ["utf-8", "gbk"])
def test_bytes_that_are_not_in_the_encoding_are_an_error(
    command: tuple[str, ...],
    option: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    # "é\n" is no character of GBK.
    write_behavior(tmp_path, Sample("latin-1", "café", "\n"))
    before = contents()
    assert main([*command, "--encoding", option]) == 1
    printed = capsys.readouterr()
    assert "error X612 wrong-encoding" in printed.out + printed.err
    assert "play.xabsl" in printed.out + printed.err
    assert {name: before[name] for name in ("agents.xabsl", "symbols.xabsl", "play.xabsl")} == {
        name: contents()[name] for name in ("agents.xabsl", "symbols.xabsl", "play.xabsl")
    }
    assert not any(Path(name).exists() for name in ("code", "designs", "play.svg"))


def test_an_unknown_encoding_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(["xabsl", "format", ".", "--encoding", "klingon"])
    assert "unknown encoding 'klingon'; choose from utf-8, cp1252" in capsys.readouterr().err


def test_what_is_added_has_the_encoding_of_the_behavior(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    write_behavior(tmp_path, Sample("ascii", "wait", "\n"))
    assert main(["import", "behavior/agents.xabsl", "--out", "designs", "--encoding", "gbk"]) == 0
    file = Path("designs/play.yaml")
    file.write_text(file.read_text("utf-8").replace("doc: wait", "doc: 等待", 1), encoding="utf-8")
    assert main(["xabsl", "update", "designs"]) == 0
    assert "/** 等待 */" in contents()["play.xabsl"].decode("gbk")
