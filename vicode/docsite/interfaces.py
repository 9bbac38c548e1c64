"""The pages of hand-written components, symbols, types and constants."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from vicode.docsite.declarations import (
    constant_rows,
    declaration_rows,
    declaration_tables,
    make_declaration_table,
    used_columns,
)
from vicode.docsite.doc_text import render_doc, render_inline_doc, summarize
from vicode.docsite.findings import finding_rows
from vicode.docsite.name_linker import NameLinker, join_spans, plain_text
from vicode.docsite.natural_sort import natural_sort_key, sorted_designs
from vicode.docsite.reference_lists import ReferenceIndex
from vicode.docsite.references import READ, SET
from vicode.docsite.site_input import SiteInput
from vicode.docsite.urls import SiteUrls, slug
from vicode.docsite.uses import user_rows
from vicode.docsite.views import (
    DeclarationRow,
    DeclarationTable,
    ElementRow,
    EnumerationView,
    InterfaceRow,
    InterfaceView,
    RichText,
    SymbolGroup,
    TextSpan,
)
from vicode.model.design import COMMON, Declaration, Design
from vicode.model.project import INTERNAL, MISSING, WORLD, Enumeration, Interface, Project
from vicode.model.words import describe_fields
from vicode.model.xabsl.names import is_basic_behavior, symbol_declarations


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfaceInputs:
    """The inputs of these pages."""

    site_input: SiteInput
    urls: SiteUrls
    references: ReferenceIndex
    agents_by_component: Mapping[str, RichText]

    @property
    def project(self) -> Project:
        return self.site_input.project


def interface_views(known: InterfaceInputs) -> Iterator[InterfaceView]:
    """One page per component without a design, by name."""
    project, addresses = known.project, known.urls
    linker, agents = NameLinker(project, addresses), known.agents_by_component
    for interface in _sorted_interfaces(project):
        yield InterfaceView(
            file=addresses.component(interface.component),
            name=addresses.names.component(interface.component),
            kind=addresses.names.interface_kind(interface),
            title=interface.title,
            doc_html=render_doc(interface.doc),
            facts=tuple(_facts(interface, is_xabsl=linker.is_xabsl)),
            agents=agents.get(interface.component, ()),
            tables=tuple(declaration_tables(interface, linker, known.references)),
            used_by=tuple(user_rows(project, interface.component, addresses, known.references)),
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
        name = owner.component
        symbols = (row for kind, section in _symbol_kinds(owner) for row in _symbol_rows(owner, section, kind, known))
        rows = tuple(symbols)
        yield SymbolGroup(
            anchor=addresses.symbols(name).partition("#")[2],
            component=NameLinker(project, addresses).component(name),
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
            name=known.urls.names.enumeration(enumeration.name),
            doc_html=render_doc(enumeration.doc, parent_level=2),
            elements=tuple(
                ElementRow(
                    anchor=f"{anchor}-{slug(name)}",
                    name=known.urls.names.element(enumeration, name),
                    doc_html=render_inline_doc(doc),
                    references=known.references.of_element(enumeration, name),
                )
                for name, doc in enumeration.elements
            ),
            facts=tuple(_facts_of_type(enumeration, is_xabsl=known.urls.names.is_xabsl)),
            declarations=join_spans(_declarations_of_type(enumeration.name, known)),
        )


def constant_table(known: InterfaceInputs) -> DeclarationTable:
    linker = NameLinker(known.project, known.urls)
    rows = (
        replace(row, references=known.references.of_constant(constant.name))
        for constant, row in constant_rows(known.project.constants, linker)
    )
    return make_declaration_table("Constants", "Value", tuple(rows))


def user_links(users: Mapping[str, tuple[str, ...]], known: InterfaceInputs) -> RichText:
    """Links to designs with their states as tooltip; if there is only one state, the link leads to it."""
    parts = []
    for name in sorted(users, key=natural_sort_key):
        states = [state for state in users[name] if state]
        design, names = known.project.design(name), known.urls.names
        words = [
            "every state" if state == COMMON else names.state_of(design, state) if design else state for state in states
        ]
        href = known.urls.component(name)
        if len(states) == 1:
            path = ("common",) if states[0] == COMMON else ("states", states[0])
            href = known.urls.design_path(name, path)
        parts.append(TextSpan(text=names.component(name), href=href, title=f"in {', '.join(words)}" if words else ""))
    return join_spans(parts)


def _sorted_interfaces(project: Project) -> list[Interface]:
    return sorted(project.components, key=lambda each: natural_sort_key(each.component))


def _row(interface: Interface, known: InterfaceInputs) -> InterfaceRow:
    addresses, name = known.urls, interface.component
    count = len(interface.readable)
    parameters = (
        TextSpan(
            text=addresses.names.argument(each),
            href=addresses.member(name, "parameters", each.name),
            title=each.doc,
        )
        for each in interface.parameters
    )
    return InterfaceRow(
        component=TextSpan(text=addresses.names.component(name), href=addresses.component(name), title=interface.title),
        parameters=join_spans(parameters),
        symbol_count=TextSpan(text=str(count), href=addresses.symbols(name)) if count else TextSpan(text="–"),
        user_count=sum(1 for design in known.project.designs if any(use.component == name for use in design.uses)),
        summary=summarize(interface.doc) or interface.title,
    )


def _symbol_kinds(owner: Interface | Design) -> tuple[tuple[str, str], ...]:
    """The kinds of symbols (input, output, internal) that the sections of a component declare."""
    is_kept = isinstance(owner, Design) or owner.implementation == INTERNAL
    return ((("internal" if is_kept else "input"), "outputs"), (("internal" if is_kept else "output"), "variables"))


def _symbol_rows(
    owner: Interface | Design, section: str, kind: str, known: InterfaceInputs
) -> Iterator[DeclarationRow]:
    name, references = owner.component, known.references.references
    linker = NameLinker(known.project, known.urls, owner if isinstance(owner, Design) else None)
    for declaration, row in declaration_rows(owner, section, linker):
        read, set_ = (user_links(references.users(how, name, declaration.name), known) for how in (READ, SET))
        href = known.urls.member(name, section, declaration.name)
        yield replace(row, kind=kind, read_in=read, set_in=set_, href=href)


def _declarations_of_type(enumeration: str, known: InterfaceInputs) -> Iterator[TextSpan]:
    owners: list[Interface | Design] = [*_sorted_interfaces(known.project), *sorted_designs(known.project)]
    for owner in owners:
        for section in ("parameters", "outputs", "variables"):
            for declaration in getattr(owner, section):
                if declaration.type == enumeration:
                    href = known.urls.member(owner.component, section, declaration.name)
                    yield TextSpan(text=_qualified_name(owner, section, declaration, known), href=href)


def _qualified_name(owner: Interface | Design, section: str, declaration: Declaration, known: InterfaceInputs) -> str:
    """The name of a declaration outside its component; symbols of XABSL are unique."""
    names = known.urls.names
    if names.is_xabsl and section != "parameters":
        return names.declaration(owner, section, declaration)
    return f"{names.component(owner.component)}.{names.argument(declaration)}"


def _facts_of_type(enumeration: Enumeration, *, is_xabsl: bool) -> Iterator[RichText]:
    count = len(enumeration.elements)
    yield plain_text(f"{count} element{'s' * (count != 1)}")
    if enumeration.internal:
        yield plain_text("internal" if is_xabsl else "stored by vicode")
    if enumeration.xabsl_name and not is_xabsl:
        yield (TextSpan(text="in XABSL "), TextSpan(text=enumeration.xabsl_name, css_class="code"))
    shown = ("elements", "doc", "internal", "xabsl_name", "xabsl_elements")
    yield from map(plain_text, describe_fields(enumeration, shown))


def _facts(interface: Interface, *, is_xabsl: bool) -> Iterator[RichText]:
    if interface.is_generated:
        # In XABSL, the kinds of symbols say it.
        if not is_xabsl:
            yield plain_text(_ORIGINS[interface.implementation])
    else:
        yield (TextSpan(text="implemented by "), TextSpan(text=interface.implementation, css_class="code"))
    if interface.frequency_hz is not None:
        yield plain_text(f"runs at {interface.frequency_hz:g} Hz")
    if interface.xabsl_name and not is_xabsl:
        yield (TextSpan(text="in XABSL "), TextSpan(text=interface.xabsl_name, css_class="code"))
    yield from map(plain_text, describe_fields(interface, _SHOWN))


_SHOWN = ("component", "title", "doc", "xabsl_name", "implementation", "frequency_hz")
_ORIGINS = {WORLD: "provided by the world", INTERNAL: "stored by vicode", MISSING: "not implemented yet"}
