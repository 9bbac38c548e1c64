"""`vicode rename`: every kind of name, in all files or none."""

import json
import shutil
from pathlib import Path

import pytest

from tests.cli.command_runner import lamps, vicode
from vicode.store import open_project

__all__ = ["lamps"]

DESIGNS = Path(__file__).parents[2] / "designs" / "forward"


@pytest.fixture
def forward(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shutil.copytree(DESIGNS, tmp_path / "forward")
    monkeypatch.chdir(tmp_path)
    return tmp_path / "forward"


def texts(folder: Path) -> dict[str, str]:
    return {file.name: file.read_text(encoding="utf-8") for file in folder.rglob("*.yaml")}


def first_names(folder: Path) -> list[tuple[str, str]]:
    """One qualified name of each kind and its kind."""
    project = open_project(folder).project
    player = next(design for design in project.designs if design.component == "Player")
    names = [
        ("Player", "component"),
        (f"Player.{player.states[0].name}", "state"),
        (f"Player.{player.uses[0].alias}", "use"),
    ]
    names += [(enumeration.name, "enumeration") for enumeration in project.enumerations[:1]]
    names += [(f"{each.name}.{each.element_names[0]}", "element") for each in project.enumerations[:1]]
    names += [(constant.name, "constant") for constant in project.constants[:1]]
    for section, kind in (("parameters", "parameter"), ("outputs", "output"), ("variables", "variable")):
        owners = ((name, getattr(each, section)) for name, each in project.interfaces().items())
        names += [(f"{name}.{declared[0].name}", kind) for name, declared in owners if declared][:1]
    return names


def test_every_kind_of_name_can_be_renamed_and_renamed_back(forward: Path) -> None:
    before = texts(forward)
    names = first_names(forward)
    assert {kind for _name, kind in names} >= {"component", "state", "use", "parameter", "output", "element"}
    for name, kind in names:
        owner, dot, last = name.rpartition(".")
        new = f"{last}New" if last[0].isupper() else f"{last}_new"
        assert vicode("rename", name, new, "forward", "--kind", kind) == 0, name
        after = texts(forward)
        assert after != before
        assert vicode("check", "forward") == 0, name
        assert vicode("rename", f"{owner}{dot}{new}", last, "forward", "--kind", kind) == 0, name
        assert texts(forward) == before, name


def test_a_state(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = texts(lamps)
    assert vicode("rename", "Lamp.Dark", "Lamp.Off", "lamps") == 0
    assert capsys.readouterr().out == "wrote lamps/lamp.yaml\n"
    after = texts(lamps)
    assert "  Off:\n" in after["lamp.yaml"]
    assert "Dark" not in after["lamp.yaml"].replace("id: Dark", "")
    assert {**after, "lamp.yaml": ""} == {**before, "lamp.yaml": ""}


def test_a_dry_run_prints_a_diff(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = texts(lamps)
    assert vicode("rename", "pause", "delay", "lamps", "--dry-run") == 0
    out = capsys.readouterr().out
    assert "--- a/lamps/lamp.yaml\n+++ b/lamps/lamp.yaml\n" in out
    assert "+    transitions: [{to: Lit, after: delay}]\n" in out
    assert "+constants: {delay: 0.1}\n" in out
    assert texts(lamps) == before


def test_a_component_takes_its_file_along(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert vicode("rename", "Bulb", "LightBulb", "lamps", "--dry-run") == 0
    assert "--- a/lamps/bulb.yaml\n+++ b/lamps/light_bulb.yaml\n" in capsys.readouterr().out
    assert vicode("rename", "Bulb", "LightBulb", "lamps") == 0
    assert not (lamps / "bulb.yaml").exists()
    assert "uses: {bulb: LightBulb}" in texts(lamps)["lamp.yaml"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("Lamp.Drak", "Off"), "there is no 'Lamp.Drak'; did you mean 'Lamp.Dark'?"),
        (("Lamp.Dark", "Lit"), "there is already a state Lit"),
        (("Lamp.Dark", "Off", "--kind", "use"), "there is no use 'Lamp.Dark': it is a state"),
        (("Bulb", "Lamp"), ""),
        (("pause", "not"), ""),
    ],
)
def test_refused(lamps: Path, capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], message: str) -> None:
    before = texts(lamps)
    old, new, *options = arguments
    assert vicode("rename", old, new, "lamps", *options) == 1
    assert message in capsys.readouterr().err
    assert texts(lamps) == before


def test_an_unreadable_design_refuses(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (lamps / "bulb.yaml").write_text("component: Bulb\nstates: [", encoding="utf-8")
    assert vicode("rename", "Lamp.Dark", "Off", "lamps") == 1
    assert "bulb.yaml cannot be read; correct it first" in capsys.readouterr().err


def test_names_in_several_projects_are_ambiguous(lamps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shutil.copytree(lamps, lamps.parent / "more")
    assert vicode("rename", "pause", "delay") == 1
    assert capsys.readouterr().err == (
        "vicode: 'pause' is ambiguous: constant in lamps, constant in more; specify --kind or the project\n"
    )


def test_all_files_or_none(lamps: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = texts(lamps)
    lamps.joinpath("project.yaml").chmod(0o444)
    assert vicode("rename", "pause", "delay", "lamps") != 0
    assert texts(lamps) == before


def run_states(folder: Path) -> list[list[str]]:
    """The states of all components in each iteration of 20 s."""
    trace = folder / "trace.jsonl"
    assert vicode("run", str(folder / "player.yaml"), "--seconds", "20", "--trace", str(trace)) == 0
    records = [json.loads(line) for line in trace.read_text(encoding="utf-8").splitlines()]
    return [[step["state"] for step in record["tree"]] for record in records if "tree" in record]


def test_hand_written_modules_are_renamed(forward: Path, capfd: pytest.CaptureFixture[str]) -> None:
    before = run_states(forward)
    capfd.readouterr()
    for old, new in (("Side.left", "port"), ("Kick", "KickMotion_"), ("KickMotion_.diagonal", "outward")):
        assert vicode("rename", old, new, "forward") == 0
    output = capfd.readouterr()
    kicker = (forward / "field" / "kicker.py").read_text(encoding="utf-8")
    assert "Side.left" not in kicker
    assert "from forward.declarations import KickMotion_, Side" in kicker
    assert "kick: KickMotion_ = KickMotion_.front, side: Side = Side.port" in kicker
    # The dictionary has the names of the elements as keys.
    assert "vicode: check by hand: field/kicks.py:" in output.err
    kicks = forward / "field" / "kicks.py"
    kicks.write_text(kicks.read_text(encoding="utf-8").replace('"diagonal"', '"outward"'), encoding="utf-8")
    assert vicode("check", "forward") == 0
    assert run_states(forward) == before


def test_a_name_that_the_project_no_longer_has_is_found(forward: Path, capsys: pytest.CaptureFixture[str]) -> None:
    kicker = forward / "field" / "kicker.py"
    kicker.write_text(kicker.read_text(encoding="utf-8").replace("Side.left", "Side.lefft"), encoding="utf-8")
    assert vicode("check", "forward") == 0
    output = capsys.readouterr().out
    assert "forward/field/kicker.py:20:27: warning P212 different-class: 'Side' has no element 'lefft'" in output
    assert "did you mean 'left'?" in output
    assert vicode("run", str(forward / "player.yaml"), "--seconds", "1") == 1


def test_profiles_with_topics_are_renamed(tmp_path: Path) -> None:
    (tmp_path / "project.yaml").write_text(
        "vicode: 1\nproject: Scouts\ncomponents:\n  Scan: {outputs: {nearest: 9.0}}\n"
        "profiles:\n  ros2:\n    components:\n"
        "      Scan: {topic: /scan, type: sensor_msgs/msg/LaserScan, outputs: {nearest: min(ranges)}}\n"
    )
    (tmp_path / "scout.yaml").write_text(
        "vicode: 1\ncomponent: Scout\nuses: {scan: Scan}\ninitial: A\nstates: {A: {requires: [scan]}}\n"
    )
    assert vicode("rename", "Scan.nearest", "closest", str(tmp_path)) == 0
    assert vicode("rename", "Scan", "Laser", str(tmp_path)) == 0
    text = texts(tmp_path)["project.yaml"]
    assert "      Laser: {topic: /scan, type: sensor_msgs/msg/LaserScan, outputs: {closest: min(ranges)}}\n" in text
