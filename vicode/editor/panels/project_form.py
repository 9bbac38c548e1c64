"""What project.yaml declares for all designs: enumerations and constants, in a fold of every design's form."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

from nicegui import ui

from vicode.editor.panels.desk import Desk
from vicode.editor.panels.fields import Bound, Field
from vicode.editor.panels.folds import fold
from vicode.editor.panels.name_field import name_field, take_declared
from vicode.editor.session.declared_names import refuse_shape
from vicode.editor.session.project_edits import Written, change_project_file, take_back
from vicode.editor.session.wording import reason_of
from vicode.model.design import Declaration, Design
from vicode.model.project import Enumeration, Project
from vicode.model.renaming import Declared

_OF_CONSTANTS = (("Value", "initial"), ("Unit", "unit"), ("Name in XABSL", "xabsl_name"), ("Doc", "doc"))


def project_form(desk: Desk, fields: list[Field]) -> None:
    """Build the fold; nothing of it if the project declares neither."""
    project = desk.workspace.project
    if not project.enumerations and not project.constants:
        return

    def build() -> None:
        ui.label("Of all designs; a change is written into project.yaml at once.").classes("empty")
        for number in range(len(project.enumerations)):
            _enumeration(desk, number, fields)
        for number in range(len(project.constants)):
            _constant(desk, number, fields)

    caption = f"{len(project.enumerations)} enumerations, {len(project.constants)} constants"
    fold(desk, "project", f"Project {project.name}", caption, build)


def _enumeration(desk: Desk, number: int, fields: list[Field]) -> None:
    found = desk.workspace.project.enumerations[number]
    spot = _Spot(section="enumerations", number=number)
    with ui.element("div").classes("declaration shared").props("role=group") as whole:
        whole.props["aria-label"] = f"enumeration {found.name}"
        fields.append(_name(desk, "Enumeration", spot, _caller(whole, "enumeration")))
        fields.append(_line(desk, spot, "Name in XABSL", "xabsl_name"))
        fields.append(_line(desk, spot, "Doc", "doc"))
        box = ui.checkbox("Internal: XABSL's engine numbers its elements").props("dense").classes("wide")
        fields.append(_FlagInFile(desk, _bound(desk, spot, "internal"), box, spot=spot))
        elements = range(len(found.elements))
        fields.extend(_name(desk, f"Element {at + 1}", replace(spot, element=at)) for at in elements)


def _constant(desk: Desk, number: int, fields: list[Field]) -> None:
    spot = _Spot(section="constants", number=number)
    with ui.element("div").classes("declaration shared").props("role=group") as whole:
        whole.props["aria-label"] = f"constant {desk.workspace.project.constants[number].name}"
        fields.append(_name(desk, "Constant", spot, _caller(whole, "constant")))
        for label, attribute in (
            ("Value", "initial"),
            ("Unit", "unit"),
            ("Name in XABSL", "xabsl_name"),
            ("Doc", "doc"),
        ):
            fields.append(_line(desk, spot, label, attribute))


@dataclass(frozen=True, slots=True, kw_only=True)
class _Spot:
    """A declaration of the project by its number, which stays when its name changes; `element` one of its elements."""

    section: str
    number: int
    element: int | None = None

    def read(self, project: Project) -> Enumeration | Declaration | None:
        found: tuple[Enumeration | Declaration, ...] = getattr(project, self.section)
        return found[self.number] if self.number < len(found) else None

    def name(self, project: Project) -> str:
        """Its name; "" when it is gone."""
        found = self.read(project)
        if self.element is None or not isinstance(found, Enumeration):
            return found.name if found else ""
        return found.element_names[self.element] if self.element < len(found.elements) else ""

    def declared(self, project: Project) -> Declared:
        """It as a thing that can be renamed."""
        found = self.read(project)
        if self.element is None or found is None:
            return Declared(section=self.section, name=self.name(project))
        return Declared(section="elements", name=self.name(project), owner=found.name)


def _same(design: Design, _value: Any) -> Design:
    return design


def _caller(whole: ui.element, kind: str) -> Callable[[str], None]:
    """Calls a group by the name of what it holds."""

    def call_it(name: str) -> None:
        whole.props["aria-label"] = f"{kind} {name}"
        whole.update()

    return call_it


def _name(desk: Desk, label: str, spot: _Spot, call_it: Callable[[str], None] = lambda _name: None) -> Field:
    def take(_old: str, new: str) -> str:
        return take_declared(desk, spot.declared(desk.workspace.project), new)

    bound = Bound(
        label=label,
        read=lambda _design: spot.name(desk.workspace.project),
        write=_same,
        refuse=lambda text: refuse_shape(str(text)),
    )
    return name_field(desk, bound, take, call_it)


def _bound(desk: Desk, spot: _Spot, attribute: str, label: str = "") -> Bound:
    return Bound(
        label=label, read=lambda _design: getattr(spot.read(desk.workspace.project), attribute, ""), write=_same
    )


def _line(desk: Desk, spot: _Spot, label: str, attribute: str) -> Field:
    """A text that is taken over when it is done, as each time is a file written."""

    def take(_old: str, new: str) -> str:
        return _write(desk, spot, attribute, new)

    made = name_field(desk, _bound(desk, spot, attribute, label), take)
    made.may_be_empty = True
    made.element.props("maxlength=2000")
    room = made.element.parent_slot
    if attribute == "doc" and room is not None:
        made.element.classes(remove="mono")
        room.parent.classes("wide")
    return made


@dataclass(eq=False)
class _FlagInFile(Field):
    """Yes or no, in project.yaml."""

    spot: _Spot = field(kw_only=True)

    def _typed(self, value: Any) -> None:
        if value != self.bound.read(self.desk.design):
            refused = _write(self.desk, self.spot, "internal", value)
            if refused:
                self.desk.say(refused, "warning")
            self.refresh()


def _write(desk: Desk, spot: _Spot, attribute: str, value: Any) -> str:
    """Write another value into project.yaml; returns why not."""
    name = spot.name(desk.workspace.project)

    def change(project: Project) -> Project:
        changes: dict[str, Any] = {attribute: value}
        things = getattr(project, spot.section)
        changed = tuple(replace(each, **changes) if each.name == name else each for each in things)
        whole: dict[str, Any] = {spot.section: changed}
        return replace(project, **whole)

    try:
        written = change_project_file(desk.workspace, change)
    except OSError as error:
        return f"not written: {reason_of(error)}"
    if not written.refused:
        desk.offer_undo(f"project.yaml is written: {name}", lambda: _undo(desk, written))
        desk.tell()
    return written.refused


def _undo(desk: Desk, written: Written) -> None:
    try:
        refused = take_back(desk.workspace, written)
    except OSError as error:
        refused = f"not written: {reason_of(error)}"
    if refused:
        desk.say(refused, "warning")
    desk.tell()
