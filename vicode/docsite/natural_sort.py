"""Natural sort order of names: case is ignored, and digits are compared as numbers."""

import re

from vicode.model.design import Design
from vicode.model.project import Project


def natural_sort_key(name: str) -> tuple[list[str | int], str]:
    parts = re.split(r"([0-9]+)", name.casefold())
    return ([int(part) if index % 2 else part for index, part in enumerate(parts)], name)


def sorted_designs(project: Project) -> list[Design]:
    return sorted(project.designs, key=lambda design: natural_sort_key(design.component))
