"""What a viewed trace shows on the canvas besides one iteration: how often and how long, and where another differs."""

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from vicode.diagram.drawn_transitions import draw_transitions
from vicode.diagram.heat_map import heat_color
from vicode.editor.view import ItemRef
from vicode.model.design import Design
from vicode.runs.design_trace import TransitionKeys
from vicode.runs.recording import Recording
from vicode.simulation import IterationResult
from vicode.traces.reader import open_trace
from vicode.traces.statistics import RunDifference, StateRun, StateStatistics, find_difference, read_history

NEVER = "never"


@dataclass(frozen=True, slots=True, kw_only=True)
class HeatMap:
    """The color of each state and transition, or `NEVER`, and its figures in words."""

    colors: Mapping[ItemRef, str]
    words: Mapping[ItemRef, str]


def measure_heat(recording: Recording, design: Design) -> HeatMap:
    """Color states by their share of the time, and transitions by their share of all that were taken.

    Transitions without ids between the same states share a count.
    """
    colors: dict[ItemRef, str] = {}
    words: dict[ItemRef, str] = {}
    states = _measure_states(recording)
    whole_ns = sum(each.total_ns for each in states.values()) or 1
    for state in design.states:
        item, known = ItemRef(kind="states", id=state.name), states.get(state.name)
        share = known.total_ns / whole_ns if known else 0.0
        colors[item] = heat_color(share) if known else NEVER
        words[item] = _describe_state(known, share) if known else "never entered"
    taken = _count_transitions(recording, design)
    most = sum(taken.values()) or 1
    for drawn in draw_transitions(design):
        item, count = ItemRef(kind="transitions", id=drawn.keys[0]), sum(taken[key] for key in drawn.keys)
        colors[item] = heat_color(count / most) if count else NEVER
        words[item] = f"taken {count} time{'s' * (count != 1)}" if count else "never taken"
    return HeatMap(colors=colors, words=words)


def compare_traces(first: Path | Iterable[IterationResult], second: Path) -> RunDifference | None:
    """The first time at which a component has different states in two traces, from their first iterations.

    Raises:
        TraceError: One of them is not a trace.
        OSError: A file cannot be read.
    """
    iterations = open_trace(first).iterations() if isinstance(first, Path) else first
    return find_difference(read_history(iterations), read_history(open_trace(second).iterations()))


def _measure_states(recording: Recording) -> dict[str, StateStatistics]:
    found: defaultdict[str, StateStatistics] = defaultdict(StateStatistics)
    states, times_ns = recording.states, recording.times_ns
    start = 0
    for index in range(1, len(states) + 1):
        if index == len(states) or states[index] != states[start]:
            end_ns = times_ns[min(index, len(states) - 1)]
            found[states[start]].add(StateRun(state=states[start], start_ns=times_ns[start], end_ns=end_ns))
            start = index
    return found


def _count_transitions(recording: Recording, design: Design) -> Counter[str]:
    keys, counts = TransitionKeys(design), Counter[str]()
    before = ""
    for state, key in zip(recording.states, recording.transitions, strict=True):
        if key:
            counts[key] += 1
        elif before and state != before:
            counts.update(keys.between(before, state))
        before = state
    return counts


def _describe_state(known: StateStatistics, share: float) -> str:
    times = f"entered {known.entries} time{'s' * (known.entries != 1)}"
    return f"{times}, {known.total_ns / 1e9:.2f} s ({share:.0%}), longest {known.longest_ns / 1e9:.2f} s"
