"""The entries of the name index and of the search: all names with their descriptions and code."""

import re
from collections.abc import Iterable, Iterator

from vicode.docsite.doc_text import summarize
from vicode.docsite.menu import dump_json, dump_rows
from vicode.docsite.site_names import SiteNames
from vicode.docsite.urls import SiteUrls
from vicode.docsite.views import SiteEntry
from vicode.findings import DesignPath
from vicode.model.design import Design, Transition
from vicode.model.project import Interface, Project
from vicode.model.texts import LocatedText, TextKind, iter_texts
from vicode.model.traversal import iter_decisions

_ELAPSED = re.compile(r"((?:state|option)_time [<>]=? [\d.]+)(?![\w.])")
"""A comparison of a time; the index has its unit, too."""


def search_entries(project: Project, addresses: SiteUrls, title: str) -> tuple[SiteEntry, ...]:
    """List all named elements, sorted by name; `title` is the title of the project.

    The names are those that the pages show. If the design has another name, it is searched, too.
    """
    entries = [*_project_entries(project, addresses, title)]
    for design in project.designs:
        entries += _design_entries(design, addresses)
    for interface in project.components:
        entries += _interface_entries(interface, addresses)
    # A symbol is sought more often than a type of the same name.
    return tuple(
        sorted(
            entries,
            key=lambda each: (
                each.name.casefold().removeprefix("@"),
                each.name,
                each.kind in ("type", "element"),
                each.context,
                each.href,
            ),
        )
    )


def search_script(entries: Iterable[SiteEntry]) -> str:
    """The index as a script, because a page opened from a file cannot read other files.

    Entries refer to shared strings (kinds, parents, pages, code snippets) by their numbers in tables. An anchor that
    equals kind and name is omitted, as are empty values at the end of an entry.
    """
    kinds, places, pages, pieces = _StringTable(), _StringTable(), _StringTable(), _StringTable()
    rows = []
    for entry in entries:
        page, _hash, anchor = entry.href.partition("#")
        anchor_part = 0 if anchor == f"{entry.kind}-{entry.name}" else anchor
        words = [pieces.add(piece) for piece in dict.fromkeys(entry.search_text.split("\n")) if piece]
        # A summary of the description is not a parent.
        place = "" if entry.context in entry.doc else entry.context
        row = [entry.name, kinds.add(entry.kind), places.add(place), pages.add(page)]
        row += [anchor_part, " ".join(entry.doc.split()), words]
        empties: tuple[object, ...] = ([], "", 0)
        for empty in empties:
            # An empty string is the anchor of the page itself, unlike the number 0.
            if row[-1] != empty:
                break
            row.pop()
        rows.append(row)
    tables = {"kinds": kinds, "places": places, "pages": pages, "pieces": pieces}
    fields = [f'"{name}":{dump_json(table.values)}' for name, table in tables.items()]
    text = f'{{{",".join(fields)},"entries":{dump_rows(rows)}}}'
    # Two characters are line ends in JavaScript, but not in JSON.
    text = text.replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")
    return f"/* vicode docs: what can be found */\nwindow.vicodeSearchIndex = {text};\n"


class _StringTable:
    """Numbers distinct values in order of first use."""

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {}

    def add(self, value: str) -> int:
        return self._numbers.setdefault(value, len(self._numbers))

    @property
    def values(self) -> list[str]:
        return list(self._numbers)


def _project_entries(project: Project, addresses: SiteUrls, title: str) -> Iterator[SiteEntry]:
    for agent in project.agents:
        href = addresses.agent(agent.name)
        name = agent.title or agent.name
        yield SiteEntry(
            name=name, kind="agent", context=title, href=href, doc=agent.doc, search_text=_other_name(agent.name, name)
        )
    names = addresses.names
    for each in project.enumerations:
        href, shown = addresses.enumeration(each.name), names.enumeration(each.name)
        other = _other_name(each.name, shown)
        yield SiteEntry(name=shown, kind="type", context=title, href=href, doc=each.doc, search_text=other)
        for element, doc in each.elements:
            href, name = addresses.enumeration(each.name, element), names.element(each, element)
            other = _other_name(element, name)
            yield SiteEntry(name=name, kind="element", context=shown, href=href, doc=doc, search_text=other)
    for constant in project.constants:
        href, name = addresses.constant(constant.name), names.declaration(None, "", constant)
        words = "\n".join(filter(None, (constant.initial, _other_name(constant.name, name))))
        yield SiteEntry(name=name, kind="constant", context=title, href=href, doc=constant.doc, search_text=words)


