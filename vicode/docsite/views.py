"""What templates see: finished strings and lists. A field named `html`, or ending in `_html`, is HTML already."""

from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True, kw_only=True)
class TextSpan:
    """A piece of a line: with `href` a link, `title` its tip, `css_class` a class of the style sheet."""

    text: str
    href: str = ""
    title: str = ""
    css_class: str = ""


RichText = tuple[TextSpan, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeBlock:
    """A piece of code in a language."""

    language: str
    html: str


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclarationRow:
    """A parameter, output, variable or constant; `css_class` says which, where a table has several.

    `read_in` and `set_in` are the components that do so, with the states as tips.
    """

    anchor: str
    name: str
    arguments: tuple[RichText, ...]
    type: RichText
    initial: RichText
    unit: str
    range: str
    doc_html: str
    href: str = ""
    kind: str = ""
    read_in: RichText = ()
    set_in: RichText = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclarationTable:
    """All declarations of one section; `columns` are those that say something."""

    title: str
    initial_heading: str
    rows: tuple[DeclarationRow, ...]
    columns: frozenset[str]


@dataclass(frozen=True, slots=True, kw_only=True)
class TransitionRow:
    """A row of the transition table: all guards of `guards` must hold; `order` leads to the line of pseudo code."""

    order: TextSpan
    source: TextSpan
    guards: tuple[RichText, ...]
    timer: RichText
    target: TextSpan
    doc_html: str
    is_disabled: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class PseudocodeLine:
    """A line of pseudo code; `blocks` is the code of its guard, `code_links` where its decision stands in other texts."""

    depth: int
    parts: RichText
    doc: str = ""
    anchor: str = ""
    is_disabled: bool = False
    code_links: tuple[TextSpan, ...] = ()
    blocks: tuple[CodeBlock, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionView:
    """One action: a line, or code."""

    text: RichText = ()
    blocks: tuple[CodeBlock, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionPhaseView:
    """What a state does at one occasion."""

    title: str
    actions: tuple[ActionView, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class StateView:
    """A state, or what is common to all; `predecessors` are the states that lead here.

    `is_folded` says that the tree shows only a part of the decisions.
    """

    anchor: str
    name: str
    badges: tuple[str, ...]
    doc_html: str
    requires: RichText
    phases: tuple[ActionPhaseView, ...]
    pseudocode: tuple[PseudocodeLine, ...]
    predecessors: RichText
    code_links: tuple[TextSpan, ...]
    tree_svg: str = ""
    is_folded: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class UseRow:
    """A used component, or one that uses this one: the states that require and that modulate it."""

    component: TextSpan
    alias: str
    required_in: RichText
    modulated_in: RichText
    doc_html: str


@dataclass(frozen=True, slots=True, kw_only=True)
class FindingRow:
    """A finding; `severity` is a word and a class."""

    severity: str
    code: str
    name: str
    message: str
    fix: str
    component: TextSpan
    location: TextSpan


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
    """What a language makes of a component: a page, or reasons why not; `is_enabled`: the project asks for it."""

    title: str
    href: str
    path: str
    is_enabled: bool
    reasons: tuple[FindingRow, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentPageView:
    """The page of a design; `transitions` are by source, `columns` those of them that say something."""

    name: str
    doc_html: str
    facts: tuple[RichText, ...]
    svg: str
    legend: tuple[TextSpan, ...]
    transitions: tuple[tuple[TransitionRow, ...], ...]
    columns: frozenset[str]
    common: StateView | None
    states: tuple[StateView, ...]
    neighbourhood_svg: str
    uses: tuple[UseRow, ...]
    used_by: tuple[UseRow, ...]
    agents: RichText
    tables: tuple[DeclarationTable, ...]
    custom_code: tuple[tuple[str, tuple[CodeBlock, ...]], ...]
    findings: tuple[FindingRow, ...]
    code_pages: tuple[TextSpan, ...]
    languages: tuple[LanguageView, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfaceView:
    """The page of a component that has no design; `file` is its address, `css_class` what it is."""

    file: str
    name: str
    kind: str
    title: str
    doc_html: str
    facts: tuple[RichText, ...]
    tables: tuple[DeclarationTable, ...]
    used_by: tuple[UseRow, ...]
    findings: tuple[FindingRow, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfaceRow:
    """A line of the list of interfaces: `symbol_count` counts what can be read or set, `user_count` who uses it."""

    component: TextSpan
    parameters: RichText
    symbol_count: TextSpan
    user_count: int
    summary: str


@dataclass(frozen=True, slots=True, kw_only=True)
class SymbolGroup:
    """The symbols of one component."""

    anchor: str
    component: TextSpan
    title: str
    rows: tuple[DeclarationRow, ...]
    columns: frozenset[str]


@dataclass(frozen=True, slots=True, kw_only=True)
class EnumerationView:
    """A type: its elements are anchor, name and doc; `declarations` are all things of it, `used_by` who says its name."""

    anchor: str
    name: str
    doc_html: str
    elements: tuple[tuple[str, str, str], ...]
    facts: tuple[RichText, ...]
    declarations: RichText
    used_by: RichText


@dataclass(frozen=True, slots=True, kw_only=True)
class ReachableComponentRow:
    """A state machine that an agent may activate."""

    component: TextSpan
    summary: str
    states: int


@dataclass(frozen=True, slots=True, kw_only=True)
class AgentView:
    """The page of an agent: all that it may activate, drawn and as lists; `hand_written` are written by hand.

    `is_partial` says that something is not drawn.
    """

    name: str
    title: str
    doc_html: str
    root: TextSpan
    state_machines: tuple[ReachableComponentRow, ...]
    hand_written: RichText
    svg: str
    is_partial: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class AgentRow:
    """A line of the list of agents."""

    agent: TextSpan
    name: str
    root: TextSpan
    state_machine_count: int
    doc_html: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentRow:
    """A line of the list of components."""

    component: TextSpan
    summary: str
    states: int
    transitions: int
    findings: int


@dataclass(frozen=True, slots=True, kw_only=True)
class HomeView:
    """The first page; `counts` are how many of what, `is_partial` says that something is not drawn."""

    doc_html: str
    counts: tuple[tuple[int, TextSpan], ...]
    svg: str
    is_partial: bool
    agents: tuple[AgentRow, ...]
    components: tuple[ComponentRow, ...]
    findings: tuple[FindingGroup, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectCard:
    """A site among others; `folder` is where it lies."""

    link: TextSpan
    folder: str
    doc_html: str
    facts: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeView:
    """A page of code; `code_pages` are all texts of the same component, `rows_html` is a row of the table for each line."""

    title: str
    path: str
    component: TextSpan
    code_pages: tuple[TextSpan, ...]
    lines_html: tuple[str, ...]
    rows_html: str


@dataclass(frozen=True, slots=True, kw_only=True)
class SiteEntry:
    """Something that can be found: `badges` are looked through as well."""

    name: str
    kind: str
    context: str
    href: str
    doc: str = ""
    search_text: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class PageHead:
    """What every page has; `menu_href` is the address of its entry in the menu."""

    title: str
    file: str
    menu_href: str
    breadcrumbs: tuple[TextSpan, ...] = field(default=())
