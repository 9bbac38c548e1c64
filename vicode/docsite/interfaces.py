"""The pages of what the designs know and share: hand-written components, symbols, types, constants."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from vicode.docsite.addresses import Addresses, slug
from vicode.docsite.declarations import columns_of, rows_of, table_of, tables_of
from vicode.docsite.docs import html_of, line_html_of, summary_of
from vicode.docsite.findings import finding_rows
from vicode.docsite.linking import Linker, listed, plain
from vicode.docsite.ordering import by_name, sorted_designs
from vicode.docsite.references import READ, SET, References, references_of
from vicode.docsite.subject import Subject
from vicode.docsite.uses import user_rows
from vicode.docsite.views import (
    DeclarationRow,
    DeclarationTable,
    EnumerationView,
    InterfaceRow,
    InterfaceView,
    Line,
    Part,
    SymbolGroup,
)
from vicode.model.design import COMMON, Declaration, Design
from vicode.model.project import INTERNAL, Enumeration, Interface, Project
from vicode.model.xabsl.names import is_behavior, symbols_of_design

BEHAVIOR = "basic behavior"


@dataclass(frozen=True, slots=True, kw_only=True)
class Known:
    """What these pages are made with."""

    subject: Subject
    addresses: Addresses
    references: References

    @property
    def project(self) -> Project:
        """The project."""
        return self.subject.project


def known_of(subject: Subject, addresses: Addresses) -> Known:
    """With all references, which are looked for once."""
    return Known(subject=subject, addresses=addresses, references=references_of(subject.project))


def interface_views(known: Known) -> Iterator[InterfaceView]:
    """A page a component that has no design, by name."""
    project, addresses = known.project, known.addresses
    linker = Linker(project, addresses)
    for each in _sorted_interfaces(project):
        tables = (_with_users(table, each.component, known) for table in tables_of(each, linker))
        yield InterfaceView(
            file=addresses.component(each.component),
            name=each.component,
            kind=BEHAVIOR if is_behavior(each) else "interface",
            title=each.title,
            doc_html=html_of(each.doc),
            facts=tuple(_facts(each)),
            tables=tuple(tables),
            used_by=tuple(user_rows(project, each.component, addresses)),
            findings=finding_rows(known.subject, addresses, each.component),
        )


def interface_rows(known: Known) -> tuple[tuple[InterfaceRow, ...], tuple[InterfaceRow, ...]]:
    """The basic behaviors, and all others."""
    behaviors: list[InterfaceRow] = []
    others: list[InterfaceRow] = []
    for each in _sorted_interfaces(known.project):
        (behaviors if is_behavior(each) else others).append(_row(each, known))
    return tuple(behaviors), tuple(others)


def symbol_groups(known: Known) -> Iterator[SymbolGroup]:
    """What is read and set across components: first what comes from and goes to the robot, then what designs offer."""
    project, addresses = known.project, known.addresses
    owners: list[Interface | Design] = [each for each in _sorted_interfaces(project) if each.readable]
    owners += [design for design in sorted_designs(project) if symbols_of_design(design)]
    for owner in owners:
        linker = Linker(project, addresses, owner if isinstance(owner, Design) else None)
        name = owner.component
        symbols = (row for kind, section in _kinds(owner) for row in _symbol_rows(owner, section, kind, linker))
        rows = tuple(_with_user(row, name, known, addresses) for row in symbols)
        yield SymbolGroup(
            anchor=addresses.symbols(name).partition("#")[2],
            component=linker.component(name),
            title=owner.title if isinstance(owner, Interface) else "",
            rows=rows,
            columns=columns_of(rows),
        )


def symbol_count(project: Project) -> int:
    """How many symbols there are."""
    declared = sum(len(each.readable) for each in project.components)
    return declared + sum(len(symbols_of_design(design)) for design in project.designs)


def enumeration_views(known: Known) -> Iterator[EnumerationView]:
    """The types, each with what is of it."""
    for each in known.project.enumerations:
        anchor = f"enum-{slug(each.name)}"
        yield EnumerationView(
            anchor=anchor,
            name=each.name,
            doc_html=html_of(each.doc, below=2),
            elements=tuple((f"{anchor}-{slug(name)}", name, line_html_of(doc)) for name, doc in each.elements),
            facts=tuple(_facts_of_type(each)),
            declares=listed(_declared_of(each.name, known)),
            used_by=users_line(known.references.to(READ, "", each.name), known),
        )


def constant_table(known: Known) -> DeclarationTable:
    """The constants."""
    linker = Linker(known.project, known.addresses)
    rows = (
        replace(row, read_in=users_line(known.references.to(READ, "", row.name), known))
        for row in rows_of(known.project.constants, linker, "constant-")
    )
    return table_of("Constants", "Value", tuple(rows))


def users_line(users: Mapping[str, tuple[str, ...]], known: Known) -> Line:
    """The designs that say something, each with its states as a tip; one state alone is led to at once."""
    parts = []
    for name in sorted(users, key=by_name):
        states = [state for state in users[name] if state]
        words = ["every state" if state == COMMON else state for state in states]
        href = known.addresses.component(name)
        if len(states) == 1:
            path = ("common",) if states[0] == COMMON else ("states", states[0])
            href = known.addresses.thing(name, path)
        parts.append(Part(text=name, href=href, title=f"in {', '.join(words)}" if words else ""))
    return listed(parts)


def _sorted_interfaces(project: Project) -> list[Interface]:
    return sorted(project.components, key=lambda each: by_name(each.component))


def _row(interface: Interface, known: Known) -> InterfaceRow:
    addresses, name = known.addresses, interface.component
    count = len(interface.readable)
    parameters = (
        Part(text=each.name, href=addresses.member(name, "parameters", each.name), title=each.doc)
        for each in interface.parameters
    )
    return InterfaceRow(
        component=Part(text=name, href=addresses.component(name), title=interface.title),
        parameters=listed(parameters),
        tells=Part(text=str(count), href=addresses.symbols(name)) if count else Part(text="–"),
        users=sum(1 for design in known.project.designs if any(use.component == name for use in design.uses)),
        summary=summary_of(interface.doc) or interface.title,
    )


def _with_users(table: DeclarationTable, component: str, known: Known) -> DeclarationTable:
    is_parameter = table.title == "Parameters"
    rows = (
        replace(row, set_in=users_line(known.references.to(SET, component, f"{row.name}()"), known))
        if is_parameter
        else _with_user(row, component, known)
        for row in table.rows
    )
    return table_of(table.title, table.initial, tuple(rows))


def _with_user(row: DeclarationRow, component: str, known: Known, addresses: Addresses | None = None) -> DeclarationRow:
    read, set_ = (users_line(known.references.to(how, component, row.name), known) for how in (READ, SET))
    section = "variables" if row.anchor.startswith("variable-") else "outputs"
    href = addresses.member(component, section, row.name) if addresses else ""
    return replace(row, read_in=read, set_in=set_, href=href)


def _kinds(owner: Interface | Design) -> tuple[tuple[str, str], ...]:
    """What the outputs and the variables of a component are for the robot."""
    is_kept = isinstance(owner, Design) or owner.implementation == INTERNAL
    return ((("internal" if is_kept else "input"), "outputs"), (("internal" if is_kept else "output"), "variables"))


def _symbol_rows(owner: Interface | Design, section: str, kind: str, linker: Linker) -> Iterator[DeclarationRow]:
    declarations: tuple[Declaration, ...] = getattr(owner, section)
    for row in rows_of(declarations, linker, f"{section.removesuffix('s')}-"):
        yield replace(row, kind=kind)


def _declared_of(enumeration: str, known: Known) -> Iterator[Part]:
    """All that is of a type."""
    owners: list[Interface | Design] = [*_sorted_interfaces(known.project), *sorted_designs(known.project)]
    for owner in owners:
        for section in ("parameters", "outputs", "variables"):
            for each in getattr(owner, section):
                if each.type == enumeration:
                    href = known.addresses.member(owner.component, section, each.name)
                    yield Part(text=f"{owner.component}.{each.name}", href=href, title=summary_of(each.doc))


def _facts_of_type(enumeration: Enumeration) -> Iterator[Line]:
    count = len(enumeration.elements)
    yield plain(f"{count} element{'s' * (count != 1)}")
    if enumeration.internal:
        yield plain("kept by vicode")
    if enumeration.xabsl_name:
        yield (Part(text="in XABSL "), Part(text=enumeration.xabsl_name, kind="code"))


def _facts(interface: Interface) -> Iterator[Line]:
    if interface.is_handed_on:
        yield plain("handed on to the world" if interface.implementation == "world" else "kept by vicode")
    elif interface.implementation:
        yield (Part(text="implemented by "), Part(text=interface.implementation, kind="code"))
    if interface.frequency_hz is not None:
        yield plain(f"works {interface.frequency_hz:g} times a second")
    if interface.xabsl_name:
        yield (Part(text="in XABSL "), Part(text=interface.xabsl_name, kind="code"))
