"""The generated code of a design that may still have mistakes."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from vicode.generators import UnsoundDesignError, generate, python_class
from vicode.model.design import Design
from vicode.model.project import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class Preview:
    """The text to show and a line above it."""

    note: str
    text: str


def preview_of(project: Project, design: Design, sources: Mapping[str, str]) -> Preview:
    """The Python module of a design as `vicode gen` would write it; no file is touched.

    Args:
        project: What surrounds the design.
        design: As it is now, in place of the one of its name in the project.
        sources: The files of the designs by component, as the generated text names them.
    """
    designs = tuple(design if each.component == design.component else each for each in project.designs)
    whole = replace(project, designs=designs)
    try:
        files = generate(whole, components=(design.component,), languages=("python",), sources=sources)
        module = python_class(whole, design.component).partition(":")[0]
    except UnsoundDesignError as error:
        return Preview(note=f"No code yet: {error}", text="")
    wanted = f"{module.replace('.', '/')}.py"
    for file in files:
        if file.path.endswith(wanted):
            return Preview(note=file.path, text=file.text)
    return Preview(note="No code: this project does not generate Python", text="")
