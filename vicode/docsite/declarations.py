"""Tables of declarations."""

from collections.abc import Iterable, Iterator

from vicode.docsite.addresses import slug
from vicode.docsite.docs import line_html_of
from vicode.docsite.linking import Linker
from vicode.docsite.views import DeclarationRow, DeclarationTable, Line, Part
from vicode.model.design import Declaration, Design
from vicode.model.project import Interface

_TITLES = {
    "parameters": ("Parameters", "Default"),
    "outputs": ("Outputs", "At first"),
    "variables": ("Variables", "At first"),
}
_COLUMNS = ("type", "initial", "unit", "range", "doc_html", "arguments", "read_in", "set_in")


def tables_of(owner: Design | Interface, linker: Linker, prefix: str = "") -> Iterator[DeclarationTable]:
    """The tables of a component; `prefix` stands before the anchors."""
    for section, (title, initial) in _TITLES.items():
        declarations = getattr(owner, section)
        if declarations:
            rows = tuple(rows_of(declarations, linker, prefix + section.removesuffix("s") + "-"))
            yield table_of(title, initial, rows)


def table_of(title: str, initial: str, rows: tuple[DeclarationRow, ...]) -> DeclarationTable:
    """A table without empty columns."""
    return DeclarationTable(title=title, initial=initial, rows=rows, columns=columns_of(rows))


def columns_of(rows: Iterable[DeclarationRow]) -> frozenset[str]:
    """The columns that at least one row has something for."""
    return frozenset(name for row in rows for name in _COLUMNS if getattr(row, name))


def rows_of(declarations: Iterable[Declaration], linker: Linker, prefix: str) -> Iterator[DeclarationRow]:
    """A row for each."""
    for each in declarations:
        yield DeclarationRow(
            anchor=prefix + slug(each.name),
            name=each.name,
            arguments=tuple(_argument(argument, linker) for argument in each.arguments or ()),
            type=linker.type_of(each),
            initial=linker.expression(each.initial),
            unit=each.unit,
            range=f"{each.range[0]:g} … {each.range[1]:g}" if each.range else "",
            doc_html=line_html_of(each.doc),
        )


def _argument(argument: Declaration, linker: Linker) -> Line:
    words = [argument.unit, f"{argument.range[0]:g} … {argument.range[1]:g}" if argument.range else "", argument.doc]
    about = ", ".join(word for word in words if word)
    type_ = linker.type_of(argument)
    line = (Part(text=argument.name, kind="code"), *((Part(text=" "), *type_) if type_ else ()))
    return (*line, Part(text=f" · {about}")) if about else line
