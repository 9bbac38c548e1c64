"""The nodes of a form, as the browser draws it: fields, rows, sections and lists of one item of a design.

Python decides what a form contains; the browser draws it and holds what its user has typed. Paths of fields are
relative to the item.
"""

import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, fields
from functools import cache
from typing import Any, Literal

from vicode.findings import DesignPath

OptionList = Literal["states", "ends", "uses", "types", "arithmetic", "time_units", "components"]
"""A list of options that many forms share; `form_data.FormLists` has its values."""
DeclarationList = Literal["parameters", "outputs", "variables", "arguments"]
ProjectList = Literal[
    "enumerations",
    "elements",
    "constants",
    "components",
    "agents",
    "component-parameters",
    "component-outputs",
    "component-variables",
    "component-arguments",
]
ConstructList = Literal["latches", "interrupts", "competence", "steps", "layers", "constructs"]
AdderList = Literal["actions", "effects", "modulates"] | DeclarationList | ConstructList | ProjectList
"""The kinds of cards that can be added to a list: actions with and without calls, modulated components, declarations
of the design and of project.yaml, constructs."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Title:
    """The heading of the form; the name is a link if `opens` is the id of an item.

    A hidden heading is for screen readers only, where sighted users read the name in a field.
    """

    text: str
    name: str = ""
    opens: tuple[str, str] | None = None
    is_hidden: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class TextField:
    """A text in one or several lines. A `code` text is set in a monospace font, without corrections of the browser."""

    path: DesignPath
    label: str
    value: str
    hint: str = ""
    help: str = ""
    is_code: bool = False
    is_long: bool = False
    is_checked: bool = False
    """Whether some texts are refused."""
    is_committed: bool = False
    """Whether the text is applied when the user presses Enter or leaves the field."""
    is_wide: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class ItemName:
    """The name of the item, which is applied when the user presses Enter or leaves the field."""

    path: DesignPath
    label: str
    value: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Notice:
    """A place above the fields for messages about the item."""

    path: DesignPath


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """A choice of one option of a shared list; `value` may be none of them."""

    path: DesignPath
    label: str
    value: str
    options: OptionList
    help: str = ""
    is_clearable: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class MultiChoice:
    """A choice of several options of a shared list, in the order in which they were chosen."""

    path: DesignPath
    label: str
    value: tuple[str, ...]
    options: OptionList


@dataclass(frozen=True, slots=True, kw_only=True)
class Colors:
    """A choice of one color, or none."""

    path: DesignPath
    label: str
    value: str
    options: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """A checkbox."""

    path: DesignPath
    label: str
    value: bool
    hint: str = ""
    is_wide: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeText:
    """A code editor with completion and marks.

    `language` is a key of LANGUAGES, "expression" for a single one, or "pairs" for lines `name = expression`:
    assignments, or the parameters of the component `alias`.
    """

    path: DesignPath
    label: str
    value: str
    language: str
    title: str = ""
    """The title of its tab, with several languages."""
    hint: str = ""
    alias: str = ""
    can_open: bool = False
    """Whether the text can be opened in the user's own editor."""
    is_checked: bool = False
    """Whether some texts are refused."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Languages:
    """The texts of a code, one tab for each language."""

    label: str
    texts: tuple[CodeText, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Heading:
    """The heading of a part of the form."""

    text: str
    hint: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class DecisionRow:
    """A decision of a list, with those of a group below it."""

    target: str
    guard: str
    is_disabled: bool
    is_derived: bool = False
    then: tuple["DecisionRow", ...] = ()
    otherwise: tuple["DecisionRow", ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Decisions:
    """The list of decisions at a path, with buttons that add, move and remove them."""

    path: DesignPath
    rows: tuple[DecisionRow, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Button:
    """A button that requests a `FormAction`."""

    label: str
    action: str
    path: DesignPath = ()
    icon: str = ""
    is_danger: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Card:
    """A framed part of the form for one item of a list; `id` names it in paths."""

    id: str
    title: str
    nodes: tuple["Node", ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Cards:
    """The list at a path, with buttons that add, move and remove its items.

    The items of a list with a `noun` are declarations, titled by their names; `owner` is the name of their output.
    A `menu` with this label adds constructs.
    """

    path: DesignPath
    cards: tuple[Card, ...]
    adders: AdderList | Literal[""]
    is_ordered: bool = False
    noun: str = ""
    owner: str = ""
    menu: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Adder:
    """A button that adds a card with these nodes, whose paths are relative to it.

    With `options`, it is a menu: the chosen one is the alias of the nodes, and completes the title. An entry of a menu
    has a `hint`, and if nothing can be added, `adds` is empty.
    """

    label: str
    icon: str
    adds: str
    title: str
    nodes: tuple["Node", ...]
    options: OptionList | None = None
    is_unique: bool = False
    """Whether each option is added once, and is the id of its card."""
    hint: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """Fields beside each other."""

    nodes: tuple["Node", ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Section:
    """A part of the form that is closed until a user opens it, or one of its fields is set.

    `key` remembers for all items whether it is open, and only for this one if the section has a look: that of details,
    or of a line in a list. `caption` summarizes its content.
    """

    key: str
    title: str
    caption: str
    nodes: tuple["Node", ...]
    is_set: bool = False
    look: Literal["", "more", "line"] = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Group:
    """The framed form of one declaration, with buttons that remove it and move it up.

    The details are the sections and lists at its end.
    """

    path: DesignPath
    noun: str
    title: str
    nodes: tuple["Node", ...]
    look: Literal["", "shared", "element"] = ""
    can_move_up: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Paragraph:
    """A text to read; `look` is its CSS class."""

    text: str
    look: str


@dataclass(frozen=True, slots=True, kw_only=True)
class FormPart:
    """A part that several forms show, with its key in the forms."""

    form: str


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclarationLine:
    """A declaration of another design, to read."""

    name: str
    about: str
    doc: str


@dataclass(frozen=True, slots=True, kw_only=True)
class AddRow:
    """Two fields and a button that adds an input or a command; `options` are those of the second field."""

    kind: Literal["input", "command"]
    detail: str
    hint: str = ""
    options: OptionList | None = None
    initial: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class UseLine:
    """A used component."""

    alias: str
    component: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Uses:
    """The list of used components, with buttons that add and remove them."""

    rows: tuple[UseLine, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ItemLink:
    """A row that leads to the form of another item."""

    label: str
    caption: str
    opens: tuple[str, str]
    is_code: bool = False


Field = TextField | ItemName | Choice | MultiChoice | CodeText
"""A part of a form with a value that can have messages."""
Node = (
    Field
    | Title
    | Notice
    | Colors
    | Check
    | Languages
    | Heading
    | Decisions
    | Button
    | Cards
    | Row
    | Section
    | Uses
    | ItemLink
    | Group
    | Paragraph
    | FormPart
    | DeclarationLine
    | AddRow
)
"""A part of a form."""


def iter_fields(nodes: Iterable[Node]) -> Iterator[Field]:
    """All fields of a form."""
    for node in nodes:
        match node:
            case Languages():
                yield from node.texts
            case Row() | Section() | Group():
                yield from iter_fields(node.nodes)
            case Cards():
                for card in node.cards:
                    yield from iter_fields(card.nodes)
            case TextField() | ItemName() | Choice() | MultiChoice() | CodeText():
                yield node
            case _:
                pass


def form_json(nodes: Sequence[Node | Adder]) -> str:
    """The nodes as JSON: objects with the kind as "is", without the fields that have their defaults."""
    return _ENCODER.encode(tuple(nodes))


def _node_data(node: object) -> dict[str, Any]:
    kind: Any = type(node)
    shown = {"is": kind.__name__}
    for name, default in _defaults(kind):
        content = getattr(node, name)
        if content is not default and content != default:
            shown[name] = content
    return shown


@cache
def _defaults(kind: Any) -> tuple[tuple[str, Any], ...]:
    return tuple((each.name, each.default) for each in fields(kind))


_ENCODER = json.JSONEncoder(default=_node_data, separators=(",", ":"), ensure_ascii=False)
