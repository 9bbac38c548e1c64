"""The generated code of a design that may still have mistakes."""

from dataclasses import dataclass, replace

from vicode.generators import generate
from vicode.model.design import Design
from vicode.model.names import snake_case
from vicode.model.project import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class Preview:
    """The text to show and a line above it."""

    note: str
    text: str


def preview_of(project: Project, design: Design) -> Preview:
    """The Python module of a design as `vicode gen` would write it; no file is touched."""
    designs = tuple(design if each.component == design.component else each for each in project.designs)
    files = generate(replace(project, designs=designs), components=(design.component,), languages=("python",))
    wanted = f"/{snake_case(design.component)}.py"
    for file in files:
        if f"/{file.path}".endswith(wanted):
            return Preview(note=file.path, text=file.text)
    return Preview(note="No code: mend the errors of the design first", text="")
