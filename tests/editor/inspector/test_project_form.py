"""The forms of project.yaml: their fields in the file, and the ids of what they list."""

from dataclasses import replace

from vicode.editor.session.forms.form_data import FormWriter
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.session.forms.marks import project_marks
from vicode.editor.session.forms.project_places import find_project_place, node_path, resolve_in_project
from vicode.findings import Finding, FindingSubject, get_rule
from vicode.model.design import Declaration, Design, Use
from vicode.model.project import Agent, Enumeration, Interface, Project

OUTPUT = Declaration(name="near", arguments=(Declaration(name="limit", type="float"),))
PROJECT = Project(
    name="p",
    enumerations=(
        Enumeration(name="Side", elements=(("left", "L"), ("right", "R")), xabsl_elements=(("right", "r"),)),
    ),
    constants=(Declaration(name="net", initial="3"), Declaration(name="far", initial="9")),
    components=(
        Interface(component="Eyes", frequency_hz=15, outputs=(OUTPUT,), parameters=(Declaration(name="zoom"),)),
    ),
    agents=(Agent(name="one", root="Eyes"),),
)


def test_fields_are_found_read_and_written_where_they_stand_in_the_file() -> None:
    ids = ListIds()
    for path, in_file, text in (
        (("project", "languages"), ("languages",), "python"),
        (("project", "constants", "0", "initial"), ("constants", "net", "value"), "3"),
        (("project", "enumerations", "0", "elements", "1", "doc"), ("enumerations", "Side", "elements", "right"), "R"),
        (("project", "enumerations", "0", "elements", "1", "xabsl"), ("enumerations", "Side", "xabsl_elements"), "r"),
        (("project", "components", "0", "frequency_hz"), ("components", "Eyes", "frequency"), "15"),
        (
            ("project", "components", "0", "parameters", "0", "initial"),
            ("components", "Eyes", "parameters", "zoom", "default"),
            "",
        ),
        (("project", "agents", "0", "root"), ("agents", "one", "root"), "Eyes"),
    ):
        place = find_project_place(PROJECT, ids, path)
        assert place is not None
        assert place.file_path == in_file
        assert place.field.read(place.node.get(PROJECT)) == text
    place = find_project_place(PROJECT, ids, ("project", "enumerations", "0", "elements", "0", "xabsl"))
    assert place is not None
    changed = place.node.update(PROJECT, lambda node: place.field.write(node, "l"))
    assert changed.enumerations[0].xabsl_elements == (("left", "l"), ("right", "r"))


def test_what_is_no_field_of_the_project_is_not_found() -> None:
    ids = ListIds()
    for path in (
        (),
        ("project",),
        ("constants", "0", "unit"),
        ("project", "constants", "0"),
        ("project", "constants", "9", "unit"),
        ("project", "constants", "0", "name"),
        ("project", "designs"),
        ("project", "agents", "0", "__class__"),
    ):
        assert find_project_place(PROJECT, ids, path) is None


def test_ids_stay_with_what_others_rename_move_and_remove() -> None:
    ids = ListIds()
    assert resolve_in_project(PROJECT, ids, ("project", "constants", "1")) == ("constants", 1)
    # A design that changes makes another project, with the same declarations.
    project = replace(PROJECT, designs=(Design(component="Player"),))
    project = replace(project, constants=project.constants[1:])
    assert resolve_in_project(project, ids, ("project", "constants", "1")) == ("constants", 0)
    assert resolve_in_project(project, ids, ("project", "constants", "0")) is None
    renamed = replace(PROJECT.components[0], component="Camera")
    project = replace(project, components=(Interface(component="Legs"), renamed))
    ids.of_project(project)
    eyes = ids.of_project(project).ids(("components",), project.components)
    project = replace(project, components=(renamed,))
    path = resolve_in_project(
        project, ids, ("project", "components", eyes[1], "outputs", "0", "arguments", "0", "unit")
    )
    assert path == ("components", 0, "outputs", 0, "arguments", 0, "unit")
    assert node_path(path[:-1]).name(project) == "limit"


def test_a_new_node_gets_the_id_that_the_browser_has_given_it() -> None:
    ids = ListIds()
    ids.of_project(PROJECT).want(("enumerations", 0, "elements"), "bwxyz1")
    side = PROJECT.enumerations[0]
    project = replace(PROJECT, enumerations=(replace(side, elements=(*side.elements, ("both", ""))),))
    known = ids.of_project(project).ids(("enumerations", 0, "elements"), project.enumerations[0].elements)
    assert known == ("0", "1", "bwxyz1")


def test_findings_stand_at_the_fields_of_the_project() -> None:
    subject = FindingSubject(component="", path=("constants", "far", "value"))
    marks = project_marks(PROJECT, ListIds(), [Finding(rule=get_rule("D403"), message="wrong", subject=subject)])
    assert [(mark["path"], mark["message"]) for mark in marks] == [("project/constants/1/initial", "wrong")]


def test_the_form_of_a_design_is_not_written_again_when_only_the_project_changes() -> None:
    design = Design(component="Player", uses=(Use(alias="eyes", component="Eyes"),))
    writer, ids = FormWriter(), ListIds()
    before = writer.write(PROJECT, design, ids)
    changed = replace(PROJECT, constants=(replace(PROJECT.constants[0], unit="m"), PROJECT.constants[1]))
    after = writer.write(changed, design, ids)
    assert [key for key in after if after[key] != before[key]] == ["project/"]
    assert "project/components/0" in after
