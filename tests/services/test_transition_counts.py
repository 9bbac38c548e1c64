"""Counts of traces belong to transitions by their ids, or by their ends if a trace has no id."""

from vicode.analysis.machines import MachineAnalysis
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.services.transition_counts import count_by_path, list_never_taken
from vicode.store import read_design

TEXT = """\
vicode: 1
component: Player
initial: A
common:
  transitions: [{to: C, after: 9}]
states:
  A: {transitions: [{id: near, to: B, after: 1}, {id: far, to: B, after: 2}]}
  B: {transitions: [{to: A, after: 1}]}
  C: {}
"""


def player() -> Design:
    design = read_design(TEXT).design
    assert design is not None
    return design


def test_an_id_names_one_of_several_transitions() -> None:
    counts = count_by_path(player(), {("A", "B", "far"): 3, ("B", "A", ""): 2})
    assert counts == {("states", "A", "transitions", 1): 3, ("states", "B", "transitions", 0): 2}


def test_transitions_with_the_same_ends_share_a_count_without_an_id() -> None:
    counts = count_by_path(player(), {("A", "B", ""): 4})
    assert sorted(counts.values()) == [4, 4]


def test_a_common_transition_counts_for_states_without_an_own_one() -> None:
    counts = count_by_path(player(), {("B", "C", ""): 1})
    assert counts == {("common", "transitions", 0): 1}
    design = player()
    machine = MachineAnalysis(Project(name="p", designs=(design,)), design)
    listed = list(list_never_taken(machine, {("B", "C", ""): 1}))
    # The second transition to B would wait longer than the first.
    assert listed == [("A → B", True), ("A → B", False), ("B → A", True)]
