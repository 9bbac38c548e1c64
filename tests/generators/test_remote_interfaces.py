"""Generated classes of components that a profile assigns to other robots."""

from pathlib import Path

from tests.generators.code_tools import format_diff, lint_errors, write_files
from vicode.generators import generate
from vicode.model.design import Declaration, Design, State, Use
from vicode.model.project import Enumeration, Interface, Profile, Project, RemoteReference, select_profile

OUTPUTS = (
    Declaration(name="found", type="bool"),
    Declaration(name="side", type="Side", initial="Side.left"),
    Declaration(name="is_alive", type="bool", initial="true"),
    Declaration(name="data_age", type="float"),
)
EYES = Interface(
    component="Eyes",
    implementation="field.eyes:Eyes",
    parameters=(Declaration(name="zoom", type="float", initial="2"),),
    outputs=OUTPUTS,
)
PROJECT = Project(
    name="Search",
    enumerations=(Enumeration(name="Side", elements=(("left", ""), ("right", ""))),),
    components=(EYES, Interface(component="Legs", implementation="field.legs:Legs")),
    designs=(
        Design(
            component="Player",
            uses=(Use(alias="eyes", component="Eyes"), Use(alias="legs", component="Legs")),
            initial="Look",
            states=(State(name="Look", requires=("eyes", "legs")),),
        ),
    ),
    profiles=(
        Profile(
            name="split",
            components=(
                RemoteReference(component="Eyes", remote="camera/Eyes", reliable=True, max_age=0.5),
                RemoteReference(component="Legs", remote="body/Legs"),
            ),
        ),
    ),
)


def test_a_remote_component_has_the_same_interface(tmp_path: Path) -> None:
    files = generate(select_profile(PROJECT, "split"))
    texts = {Path(file.path).name: file.text for file in files}
    code = texts["interfaces.py"]
    assert 'super().__init__(root, "camera/Eyes", reliable=True, max_age=0.5)' in code
    assert 'super().__init__(root, "body/Legs")' in code
    assert "self.zoom = 2.0" in code
    assert "self.side = declarations.Side.left" in code
    # The runtime sets them.
    assert "self.is_alive" not in code
    assert "self.data_age" not in code
    assert "from .interfaces import Eyes, Legs" in texts["player.py"]
    write_files(files, tmp_path)
    assert format_diff(tmp_path) == ""
    assert lint_errors(tmp_path) == ""


def test_other_profiles_do_not_import_the_network() -> None:
    assert all("remote" not in file.text for file in generate(PROJECT))
