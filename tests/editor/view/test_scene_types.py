"""What the canvas reads of a scene is what Python declares, and nothing else is sent."""

import re
from pathlib import Path
from typing import Any, get_args, get_type_hints

import pytest
from hypothesis import given, settings

from tests.strategies.designs import designs
from vicode.editor.view import make_scene
from vicode.editor.view.scene_types import SCENE_LISTS, Scene, SceneCommon, SceneItem
from vicode.model.design import Design
from vicode.model.project import Project

SCRIPTS = Path(__file__).parents[3] / "vicode" / "editor" / "canvas" / "js"
SOURCE = "\n".join(path.read_text(encoding="utf-8") for path in sorted(SCRIPTS.glob("*.js")))
TYPES = (*get_args(SceneItem), SceneCommon)
KEYS = {key for each in TYPES for key in get_type_hints(each)}


def test_the_canvas_reads_only_declared_keys() -> None:
    read = {*re.findall(r"(?<![\w$])data\.(\w+)", SOURCE)}
    assert len(read) > 20
    assert read <= KEYS


@pytest.mark.parametrize("key", sorted(KEYS))
def test_the_canvas_reads_every_key(key: str) -> None:
    assert re.search(rf"(?<![\w$]){key}(?![\w$])", SOURCE)


@settings(max_examples=settings().max_examples // 4)
@given(designs)
def test_scenes_have_the_declared_keys(design: Design) -> None:
    scene: Any = make_scene(Project(name="p", designs=(design,)), design, (), 3)
    assert scene.keys() == get_type_hints(Scene).keys()
    types = dict(zip(SCENE_LISTS, get_args(SceneItem), strict=True))
    for name in SCENE_LISTS:
        assert all(item.keys() == get_type_hints(types[name]).keys() for item in scene[name])
    assert scene["common"] is None or scene["common"].keys() == get_type_hints(SceneCommon).keys()
