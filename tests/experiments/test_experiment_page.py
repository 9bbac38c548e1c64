"""The page of an experiment, from runs that were made up: faults of the robot, and the option of the thesis."""

import re
from dataclasses import replace

from tests.experiments.test_charts import BOX, GATE, make_tracks
from vicode.experiments.definitions import EXPERIMENTS
from vicode.experiments.page import VersionResult, write_page
from vicode.experiments.runs import FaultResult, RunResult, RunsResult
from vicode.simulated_robot.faults import FAULTS
from vicode.store import read_design


def make_version(title: str, problem: str = "", **more: object) -> VersionResult:
    run = RunResult(
        world_map=BOX, seed=1, tracks=make_tracks("wait inside"), time_s=1.0, problem=problem, overshoot_deg=None
    )
    return VersionResult(title=title, result=RunsResult(runs=(run,), wall_s=1.0), **more)  # type: ignore[arg-type]


def write(*versions: VersionResult) -> str:
    design = read_design(GATE.encode(), "gate.yaml").design
    assert design is not None
    return write_page(replace(EXPERIMENTS["circle"], thesis_design=""), design, versions)


def test_the_option_of_the_thesis_need_not_succeed() -> None:
    page = write(
        make_version("design"), make_version("XABSL"), make_version("as printed", "touched", is_reference=True)
    )
    assert "2 of 2 runs have succeeded." in page
    assert "<p>The option as printed succeeded in 0 of 1 runs: 1 × touched.</p>" in page
    assert "in 1 of 1 runs" in page


def test_runs_with_faults_are_rows() -> None:
    (track,) = make_tracks("wait inside inside")
    track.points = [replace(point, command_age_ms=10.0 * number) for number, point in enumerate(track.points, 1)]
    track.notices += ["commands are at rest: LASER is older than 0.5 s", "newer commands wait"]
    fault = next(each for each in FAULTS if each.name == "lost sensor")
    page = write(make_version("design", faults=(FaultResult(fault=fault, tracks=(track,)),)))
    cells = re.findall(r"<td[^>]*>([^<]*)</td>", page[page.index("Faults of the robot") :])
    assert cells[:9] == [
        *("lost sensor", "design", "2.0 ms", "2.0 ms", "20.0 ms", "30.0 ms", "1", "0"),
        "It sends no laser from 5 to 8 s.",
    ]
