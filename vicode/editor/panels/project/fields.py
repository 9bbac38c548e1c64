"""Fields of what project.yaml declares: each change is written into the file at once, and can be taken back."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from nicegui import ui

from vicode.editor.panels.desk import Desk
from vicode.editor.panels.fields import Bound, ChoiceField, Field, findings_at
from vicode.editor.panels.name_field import NameField, take_declared
from vicode.editor.panels.text_input import TextInput
from vicode.editor.session import numbers
from vicode.editor.session.declared_names import refuse_shape
from vicode.editor.session.project_edits import ProjectEdit, change_project_file
from vicode.editor.session.project_spots import Spot
from vicode.editor.session.wording import reason_of
from vicode.findings import Finding, Path
from vicode.model.design import Design
from vicode.model.project import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """An attribute that is typed as a text. `text_of` and `value_of` lead there and back, `refuse` says why not."""

    label: str
    attribute: str
    hint: str = ""
    text_of: Callable[[Any], str] = str
    value_of: Callable[[str], Any] = str.strip
    refuse: Callable[[str], str] = lambda _text: ""
    is_long: bool = False


DOC = Line(label="Doc", attribute="doc", is_long=True)
XABSL_NAME = Line(label="Name in XABSL", attribute="xabsl_name")
RANGE = Line(
    label="Range",
    attribute="range",
    hint="lowest, highest: 0, 9000",
    text_of=numbers.text_of_range,
    value_of=numbers.range_of,
    refuse=numbers.refuse_range,
)
FREQUENCY = Line(
    label="Frequency, Hz",
    attribute="frequency_hz",
    hint="at every step",
    text_of=numbers.text_of,
    value_of=numbers.frequency_of,
    refuse=numbers.refuse_frequency,
)


@dataclass(eq=False)
class LineField(NameField):
    """A text that is taken over when it is done; `after` is called when what is shown may be another."""

    after: Callable[[], None] = field(default=lambda: None)
    place: Callable[[], Path] = field(default=tuple)
    """Where it stands in project.yaml."""

    def other_findings(self) -> list[Finding]:
        """What is wrong with it in project.yaml."""
        return findings_at(self.place(), self.desk.workspace.project_findings)

    def refresh(self) -> None:
        """Show what the file says."""
        super().refresh()
        self.after()


def name_in_file(desk: Desk, label: str, spot: Spot, called: Callable[[str], None] = lambda _name: None) -> Field:
    """The name of a thing: all that say it follow, after it was agreed to; `called` hears it when it is another."""

    def take(_old: str, new: str) -> str:
        return take_declared(desk, spot.declared(desk.workspace.project), new)

    bound = Bound(
        label=label,
        read=lambda _design: spot.name(desk.workspace.project),
        write=_same,
        refuse=lambda text: refuse_shape(str(text)),
    )
    element, message = _input(bound, is_code=True)
    element.props("maxlength=80")
    return NameField(desk, bound, element, message, take=take, on_shown=called)


def line_in_file(desk: Desk, spot: Spot, line: Line, after: Callable[[], None] = lambda: None) -> Field:
    """A text of a thing, or a number."""

    def read(_design: Design) -> str:
        thing = spot.read(desk.workspace.project)
        return "" if thing is None else line.text_of(getattr(thing, line.attribute))

    def change(text: str) -> Callable[[Any], Any]:
        changes: dict[str, Any] = {line.attribute: line.value_of(text)}
        return lambda thing: replace(thing, **changes)

    return typed_in_file(desk, spot, line, (read, change), after)


def typed_in_file(
    desk: Desk,
    spot: Spot,
    line: Line,
    ways: tuple[Callable[[Design], str], Callable[[str], Callable[[Any], Any]]],
    after: Callable[[], None] = lambda: None,
) -> Field:
    """A text that `ways` read, and make a change of the thing of."""
    read, change = ways

    def take(_old: str, new: str) -> str:
        return line.refuse(new) or write(desk, spot, change(new))

    bound = Bound(label=line.label, hint=line.hint, read=read, write=_same, refuse=lambda text: line.refuse(str(text)))
    is_text = line.attribute in ("doc", "title")
    element, message = _input(bound, is_code=not is_text, is_long=line.is_long)
    element.props("maxlength=2000")

    def place() -> Path:
        return (*spot.path(desk.workspace.project), *_key_of(spot, line))

    made = LineField(desk, bound, element, message, take=take, after=after, place=place, is_long=line.is_long)
    made.may_be_empty = True
    return made


def _key_of(spot: Spot, line: Line) -> Path:
    """The key below which an attribute stands in the file: of an element none, it is its value."""
    match (spot.section, line.attribute):
        case ("elements", _):
            return ()
        case ("constants", "initial"):
            return ("value",)
        case ("parameters" | "arguments", "initial"):
            return ("default",)
        case (_, "frequency_hz"):
            return ("frequency",)
        case (_, attribute):
            return (attribute,)


def _input(bound: Bound, *, is_code: bool, is_long: bool = False) -> tuple[TextInput, ui.label]:
    with ui.column().classes("field"):
        element = TextInput(bound.label, placeholder=bound.hint, lines=is_long, monospace=is_code)
        message = ui.label().classes("field-finding").props('role="status"')
        message.set_visibility(False)
    return element, message


def flag_in_file(desk: Desk, spot: Spot, label: str, attribute: str) -> Field:
    """Yes or no."""

    def read(_design: Design) -> bool:
        return bool(getattr(spot.read(desk.workspace.project), attribute, False))

    box = ui.checkbox(label).props("dense").classes("wide")
    return _Flag(desk, Bound(label=label, read=read, write=_same), box, spot=spot, attribute=attribute)


def choice_in_file(desk: Desk, spot: Spot, label: str, attribute: str, options: Callable[[], Sequence[str]]) -> Field:
    """One of several names."""

    def read(_design: Design) -> str | None:
        return getattr(spot.read(desk.workspace.project), attribute, None) or None

    with ui.column().classes("field"):
        element = ui.select(list(options()), label=label, value=None).props("outlined dense options-dense stack-label")
        message = ui.label().classes("field-finding").props('role="status"')
        message.set_visibility(False)
    bound = Bound(label=label, read=read, write=_same)
    return _Choice(desk, bound, element, message, options=lambda _design: options(), spot=spot, attribute=attribute)


@dataclass(eq=False)
class _Flag(Field):
    spot: Spot = field(kw_only=True)
    attribute: str = field(kw_only=True)

    def _typed(self, value: Any) -> None:
        _take(self, self.spot, self.attribute, value)


@dataclass(eq=False)
class _Choice(ChoiceField):
    spot: Spot = field(kw_only=True)
    attribute: str = field(kw_only=True)

    def _typed(self, value: Any) -> None:
        if value is not None:
            _take(self, self.spot, self.attribute, value)


def _take(made: Field, spot: Spot, attribute: str, value: Any) -> None:
    """Write what was chosen; what cannot be is told, and shown no more."""
    if value == made.bound.read(made.desk.design):
        return
    changes = {attribute: value}
    refused = write(made.desk, spot, lambda thing: replace(thing, **changes))
    if refused:
        made.desk.say(refused[:1].upper() + refused[1:], "warning")
        made.has_focus = False
        made.refresh()


def _same(design: Design, _value: Any) -> Design:
    return design


def write(desk: Desk, spot: Spot, change: Callable[[Any], Any]) -> str:
    """Write another thing into project.yaml; returns why not."""
    project = desk.workspace.project
    name = " of ".join(reversed(spot.names(project) or (project.name,)))
    return write_project(desk, lambda project: spot.write(project, change), name, spot)


def write_project(
    desk: Desk, change: Callable[[Project], Project], what: str, spot: Spot | None = None, *, is_agreed: bool = False
) -> str:
    """Write another project.yaml, say so, and offer to take it back; returns why not. See `change_project_file`."""
    try:
        written = change_project_file(desk.workspace, change, spot, what=what, is_agreed=is_agreed)
    except OSError as error:
        return f"not written: {reason_of(error)}"
    edit = written.edit
    if edit is not None:
        broken = f"; now with errors: {', '.join(written.broken)}" if written.broken else ""
        desk.document.note(edit)
        desk.offer_undo(f"project.yaml is written: {what}{broken}", lambda: _undo(desk, edit))
        desk.tell()
    return written.refused


def _undo(desk: Desk, edit: ProjectEdit) -> None:
    refused = desk.document.take_back(edit)
    if refused:
        desk.say(refused, "warning")
    desk.tell()
