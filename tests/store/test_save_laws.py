"""Laws of saving: the saved text has the value of the design, and unchanged parts keep each byte."""

from hypothesis import given

from tests.strategies.commented_texts import fewer_examples
from tests.strategies.designs import lowered_designs, projects
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.store import read_design, read_project_file, save_design, save_project_file


@given(lowered_designs)
def test_a_saved_design_is_read_again(design: Design) -> None:
    read = read_design(save_design(design))
    assert read.findings == ()
    assert read.design == design


@given(projects)
def test_a_saved_project_is_read_again(project: Project) -> None:
    read = read_project_file(save_project_file(project))
    assert read.findings == ()
    assert read.project == project


@given(lowered_designs)
def test_an_unedited_save_keeps_every_byte(design: Design) -> None:
    text = save_design(design)
    assert save_design(design, text) == text


@fewer_examples
@given(lowered_designs, lowered_designs)
def test_any_design_can_be_saved_over_any_other(old: Design, new: Design) -> None:
    assert read_design(save_design(new, save_design(old))).design == new


@given(projects, projects)
def test_any_project_can_be_saved_over_any_other(old: Project, new: Project) -> None:
    assert read_project_file(save_project_file(new, save_project_file(old))).project == new
