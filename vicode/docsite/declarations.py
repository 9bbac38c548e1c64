"""Tables of declarations."""

from collections.abc import Iterable, Iterator
from dataclasses import replace

from vicode.docsite.doc_text import render_facts
from vicode.docsite.name_linker import NameLinker
from vicode.docsite.reference_lists import ReferenceIndex
from vicode.docsite.urls import slug
from vicode.docsite.views import DeclarationRow, DeclarationTable, RichText, TextSpan
from vicode.model.design import Declaration, Design
from vicode.model.project import Interface
from vicode.model.words import describe_fields

_SECTIONS = {"parameters": "Default", "outputs": "Initial value", "variables": "Initial value"}
"""The sections with the titles of their values."""
_SHOWN = ("type", "initial", "unit", "range", "doc", "xabsl_name")
_COLUMNS = ("type", "initial", "unit", "range", "doc_html", "arguments", "read_in", "set_in")


def declaration_tables(
    owner: Design | Interface, linker: NameLinker, references: ReferenceIndex
) -> Iterator[DeclarationTable]:
    """The tables of a component, with all places that set and read each declaration."""
    for section, initial in _SECTIONS.items():
        rows = tuple(
            replace(row, references=references.of_member(owner.component, section, declaration))
            for declaration, row in declaration_rows(owner, section, linker)
        )
        if rows:
            title = f"{linker.declaration_kind(owner, section)}s"
            yield make_declaration_table(title.capitalize(), initial, rows)


def make_declaration_table(title: str, initial: str, rows: tuple[DeclarationRow, ...]) -> DeclarationTable:
    """A table that omits empty columns."""
    return DeclarationTable(title=title, initial_heading=initial, rows=rows, columns=used_columns(rows))


def used_columns(rows: Iterable[DeclarationRow]) -> frozenset[str]:
    """The columns that have a value in at least one row."""
    return frozenset(name for row in rows for name in _COLUMNS if getattr(row, name))


def declaration_rows(
    owner: Design | Interface, section: str, linker: NameLinker
) -> Iterator[tuple[Declaration, DeclarationRow]]:
    """The declarations of a section of a component with their rows."""
    declarations: tuple[Declaration, ...] = getattr(owner, section)
    for each in declarations:
        yield each, _row(each, linker.declaration_name(owner, section, each), section.removesuffix("s"), linker)


def constant_rows(constants: Iterable[Declaration], linker: NameLinker) -> Iterator[tuple[Declaration, DeclarationRow]]:
    for each in constants:
        yield each, _row(each, linker.declaration_name(None, "", each), "constant", linker)


def _row(declaration: Declaration, name: str, prefix: str, linker: NameLinker) -> DeclarationRow:
    return DeclarationRow(
        anchor=f"{prefix}-{slug(declaration.name)}",
        name=name,
        arguments=tuple(_argument(argument, linker) for argument in declaration.arguments or ()),
        type=linker.declared_type(declaration),
        initial=linker.expression(declaration.initial, declaration.type),
        unit=declaration.unit,
        range=f"{declaration.range[0]:g} … {declaration.range[1]:g}" if declaration.range else "",
        doc_html=render_facts(declaration.doc, describe_fields(declaration, _SHOWN)),
    )


def _argument(argument: Declaration, linker: NameLinker) -> RichText:
    words = [argument.unit, f"{argument.range[0]:g} … {argument.range[1]:g}" if argument.range else "", argument.doc]
    words += describe_fields(argument, _SHOWN)
    about = ", ".join(word for word in words if word)
    type_ = linker.declared_type(argument)
    line = (
        TextSpan(text=linker.argument_name(argument), css_class="code"),
        *((TextSpan(text=" "), *type_) if type_ else ()),
    )
    return (*line, TextSpan(text=f" · {about}")) if about else line
