"""The configurations of docs/network.md are accepted by zenoh, and its profile by the format."""

import re
from pathlib import Path

import pytest
import zenoh

from vicode.store import read_project_file

PAGE = (Path(__file__).parents[2] / "docs" / "network.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("text", re.findall(r"```json5 \S+\n(.*?)```", PAGE, re.DOTALL))
def test_configurations_are_valid(text: str) -> None:
    assert "peer" in str(zenoh.Config.from_json5(text))


def test_the_profile_is_valid() -> None:
    text = re.findall(r"```yaml\n(.*?)```", PAGE, re.DOTALL)[0]
    assert read_project_file(text).findings == ()
