"""The functions that limit ints are no part of a design: code with and without them is read as the same design."""

from dataclasses import replace

import pytest

from tests.conformance.int_designs import int_project
from tests.sync.cpp_law import source_of
from vicode.generators import component_generator
from vicode.generators.cpp import cpp_generator
from vicode.model.design import Assign, Design
from vicode.model.project import Project
from vicode.sync.interpret import Interpretation, interpret_cpp_edits, interpret_edits

PROJECT = int_project(
    "limits",
    [
        ("sum", "int", "sensor.a + 2 * sensor.b"),
        ("product", "int", "-(p * sensor.a) + p"),
        ("is_far", "bool", "p * p + 1 > n * n"),
        ("ratio", "float", "(p * p) / sensor.a"),
        ("fast", "int", "fast + p"),
        ("slow", "int", "slow + 1"),
        ("seen", "int", "eyes.count - 1"),
    ],
)
_PYTHON_NAMES = ("arithmetic.limit", "arithmetic.saturate", "float")
_CPP_NAMES = ("bica::limit",)


def player() -> Design:
    design = PROJECT.design("Player")
    assert design is not None
    return design


def python_of(design: Design, project: Project = PROJECT) -> str:
    code = component_generator(project, "python", {"Player": "player.yaml"})(design)
    assert code is not None
    return code.file.text


PYTHON = python_of(player())
CPP = source_of(replace(PROJECT, languages=("cpp",)), "Player")


def read_python(edited: str) -> Interpretation:
    return interpret_edits(PROJECT, "Player", generated=PYTHON, edited=edited)


def read_cpp(edited: str, file: str = "player.cpp", generated: str = CPP) -> Interpretation:
    project = replace(PROJECT, languages=("cpp",))
    return interpret_cpp_edits(project, "Player", generated=generated, edited=edited, file=file)


def without(text: str, *names: str) -> str:
    """Remove calls of functions with one argument, but not the argument."""
    for name in names:
        while (start := text.find(f"{name}(")) >= 0:
            end, depth = start + len(name), 0
            while True:
                depth += {"(": 1, ")": -1}.get(text[end], 0)
                end += 1
                if depth == 0:
                    break
            inner = text[start + len(name) : end]
            text = text[:start] + inner + text[end:]
    return text


def test_only_values_that_may_be_too_large_are_limited() -> None:
    assert "self.slow += 1\n" in PYTHON
    assert "    slow += 1;\n" in CPP
    assert "self.fast = arithmetic.limit(self.fast + self.p)\n" in PYTHON
    assert "fast = bica::limit(fast + p);\n" in CPP
    assert "bica::multiply(p, p)" in CPP


def test_code_without_the_functions_is_the_same_design() -> None:
    for edited in (
        without(PYTHON, *_PYTHON_NAMES),
        PYTHON.replace("self.slow += 1", "self.slow = arithmetic.limit(self.slow + 1)"),
    ):
        assert edited != PYTHON
        found = read_python(edited)
        assert (found.design, found.edits, found.leftover) == (player(), (), "")
    for edited in (
        without(CPP, *_CPP_NAMES),
        CPP.replace("slow += 1;", "slow = bica::limit(slow + 1);"),
        CPP.replace("slow += 1;", "slow = bica::add(slow, 1);"),
        CPP.replace("bica::multiply(p, p)", "p * p"),
    ):
        assert edited != CPP
        found = read_cpp(edited)
        assert (found.design, found.edits, found.leftover) == (player(), (), "")


def test_limits_of_parameters_are_no_edit() -> None:
    assert "self.p = arithmetic.limit(p)\n" in PYTHON
    assert read_python(PYTHON.replace("self.p = arithmetic.limit(p)", "self.p = p")).leftover == ""
    assert "p = bica::limit(parameters.p);\n" in CPP
    assert read_cpp(CPP.replace("bica::limit(parameters.p)", "parameters.p")).leftover == ""


@pytest.mark.parametrize("written", ["self.fast - self.p", "arithmetic.limit(self.fast - self.p)"])
def test_an_edited_python_expression_is_read_with_and_without_the_function(written: str) -> None:
    found = read_python(PYTHON.replace("arithmetic.limit(self.fast + self.p)", written))
    assert found.leftover == ""
    assert Assign(values=(("fast", "fast - p"),)) in found.design.common.actions
    assert python_of(found.design).count("self.fast = arithmetic.limit(self.fast - self.p)\n") == 1


@pytest.mark.parametrize(
    "written", ["fast - p", "bica::limit(fast - p)", "bica::subtract(fast, p)", "fast + bica::negate(p)"]
)
def test_an_edited_cpp_expression_is_read_with_and_without_the_function(written: str) -> None:
    found = read_cpp(CPP.replace("bica::limit(fast + p)", written))
    assert found.leftover == ""
    text = "fast + -p" if "negate" in written else "fast - p"
    assert Assign(values=(("fast", text),)) in found.design.common.actions


def test_a_counter_becomes_an_assignment_that_is_limited() -> None:
    found = read_python(PYTHON.replace("self.slow += 1", "self.slow += self.p"))
    assert found.leftover == ""
    assert "self.slow = arithmetic.limit(self.slow + self.p)\n" in python_of(found.design)
    taken = read_cpp(CPP.replace("slow += 1;", "slow += p;"))
    assert (taken.design, taken.leftover) == (found.design, "")
    project = replace(PROJECT, languages=("cpp",))
    assert "slow = bica::limit(slow + p);\n" in cpp_generator(project, {})(taken.design).source
