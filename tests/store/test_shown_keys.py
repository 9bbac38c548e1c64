"""Each key of the format is shown: a change of its value alone changes the differences, the diagram with its tooltips,
the forms and the documentation site.

The changes are derived from the model, so a new key is covered by itself. The keys that are not shown have a reason.
"""

from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass, replace
from fnmatch import fnmatchcase
from typing import Any

import pytest

from tests.strategies.field_changes import Place, full_value, iter_changes
from vicode.docsite.site_builder import build_site
from vicode.docsite.site_input import SiteInput
from vicode.editor.session.forms.form_data import FormWriter
from vicode.editor.session.forms.list_ids import ListIds
from vicode.editor.view import ItemRef, tooltip_sections
from vicode.editor.view.scene import make_scene
from vicode.editor.view.selection import ItemKind
from vicode.model.decision_keys import transition_key
from vicode.model.design import Code, Design, State, Transition
from vicode.model.lowering import lower_design
from vicode.model.project import Interface, Project
from vicode.model.traversal import iter_decisions, iter_transitions
from vicode.services.design_diff.file_differences import FileDifference, compare_pair
from vicode.services.design_diff.file_pairs import FileVersion, VersionPair
from vicode.store import save_design, save_project_file

FULL = full_value(Project)
DESIGN = FULL.designs[0]
STATE = DESIGN.states[0]
OTHER = "Other"
NAMES = {
    FULL.languages[0]: "python",
    STATE.requires[0]: DESIGN.uses[0].alias,
    DESIGN.frames[0].states[0]: STATE.name,
    DESIGN.initial: STATE.name,
    f"{DESIGN.initial}x": OTHER,
    **{located.decision.to: OTHER for located in iter_decisions(DESIGN) if isinstance(located.decision, Transition)},
}
"""The texts of the invented project that must refer to something."""
CHOICES = {
    "arithmetic": ("", "xabsl"),
    "time_unit": ("ms", "s"),
    "color": ("blue", "red"),
    "clock": ("world", ""),
    "xabsl_encoding": ("gbk", "big5"),
}
"""The value, and the other value, of fields with a choice."""


def with_names(value: Any) -> Any:
    """The value with names that refer to something in the place of invented ones."""
    match value:
        case str():
            return NAMES.get(value, value)
        case tuple():
            return tuple(with_names(each) for each in value)
        case Code(texts=((language, text), *_)):
            return Code(texts=(("cpp" if language.endswith("x") else "python", text),))
        case _ if not is_dataclass(value) or isinstance(value, type):
            return value
    values = {field.name: with_names(getattr(value, field.name)) for field in fields(value) if field.init}
    if "disabled" in values:
        values["disabled"] = not values["disabled"]
    values |= {name: choices[values[name].endswith("x")] for name, choices in CHOICES.items() if name in values}
    if isinstance(value, Design):
        values["states"] = (*values["states"], State(name=OTHER))
    if isinstance(value, Interface):
        values["remote"], values["tunable"] = None, ()
    return replace(value, **values)


def field_at(value: Any, place: Place) -> str:
    """The last field on the way to a place, such as "State.doc"."""
    found = ""
    for step in place:
        if isinstance(step, str):
            found = f"{type(value).__name__}.{step}"
        value = getattr(value, step) if isinstance(step, str) else value[step]
    return found


PROJECT = with_names(FULL)
CHANGES: dict[str, list[Project]] = defaultdict(list)
"""The projects that differ in one field, by the field."""
for place, changed in iter_changes(FULL, frozenset({"unreadable"})):
    other = with_names(changed)
    is_valid = len(changed.designs) == 1 and all(each.elements for each in changed.enumerations)
    if is_valid and other != PROJECT:
        CHANGES[field_at(FULL, place)].append(other)


def draw(project: Project) -> object:
    """What the canvas draws of the design, and its tooltips."""
    (design,) = project.designs
    names: dict[ItemKind, list[str]] = {
        "states": [state.name for state in design.states],
        "transitions": [transition_key(located.path) for located in iter_transitions(design)],
        "components": [use.alias for use in design.uses],
        "frames": [frame.name for frame in design.frames],
        "common": ["@common"],
    }
    items = [ItemRef(kind=kind, id=name) for kind, found in names.items() for name in found]
    return make_scene(project, design, (), 0), [tooltip_sections(project, design, item) for item in items]


