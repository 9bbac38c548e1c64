"""How often the transitions of a design were taken in traces, which know them by their ends or their ids."""

from collections.abc import Iterable, Mapping

from vicode.analysis.machines import MachineAnalysis
from vicode.findings import DesignPath
from vicode.model.design import COMMON, Design
from vicode.model.traversal import iter_transitions

CountByEnds = Mapping[tuple[str, str, str], int]
"""The counts by source, target and id; the id is "" if the trace has none."""


def count_by_path(design: Design, transitions: CountByEnds) -> dict[DesignPath, int]:
    """The counts of transitions that are known by their id or their ends.

    Several transitions without ids between the same states share a count, as a trace does not tell them apart.
    """
    counts: dict[DesignPath, int] = {}
    located_transitions = list(iter_transitions(design))
    for (source, target, given), count in transitions.items():
        by_id = [each for each in located_transitions if given and each.decision.id == given]
        ends = [each for each in located_transitions if getattr(each.decision, "to", "") == target]
        by_ends = [each for each in ends if each.source == source] or [each for each in ends if each.source == COMMON]
        for each in by_id or by_ends:
            counts[each.path] = counts.get(each.path, 0) + count
    return counts


def list_never_taken(machine: MachineAnalysis, transitions: CountByEnds) -> Iterable[tuple[str, bool]]:
    """The transitions that no trace contains, in words, and whether they can be taken at all."""
    counts = count_by_path(machine.design, transitions)
    live = {edge.path for name in machine.reachable for edge in machine.live_in(name)}
    for located in iter_transitions(machine.design):
        if not counts.get(located.path):
            source = "common" if located.source == COMMON else located.source
            yield f"{source} → {getattr(located.decision, 'to', '')}", located.path in live
