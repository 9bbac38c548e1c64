"""vicode trace: the statistics of runs, and the differences of two."""

import json
import re
import sys
from pathlib import Path

import pytest

from tests.cli.command_runner import LAMP, PROJECT, lamps, vicode

__all__ = ["lamps"]


def record(name: str, seconds: float) -> None:
    assert vicode("run", "lamps/lamp.yaml", "--seconds", str(seconds), "--trace", name) == 0


def test_states_and_transitions_of_several_runs_are_counted(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (lamps / "lamp.yaml").write_text(LAMP + "  Off: {transitions: [{to: Dark}]}\n")
    record("one", 1)
    record("two", 0.5)
    capsys.readouterr()
    assert vicode("trace", "stats", "one", "two", "--design", "lamps", "--component", "Lamp", "--svg", "heat.svg") == 0
    out = capsys.readouterr().out
    assert out.startswith("2 runs, 1.46 s\n\nLamp\n")
    rows = [line.split() for line in out.splitlines()]
    assert [row[:2] for row in rows if row and row[0] in ("Dark", "Lit", "Off")][:3] == [
        ["Lit", "5"],
        ["Dark", "6"],
        ["Off", "never"],
    ]
    assert ["Dark", "→", "Lit", "5"] in rows
    # No transition leads to it.
    assert ["Off", "→", "Dark", "never", "it", "cannot", "occur"] in rows
    svg = Path("heat.svg").read_text()
    assert set(re.findall(r">(\d× \d+%|\d×|never)<", svg)) >= {"5×", "4×", "never"}
    assert "never entered" in svg


def test_segments_of_one_run_are_one_run(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    record("whole", 1)
    header, *lines, _summary = Path("whole").read_text().splitlines()
    for run in (1, 2):
        for segment in range(1, 6):
            part = [json.dumps({**json.loads(header), "segment": segment}), *lines[segment * 10 - 10 : segment * 10]]
            Path(f"robot.{run}.{segment:06}.jsonl").write_text("\n".join(part) + "\n")
    capsys.readouterr()
    assert vicode("trace", "stats", "whole") == 0
    whole = capsys.readouterr().out
    names = [f"robot.1.{segment:06}.jsonl" for segment in (3, 1, 5, 2, 4)]
    for given in (names, [*names, names[0]], ["robot.jsonl"]):
        assert vicode("trace", "stats", *given) == 0
        assert capsys.readouterr().out == whole
    assert vicode("trace", "stats", *names, *(str(path) for path in Path().glob("robot.2.*"))) == 0
    assert capsys.readouterr().out.startswith("2 runs, 1.96 s\n")


def test_two_runs_are_compared(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    record("one", 1)
    (lamps / "lamp.yaml").write_text(LAMP.replace("after: 0.2", "after: 0.3"))
    record("two", 0.8)
    capsys.readouterr()
    assert vicode("trace", "diff", "one", "one") == 0
    assert capsys.readouterr().out.endswith("same states for 0.98 s\n")
    assert vicode("trace", "diff", "one", "two") == 1
    out = capsys.readouterr().out
    assert out.endswith("first difference: 0.300 s, Lamp: Dark in A, Lit in B\n")
    assert re.search(r"^Lamp Lit +3 +0\.60 +2 +0\.58 +-0\.02$", out, re.MULTILINE), out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("stats", "one", "--svg", "x.svg"), "--svg draws on the diagram of a design; give it with --design"),
        (("stats", "one", "--component", "Torch"), "no trace has states of Torch; known are Lamp, Bulb"),
        (("stats", "lamps/lamp.yaml"), "lamps/lamp.yaml: line 1 is not JSON"),
        (("diff", "one", "nowhere"), "nowhere"),
    ],
)
def test_mistakes_are_reported(
    lamps: Path, capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], message: str
) -> None:
    record("one", 0.4)
    capsys.readouterr()
    assert vicode("trace", *arguments) == 2
    assert message in capsys.readouterr().err


def test_a_trace_is_exported_as_mcap(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from mcap.reader import make_reader

    record("one", 0.4)
    capsys.readouterr()
    assert vicode("trace", "export", "one", "--mcap", "one.mcap") == 0
    assert capsys.readouterr().out == "wrote one.mcap, 30 messages\n"
    with Path("one.mcap").open("rb") as stream:
        messages = [
            (channel.topic, message.log_time, json.loads(message.data)["state"])
            for _schema, channel, message in make_reader(stream).iter_messages()
        ]
    assert messages[:2] == [("/Lamp", 0, "Dark"), ("/Lamp", 20_000_000, "Dark")]
    assert ("/Bulb", 100_000_000, "On") in messages


def test_an_exported_topic_has_one_message_per_time_with_the_same_fields(
    lamps: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from mcap.reader import make_reader

    (lamps / "project.yaml").write_text(
        PROJECT + "world: sky:Sky\ncomponents:\n  Sun: {implementation: world, outputs: {angle: float}}\n"
    )
    (lamps / "sky.py").write_text("class Sky:\n    angle = 30.0\n")
    text = LAMP.replace("{bulb: Bulb}", "{bulb: Bulb, sun: Sun}").replace("Dark:\n", "Dark:\n    requires: [sun]\n")
    (lamps / "lamp.yaml").write_text(text)
    assert vicode("run", "lamps/lamp.yaml", "--seconds", "1", "--trace", "one", "--values") == 0
    assert vicode("trace", "export", "one", "--mcap", "one.mcap") == 0
    found: dict[str, dict[int, set[str]]] = {}
    with Path("one.mcap").open("rb") as stream:
        for _schema, channel, message in make_reader(stream).iter_messages():
            times = found.setdefault(channel.topic, {})
            assert message.log_time not in times
            times[message.log_time] = set(json.loads(message.data))
    assert len(found["/Sun"]) == 50
    assert {topic: set.union(*times.values()) for topic, times in found.items()} == {
        topic: set.intersection(*times.values()) for topic, times in found.items()
    }
    assert found["/Sun"][0] == {"angle", "state", "transition", "worked"}


def test_the_export_says_which_package_is_missing(
    lamps: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    record("one", 0.1)
    monkeypatch.setitem(sys.modules, "mcap.writer", None)
    assert vicode("trace", "export", "one", "--mcap", "one.mcap") == 2
    assert "pip install 'vicode-fsm[mcap]'" in capsys.readouterr().err
