"""The probes of a component evaluate its guards as the component does."""

import ast
import importlib
from pathlib import Path

import pytest
from hypothesis import assume, given

from tests.generators.sound_designs import project_of, sound_designs
from tests.generators.test_generator_laws import is_sound
from vicode.bica import Root
from vicode.generators import generate, python_class_path, python_probes
from vicode.model.decision_keys import with_decision_ids
from vicode.model.design import Design
from vicode.output import apply_diffs, compare_files
from vicode.store import read_design

DESIGN = """
vicode: 1
component: {name}
frequency: 50
variables: {{x: {{type: float, initial: 2}}, on: {{type: bool, initial: true}}}}
initial: A
common:
  transitions: [{{to: B, when: x > 99, id: far}}]
states:
  A:
    transitions:
      - {{when: on, then: [{{to: B, when: x / 0 > 1e9 and x < 3}}], else: [{{to: A, after: 1}}]}}
      - {{to: B, when: x > 0, code: "return self.x > 1"}}
  B: {{}}
"""


@given(sound_designs())
def test_probes_compile_and_list_every_guard(design: Design) -> None:
    assume(is_sound(project_of(design)))
    text = python_probes(project_of(with_decision_ids(design)), design.component).text
    module = ast.parse(text)
    names = [node.targets[0].id for node in module.body if isinstance(node, ast.Assign)]  # type: ignore[attr-defined]
    assert names == ["GUARDS", "READS", "ENUMERATIONS"]


def test_probes_evaluate_guards(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    design = read_design(DESIGN.format(name="Probed"), "probed.yaml").design
    assert design is not None
    project = project_of(with_decision_ids(design))
    files = [*generate(project, components=["Probed"]), python_probes(project, "Probed")]
    apply_diffs(compare_files(files, tmp_path), tmp_path)
    monkeypatch.syspath_prepend(tmp_path / "python")
    module, _colon, name = python_class_path(project, "Probed").partition(":")
    main = Root(getattr(importlib.import_module(module), name)).main
    probes = importlib.import_module(f"{module.partition('.')[0]}._probes")

    assert list(probes.GUARDS) == ["@common", "A", "B"]
    assert list(probes.GUARDS["A"]) == ["A/0", "A/0/then/0", "A/0/else/0", "A/1"]
    held = {key: [part(main) for part in parts[:1]] for key, parts in probes.GUARDS["A"].items()}
    assert held == {"A/0": [True], "A/0/then/0": [True], "A/0/else/0": [False], "A/1": [True]}
    assert probes.GUARDS["A"]["A/1"][1] == "_when_a_1"
    assert hasattr(main, "_when_a_1")
    assert {name: read(main) for name, read in probes.READS["A/1"].items()} == {"x": 2.0}
    assert [part(main) for part in probes.GUARDS["@common"]["@common/0"]] == [False]
