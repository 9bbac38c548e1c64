"""The model of a team for SPIN; `python -m benchmarks.teams` lets SPIN search it."""

from pathlib import Path

import pytest

from vicode.cli import main
from vicode.diagram.export_formats import EXPORT_FORMATS, ExportOptions, NotExportableError
from vicode.model.design import Design, State, Transition

_PROJECT = "vicode: 1\nproject: carry\n"
_CARRIER = """\
vicode: 1
component: Carrier
uses: {lift: Lift}
initial: Queue
states:
  Queue: {transitions: [{to: Door}]}
  Door: {capacity: 1, transitions: [{to: Work}]}
  Work: {modulates: {lift: {}}, transitions: [{to: Rest, when: done(lift)}]}
  Rest: {final: true}
"""
_LIFT = """\
vicode: 1
component: Lift
initial: Wait
states:
  Wait: {transitions: [{to: Up}]}
  Up: {synchronized: 2, final: true}
"""
_MODEL = """\
#define s0_Queue 0
#define s1_Door 1
#define s2_Work_Wait 2
#define s3_Work_Up 3
#define s4_Rest 4
short at[2]; /* the states of the robots */

/* Carrier: Door */
#define inside0(r) (at[r] == s1_Door)
#define inside0_count (inside0(0) + inside0(1))
/* Lift: Up */
#define inside1(r) (at[r] == s3_Work_Up)
#define inside1_count (inside1(0) + inside1(1))
#define active1(r) (at[r] == s2_Work_Wait || at[r] == s3_Work_Up)
#define active1_count (active1(0) + active1(1))
#define ready1(r) (at[r] == s2_Work_Wait)
#define ready1_count (ready1(0) + ready1(1))

active [2] proctype robot() {
  do
  :: atomic { at[_pid] == s0_Queue && inside0_count < 1 -> at[_pid] = s1_Door }
  :: atomic { at[_pid] == s1_Door -> at[_pid] = s2_Work_Wait }
  :: atomic { at[_pid] == s3_Work_Up -> at[_pid] = s4_Rest }
  :: at[_pid] == s4_Rest -> break
  od
}

active proctype together1() {
"""


def test_robots_places_and_barriers_are_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, text in (("project", _PROJECT), ("carrier", _CARRIER), ("lift", _LIFT)):
        (tmp_path / f"{name}.yaml").write_text(text, encoding="utf-8")
    assert main(["export", str(tmp_path / "carrier.yaml"), "--format", "promela", "-o", "-"]) == 0
    written = capsys.readouterr().out
    assert _MODEL in written
    barrier = written.partition("proctype together1() {\n")[2]
    assert (
        "active1_count >= 2 && ready1_count > 0 &&\n       ready1_count + inside1_count == active1_count ->" in barrier
    )
    assert ":: r < 2 && at[r] == s2_Work_Wait -> at[r] = s3_Work_Up; r++" in barrier


def test_one_robot_runs_a_design_that_coordinates_nothing() -> None:
    design = Design(
        component="Lamp",
        initial="on",
        states=(State(name="on", transitions=(Transition(to="off"),)), State(name="off")),
    )
    written = EXPORT_FORMATS["promela"].write(design, ExportOptions()).decode()
    assert "active [1] proctype robot()" in written
    assert ":: atomic { at[_pid] == s0_on -> at[_pid] = s1_off }\n  :: at[_pid] == s1_off -> break" in written


@pytest.mark.parametrize(("capacity", "only"), [(255, None), (1, frozenset({"on"}))])
def test_what_spin_cannot_have_is_refused(capacity: int, only: frozenset[str] | None) -> None:
    states = (State(name="on", transitions=(Transition(to="off"),)), State(name="off", capacity=capacity))
    with pytest.raises(NotExportableError):
        EXPORT_FORMATS["promela"].write(Design(component="Lamp", initial="on", states=states), ExportOptions(only=only))
