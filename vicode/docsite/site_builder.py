"""Builds all files of a site: a pure function of its input."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache, partial

from vicode.diagram.layout import LayoutService
from vicode.docsite.build_cache import BuildCache, StoredResults, compute_digest
from vicode.docsite.code_pages import (
    CodeFile,
    CodeFiles,
    code_links_by_path,
    code_page_links,
    code_page_title,
    code_view,
)
from vicode.docsite.components import ComponentInputs, component_view
from vicode.docsite.declarations import declaration_tables
from vicode.docsite.diagrams import add_missing_layouts
from vicode.docsite.doc_text import summarize
from vicode.docsite.interfaces import (
    InterfaceInputs,
    constant_table,
    enumeration_views,
    interface_rows,
    interface_views,
    symbol_count,
    symbol_groups,
)
from vicode.docsite.languages import GenerationErrors, find_generation_errors, language_views
from vicode.docsite.markdown_pages import PageContent, markdown_files
from vicode.docsite.menu import MENU_SCRIPT, DesignFolder, fixed_links, group_by_folder, menu_script
from vicode.docsite.name_linker import NameLinker
from vicode.docsite.overview import agent_links, agent_view, group_home, home_view
from vicode.docsite.page_inputs import restrict_to_component, strip_to_usage
from vicode.docsite.reference_lists import ReferenceIndex
from vicode.docsite.references import find_symbol_references
from vicode.docsite.site_input import SiteInput
from vicode.docsite.site_names import is_from_xabsl
from vicode.docsite.site_search import search_entries, search_script
from vicode.docsite.site_writer import PlannedFile
from vicode.docsite.svg_classes import shape_rules, shorten_shapes
from vicode.docsite.try_it import TRY_SCRIPT, TryScripts, try_script
from vicode.docsite.urls import AGENTS, HOME, INTERFACES, NAME_INDEX, SYMBOLS, TYPES, SiteUrls
from vicode.docsite.uses import user_rows
from vicode.docsite.views import PageHead, RichText, TextSpan
from vicode.generators import GENERATORS
from vicode.model.design import Design
from vicode.model.project import Agent, Project
from vicode.output import OutputFile
from vicode.templating import read_asset, render

TemplateContext = dict[str, object]
"""The variables of a template."""

_SEARCH = "search.js"
_SCRIPT = """\
/* vicode docs: search and interactive diagrams. The pages work without it. */
(() => {{
"use strict";

{}}})();
"""
# Concatenated in this order into one scope.
_SCRIPT_FILES = ("elements", "text_matching", "search_box", "diagram_viewer", "decision_trees", "menu", "page_tools")


def build_site(subject: SiteInput) -> tuple[OutputFile, ...]:
    with SiteBuilder() as builder:
        return tuple(OutputFile(path=each.path, text=each.render()) for each in builder.plan(subject))


class SiteBuilder:
    """Builds a site incrementally; `stored` has results of earlier processes. Call `close` when done."""

    def __init__(self, stored: StoredResults | None = None) -> None:
        self._cache = BuildCache(stored)
        self._service = LayoutService()

    def plan(self, subject: SiteInput, *, is_markdown: bool = False) -> tuple[PlannedFile, ...]:
        """Plan the files of a site; `PlannedFile.render` renders one.

        For Markdown, all pages are rendered at once: the set of images is known only afterwards.
        """
        planner = self._planner(subject)
        files = tuple(planner.plan_files())
        self._cache.evict_unused()
        if is_markdown:
            return tuple(_plain_file(each.path, each.text) for each in markdown_files(planner.page_contents))
        return tuple(sorted(files, key=lambda file: file.path))

    def make_file_lookup(self, subject: SiteInput) -> Callable[[str], PlannedFile | None]:
        """Return a function that plans a single file by its path, or returns None."""
        # Cached values of the previous build are kept until the next one.
        self._cache.evict_unused()
        planner = self._planner(subject)
        return cache(lambda path: next((each for each in planner.plan_files(path) if each.path == path), None))

    def _planner(self, subject: SiteInput) -> "_SitePlanner":
        whole = replace(subject, project=add_missing_layouts(subject.project, self._service, self._cache))
        return _make_planner(whole, self._cache)

    def save_results(self) -> None:
        """Keep the results that are slow to create for the next process."""
        self._cache.save()

    def close(self) -> None:
        self._service.close()

    def __enter__(self) -> "SiteBuilder":
        return self

    def __exit__(self, *_exception: object) -> None:
        self.close()


@dataclass(frozen=True, slots=True, kw_only=True)
class _SitePlanner:
    """The inputs of all pages. The key of a page covers its own inputs, `shared_digest` the shared ones."""

    site_input: SiteInput
    urls: SiteUrls
    references: ReferenceIndex
    agents_by_component: Mapping[str, RichText]
    code_files: CodeFiles
    generation_errors: GenerationErrors
    try_scripts: TryScripts
    menu: tuple[TextSpan, ...]
    folders: tuple[DesignFolder, ...]
    shared_digest: str
    page_contents: list[PageContent] = field(default_factory=list)

    def plan_files(self, only: str = "") -> Iterator[PlannedFile]:
        """Plan all files, or a subset that contains the path `only`."""
        if only not in {each.path for each in self._assets()}:
            yield from self._overview_pages(only)
            yield from self._interface_pages(only)
            yield from self._component_pages(only)
            yield from self._code_pages(only)
        yield from self._assets()

    def _assets(self) -> Iterator[PlannedFile]:
        yield _plain_file("site.css", read_asset("docsite/site.css") + shape_rules())
        parts = "\n".join(read_asset(f"docsite/js/{name}.js") for name in _SCRIPT_FILES)
        yield _plain_file("site.js", _SCRIPT.format(parts))
        yield _plain_file(TRY_SCRIPT, try_script())
        yield _plain_file(MENU_SCRIPT, menu_script(self.folders, self.urls))

    def _overview_pages(self, only: str = "") -> Iterator[PlannedFile]:
        """The pages about the whole project, and the search index."""
        agents = {self.urls.agent(agent.name) for agent in self.site_input.project.agents}
        if only and only not in {HOME, AGENTS, NAME_INDEX, _SEARCH, *agents}:
            return
        project, addresses = self.site_input.project, self.urls
        bones = strip_to_usage(project)
        maps, home = compute_digest(bones), home_view(self.site_input, addresses)
        grouping = tuple((folder.name, len(folder.designs)) for folder in self.folders)
        bones_titled = replace(bones, name=self.site_input.name)

        def drawn_home() -> TemplateContext:
            return {"view": group_home(home, bones_titled, self.folders, addresses)}

        yield self._page(_head(HOME, self.site_input.name), "home", (maps, home, grouping), drawn_home)
        if project.agents:
            yield self._page_from_context(_head(AGENTS, "Agents"), "agents", agents=home.agents)
        for agent in project.agents:
            head = _head(addresses.agent(agent.name), agent.title or agent.name, TextSpan(text="Agents", href=AGENTS))
            yield self._page(head, "agent", (maps, agent.name), partial(_agent, bones, agent, addresses))
        entries = search_entries(project, addresses, self.site_input.name)
        yield self._page_from_context(_head(NAME_INDEX, "Index"), "all", entries=entries)
        yield PlannedFile(path=_SEARCH, key=compute_digest(entries), render=partial(search_script, entries))

    def _interface_pages(self, only: str = "") -> Iterator[PlannedFile]:
        """The pages of interfaces, symbols and types; empty ones are omitted."""
        pages = {self.urls.component(each.component) for each in self.site_input.project.components}
        if only and only not in {INTERFACES, SYMBOLS, TYPES, *pages}:
            return
        known = InterfaceInputs(
            site_input=self.site_input,
            urls=self.urls,
            references=self.references,
            agents_by_component=self.agents_by_component,
        )
        project = known.project
        if project.components:
            behaviors, others = interface_rows(known)
            yield self._page_from_context(
                _head(INTERFACES, "Interfaces"), "interfaces", behaviors=behaviors, others=others
            )
        for view in interface_views(known):
            crumb = TextSpan(text="Interfaces", href=INTERFACES)
            yield self._page_from_context(_head(view.file, view.name, crumb), "interface", view=view)
        if symbol_count(project):
            yield self._page_from_context(_head(SYMBOLS, "Symbols"), "symbols", groups=tuple(symbol_groups(known)))
        if project.enumerations or project.constants:
            types, constants = tuple(enumeration_views(known)), constant_table(known)
            yield self._page_from_context(
                _head(TYPES, "Types and constants"), "types", enumerations=types, constants=constants
            )

    def _component_pages(self, only: str = "") -> Iterator[PlannedFile]:
        project = self.site_input.project
        for design in project.designs:
            name = design.component
            if only not in ("", self.urls.component(name), self.urls.try_script(name)):
                continue
            tried, file = self.try_scripts.find(name), self.urls.try_script(name)
            if isinstance(tried, str):
                yield _plain_file(file, tried)
            texts = self.code_files.files_of(name)
            written = {text.variant: text.path for text in texts}
            made = ComponentInputs(
                site_input=restrict_to_component(self.site_input, design),
                urls=self.urls,
                tables=tuple(declaration_tables(design, NameLinker(project, self.urls, design), self.references)),
                used_by=tuple(user_rows(project, name, self.urls, self.references)),
                agents=self.agents_by_component.get(name, ()),
                code_links=code_links_by_path(texts, self.urls, self.site_input.repository_link),
                code_pages=code_page_links(texts, self.urls),
                languages=tuple(language_views(self.site_input, name, written, self.generation_errors, self.urls)),
                try_script=file if isinstance(tried, str) else "",
                not_tried=() if isinstance(tried, str) else tried,
            )
            lists = (made.tables, made.used_by, made.agents)
            key = (
                made.site_input,
                lists,
                made.code_links,
                made.code_pages,
                made.languages,
                made.try_script,
                made.not_tried,
            )
            head = _head(self.urls.component(name), self.urls.names.component(name))
            yield self._page(head, "component", key, partial(_component, design, made))

    def _code_pages(self, only: str = "") -> Iterator[PlannedFile]:
        for name in self.code_files.component_names:
            if only and only not in {self.urls.code(name, form) for form in ("source", *GENERATORS)}:
                continue
            texts = self.code_files.files_of(name)
            shown = self.urls.names.component(name)
            component = TextSpan(text=shown or self.site_input.name, href=self.urls.component(name) or HOME)
            links = code_page_links(texts, self.urls)
            for text in texts:
                crumbs = (component,) if name else ()
                head = _head(self.urls.code(name, text.variant), code_page_title(text, shown), *crumbs)
                repository = self.site_input.repository_link(text.path) if text.variant == "source" else ""
                views = partial(_code, text, links, self.urls, component, repository)
                yield self._page(head, "code", (text, links, component, repository), views)

    def _page_from_context(self, head: PageHead, template: str, **views: object) -> PlannedFile:
        """A page keyed by its views, which are cheap to create."""
        return self._page(head, template, views, lambda: views)

    def _page(self, head: PageHead, template: str, key: object, views: Callable[[], TemplateContext]) -> PlannedFile:
        name, about = self.site_input.name, summarize(self.site_input.project.doc)
        self.page_contents.append(PageContent(head=head, template=template, site=name, views=views))

        def make() -> str:
            file, is_xabsl = f"docsite/{template}.html.jinja", self.urls.names.is_xabsl
            text = render(file, page=head, site=name, about=about, menu=self.menu, is_xabsl=is_xabsl, **views())
            # Many links of a page lead to the page itself.
            return shorten_shapes(text.replace(f'href="{head.file}#', 'href="#'))

        return PlannedFile(path=head.file, key=compute_digest(template, head, self.shared_digest, key), render=make)


def _make_planner(subject: SiteInput, memory: BuildCache) -> _SitePlanner:
    generation_errors = find_generation_errors(subject)
    texts = CodeFiles(subject, generation_errors, memory)
    project = _with_shown_expressions(subject.project, memory)
    shown, addresses = replace(subject, project=project), SiteUrls(project)
    menu = tuple(fixed_links(subject, addresses, has_file="" in texts.component_names))
    return _SitePlanner(
        site_input=shown,
        urls=addresses,
        references=ReferenceIndex(
            site_input=shown, urls=addresses, references=find_symbol_references(subject.project, project)
        ),
        agents_by_component=agent_links(project, addresses),
        code_files=texts,
        generation_errors=generation_errors,
        try_scripts=TryScripts(
            project=subject.project, code_files=texts, generation_errors=generation_errors, urls=addresses, cache=memory
        ),
        menu=menu,
        folders=group_by_folder(subject),
        shared_digest=compute_digest(subject.name, project.doc, menu, addresses.key),
    )


def _with_shown_expressions(project: Project, memory: BuildCache) -> Project:
    if not is_from_xabsl(project):
        return project
    # The generator of XABSL is slow to import, and most projects do not come from XABSL.
    from vicode.docsite.xabsl_wording import with_xabsl_expressions  # noqa: PLC0415

    return with_xabsl_expressions(project, memory)


def _plain_file(path: str, text: str) -> PlannedFile:
    return PlannedFile(path=path, key=compute_digest(text), render=partial(str, text))


def _head(file: str, title: str, *crumbs: TextSpan) -> PageHead:
    return PageHead(title=title, file=file, menu_href=crumbs[-1].href if crumbs else file, breadcrumbs=crumbs)


def _agent(bones: Project, agent: Agent, addresses: SiteUrls) -> TemplateContext:
    return {"view": agent_view(bones, agent, addresses)}


def _component(design: Design, made: ComponentInputs) -> TemplateContext:
    return {"view": component_view(design, made)}


def _code(
    text: CodeFile, links: tuple[TextSpan, ...], addresses: SiteUrls, component: TextSpan, repository: str
) -> TemplateContext:
    return {"view": replace(code_view(text, links, addresses, component), repository_href=repository)}
