"""Random projects of the strategies as files, with the code that they need to run."""

from dataclasses import replace
from functools import cache
from pathlib import Path

from tests.conformance.random_designs import draw_projects
from vicode.model.project import Project
from vicode.store import save_design, save_project_file

PARTS = """\
import math
from vicode.bica import Component


class World:
    seen, distance, side, led = False, 0.0, "left", False

    def advance(self, now_ns):
        count = now_ns // 20_000_000
        self.seen = count % 3 == 0
        self.distance = 10.0 * math.sin(count)
        self.side = "right" if count % 2 else "left"

    def bearing(self, x, y):
        return self.distance + x - y

    def legs(self, speed, side):
        pass


class Legs(Component):
    load = 1.0

    def modulate(self, *, speed=0.0, side=None):
        self.speed, self.side = speed, side

    def wear(self, times=2.0):
        return int(times) if math.isfinite(times) else 0
"""


def write_random_project(folder: Path, number: int) -> None:
    """Write one of the projects that are drawn with the same seed."""
    project = random_project(number)
    folder.mkdir(parents=True)
    texts = {"project.yaml": save_project_file(project), "parts.py": PARTS}
    texts |= {f"{design.component.lower()}.yaml": save_design(design) for design in project.designs}
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")


def random_project(number: int) -> Project:
    return replace(_draw()[number], world="parts:World")


@cache
def _draw() -> tuple[Project, ...]:
    return tuple(draw_projects(6, seed=1))
