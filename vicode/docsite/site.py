"""All files of a site: a pure function of its subject, the same bytes every time."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from vicode.docsite.addresses import AGENTS, EVERYTHING, HOME, INTERFACES, SYMBOLS, TYPES, Addresses
from vicode.docsite.components import Made, component_view
from vicode.docsite.docs import summary_of
from vicode.docsite.drawings import laid_out
from vicode.docsite.generated import Text, code_view, places_in, text_links, texts_of
from vicode.docsite.interfaces import (
    Known,
    constant_table,
    enumeration_views,
    interface_rows,
    interface_views,
    known_of,
    symbol_count,
    symbol_groups,
)
from vicode.docsite.languages import Unsaid, language_views, unsaid_in
from vicode.docsite.ordering import sorted_designs
from vicode.docsite.overview import agent_views, home_view
from vicode.docsite.searching import entries_of, search_script
from vicode.docsite.subject import Subject
from vicode.docsite.views import Page, Part
from vicode.output import OutputFile
from vicode.templating import render, text_of

MARK = "vicode docs"
"""Stands at the beginning of every file of a site."""

_ASSETS = ("site.css", "site.js")


def build_site(subject: Subject) -> tuple[OutputFile, ...]:
    """The files of a site, all in one folder."""
    whole = replace(subject, project=laid_out(subject.project))
    unsaid = unsaid_in(whole)
    builder = _Builder(subject=whole, addresses=Addresses(whole.project), texts=texts_of(whole, unsaid), unsaid=unsaid)
    files = [*builder.overview(), *builder.components(), *builder.codes()]
    files += [OutputFile(path=name, text=text_of(f"docsite/{name}")) for name in _ASSETS]
    return tuple(sorted(files, key=lambda file: file.path))


@dataclass(frozen=True, slots=True, kw_only=True)
class _Builder:
    """What all pages are made with."""

    subject: Subject
    addresses: Addresses
    texts: dict[str, tuple[Text, ...]]
    unsaid: Unsaid
    menus: dict[str, str] = field(default_factory=dict)

    def overview(self) -> Iterator[OutputFile]:
        """The pages about the whole, and what the search looks through."""
        project, addresses = self.subject.project, self.addresses
        entries = entries_of(project, addresses)
        yield self._page(HOME, project.name, "home", view=home_view(self.subject, addresses))
        if project.agents:
            yield self._page(AGENTS, "Agents", "agents", agents=tuple(agent_views(project, addresses)))
        yield from self._interfaces(known_of(self.subject, addresses))
        yield self._page(EVERYTHING, "Everything", "all", entries=entries)
        yield OutputFile(path="search.js", text=search_script(entries))

    def _interfaces(self, known: Known) -> Iterator[OutputFile]:
        """The pages about what designs know and share; none about what there is nothing of."""
        project = known.project
        if project.components:
            behaviors, others = interface_rows(known)
            yield self._page(INTERFACES, "Interfaces", "interfaces", behaviors=behaviors, others=others)
        for view in interface_views(known):
            crumb = Part(text="Interfaces", href=INTERFACES)
            yield self._page(view.file, view.name, "interface", crumbs=(crumb,), view=view)
        if symbol_count(project):
            yield self._page(SYMBOLS, "Symbols", "symbols", groups=tuple(symbol_groups(known)))
        if project.enumerations or project.constants:
            types, constants = tuple(enumeration_views(known)), constant_table(known)
            yield self._page(TYPES, "Types and constants", "types", enumerations=types, constants=constants)

    def components(self) -> Iterator[OutputFile]:
        """A page a design."""
        for design in self.subject.project.designs:
            name = design.component
            texts = self.texts.get(name, ())
            written = {text.form: text.path for text in texts}
            made = Made(
                subject=self.subject,
                addresses=self.addresses,
                places=places_in(texts, self.addresses),
                texts=text_links(texts, self.addresses),
                languages=tuple(language_views(self.subject, name, written, self.unsaid, self.addresses)),
            )
            view = component_view(design, made)
            yield self._page(self.addresses.component(name), name, "component", view=view)

    def codes(self) -> Iterator[OutputFile]:
        """A page a text."""
        for name, texts in self.texts.items():
            component = Part(text=name or self.subject.project.name, href=self.addresses.component(name) or HOME)
            for text in texts:
                view = code_view(text, texts, self.addresses, component)
                file = self.addresses.code(name, text.form)
                yield self._page(file, view.title, "code", crumbs=(component,) if name else (), view=view)

    def _page(self, file: str, title: str, template: str, crumbs: tuple[Part, ...] = (), **views: object) -> OutputFile:
        project = self.subject.project
        page = Page(title=title, file=file, here=crumbs[-1].href if crumbs else file, crumbs=crumbs)
        text = render(
            f"docsite/{template}.html.jinja",
            page=page,
            site=project.name,
            about=summary_of(project.doc),
            menu_html=self._menu_html(page.here),
            **views,
        )
        return OutputFile(path=file, text=text)

    def _menu_html(self, here: str) -> str:
        """The menu with one of its entries marked; the pages of a component share one."""
        found = self.menus.get(here)
        if found is None:
            found = render("docsite/menu.html.jinja", here=here, menu=self._menu(), machines=self._machines())
            self.menus[here] = found
        return found

    def _menu(self) -> tuple[Part, ...]:
        project = self.subject.project
        menu = [Part(text="Home", href=HOME)]
        menu += [Part(text="Agents", href=AGENTS)] if project.agents else []
        menu += [Part(text="Interfaces", href=INTERFACES)] if project.components else []
        menu += [Part(text="Symbols", href=SYMBOLS)] if symbol_count(project) else []
        menu += [Part(text="Types and constants", href=TYPES)] if project.enumerations or project.constants else []
        menu.append(Part(text="Everything", href=EVERYTHING))
        menu += [Part(text="Project file", href=self.addresses.code("", "source"))] if "" in self.texts else []
        return tuple(menu)

    def _machines(self) -> tuple[Part, ...]:
        return tuple(
            Part(text=each.component, href=self.addresses.component(each.component), title=summary_of(each.doc))
            for each in sorted_designs(self.subject.project)
        )
