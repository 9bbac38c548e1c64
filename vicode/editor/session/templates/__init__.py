"""Templates for new designs, stored as design files in this folder."""

from dataclasses import dataclass, replace
from pathlib import Path

from vicode.model.design import Design
from vicode.model.edits import rename_use
from vicode.model.names import snake_case
from vicode.model.project import Interface, Project
from vicode.model.texts import TextKind, iter_texts, rewrite_text
from vicode.store import read_design, save_design

_FOLDER = Path(__file__).parent
_NAMES = ("empty", "two_states", "timer_and_retry", "follow_what_is_seen")
# The alias and the output of the sensor in the template `follow_what_is_seen`.
_SENSE, _SEEN = "sense", "seen"


@dataclass(frozen=True, slots=True, kw_only=True)
class Template:
    """A template; `title` and `doc` are shown to the user."""

    name: str
    title: str
    doc: str
    text: str
    design: Design


def list_templates() -> tuple[Template, ...]:
    """All templates, the simplest first."""
    return tuple(_template(name) for name in _NAMES)


def instantiate_template(template: Template, component: str, project: Project) -> str:
    """The text of a new design, with the comments and the order of the template.

    The description of the empty template would be wrong after the first edit.
    """
    design = replace(template.design, component=component, doc="" if template.name == _NAMES[0] else template.doc)
    if design.use(_SENSE) is not None:
        design = _bind_sensor(design, project)
    return save_design(design, template.text)


def _template(name: str) -> Template:
    text = (_FOLDER / f"{name}.yaml").read_text(encoding="utf-8")
    design = read_design(text, f"{name}.yaml").design
    assert design is not None, "the templates of the package can be read"
    title = name.replace("_", " ").capitalize()
    return Template(name=name, title=title, doc=design.doc, text=text, design=design)


def _bind_sensor(design: Design, project: Project) -> Design:
    """Replace the sensor by the first component of the project with a boolean output; unchanged if there is none."""
    found = next(
        (
            (interface, seen)
            for interface in project.interfaces().values()
            if (seen := _first_boolean_output(interface))
        ),
        None,
    )
    if found is None:
        return design
    interface, seen = found
    uses = tuple(replace(use, component=interface.component) for use in design.uses)
    design = replace(design, uses=uses)
    for located in iter_texts(design):
        if located.kind is TextKind.EXPRESSION:
            design = rewrite_text(
                design, located.path, lambda text: text.replace(f"{_SENSE}.{_SEEN}", f"{_SENSE}.{seen}")
            )
    return rename_use(design, _SENSE, snake_case(interface.component))


def _first_boolean_output(interface: Interface) -> str:
    """The first boolean output without arguments, empty if there is none."""
    return next((output.name for output in interface.outputs if output.type == "bool" and not output.arguments), "")
