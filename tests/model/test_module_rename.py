"""Renames in hand-written modules: the module does after a rename what it did before, or its lines are listed."""

import sys
from enum import Enum
from types import ModuleType
from typing import Any

import pytest

from vicode.model.rename import ReferenceKind, ReferenceRename
from vicode.model.rename.modules import find_unrenamed_lines, rename_in_module

ELEMENT = ReferenceRename(kind=ReferenceKind.ELEMENT, old="left", new="port", owner="Side")
ENUMERATION = ReferenceRename(kind=ReferenceKind.ENUMERATION, old="Side", new="Board")
CONSTANT = ReferenceRename(kind=ReferenceKind.CONSTANT, old="speed", new="pace")


def import_with(text: str, monkeypatch: pytest.MonkeyPatch, **declared: Any) -> Any:
    """Run a module beside a package with these declarations; return its `result`."""
    package, declarations = ModuleType("robot"), ModuleType("robot.declarations")
    vars(declarations).update(declared)
    package.declarations = declarations  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "robot", package)
    monkeypatch.setitem(sys.modules, "robot.declarations", declarations)
    names: dict[str, Any] = {"__name__": "hands"}
    exec(compile(text, "hands.py", "exec"), names)
    return names["result"]


def plain(value: Any) -> Any:
    return (
        value.value
        if isinstance(value, Enum)
        else [plain(each) for each in value]
        if isinstance(value, list)
        else value
    )


SURE = {
    "import": "from robot.declarations import Side, speed\nresult = [Side.left, Side.right, speed]\n",
    "alias": "from robot.declarations import Side as S, speed as v\nresult = [S.left, v]\n",
    "module": "import robot.declarations\nresult = [robot.declarations.Side.left, robot.declarations.speed]\n",
    "module alias": "import robot.declarations as d\nresult = [d.Side.left, d.speed]\n",
    "from package": "from robot import declarations\nresult = [declarations.Side.left, declarations.speed]\n",
    "default": "from robot.declarations import Side\ndef f(*, side: Side = Side.left): return side\nresult = f()\n",
    "local import": "def f():\n    from robot.declarations import Side\n    return Side.left\nresult = f()\n",
    "other left": "from robot.declarations import Side\nclass A: left = 3\nresult = [A.left, A().left, Side.left]\n",
    "umlauts": "from robot.declarations import Side\nä = 'ö'; result = [ä, Side.left, 'ü', Side.left]\n",
    "line ends": "from robot.declarations import Side\r\n\x0cresult = Side.left\r\n",
    "long": "from robot.declarations import (\n    Side,\n    speed,\n)\nresult = [\n    Side\n    .left, speed]\n",
}
UNSURE = {
    "rebound": "from robot.declarations import Side\nSide = type('Other', (), {'left': 1})\nresult = Side.left\n",
    "argument": "from robot.declarations import Side\ndef f(Side): return Side.left\nresult = f(Side)\n",
    "by name": "from robot.declarations import Side\nresult = Side['left']\n",
    "star": "from robot.declarations import *\nresult = Side.left\n",
    "getattr": "import robot.declarations as d\nresult = getattr(d.Side, 'left')\n",
}


@pytest.mark.parametrize("text", SURE.values(), ids=SURE)
@pytest.mark.parametrize("rename", [ELEMENT, ENUMERATION, CONSTANT], ids=lambda rename: rename.kind)
def test_a_module_does_the_same_after_a_rename(
    text: str, rename: ReferenceRename, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = import_with(text, monkeypatch, Side=Enum("Side", {"left": 1, "right": 2}), speed=0.5)
    elements = {"port" if rename is ELEMENT else "left": 1, "right": 2}
    side, speed = ("Board" if rename is ENUMERATION else "Side"), ("pace" if rename is CONSTANT else "speed")
    renamed = rename_in_module(text, "robot", rename)
    after = import_with(renamed, monkeypatch, **{side: Enum("Side", elements), speed: 0.5})
    assert plain(after) == plain(before)
    assert len(renamed.splitlines()) == len(text.splitlines())


@pytest.mark.parametrize("text", UNSURE.values(), ids=UNSURE)
def test_what_is_not_sure_is_listed(text: str) -> None:
    assert rename_in_module(text, "robot", ELEMENT) == text
    assert find_unrenamed_lines(text, ELEMENT)


@pytest.mark.parametrize(
    "text",
    ["from other.declarations import Side\nresult = Side.left\n", "from robot.declarations import Side\nresult = (\n"],
    ids=["other package", "syntax error"],
)
def test_other_modules_stay(text: str) -> None:
    assert rename_in_module(text, "robot", ELEMENT) == text


def test_a_new_name_that_the_module_uses_already_is_left() -> None:
    text = "from robot.declarations import Side\nresult = [Side.left, Side.port]\n"
    assert rename_in_module(text, "robot", ELEMENT) == text
    assert find_unrenamed_lines(text, ELEMENT) == [2]
