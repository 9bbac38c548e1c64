"""A formatter changes no code, and any other change is one."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given

from tests.generators.code_tools import write_files
from tests.generators.sound_designs import project_of, sound_designs
from vicode.generators import generate
from vicode.model.design import Design
from vicode.output import OutputFile
from vicode.store import open_project
from vicode.sync.same_code import is_same_code

ROOT = Path(__file__).parents[2]
FILES = {file.path: file.text for file in generate(open_project(ROOT / "designs" / "forward").project)}
RESCUE = {file.path: file.text for file in generate(open_project(ROOT / "designs" / "rescue").project)}
PATH = "python/forward/player.py"
PLAYER = FILES[PATH]


def ruff(folder: Path, *arguments: str) -> dict[str, str]:
    """Return the files after a command of ruff that changes them."""
    write_files((OutputFile(path=path, text=text) for path, text in FILES.items()), folder)
    command = [sys.executable, "-m", "ruff", *arguments, "--isolated", "--no-cache", "--quiet", "."]
    subprocess.run(command, cwd=folder, check=True)
    return {path: (folder / path).read_text(encoding="utf-8") for path in FILES}


def test_every_generated_file_may_be_reformatted(tmp_path: Path) -> None:
    narrow = ruff(tmp_path, "format", "--line-length", "60")
    style = ("--config", "format.indent-style='tab'", "--config", "format.quote-style='single'")
    tabs = ruff(tmp_path, "format", *style)
    for path, text in FILES.items():
        assert is_same_code(text, narrow[path]), path
        assert is_same_code(tabs[path], narrow[path]), path
        assert is_same_code(text, text.replace("\n", "\r\n")), path
    assert narrow[PATH] != PLAYER
    assert "\t\tif" in tabs[PATH]


def test_imports_may_be_sorted_in_another_way(tmp_path: Path) -> None:
    single = ruff(tmp_path, "check", "--select", "I", "--fix", "--config", "lint.isort.force-single-line=true")[PATH]
    assert single.count("from .declarations import") > 5
    assert is_same_code(PLAYER, single)


def test_bodies_of_regions_are_ignored() -> None:
    assert is_same_code(PLAYER, PLAYER.replace("log.info(", "log.debug((("))
    assert is_same_code(PLAYER, re.sub(r"(Kick.enter) \w{8}", r"\1 00000000", PLAYER))


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("neck_tilt > near_tilt", "neck_tilt >= near_tilt"),
        ("# ball at the feet", "# ball at the foot"),
        ("            # ball at the feet\n", ""),
        ("# after 0.5 s", "# after 0.6 s"),
        ('"""Kick, with', '"""Kick with'),
        ("frequency_hz = 10", "frequency_hz = 20"),
        ("        self._call(self.face_ball)\n        self._call(self.kicker", "        self._call(self.kicker"),
        ("import Component, State", "import Component, State, arithmetic"),
        ("    def _in_kick(", "    # now\n    def _in_kick("),
        ("# <vicode Kick.enter ", "# <vicode Kick.leave "),
        ('            self._change_to("GetUp")\n            return True\n        return', "            return"),
        ("def _in_kick(", "def ("),
    ],
)
def test_edits_are_seen(old: str, new: str) -> None:
    assert old in PLAYER
    assert not is_same_code(PLAYER, PLAYER.replace(old, new, 1))
    assert not is_same_code(PLAYER.replace(old, new, 1), PLAYER)


@pytest.mark.parametrize("path", [path for path in RESCUE if path.endswith(".xabsl")])
def test_xabsl_is_compared_by_tokens(path: str) -> None:
    text = RESCUE[path]
    assert is_same_code(text, re.sub(r"\n *", "\r\n\t", text), "//")
    word = re.findall(r"\w+", text)[-1]
    assert not is_same_code(text, text[: text.rindex(word)] + "other" + text[text.rindex(word) :], "//")


@given(sound_designs())
def test_code_is_the_same_as_itself(design: Design) -> None:
    for file in generate(project_of(design)):
        assert is_same_code(file.text, file.text.replace("\n", "\r\n"))
        assert not is_same_code(file.text, file.text + "x = 1\n")