def _design_entries(design: Design, addresses: SiteUrls) -> Iterator[SiteEntry]:
    names = addresses.names
    name, words = names.component(design.component), _search_texts(design, names)
    yield SiteEntry(
        name=name,
        kind="option" if names.is_xabsl else "component",
        context=summarize(design.doc),
        href=addresses.component(design.component),
        doc=" ".join(design.doc.split()),
        search_text="\n".join(filter(None, (words.get((), ""), _other_name(design.component, name)))),
    )
    yield from _declaration_entries(design, addresses)
    for state in design.states:
        path = ("states", state.name)
        shown = names.state(state)
        yield SiteEntry(
            name=shown,
            kind="state",
            context=name,
            href=addresses.design_path(design.component, path),
            doc=" ".join(state.doc.split()),
            search_text="\n".join(filter(None, (words.get(path, ""), _other_name(state.name, shown)))),
        )


def _interface_entries(interface: Interface, addresses: SiteUrls) -> Iterator[SiteEntry]:
    name = addresses.names.component(interface.component)
    yield SiteEntry(
        name=name,
        kind=addresses.names.interface_kind(interface) if addresses.names.is_xabsl else "interface",
        context=summarize(interface.doc),
        href=addresses.component(interface.component),
        doc=interface.doc,
        search_text=_other_name(interface.component, name),
    )
    yield from _declaration_entries(interface, addresses)


def _declaration_entries(owner: Design | Interface, addresses: SiteUrls) -> Iterator[SiteEntry]:
    names = addresses.names
    for section in ("parameters", "outputs", "variables"):
        for each in getattr(owner, section):
            name = names.declaration(owner, section, each)
            yield SiteEntry(
                name=name,
                kind=names.declaration_kind(owner, section),
                context=names.component(owner.component),
                href=addresses.member(owner.component, section, each.name),
                doc=each.doc,
                search_text=_other_name(each.name, name),
            )


def _other_name(name: str, shown: str) -> str:
    """The name in the design if it differs from the shown one."""
    return "" if name == shown else name


def _search_texts(design: Design, names: SiteNames) -> dict[DesignPath, str]:
    """Expressions, code and descriptions of decisions, one per line, by the path of their state, or () outside states.

    The guard of a transition is followed by its target, a value by the name that it is assigned to.
    """
    found = ((each.path, each.decision) for each in iter_decisions(design))
    targets = {path: decision.to for path, decision in found if isinstance(decision, Transition)}
    words: dict[DesignPath, list[str]] = {}
    for placed in iter_texts(design):
        path = placed.path[:2] if placed.path[0] == "states" else ()
        is_own_doc = placed.kind is TextKind.DOC and len(placed.path) <= 3
        if not is_own_doc:
            target = targets.get(placed.path[:-1], "")
            text = _described_text(placed, design.time_unit or "s", is_xabsl=names.is_xabsl)
            words.setdefault(path, []).append(f"{text} → {names.state_of(design, target)}" if target else text)
    return {path: "\n".join(lines) for path, lines in words.items()}


def _described_text(placed: LocatedText, time_unit: str, *, is_xabsl: bool) -> str:
    text = " ".join(placed.text.split())
    if placed.kind is TextKind.EXPRESSION:
        match placed.path:
            case (*_rest, "after"):
                return f"state_time >= {text} {time_unit}" if is_xabsl else f"after {text} {time_unit}"
            case (*_rest, "set" | "with", str(name)):
                return f"{name} = {text}"
            case _:
                return _ELAPSED.sub(rf"\1 {time_unit}", text) if is_xabsl else text
    return text
