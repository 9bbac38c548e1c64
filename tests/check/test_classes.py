"""Hand-written classes are compared with project.yaml by reading their source."""

import pytest

from vicode.check.classes import check_classes
from vicode.model.design import Declaration
from vicode.model.project import Interface, Project

EYES = Interface(
    component="Eyes",
    implementation="robot.eyes:Eyes",
    frequency_hz=10,
    outputs=(Declaration(name="seen", type="bool"), Declaration(name="near", arguments=(Declaration(name="x"),))),
    parameters=(Declaration(name="pan"),),
)
HEAD = "from vicode.bica import Component\n\n\n"
SOUND = (
    HEAD
    + """class Eyes(Component):
    frequency_hz = 10.0

    def __init__(self, root):
        super().__init__(root)
        self.seen, self.other = False, 1

    def near(self, x):
        return x > 1

    def modulate(self, *, pan=0.0):
        self._pan = pan
"""
)


def findings(text: str, interface: Interface = EYES) -> list[tuple[str, int]]:
    project = Project(name="P", components=(interface,))
    modules = {"robot.eyes": ("robot/eyes.py", text)}
    found = list(check_classes(project, modules.get))
    assert all(each.location and each.location.file == "robot/eyes.py" for each in found)
    return [(each.message, each.location.line) for each in found if each.location]


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("", "", []),
        ("self.seen, self.other = False, 1", "pass", [("'Eyes' has no attribute 'seen'", 4)]),
        ("    def near(self, x):\n        return x > 1\n", "", [("'Eyes' has no attribute 'near'", 4)]),
        ("pan=0.0", "tilt=0.0", [("'modulate' has no parameter 'pan'", 14)]),
        ("pan=0.0", "pan, tilt", [("'modulate' requires 'tilt', which project.yaml does not declare", 14)]),
        ("*, pan=0.0", "**given", []),
        ("modulate", "set", [("'Eyes' has no method 'modulate'", 4)]),
        ("10.0", "20", [("'Eyes' runs at 20 Hz, but project.yaml declares at 10 Hz", 5)]),
        ("10.0", "RATE", []),
        ("    frequency_hz = 10.0\n", "", [("'Eyes' runs on every step, but project.yaml declares at 10 Hz", 4)]),
        ("class Eyes", "class Ears", [("robot/eyes.py has no class 'Eyes'", 1)]),
        ("self.seen, self.other = False, 1", "for name in NAMES: setattr(self, name, 0)", []),
        ("(Component)", "(Camera)", []),
        ("class Eyes", "class (", []),
    ],
)
def test_differences_are_found(old: str, new: str, expected: list[tuple[str, int]]) -> None:
    text = SOUND.replace(old, new) if old else SOUND
    assert findings(text) == expected


def test_an_output_without_arguments_is_no_method() -> None:
    method = "def seen(self):\n        return True"
    text = SOUND.replace("self.seen, self.other = False, 1", "pass").replace("def near", f"{method}\n\n    def near")
    message = "'seen' is a method, but project.yaml declares it without arguments"
    assert findings(text) == [(message, 11)]
    assert findings(text.replace("    def seen", "    @property\n    def seen")) == []


def test_bases_in_the_same_module_count() -> None:
    text = SOUND.replace("class Eyes", "class Sensor") + "\n\nclass Eyes(Sensor):\n    pass\n"
    assert findings(text) == []


def test_modules_outside_the_folder_and_generated_classes_are_not_read() -> None:
    project = Project(name="P", components=(EYES, Interface(component="World", implementation="world")))
    assert list(check_classes(project, lambda _module: None)) == []


BALL = Interface(
    component="Ball",
    implementation="world",
    outputs=(
        Declaration(name="ball_seen", type="bool", xabsl_name="ball.seen"),
        Declaration(name="near", arguments=(Declaration(name="x"),)),
    ),
)
WALK_TO = Interface(component="WalkTo", implementation="world", parameters=(Declaration(name="speed"),))
WORLD = """class Field:
    ball_seen = False

    def near(self, x):
        return x > 1

    def walk_to(self, speed):
        pass
"""


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("", "", []),
        ("ball_seen", "ball_scene", ["'Field' has no attribute 'ball_seen', which Ball uses"]),
        ("near", "far", ["'Field' has no method 'near', which Ball uses"]),
        ("walk_to", "walk", ["'Field' has no method 'walk_to', which WalkTo uses"]),
        ("Field", "Ground", ["robot/field.py has no class 'Field'"]),
        ("ball_seen = False", "def __getattr__(self, name): return 0", []),
        ("Field:", "Field(Ground):", []),
        ("Field:", "Field(:", []),
    ],
)
def test_a_world_has_what_components_use(old: str, new: str, expected: list[str]) -> None:
    project = Project(name="P", world="robot.field:Field", components=(BALL, WALK_TO))
    modules = {"robot.field": ("robot/field.py", WORLD.replace(old, new) if old else WORLD)}
    assert [each.message for each in check_classes(project, modules.get)] == expected
    assert [*check_classes(project, modules.get, ())] == []
