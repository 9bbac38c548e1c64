"""Generated classes of components that a profile assigns to topics of ROS 2."""

from dataclasses import replace
from pathlib import Path

from tests.check.test_topics import PROJECT
from tests.generators.code_tools import format_diff, lint_errors, write_files
from vicode.generators import generate
from vicode.model.design import Declaration
from vicode.model.project import select_profile


def test_a_topic_has_the_same_interface(tmp_path: Path) -> None:
    files = generate(select_profile(PROJECT, "ros2"))
    texts = {Path(file.path).name: file.text for file in files}
    code = texts["interfaces.py"]
    assert "from vicode.bica.ros_topic import TopicComponent" in code
    assert 'outputs={"nearest": "min(ranges)"}' in code
    assert "max_age=0.5" in code
    assert 'parameters={"speed": "linear.x"}' in code
    assert "self.nearest = 9.0" in code
    # The runtime sets it.
    assert "self.is_alive" not in code
    write_files(files, tmp_path)
    assert format_diff(tmp_path) == ""
    assert lint_errors(tmp_path) == ""


def test_other_profiles_do_not_import_ros() -> None:
    assert all("ros_topic" not in file.text for file in generate(PROJECT))


def test_tunable_constants_have_their_limits(tmp_path: Path) -> None:
    near = Declaration(name="near", initial="1.0", tunable=True, range=(0.2, 5.0))
    plain = Declaration(name="far", initial="9.0")
    profile = replace(PROJECT.profiles[0], tune=True)
    project = replace(PROJECT, constants=(near, plain), profiles=(profile,))
    files = generate(select_profile(project, "ros2"))
    assert any('tunable={"near": (0.2, 5.0)}' in file.text for file in files)
    assert all("tunable=" not in file.text for file in generate(project))
    write_files(files, tmp_path)
    assert format_diff(tmp_path) == ""