def write_forms(project: Project) -> object:
    return FormWriter().write(project, project.designs[0], ListIds())


def write_site(project: Project) -> object:
    return [file.text for file in build_site(SiteInput(project=project))]


_FOR_RUNS = "for runs of the project"
_DERIVED = "positions of what a competence or layers mean, which this design has not"
_IN_FILE = "edited in project.yaml"
_IN_XABSL = "shown in the place of the name if the project comes from XABSL"
NOT_SHOWN: Mapping[Callable[[Project], object], Mapping[str, str]] = {
    draw: {
        "*.id": "written by the editor",
        **dict.fromkeys(("Stay.*", "DecisionGroup.*"), "labels show guards only; other decisions are not drawn"),
        **dict.fromkeys(("Design.*", "Declaration.*", "*Property.*"), "the form of the design shows them"),
        "DerivedPosition.*": _DERIVED,
        **dict.fromkeys(("Latch.*", "Interrupt.*", "Competence*.*", "Layer.*"), "what they mean is drawn"),
        **dict.fromkeys(("Project.*", "Enumeration.*", "Interface.*", "Agent.*"), "the diagram is that of a design"),
        **dict.fromkeys(
            ("Profile.*", "ProfileClass.*", "RemoteReference.*", "TopicReference.*", "BridgeSettings.*"), _FOR_RUNS
        ),
    },
    write_forms: {
        "*.id": "written by the editor",
        **dict.fromkeys(("*.at", "*.label_at"), "moved in the diagram"),
        **dict.fromkeys(("Design.positions", "DerivedPosition.name"), _DERIVED),
        **dict.fromkeys(
            ("Project.clock", "Project.generated", "Project.live", "Project.xabsl_encoding", "Project.profiles"),
            _IN_FILE,
        ),
        **dict.fromkeys(
            ("Profile.*", "ProfileClass.*", "RemoteReference.*", "TopicReference.*", "BridgeSettings.*"), _IN_FILE
        ),
    },
    write_site: {
        "*.id": "written by the editor",
        **dict.fromkeys(("Design.positions", "DerivedPosition.*"), _DERIVED),
        **dict.fromkeys(("State.xabsl_name", "Declaration.xabsl_name"), _IN_XABSL),
        **dict.fromkeys(("Agent.xabsl_name", "Enumeration.xabsl_elements"), "of interest to the XABSL engine only"),
        **dict.fromkeys(("Project.world", "Project.clock", "Project.profiles"), _FOR_RUNS),
        **dict.fromkeys(
            ("Project.generated", "Project.live", "Project.xabsl_encoding"), "of interest to generators only"
        ),
        **dict.fromkeys(
            ("Profile.*", "ProfileClass.*", "RemoteReference.*", "TopicReference.*", "BridgeSettings.*"), _FOR_RUNS
        ),
    },
}
"""The fields that are not shown, as patterns, with the reason."""


@pytest.mark.parametrize("show", NOT_SHOWN)
def test_a_change_of_each_key_is_shown(show: Callable[[Project], object]) -> None:
    before = show(PROJECT)
    assert show(with_names(full_value(Project))) == before
    hidden = [field for field, changed in CHANGES.items() if all(show(each) == before for each in changed)]
    patterns = NOT_SHOWN[show]
    assert [field for field in hidden if not any(fnmatchcase(field, each) for each in patterns)] == []
    assert [each for each in patterns if not any(fnmatchcase(field, each) for field in hidden)] == []


def test_a_change_of_each_key_is_a_difference_of_files() -> None:
    before = save(PROJECT)
    for field, projects in CHANGES.items():
        pairs = [pair for project in projects for pair in zip(before, save(project), strict=True)]
        assert any(compare_texts(*pair).changes for pair in pairs if pair[0] != pair[1]), field


def save(project: Project) -> tuple[str, str]:
    return save_design(lower_design(project.designs[0])), save_project_file(project)


def compare_texts(old: str, new: str) -> FileDifference:
    versions = [FileVersion(name="a.yaml", content=text.encode()) for text in (old, new)]
    return compare_pair(VersionPair(old=versions[0], new=versions[1], is_explicit=True))
