"""Generated classes of components that a profile assigns to topics of ROS 2."""

from pathlib import Path

from tests.check.test_topics import PROJECT
from tests.generators.code_tools import format_diff, lint_errors, write_files
from vicode.generators import generate
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
