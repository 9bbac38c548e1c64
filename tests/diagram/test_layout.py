"""Layout with Graphviz in its worker process, and its failures."""

import os
import signal
import subprocess
import sys
import threading
from dataclasses import replace
from pathlib import Path

import pytest

from tests.diagram.diagram_designs import HOSTILE_NAMES, find_overlaps, list_boxes, ring_design, shipped_designs
from tests.diagram.layouts import compute_layout
from vicode.diagram.layered_layout import complete_layout
from vicode.diagram.layout import WORKER_COMMAND, LayoutMethod, LayoutResult, LayoutService
from vicode.diagram.layout_fit import fit_layout, layered_positions, screens_needed
from vicode.model.design import CommonSection, Design, State, Transition

PATIENCE_S = 60.0


@pytest.mark.parametrize("design", shipped_designs(), ids=lambda design: design.component)
def test_shipped_designs_are_laid_out_the_same_each_time_without_overlaps(design: Design) -> None:
    with LayoutService() as service:
        first, second = (service.compute(design, timeout_s=PATIENCE_S) for _ in range(2))
    assert first == second
    assert (first.method, first.note) == (LayoutMethod.GRAPHVIZ, "")
    _assert_sound(design, first)


def test_layers_are_used_if_graphviz_needs_far_more_space() -> None:
    design = ring_design(300, chords=3)
    layout = compute_layout(design, timeout_s=PATIENCE_S)
    assert layout.method == LayoutMethod.LAYERS
    assert "times as large; used a layered layout instead" in layout.note
    assert screens_needed(layout.layout.states.values()) < 6
    _assert_sound(design, layout)


def test_layers_place_the_common_decisions_beside_the_states() -> None:
    common = CommonSection(transitions=(Transition(to="State1"),), at=(9000, 9000))
    design = replace(ring_design(4), common=common)
    layout = fit_layout(design, layered_positions(design, None), None)
    assert max(layout.common) < 2000
    assert screens_needed([*layout.states.values(), layout.common]) < 2


def test_the_layout_of_the_player_fits_a_screen() -> None:
    (design,) = (design for design in shipped_designs() if design.component == "Player")
    placement = compute_layout(design, timeout_s=PATIENCE_S).layout
    assert screens_needed([*placement.states.values(), *placement.uses.values()]) < 1.1


def test_any_text_can_be_a_name() -> None:
    names = HOSTILE_NAMES
    leads = (names[(2 * index + 1) % len(names)] for index in range(len(names)))
    states = tuple(State(name=name, transitions=(Transition(to=to),)) for name, to in zip(names, leads, strict=True))
    layout = compute_layout(Design(component="D", initial=names[0], states=states), timeout_s=PATIENCE_S)
    assert (layout.method, layout.note) == (LayoutMethod.GRAPHVIZ, "")
    assert set(layout.layout.states) == set(names)
    assert not find_overlaps(list_boxes(Design(component="D", states=states), layout.layout))


def test_a_design_without_states_has_a_layout() -> None:
    assert compute_layout(Design(component="D")).layout.states == {}


