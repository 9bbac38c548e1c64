"""What templates see: finished strings and lists. A field named `html`, or ending in `_html`, is HTML already."""

from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """A piece of a line: with `href` a link, `title` its tip, `kind` a class of the style sheet."""

    text: str
    href: str = ""
    title: str = ""
    kind: str = ""


Line = tuple[Part, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeBlock:
    """A piece of code in a language."""

    language: str
    html: str


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclarationRow:
    """A parameter, output, variable or constant; `kind` says which, where a table has several.

    `read_in` and `set_in` are the components that do so, with the states as tips.
    """

    anchor: str
    name: str
    arguments: tuple[Line, ...]
    type: Line
    initial: Line
    unit: str
    range: str
    doc_html: str
    href: str = ""
    kind: str = ""
    read_in: Line = ()
    set_in: Line = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclarationTable:
    """All declarations of one section; `columns` are those that say something."""

    title: str
    initial: str
    rows: tuple[DeclarationRow, ...]
    columns: frozenset[str]


@dataclass(frozen=True, slots=True, kw_only=True)
class TransitionRow:
    """A row of the transition table: all guards of `guards` must hold; `order` leads to the line of pseudo code."""

    order: Part
    source: Part
    guards: tuple[Line, ...]
    timer: Line
    target: Part
    doc_html: str
    is_off: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class PseudoLine:
    """A line of pseudo code; `blocks` is the code of its guard, `places` where its decision stands in other texts."""

    depth: int
    parts: Line
    doc: str = ""
    anchor: str = ""
    is_off: bool = False
    places: tuple[Part, ...] = ()
    blocks: tuple[CodeBlock, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionView:
    """One action: a line, or code."""

    line: Line = ()
    blocks: tuple[CodeBlock, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Phase:
    """What a state does at one occasion."""

    title: str
    actions: tuple[ActionView, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class StateView:
    """A state, or what is common to all; `comes_from` are the states that lead here.

    `is_folded` says that the tree shows only a part of the decisions.
    """

    anchor: str
    name: str
    words: tuple[str, ...]
    doc_html: str
    requires: Line
    phases: tuple[Phase, ...]
    pseudo: tuple[PseudoLine, ...]
    comes_from: Line
    places: tuple[Part, ...]
    tree_svg: str = ""
    is_folded: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class UseRow:
    """A used component, or one that uses this one: the states that require and that modulate it."""

    component: Part
    alias: str
    required_in: Line
    modulated_in: Line
    doc_html: str


@dataclass(frozen=True, slots=True, kw_only=True)
class FindingRow:
    """A finding; `severity` is a word and a class."""

    severity: str
    code: str
    name: str
    message: str
    mend: str
    component: Part
    place: Part


@dataclass(frozen=True, slots=True, kw_only=True)
class FindingGroup:
    """All findings of one rule."""

    severity: str
    code: str
    name: str
    rows: tuple[FindingRow, ...]

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self.rows)


@dataclass(frozen=True, slots=True, kw_only=True)
class LanguageView:
    """What a language makes of a component: a page, or reasons why not; `is_chosen`: the project asks for it."""

    title: str
    href: str
    path: str
    is_chosen: bool
    reasons: tuple[FindingRow, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentView:
    """The page of a design; `transitions` are by source, `columns` those of them that say something."""

    name: str
    doc_html: str
    facts: tuple[Line, ...]
    svg: str
    legend: tuple[Part, ...]
    transitions: tuple[tuple[TransitionRow, ...], ...]
    columns: frozenset[str]
    common: StateView | None
    states: tuple[StateView, ...]
    around_svg: str
    uses: tuple[UseRow, ...]
    used_by: tuple[UseRow, ...]
    agents: Line
    tables: tuple[DeclarationTable, ...]
    shared_code: tuple[tuple[str, tuple[CodeBlock, ...]], ...]
    findings: tuple[FindingRow, ...]
    texts: tuple[Part, ...]
    languages: tuple[LanguageView, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfaceView:
    """The page of a component that has no design; `file` is its address, `kind` what it is."""

    file: str
    name: str
    kind: str
    title: str
    doc_html: str
    facts: tuple[Line, ...]
    tables: tuple[DeclarationTable, ...]
    used_by: tuple[UseRow, ...]
    findings: tuple[FindingRow, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfaceRow:
    """A line of the list of interfaces: `tells` counts what can be read or set, `users` who uses it."""

    component: Part
    parameters: Line
    tells: Part
    users: int
    summary: str


@dataclass(frozen=True, slots=True, kw_only=True)
class SymbolGroup:
    """The symbols of one component."""

    anchor: str
    component: Part
    title: str
    rows: tuple[DeclarationRow, ...]
    columns: frozenset[str]


@dataclass(frozen=True, slots=True, kw_only=True)
class EnumerationView:
    """A type: its elements are anchor, name and doc; `declares` are all things of it, `used_by` who says its name."""

    anchor: str
    name: str
    doc_html: str
    elements: tuple[tuple[str, str, str], ...]
    facts: tuple[Line, ...]
    declares: Line
    used_by: Line


@dataclass(frozen=True, slots=True, kw_only=True)
class ReachedRow:
    """A state machine that an agent may activate."""

    component: Part
    summary: str
    states: int


@dataclass(frozen=True, slots=True, kw_only=True)
class AgentView:
    """The page of an agent: all that it may activate, drawn and as lists; `others` are written by hand.

    `is_sparse` says that something is not drawn.
    """

    name: str
    title: str
    doc_html: str
    root: Part
    machines: tuple[ReachedRow, ...]
    others: Line
    svg: str
    is_sparse: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class AgentRow:
    """A line of the list of agents."""

    agent: Part
    name: str
    root: Part
    machines: int
    doc_html: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentRow:
    """A line of the list of components."""

    component: Part
    summary: str
    states: int
    transitions: int
    findings: int


@dataclass(frozen=True, slots=True, kw_only=True)
class HomeView:
    """The first page; `numbers` are how many of what, `is_sparse` says that something is not drawn."""

    doc_html: str
    numbers: tuple[tuple[int, Part], ...]
    svg: str
    is_sparse: bool
    agents: tuple[AgentRow, ...]
    components: tuple[ComponentRow, ...]
    findings: tuple[FindingGroup, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class HomeRow:
    """A site among others; `folder` is where it lies."""

    site: Part
    folder: str
    doc_html: str
    facts: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeView:
    """A page of code; `texts` are all texts of the same component, `rows_html` is a row of the table for each line."""

    title: str
    path: str
    component: Part
    texts: tuple[Part, ...]
    lines_html: tuple[str, ...]
    rows_html: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """Something that can be found: `words` are looked through as well."""

    name: str
    kind: str
    where: str
    href: str
    doc: str = ""
    words: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Page:
    """What every page has; `here` is the address of its entry in the menu."""

    title: str
    file: str
    here: str
    crumbs: tuple[Part, ...] = field(default=())
