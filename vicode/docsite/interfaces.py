"""The pages of hand-written components, symbols, types and constants."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from vicode.docsite.declarations import declaration_rows, declaration_tables, make_declaration_table, used_columns
from vicode.docsite.doc_text import render_doc, render_inline_doc, summarize
from vicode.docsite.findings import finding_rows
from vicode.docsite.name_linker import NameLinker, join_spans, plain_text
from vicode.docsite.natural_sort import natural_sort_key, sorted_designs
from vicode.docsite.references import READ, SET, SymbolReferences, find_symbol_references
from vicode.docsite.site_input import SiteInput
from vicode.docsite.urls import SiteUrls, slug
from vicode.docsite.uses import user_rows
from vicode.docsite.views import (
    DeclarationRow,
    DeclarationTable,
    EnumerationView,
    InterfaceRow,
    InterfaceView,
    RichText,
    SymbolGroup,
    TextSpan,
)
from vicode.model.design import COMMON, Declaration, Design
from vicode.model.project import INTERNAL, MISSING, WORLD, Enumeration, Interface, Project
from vicode.model.xabsl.names import is_basic_behavior, symbol_declarations

BASIC_BEHAVIOR = "basic behavior"


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfaceInputs:
    """The inputs of these pages."""

    site_input: SiteInput
    urls: SiteUrls
    references: SymbolReferences

    @property
    def project(self) -> Project:
        return self.site_input.project


def make_interface_inputs(subject: SiteInput, addresses: SiteUrls) -> InterfaceInputs:
    """Collect all references once for all pages."""
    return InterfaceInputs(site_input=subject, urls=addresses, references=find_symbol_references(subject.project))


def interface_views(known: InterfaceInputs) -> Iterator[InterfaceView]:
    """One page per component without a design, by name."""
    project, addresses = known.project, known.urls
    linker = NameLinker(project, addresses)
    for interface in _sorted_interfaces(project):
        tables = (
            _add_references_to_table(table, interface.component, known)
            for table in declaration_tables(interface, linker)
        )
        yield InterfaceView(
            file=addresses.component(interface.component),
            name=interface.component,
            kind=BASIC_BEHAVIOR if is_basic_behavior(interface) else "interface",
            title=interface.title,
            doc_html=render_doc(interface.doc),
            facts=tuple(_facts(interface)),
            tables=tuple(tables),
            used_by=tuple(user_rows(project, interface.component, addresses)),
            findings=finding_rows(known.site_input, addresses, interface.component),
        )


def interface_rows(known: InterfaceInputs) -> tuple[tuple[InterfaceRow, ...], tuple[InterfaceRow, ...]]:
    """The rows of basic behaviors, and those of other components."""
    behaviors: list[InterfaceRow] = []
    others: list[InterfaceRow] = []
    for interface in _sorted_interfaces(known.project):
        (behaviors if is_basic_behavior(interface) else others).append(_row(interface, known))
    return tuple(behaviors), tuple(others)


def symbol_groups(known: InterfaceInputs) -> Iterator[SymbolGroup]:
    """The symbols that components share: first those of hand-written components, then those of designs."""
    project, addresses = known.project, known.urls
    owners: list[Interface | Design] = [each for each in _sorted_interfaces(project) if each.readable]
    owners += [design for design in sorted_designs(project) if symbol_declarations(design)]
    for owner in owners:
        linker = NameLinker(project, addresses, owner if isinstance(owner, Design) else None)
        name = owner.component
        symbols = (row for kind, section in _symbol_kinds(owner) for row in _symbol_rows(owner, section, kind, linker))
        rows = tuple(_add_references_to_row(row, name, known, addresses) for row in symbols)
        yield SymbolGroup(
            anchor=addresses.symbols(name).partition("#")[2],
            component=linker.component(name),
            title=owner.title if isinstance(owner, Interface) else "",
            rows=rows,
            columns=used_columns(rows),
        )


def symbol_count(project: Project) -> int:
    declared = sum(len(each.readable) for each in project.components)
    return declared + sum(len(symbol_declarations(design)) for design in project.designs)


def enumeration_views(known: InterfaceInputs) -> Iterator[EnumerationView]:
    """The enumerations with the declarations of their type."""
    for enumeration in known.project.enumerations:
        anchor = f"enum-{slug(enumeration.name)}"
        yield EnumerationView(
            anchor=anchor,
            name=enumeration.name,
            doc_html=render_doc(enumeration.doc, parent_level=2),
            elements=tuple(
                (f"{anchor}-{slug(name)}", name, render_inline_doc(doc)) for name, doc in enumeration.elements
            ),
            facts=tuple(_facts_of_type(enumeration)),
            declarations=join_spans(_declarations_of_type(enumeration.name, known)),
            used_by=user_links(known.references.users(READ, "", enumeration.name), known),
        )


def constant_table(known: InterfaceInputs) -> DeclarationTable:
    linker = NameLinker(known.project, known.urls)
    rows = (
        replace(row, read_in=user_links(known.references.users(READ, "", row.name), known))
        for row in declaration_rows(known.project.constants, linker, "constant-")
    )
    return make_declaration_table("Constants", "Value", tuple(rows))


def user_links(users: Mapping[str, tuple[str, ...]], known: InterfaceInputs) -> RichText:
    """Links to designs with their states as tooltip; if there is only one state, the link leads to it."""
    parts = []
    for name in sorted(users, key=natural_sort_key):
        states = [state for state in users[name] if state]
        words = ["every state" if state == COMMON else state for state in states]
        href = known.urls.component(name)
        if len(states) == 1:
            path = ("common",) if states[0] == COMMON else ("states", states[0])
            href = known.urls.design_path(name, path)
        parts.append(TextSpan(text=name, href=href, title=f"in {', '.join(words)}" if words else ""))
    return join_spans(parts)


def _sorted_interfaces(project: Project) -> list[Interface]:
    return sorted(project.components, key=lambda each: natural_sort_key(each.component))


def _row(interface: Interface, known: InterfaceInputs) -> InterfaceRow:
    addresses, name = known.urls, interface.component
    count = len(interface.readable)
    parameters = (
        TextSpan(text=each.name, href=addresses.member(name, "parameters", each.name), title=each.doc)
        for each in interface.parameters
    )
    return InterfaceRow(
        component=TextSpan(text=name, href=addresses.component(name), title=interface.title),
        parameters=join_spans(parameters),
        symbol_count=TextSpan(text=str(count), href=addresses.symbols(name)) if count else TextSpan(text="–"),
        user_count=sum(1 for design in known.project.designs if any(use.component == name for use in design.uses)),
        summary=summarize(interface.doc) or interface.title,
    )


def _add_references_to_table(table: DeclarationTable, component: str, known: InterfaceInputs) -> DeclarationTable:
    is_parameter = table.title == "Parameters"
    rows = (
        replace(row, set_in=user_links(known.references.users(SET, component, f"{row.name}()"), known))
        if is_parameter
        else _add_references_to_row(row, component, known)
        for row in table.rows
    )
    return make_declaration_table(table.title, table.initial_heading, tuple(rows))


def _add_references_to_row(
    row: DeclarationRow, component: str, known: InterfaceInputs, addresses: SiteUrls | None = None
) -> DeclarationRow:
    read, set_ = (user_links(known.references.users(how, component, row.name), known) for how in (READ, SET))
    section = "variables" if row.anchor.startswith("variable-") else "outputs"
    href = addresses.member(component, section, row.name) if addresses else ""
    return replace(row, read_in=read, set_in=set_, href=href)


def _symbol_kinds(owner: Interface | Design) -> tuple[tuple[str, str], ...]:
    """The kinds of symbols (input, output, internal) that the sections of a component declare."""
    is_kept = isinstance(owner, Design) or owner.implementation == INTERNAL
    return ((("internal" if is_kept else "input"), "outputs"), (("internal" if is_kept else "output"), "variables"))


def _symbol_rows(owner: Interface | Design, section: str, kind: str, linker: NameLinker) -> Iterator[DeclarationRow]:
    declarations: tuple[Declaration, ...] = getattr(owner, section)
    for row in declaration_rows(declarations, linker, f"{section.removesuffix('s')}-"):
        yield replace(row, kind=kind)


def _declarations_of_type(enumeration: str, known: InterfaceInputs) -> Iterator[TextSpan]:
    owners: list[Interface | Design] = [*_sorted_interfaces(known.project), *sorted_designs(known.project)]
    for owner in owners:
        for section in ("parameters", "outputs", "variables"):
            for declaration in getattr(owner, section):
                if declaration.type == enumeration:
                    href = known.urls.member(owner.component, section, declaration.name)
                    yield TextSpan(
                        text=f"{owner.component}.{declaration.name}", href=href, title=summarize(declaration.doc)
                    )


def _facts_of_type(enumeration: Enumeration) -> Iterator[RichText]:
    count = len(enumeration.elements)
    yield plain_text(f"{count} element{'s' * (count != 1)}")
    if enumeration.internal:
        yield plain_text("stored by vicode")
    if enumeration.xabsl_name:
        yield (TextSpan(text="in XABSL "), TextSpan(text=enumeration.xabsl_name, css_class="code"))


def _facts(interface: Interface) -> Iterator[RichText]:
    if interface.is_generated:
        yield plain_text(_ORIGINS[interface.implementation])
    else:
        yield (TextSpan(text="implemented by "), TextSpan(text=interface.implementation, css_class="code"))
    if interface.frequency_hz is not None:
        yield plain_text(f"runs at {interface.frequency_hz:g} Hz")
    if interface.xabsl_name:
        yield (TextSpan(text="in XABSL "), TextSpan(text=interface.xabsl_name, css_class="code"))


_ORIGINS = {WORLD: "provided by the world", INTERNAL: "stored by vicode", MISSING: "not implemented yet"}