def test_layout_needs_no_dot_program(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert compute_layout(ring_design(12), timeout_s=PATIENCE_S).method == LayoutMethod.GRAPHVIZ


def test_without_library_and_program_layers_are_used(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    _hide_library(monkeypatch, tmp_path)
    layout = compute_layout(ring_design(12), timeout_s=PATIENCE_S)
    assert layout.method == LayoutMethod.LAYERS
    assert "could not be run" in layout.note
    _assert_sound(ring_design(12), layout)


def test_an_installed_dot_replaces_the_library(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    program = tmp_path / "dot"
    program.write_text(f"#!{sys.executable}\nprint('graph 1 10 10\\nnode s0 5 5 1 1 A\\nnode s1 5 1 1 1 B\\nstop')\n")
    program.chmod(0o700)
    _hide_library(monkeypatch, tmp_path)
    monkeypatch.setenv("PATH", str(tmp_path))
    layout = compute_layout(ring_design(2, chords=0), timeout_s=PATIENCE_S)
    assert layout == LayoutResult(layout=layout.layout, method=LayoutMethod.GRAPHVIZ)
    (x, y), (below_x, below_y) = layout.layout.states.values()
    assert below_x == x
    assert below_y == pytest.approx(y + 4 * 72, abs=5)


def test_a_timeout_falls_back_to_layers_and_the_next_request_is_served() -> None:
    design = ring_design(800, chords=3)
    with LayoutService() as service:
        late = service.compute(design, timeout_s=0.2)
        assert late.method == LayoutMethod.LAYERS
        assert late.note == "Graphviz took longer than 0.2 s; used a layered layout instead"
        assert service.compute(ring_design(5), timeout_s=PATIENCE_S).method == LayoutMethod.GRAPHVIZ
    _assert_sound(design, late)


def test_a_killed_worker_is_replaced() -> None:
    suicidal = (sys.executable, "-c", "import os, signal; input(); os.kill(os.getpid(), signal.SIGKILL)")
    with LayoutService(suicidal) as service:
        layout = service.compute(ring_design(5), timeout_s=PATIENCE_S)
        assert layout.note == "Graphviz stopped unexpectedly; used a layered layout instead"
        assert service.compute(ring_design(5), timeout_s=PATIENCE_S) == layout


def test_a_worker_killed_between_two_requests_is_replaced() -> None:
    with LayoutService() as service:
        before = service.compute(ring_design(5), timeout_s=PATIENCE_S)
        process = service._process
        assert process is not None
        os.kill(process.pid, signal.SIGKILL)
        process.wait()
        assert service.compute(ring_design(5), timeout_s=PATIENCE_S) == before


def test_closing_from_another_thread_ends_a_request() -> None:
    service = LayoutService((sys.executable, "-c", "import time; time.sleep(600)"))
    closing = threading.Timer(0.5, service.close)
    closing.start()
    layout = service.compute(ring_design(5), timeout_s=PATIENCE_S)
    closing.join()
    service.close()
    assert layout.method == LayoutMethod.LAYERS


def test_a_program_that_cannot_be_started_is_reported() -> None:
    with LayoutService(("no-such-program-here",)) as service:
        assert "No such file" in service.compute(ring_design(3)).note


def test_a_thousand_states_get_an_answer() -> None:
    design = ring_design(1000)
    layout = compute_layout(design, timeout_s=10.0)
    assert len(set(layout.layout.states.values())) == 1000


def test_output_of_the_library_is_not_a_response() -> None:
    program = (
        "import os; from vicode.diagram.worker import _private_stdout\n"
        "with _private_stdout() as answers: os.write(1, b'noise'); answers.write('answer')"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert (ended.stdout, ended.stderr) == ("answer", "noise")


@pytest.mark.parametrize("command", [WORKER_COMMAND, ("no-such-program-here",)], ids=["graphviz", "layers"])
def test_selected_states_stay_near_their_old_positions(command: tuple[str, ...]) -> None:
    (design,) = (design for design in shipped_designs() if design.component == "Player")
    moved = {state.name for state in design.states[1:5]}
    before = complete_layout(design)
    with LayoutService(command) as service:
        after = service.compute(design, only=moved, timeout_s=PATIENCE_S).layout
    rest = set(before.states) - moved
    assert {name: after.states[name] for name in rest} == {name: before.states[name] for name in rest}
    assert (after.uses, after.common) == (before.uses, before.common)
    assert any(after.states[name] != before.states[name] for name in moved)
    boxes = list_boxes(design, after)
    assert not find_overlaps(boxes, apart_from=[name for name in boxes if name.removeprefix("state ") not in moved])


def test_a_free_position_is_kept() -> None:
    far = tuple(State(name=name, at=(5000.0, 3000.0)) for name in ("A", "B"))
    design = Design(component="D", states=(*far, State(name="C", at=(0.0, 0.0))))
    after = compute_layout(design, only={"A", "B", "unknown"}, timeout_s=PATIENCE_S).layout.states
    (left, top), (right, bottom) = after["A"], after["B"]
    assert (abs(left + right - 10000) <= 20, abs(top + bottom - 6000) <= 20) == (True, True)
    assert not find_overlaps(list_boxes(design, complete_layout(replace(design, states=_at(design, after)))))


def test_the_editor_process_imports_neither_library() -> None:
    program = (
        "import sys, vicode.diagram.layout\nsys.exit(', '.join({'graphviz', 'pygraphviz'} & set(sys.modules)) or None)"
    )
    subprocess.run([sys.executable, "-c", program], check=True)


def _at(design: Design, places: dict[str, tuple[float, float]]) -> tuple[State, ...]:
    return tuple(replace(state, at=places[state.name]) for state in design.states)


def _hide_library(monkeypatch: pytest.MonkeyPatch, folder: Path) -> None:
    """Shadow the real library by a module that cannot be imported."""
    (folder / "pygraphviz.py").write_text("raise ImportError('no wheel for this machine')\n")
    monkeypatch.setenv("PYTHONPATH", str(folder))


def _assert_sound(design: Design, layout: LayoutResult) -> None:
    assert not find_overlaps(list_boxes(design, layout.layout))
    moved = [*layout.layout.states.values(), *layout.layout.uses.values()]
    if layout.method == LayoutMethod.GRAPHVIZ:
        assert all(coordinate % 10 == 0 for point in moved for coordinate in point)
