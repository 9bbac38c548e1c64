"""The data for templates: strings and lists. Fields named `html` or ending in `_html` contain HTML."""

from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True, kw_only=True)
class TextSpan:
    """A span of text; `href` makes it a link, `title` is its tooltip."""

    text: str
    href: str = ""
    title: str = ""
    css_class: str = ""


RichText = tuple[TextSpan, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeBlock:
    """A code block in a language."""

    language: str
    html: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ReferenceLine:
    """The places in one component, or the places that set one value, in all components."""

    value: str = ""
    place_count: int
    places: RichText


@dataclass(frozen=True, slots=True, kw_only=True)
class ReferenceList:
    """The places that read or set something."""

    title: str
    place_count: int
    lines: tuple[ReferenceLine, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclarationRow:
    """A parameter, output, variable or constant.

    `references` are all places that read or set it. On the page of all symbols, `read_in` and `set_in` link to the
    components instead, with the states as tooltips.
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
    references: tuple[ReferenceList, ...] = ()
    read_in: RichText = ()
    set_in: RichText = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclarationTable:
    """The declarations of one section; `columns` are the non-empty columns."""

    title: str
    initial_heading: str
    rows: tuple[DeclarationRow, ...]
    columns: frozenset[str]


@dataclass(frozen=True, slots=True, kw_only=True)
class TransitionRow:
    """A row of the transition table; all `guards` must hold; `order` links to the line of pseudocode."""

    order: TextSpan
    source: TextSpan
    guards: tuple[RichText, ...]
    timer: RichText
    target: TextSpan
    doc_html: str
    is_disabled: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class PseudocodeLine:
    """A line of pseudocode; `blocks` is the code of its guard, `code_links` lead to code pages."""

    depth: int
    parts: RichText
    doc: str = ""
    anchor: str = ""
    is_disabled: bool = False
    code_links: tuple[TextSpan, ...] = ()
    blocks: tuple[CodeBlock, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionView:
    """One action: a line of text or code blocks."""

    text: RichText = ()
    blocks: tuple[CodeBlock, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionPhaseView:
    """The actions of one phase (entry, iteration, exit) of a state."""

    title: str
    actions: tuple[ActionView, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class StateView:
    """A state or the common section; `facts` are pairs of a title and its text.

    If `is_folded`, the tree shows only a part of the decisions.
    """

    anchor: str
    name: str
    badges: tuple[str, ...]
    doc_html: str
    facts: tuple[tuple[str, RichText], ...]
    phases: tuple[ActionPhaseView, ...]
    pseudocode: tuple[PseudocodeLine, ...]
    code_links: tuple[TextSpan, ...]
    tree_svg: str = ""
    is_folded: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class UseRow:
    """A used component, or a user, with the states that require and modulate it."""

    component: TextSpan
    alias: str
    required_in: RichText
    modulated_in: RichText
    doc_html: str


@dataclass(frozen=True, slots=True, kw_only=True)
class FindingRow:
    """A finding; `severity` is also a CSS class."""

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
        return len(self.rows)


@dataclass(frozen=True, slots=True, kw_only=True)
class LanguageView:
    """Generated code in a language, or the reasons why there is none."""

    title: str
    href: str
    path: str
    is_enabled: bool
    reasons: tuple[FindingRow, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentPageView:
    """The page of a design; `transitions` are grouped by source, `columns` are the non-empty columns.

    `properties` are pairs of a property and what is proved about it.

    `root_of` are the agents with this root, `agents` those that can activate it. `try_script` is the file with which
    the page runs the design, "" if `not_tried` says why it does not.
    """

    name: str
    doc_html: str
    facts: tuple[RichText, ...]
    svg: str
    legend: tuple[TextSpan, ...]
    transitions: tuple[tuple[TransitionRow, ...], ...]
    columns: frozenset[str]
    properties: tuple[tuple[str, str], ...]
    common: StateView | None
    states: tuple[StateView, ...]
    neighborhood_svg: str
    uses: tuple[UseRow, ...]
    used_by: tuple[UseRow, ...]
    root_of: RichText
    agents: RichText
    tables: tuple[DeclarationTable, ...]
    custom_code: tuple[tuple[str, tuple[CodeBlock, ...]], ...]
    findings: tuple[FindingRow, ...]
    code_pages: tuple[TextSpan, ...]
    languages: tuple[LanguageView, ...]
    try_script: str
    not_tried: RichText


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfaceView:
    """The page of a component without a design; `file` is its file name."""

    file: str
    name: str
    kind: str
    title: str
    doc_html: str
    facts: tuple[RichText, ...]
    agents: RichText
    tables: tuple[DeclarationTable, ...]
    used_by: tuple[UseRow, ...]
    findings: tuple[FindingRow, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfaceRow:
    """A row of the list of interfaces."""

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
class ElementRow:
    """An element of an enumeration with the places that use it."""

    anchor: str
    name: str
    doc_html: str
    references: tuple[ReferenceList, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class EnumerationView:
    """An enumeration; `declarations` have this type."""

    anchor: str
    name: str
    doc_html: str
    elements: tuple[ElementRow, ...]
    facts: tuple[RichText, ...]
    declarations: RichText


@dataclass(frozen=True, slots=True, kw_only=True)
class ReachableComponentRow:
    """A state machine that an agent can activate."""

    component: TextSpan
    summary: str
    states: int


@dataclass(frozen=True, slots=True, kw_only=True)
class AgentView:
    """The page of an agent with the components that it can activate.

    If `is_partial`, the diagram omits components.
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
    """A row of the list of agents."""

    agent: TextSpan
    name: str
    root: TextSpan
    state_machine_count: int
    doc_html: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ComponentRow:
    """A row of the list of components."""

    component: TextSpan
    summary: str
    states: int
    transitions: int
    findings: int


@dataclass(frozen=True, slots=True, kw_only=True)
class FolderView:
    """The components of a folder, with their dependencies on each other."""

    anchor: str
    name: str
    rows: tuple[ComponentRow, ...]
    svg: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class HomeView:
    """The home page; `counts` are numbers with links; if `is_partial`, the diagram omits components.

    With `folders`, the diagram shows them instead of components.
    """

    doc_html: str
    counts: tuple[tuple[int, TextSpan], ...]
    svg: str
    is_partial: bool
    agents: tuple[AgentRow, ...]
    components: tuple[ComponentRow, ...]
    findings: tuple[FindingGroup, ...]
    folders: tuple[FolderView, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectCard:
    """An entry of the common home page; `folder` contains the site."""

    link: TextSpan
    folder: str
    doc_html: str
    facts: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeView:
    """A code page; `code_pages` links to all files of the component, `rows_html` has one table row per line."""

    title: str
    path: str
    component: TextSpan
    code_pages: tuple[TextSpan, ...]
    lines_html: tuple[str, ...]
    rows_html: str
    repository_href: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class SiteEntry:
    """An entry of the search index; `badges` are searched, too."""

    name: str
    kind: str
    context: str
    href: str
    doc: str = ""
    search_text: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class PageHead:
    """The data of every page; `menu_href` is the link of its menu entry."""

    title: str
    file: str
    menu_href: str
    breadcrumbs: tuple[TextSpan, ...] = field(default=())
