"""Layouts and generated code are kept for the next process: what did not change is not computed again."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from vicode.cli import main
from vicode.diagram.layout import LayoutResult, LayoutService
from vicode.docsite import code_pages, results_path
from vicode.docsite.diagrams import LayoutMethod, NodeLayout, _encode_layout
from vicode.generators import component_generator
from vicode.model.design import Design

DESIGN = """\
vicode: 1
component: %s
outputs: {speed: float}
initial: Wait
states:
  Wait:
    transitions:
      - {to: Go, when: seen}
  Go:
    actions:
      - set: {speed: 1.5}
    transitions:
      - {to: Wait, after: 2}
"""


class Docs:
    """Runs of `vicode docs`, each as a new process would do it; `computed` are the layouts and codes since the last."""

    def __init__(self, path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        self.folder, self.out = path / "designs", path / "site"
        self.computed: list[str] = []
        self.folder.mkdir()
        for name in ("One", "Two", "Three"):
            (self.folder / f"{name.lower()}.yaml").write_text(DESIGN % name)
        (self.folder / "project.yaml").write_text("vicode: 1\nproject: Docs\nconstants: {seen: true}\n")
        compute = LayoutService.compute

        def counted(service: LayoutService, design: Design, **options: float) -> LayoutResult:
            self.computed.append(f"layout {design.component}")
            return compute(service, design, **options)

        def counting_generator(project: object, language: str, sources: object) -> object:
            generate = component_generator(project, language, sources)  # type: ignore[arg-type]

            def write(design: Design) -> object:
                self.computed.append(f"{language} {design.component}")
                return generate(design)

            return write

        monkeypatch.setattr(LayoutService, "compute", counted)
        monkeypatch.setattr(code_pages, "component_generator", counting_generator)

    def run(self, *options: str, out: Path | None = None) -> dict[str, str]:
        """Build; returns the pages."""
        self.computed.clear()
        assert main(["docs", str(self.folder), "--out", str(out or self.out), *options]) == 0
        return {path.name: path.read_text() for path in (out or self.out).iterdir()}

    def edit(self) -> None:
        file = self.folder / "two.yaml"
        file.write_text(file.read_text().replace("after: 2", "after: 3").replace("1.5", "2.5"))


@pytest.fixture
def docs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Docs:
    monkeypatch.setenv("VICODE_CACHE", str(tmp_path / "cache"))
    return Docs(tmp_path, monkeypatch)


def test_only_what_changed_is_computed_in_a_new_process(docs: Docs, tmp_path: Path) -> None:
    docs.run()
    first = sorted(docs.computed)
    assert {each.split()[1] for each in first} == {"One", "Two", "Three"}
    docs.edit()
    again = docs.run()
    assert sorted(docs.computed) == [each for each in first if each.endswith(" Two")]
    assert again == docs.run(out=tmp_path / "elsewhere")


def test_a_fresh_build_computes_everything(docs: Docs) -> None:
    docs.run()
    first = sorted(docs.computed)
    docs.run("--fresh")
    assert sorted(docs.computed) == first


def each_result(value: object) -> Callable[[str], str]:
    """Replaces each kept result."""

    def replaced(text: str) -> str:
        data = json.loads(text)
        return json.dumps({**data, "results": dict.fromkeys(data["results"], value)})

    return replaced


@pytest.mark.parametrize(
    "damage",
    [
        lambda _text: "",
        lambda _text: "[" * 100_000,
        lambda text: text.replace('"tool":"', '"tool":"x'),
        lambda text: json.dumps({**json.loads(text), "results": 1}),
        each_result(None),
        each_result([[]]),
        each_result("12345"),
    ],
)
def test_a_damaged_file_counts_as_empty(docs: Docs, tmp_path: Path, damage: Callable[[str], str]) -> None:
    docs.run()
    file = results_path(docs.out)
    file.write_text(damage(file.read_text()))
    docs.edit()
    assert docs.run() == docs.run(out=tmp_path / "elsewhere")


def test_a_layout_that_replaces_a_late_one_is_not_kept() -> None:
    layout = NodeLayout(states={"Go": (1.0, 2.0)}, uses={}, common=(0.0, 0.0))
    assert _encode_layout(LayoutResult(layout=layout, method=LayoutMethod.GRAPHVIZ)) is not None
    assert _encode_layout(LayoutResult(layout=layout, method=LayoutMethod.LAYERS)) is None
