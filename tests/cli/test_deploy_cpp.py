"""vicode deploy --language cpp: sources that build where they are, and a launcher that builds them."""

import os
import subprocess
from pathlib import Path

import pytest

from tests.cli.command_runner import lamps, vicode
from tests.cli.test_deploy_command import RSYNC, SSH

__all__ = ["lamps"]

PROJECT = """\
vicode: 1
project: Lamps
languages: [cpp]
components:
  Sensor: {implementation: "rig:Sensor", outputs: {level: {type: float}}}
"""
LAMP = """\
vicode: 1
component: Lamp
uses: {sensor: Sensor}
initial: Dark
states:
  Dark: {requires: [sensor], transitions: [{to: Lit, when: sensor.level > 1}]}
  Lit: {final: true}
"""
SENSOR = """\
#include "lamps/components.hpp"

struct Sensor final : lamps::Sensor {
    using lamps::Sensor::Sensor;

private:
    void work() override { level += 0.5; }
};
"""
MAIN = """\
#include <cstdio>

#include "rig/sensor.hpp"

int main(int count, char** arguments) {
    bica::Root root;
    Sensor sensor(root);
    lamps::Components components(root, sensor);
    for (int step = 0; step < 5; ++step) {
        root.step(components.lamp, step * 20'000'000);
    }
    std::printf("%s %d %s\\n", components.lamp.state_name(), count, arguments[count - 1]);
    return 0;
}
"""


@pytest.fixture
def robot_program(lamps: Path) -> Path:
    (lamps / "project.yaml").write_text(PROJECT)
    (lamps / "lamp.yaml").write_text(LAMP)
    (lamps / "rig").mkdir()
    (lamps / "rig/sensor.hpp").write_text(SENSOR)
    (lamps / "main.cpp").write_text(MAIN)
    return lamps


def test_a_program_is_built_here_and_runs(
    robot_program: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "robot", "--language", "cpp", "--arguments=--fast") == 0
    assert "start it with robot/run\n" in capsys.readouterr().out
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "robot", "--language", "cpp", "--arguments=--watch 0") == 0
    assert "vicode: programs in C++ can be watched with 'live: true'" in capsys.readouterr().err
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "robot", "--language", "cpp", "--arguments=--fast") == 0
    done = subprocess.run(["robot/run", "more"], capture_output=True, text=True, check=True)
    assert done.stdout == "Lit 3 more\n"
    assert (tmp_path / "robot/lamps.service").is_file()
    (tmp_path / "robot/log").mkdir()
    (tmp_path / "robot/old.cpp").write_text("old")
    (robot_program / "main.cpp").write_text("broken")
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "robot", "--language", "cpp") == 2
    assert "robot/build.sh failed" in capsys.readouterr().err
    assert (tmp_path / "robot/log").exists()
    assert not (tmp_path / "robot/old.cpp").exists()


def test_without_cmake_the_command_is_printed(
    robot_program: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "my robot", "--language", "cpp") == 0
    assert "build it with 'my robot/build.sh', then start it with 'my robot/run'" in capsys.readouterr().out
    (tmp_path / "thesis").mkdir()
    (tmp_path / "thesis/thesis.tex").touch()
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "thesis", "--language", "cpp") == 2
    assert "did not deploy" in capsys.readouterr().err


def test_a_robot_gets_the_sources(
    robot_program: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    programs = tmp_path / "bin"
    programs.mkdir()
    for name, text in [("ssh", SSH), ("rsync", RSYNC)]:
        (programs / name).write_text(text)
        (programs / name).chmod(0o755)
    monkeypatch.setenv("PATH", f"{programs}{os.pathsep}{os.environ['PATH']}")
    place = tmp_path / "far"
    assert vicode("deploy", "lamps/lamp.yaml", "--to", f"nao@10.0.0.7:{place}", "--language", "cpp") == 0
    assert f"build it with ssh -t nao@10.0.0.7 {place}/build.sh, then" in capsys.readouterr().out
    files = {path.relative_to(place).as_posix() for path in place.rglob("*") if path.is_file()}
    assert {"generated/cpp/bica.hpp", "generated/cpp/lamps/lamp.cpp", "main.cpp", "rig/sensor.hpp", "run"} <= files
    assert "build" not in {path.name for path in place.iterdir()}


def test_the_build_files_of_the_project_are_used(
    robot_program: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (robot_program / "CMakeLists.txt").write_text("project(x)\nadd_executable( striker main.cpp)\n")
    (robot_program / "build.sh").write_text("#!/bin/sh\necho mine\n")
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "robot", "--language", "cpp") == 0
    assert (tmp_path / "robot/CMakeLists.txt").read_text().startswith("project(x)\n")
    assert (tmp_path / "robot/run").read_text().endswith('exec build/striker "$@"\n')
    assert (tmp_path / "robot/build.sh").read_text() == "#!/bin/sh\necho mine\n"


def test_a_project_without_a_program_is_refused(robot_program: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (robot_program / "main.cpp").unlink()
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "robot", "--language", "cpp") == 2
    assert "the project has no main.cpp and no CMakeLists.txt" in capsys.readouterr().err


def test_a_program_with_the_live_view_is_built_for_it(robot_program: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main = MAIN.replace("rig/sensor.hpp", 'lamps/live.hpp"\n#include "rig/sensor.hpp')
    live = "    bica::Live live(root, components.lamp, lamps::live_project(components), {count, arguments});\n    for"
    (robot_program / "main.cpp").write_text(main.replace("    for", live))
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "robot", "--language", "cpp") == 2
    assert "live.hpp, which does not exist; programs in C++ can be watched with 'live: true'" in capsys.readouterr().err
    (robot_program / "project.yaml").write_text(PROJECT + "live: true\n")
    assert vicode("deploy", "lamps/lamp.yaml", "--to", "robot", "--language", "cpp") == 0
    assert "BICA_LIVE" in Path("robot/generated/cpp/lamps/CMakeLists.txt").read_text()
    command = ["robot/run", "--watch", "0", "--record", "log/run.jsonl"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert "watch: vicode attach 127.0.0.1:" in done.stderr
    assert Path("robot/log/run.1.000001.jsonl").read_text().count("\n") == 6
