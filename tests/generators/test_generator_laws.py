"""Properties of code generated from random designs."""

import ast
import tempfile
from dataclasses import replace
from pathlib import Path

from hypothesis import Phase, assume, given, settings
from hypothesis import strategies as st

from tests.generators.code_tools import format_diff, write_files
from tests.generators.sound_designs import docs, project_of, sound_designs, words
from tests.strategies.designs import designs, projects
from vicode import regions
from vicode.check import check_project
from vicode.findings import Severity
from vicode.generators import UnsoundDesignError, generate
from vicode.generators.python.text import comment, docstring, quoted
from vicode.model.design import Design
from vicode.model.disabled import strip_disabled
from vicode.model.project import Project
from vicode.output import compare_files
from vicode.sync import find_file_edits


def is_sound(project: Project) -> bool:
    return not any(finding.severity is Severity.ERROR for finding in check_project(project))


@given(sound_designs(), words)
def test_code_of_sound_designs_compiles(design: Design, text: str) -> None:
    project = project_of(design, text)
    assume(is_sound(project))
    files = generate(project)
    for file in files:
        compile(file.text, file.path, "exec", dont_inherit=True)
        result = regions.find_regions(file.text)
        assert not result.findings
        assert not any(regions.is_edited(region) for region in result.regions)
    assert files == generate(project)


@given(sound_designs())
def test_disabled_elements_are_not_generated(design: Design) -> None:
    project = project_of(design)
    assume(is_sound(project))
    assert generate(project) == generate(project_of(strip_disabled(design)))


# Shrinking would run the formatter thousands of times.
@settings(
    max_examples=max(8, settings.default.max_examples // 20), phases=[Phase.explicit, Phase.reuse, Phase.generate]
)
@given(st.lists(sound_designs(), min_size=1, max_size=4))
def test_code_is_formatted(some: list[Design]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        for number, design in enumerate(some):
            project = project_of(design)
            if is_sound(project):
                write_files(generate(project), Path(folder) / f"number_{number}")
        assert format_diff(Path(folder)) == ""


@given(projects, st.lists(designs, max_size=2))
def test_any_project_gives_code_that_compiles_or_is_rejected(project: Project, some: list[Design]) -> None:
    unique = {design.component: design for design in some}
    whole = replace(project, designs=tuple(unique.values()))
    try:
        files = generate(whole, languages=["python"])
    except UnsoundDesignError:
        assert not is_sound(whole)
        return
    if is_sound(whole):
        for file in files:
            compile(file.text, file.path, "exec", dont_inherit=True)


@given(docs)
def test_docs_stay_inside_docstrings(text: str) -> None:
    source = f"class A:\n{docstring(text, 4)}\n"
    (node,) = ast.parse(source).body
    assert isinstance(node, ast.ClassDef)
    assert len(node.body) == 1
    assert (ast.get_docstring(node) or "").split() == regions.escape_marks(text).split()


@given(docs)
def test_comments_stay_inside_comments(text: str) -> None:
    lines = comment(text, 4)
    assert all(line.startswith("    # ") for line in lines)
    assert ast.parse("\n".join(lines)).body == []


@given(st.text())
def test_strings_evaluate_to_their_text(text: str) -> None:
    assert ast.literal_eval(quoted(text)) == text


@settings(max_examples=max(15, settings.default.max_examples // 8))
@given(sound_designs())
def test_generated_code_is_not_edited(design: Design) -> None:
    project = project_of(design)
    assume(is_sound(project))
    with tempfile.TemporaryDirectory() as name:
        write_files(generate(project), Path(name))
        different = generate(project, sources={design.component: "other.yaml"})
        differences = compare_files(different, Path(name))
        assert any(difference.old != difference.new for difference in differences)
        old = {difference.path: difference.old or "" for difference in differences}
        assert find_file_edits(differences, different, lambda path: [old[path]]) == ()
