"""All files of a site: a pure function of its subject, the same bytes every time."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import cache, partial

from vicode.diagram.layout import LayoutService
from vicode.docsite.addresses import AGENTS, EVERYTHING, HOME, INTERFACES, SYMBOLS, TYPES, Addresses
from vicode.docsite.components import Made, component_view
from vicode.docsite.docs import summary_of
from vicode.docsite.drawings import draw_uses, laid_out
from vicode.docsite.generated import Text, Texts, code_view, places_in, text_links, title_of
from vicode.docsite.interfaces import (
    constant_table,
    enumeration_views,
    interface_rows,
    interface_views,
    known_of,
    symbol_count,
    symbol_groups,
)
from vicode.docsite.languages import Unsaid, language_views, unsaid_in
from vicode.docsite.markdown import Content, markdown_files
from vicode.docsite.memory import Memory, digest_of
from vicode.docsite.ordering import sorted_designs
from vicode.docsite.overview import agent_view, home_view
from vicode.docsite.parts import part_around, skeleton_of
from vicode.docsite.searching import entries_of, search_script
from vicode.docsite.subject import Subject
from vicode.docsite.views import Page, Part
from vicode.docsite.writing import PlannedFile
from vicode.generators import GENERATORS
from vicode.model.design import Design
from vicode.model.project import Agent, Project
from vicode.output import OutputFile
from vicode.templating import render, text_of

Views = dict[str, object]
"""What a template sees, by name."""

_SEARCH = "search.js"
_SCRIPT = """\
/* vicode docs: search, and drawings that can be moved. Without it every page can be read all the same. */
(() => {{
"use strict";

{}}})();
"""
# In this order: what is joined shares its names.
_PARTS = ("finding", "drawing", "trees", "menu")


def build_site(subject: Subject) -> tuple[OutputFile, ...]:
    """The files of a site, all in one folder."""
    with SiteBuilder() as builder:
        return tuple(OutputFile(path=each.path, text=each.make()) for each in builder.plan(subject))


class SiteBuilder:
    """Builds one site again and again: what an edit does not concern is not made anew. Close it in the end."""

    def __init__(self) -> None:
        self._memory = Memory()
        self._service = LayoutService()

    def plan(self, subject: Subject, *, is_markdown: bool = False) -> tuple[PlannedFile, ...]:
        """The files of a site with what each is made from; they are made when they are asked for.

        In Markdown all are made at once, since only the pages know how many pictures there are.
        """
        planner = self._planner(subject)
        files = tuple(planner.files())
        self._memory.forget_unasked()
        if is_markdown:
            return tuple(_plain_file(each.path, each.text) for each in markdown_files(planner.contents))
        return tuple(sorted(files, key=lambda file: file.path))

    def open(self, subject: Subject) -> Callable[[str], PlannedFile | None]:
        """What finds single files of a site by their paths, each made from as little as it needs; None for no file."""
        # What was asked of the one before is remembered until the next.
        self._memory.forget_unasked()
        planner = self._planner(subject)
        return cache(lambda path: next((each for each in planner.files(path) if each.path == path), None))

    def _planner(self, subject: Subject) -> "_Planner":
        whole = replace(subject, project=laid_out(subject.project, self._service, self._memory))
        return _planner_of(whole, self._memory)

    def close(self) -> None:
        """End the process that lays designs out."""
        self._service.close()

    def __enter__(self) -> "SiteBuilder":
        return self

    def __exit__(self, *_exception: object) -> None:
        self.close()


@dataclass(frozen=True, slots=True, kw_only=True)
class _Planner:
    """What all pages are made with. A page is made from what its key names, and from what `frame` is the digest of."""

    subject: Subject
    addresses: Addresses
    texts: Texts
    unsaid: Unsaid
    menu: tuple[Part, ...]
    machines: tuple[Part, ...]
    frame: str
    contents: list[Content] = field(default_factory=list)
    _menus: list[str] = field(default_factory=list)

    def files(self, only: str = "") -> Iterator[PlannedFile]:
        """All files, or some of those among which the one with a path is."""
        if only not in {each.path for each in self._assets()}:
            yield from self.overview(only)
            yield from self.interfaces(only)
            yield from self.components(only)
            yield from self.codes(only)
        yield from self._assets()

    def _assets(self) -> Iterator[PlannedFile]:
        yield _plain_file("site.css", text_of("docsite/site.css"))
        parts = "\n".join(text_of(f"docsite/js/{name}.js") for name in _PARTS)
        yield _plain_file("site.js", _SCRIPT.format(parts))

    def overview(self, only: str = "") -> Iterator[PlannedFile]:
        """The pages about the whole, and what the search looks through."""
        agents = {self.addresses.agent(agent.name) for agent in self.subject.project.agents}
        if only and only not in {HOME, AGENTS, EVERYTHING, _SEARCH, *agents}:
            return
        project, addresses = self.subject.project, self.addresses
        bones = skeleton_of(project)
        maps, home = digest_of(bones), home_view(self.subject, addresses)
        title = f"Who uses whom in {self.subject.name}"

        def drawn_home() -> Views:
            return {"view": replace(home, svg=draw_uses(bones, addresses, title))}

        yield self._page(_head(HOME, self.subject.name), "home", (maps, home), drawn_home)
        if project.agents:
            yield self._viewed(_head(AGENTS, "Agents"), "agents", agents=home.agents)
        for agent in project.agents:
            head = _head(addresses.agent(agent.name), agent.title or agent.name, Part(text="Agents", href=AGENTS))
            yield self._page(head, "agent", (maps, agent.name), partial(_agent, bones, agent, addresses))
        entries = entries_of(project, addresses, self.subject.name)
        yield self._viewed(_head(EVERYTHING, "Everything"), "all", entries=entries)
        yield PlannedFile(path=_SEARCH, key=digest_of(entries), make=partial(search_script, entries))

    def interfaces(self, only: str = "") -> Iterator[PlannedFile]:
        """The pages about what designs know and share; none about what there is nothing of."""
        pages = {self.addresses.component(each.component) for each in self.subject.project.components}
        if only and only not in {INTERFACES, SYMBOLS, TYPES, *pages}:
            return
        known = known_of(self.subject, self.addresses)
        project = known.project
        if project.components:
            behaviors, others = interface_rows(known)
            yield self._viewed(_head(INTERFACES, "Interfaces"), "interfaces", behaviors=behaviors, others=others)
        for view in interface_views(known):
            crumb = Part(text="Interfaces", href=INTERFACES)
            yield self._viewed(_head(view.file, view.name, crumb), "interface", view=view)
        if symbol_count(project):
            yield self._viewed(_head(SYMBOLS, "Symbols"), "symbols", groups=tuple(symbol_groups(known)))
        if project.enumerations or project.constants:
            types, constants = tuple(enumeration_views(known)), constant_table(known)
            yield self._viewed(_head(TYPES, "Types and constants"), "types", enumerations=types, constants=constants)

    def components(self, only: str = "") -> Iterator[PlannedFile]:
        """A page a design."""
        for design in self.subject.project.designs:
            name = design.component
            if only not in ("", self.addresses.component(name)):
                continue
            texts = self.texts.of(name)
            written = {text.form: text.path for text in texts}
            made = Made(
                subject=part_around(self.subject, design),
                addresses=self.addresses,
                places=places_in(texts, self.addresses),
                texts=text_links(texts, self.addresses),
                languages=tuple(language_views(self.subject, name, written, self.unsaid, self.addresses)),
            )
            key = (made.subject, made.places, made.texts, made.languages)
            head = _head(self.addresses.component(name), name)
            yield self._page(head, "component", key, partial(_component, design, made))

    def codes(self, only: str = "") -> Iterator[PlannedFile]:
        """A page a text."""
        for name in self.texts.names:
            if only and only not in {self.addresses.code(name, form) for form in ("source", *GENERATORS)}:
                continue
            texts = self.texts.of(name)
            component = Part(text=name or self.subject.name, href=self.addresses.component(name) or HOME)
            links = text_links(texts, self.addresses)
            for text in texts:
                crumbs = (component,) if name else ()
                head = _head(self.addresses.code(name, text.form), title_of(text), *crumbs)
                views = partial(_code, text, links, self.addresses, component)
                yield self._page(head, "code", (text, links, component), views)

    def _viewed(self, head: Page, template: str, **views: object) -> PlannedFile:
        """A page whose views are quickly made: they are its key."""
        return self._page(head, template, views, lambda: views)

    def _page(self, head: Page, template: str, key: object, views: Callable[[], Views]) -> PlannedFile:
        name, about = self.subject.name, summary_of(self.subject.project.doc)
        self.contents.append(Content(head=head, template=template, site=name, views=views))

        def make() -> str:
            menu, page = self._menu_html(head.here), f"docsite/{template}.html.jinja"
            return render(page, page=head, site=name, about=about, menu_html=menu, **views())

        return PlannedFile(path=head.file, key=digest_of(template, head, self.frame, key), make=make)

    def _menu_html(self, here: str) -> str:
        """The menu with one of its entries marked: it is made once, and marked for each page."""
        if not self._menus:
            self._menus.append(render("docsite/menu.html.jinja", menu=self.menu, machines=self.machines))
        # Addresses hold letters, digits and the like alone: nothing in them is escaped.
        return self._menus[0].replace(f'<a href="{here}"', f'<a href="{here}" aria-current="page"', 1)


def _planner_of(subject: Subject, memory: Memory) -> _Planner:
    project, unsaid = subject.project, unsaid_in(subject)
    addresses, texts = Addresses(project), Texts(subject, unsaid, memory)
    menu, machines = tuple(_menu(project, addresses, has_file="" in texts.names)), tuple(_machines(project, addresses))
    return _Planner(
        subject=subject,
        addresses=addresses,
        texts=texts,
        unsaid=unsaid,
        menu=menu,
        machines=machines,
        frame=digest_of(subject.name, project.doc, menu, machines, addresses.names),
    )


def _menu(project: Project, addresses: Addresses, *, has_file: bool) -> Iterator[Part]:
    yield Part(text="Home", href=HOME)
    if project.agents:
        yield Part(text="Agents", href=AGENTS)
    if project.components:
        yield Part(text="Interfaces", href=INTERFACES)
    if symbol_count(project):
        yield Part(text="Symbols", href=SYMBOLS)
    if project.enumerations or project.constants:
        yield Part(text="Types and constants", href=TYPES)
    yield Part(text="Everything", href=EVERYTHING)
    if has_file:
        yield Part(text="Project file", href=addresses.code("", "source"))


def _machines(project: Project, addresses: Addresses) -> Iterator[Part]:
    for each in sorted_designs(project):
        yield Part(text=each.component, href=addresses.component(each.component), title=summary_of(each.doc))


def _plain_file(path: str, text: str) -> PlannedFile:
    return PlannedFile(path=path, key=digest_of(text), make=partial(str, text))


def _head(file: str, title: str, *crumbs: Part) -> Page:
    return Page(title=title, file=file, here=crumbs[-1].href if crumbs else file, crumbs=crumbs)


def _agent(bones: Project, agent: Agent, addresses: Addresses) -> Views:
    return {"view": agent_view(bones, agent, addresses)}


def _component(design: Design, made: Made) -> Views:
    return {"view": component_view(design, made)}


def _code(text: Text, links: tuple[Part, ...], addresses: Addresses, component: Part) -> Views:
    return {"view": code_view(text, links, addresses, component)}
