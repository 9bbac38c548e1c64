"""The faults of `benchmarks.planted_faults` can be planted."""

import ast

import pytest

from benchmarks.fault_table import RUNTIME_FAULTS, Fault
from benchmarks.fault_tests import TESTS
from benchmarks.generator_faults import GENERATOR_FAULTS
from benchmarks.mutants import ROOT

FAULTS = (*RUNTIME_FAULTS, *GENERATOR_FAULTS)


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: "-".join(fault.key))
def test_fault_replaces_a_text_that_occurs_once(fault: Fault) -> None:
    planted = fault.plant((ROOT / fault.file).read_text(encoding="utf-8"))
    if fault.file.endswith(".py"):
        ast.parse(planted)


def test_faults_differ_in_their_words() -> None:
    assert len({fault.key for fault in FAULTS}) == len(FAULTS)


def test_each_fault_has_tests() -> None:
    assert all(any(fault.file.startswith(start) for start in TESTS) for fault in FAULTS)
    assert all((ROOT / file).is_file() for files in TESTS.values() for file in files)
