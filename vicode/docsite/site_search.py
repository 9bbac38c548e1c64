"""The entries of the name index and of the search: all names with their descriptions and code."""

import json
from collections.abc import Iterable, Iterator

from vicode.docsite.doc_text import summarize
from vicode.docsite.urls import SiteUrls
from vicode.docsite.views import SiteEntry
from vicode.findings import DesignPath
from vicode.model.design import Design, Transition
from vicode.model.project import Interface, Project
from vicode.model.texts import TextKind, iter_texts
from vicode.model.traversal import iter_decisions

_KINDS = {"parameters": "parameter", "outputs": "output", "variables": "variable"}


def search_entries(project: Project, addresses: SiteUrls, title: str) -> tuple[SiteEntry, ...]:
    """List all named elements, sorted by name; `title` is the title of the project."""
    entries = [*_project_entries(project, addresses, title)]
    for design in project.designs:
        entries += _design_entries(design, addresses)
    for interface in project.components:
        entries += _interface_entries(interface, addresses)
    return tuple(sorted(entries, key=lambda each: (each.name.casefold(), each.name, each.context, each.href)))


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
    index = {
        "kinds": kinds.values,
        "places": places.values,
        "pages": pages.values,
        "pieces": pieces.values,
        "entries": rows,
    }
    text = json.dumps(index, ensure_ascii=False, separators=(",", ":")).replace("],[", "],\n[")
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
        yield SiteEntry(name=agent.name, kind="agent", context=title, href=href, doc=agent.doc)
    for each in project.enumerations:
        href = addresses.enumeration(each.name)
        yield SiteEntry(name=each.name, kind="type", context=title, href=href, doc=each.doc)
        for name, doc in each.elements:
            href = addresses.enumeration(each.name, name)
            yield SiteEntry(name=name, kind="element", context=each.name, href=href, doc=doc)
    for constant in project.constants:
        href = addresses.constant(constant.name)
        words = constant.initial
        yield SiteEntry(
            name=constant.name, kind="constant", context=title, href=href, doc=constant.doc, search_text=words
        )


def _design_entries(design: Design, addresses: SiteUrls) -> Iterator[SiteEntry]:
    name = design.component
    words = _search_texts(design)
    yield SiteEntry(
        name=name,
        kind="component",
        context=summarize(design.doc),
        href=addresses.component(name),
        doc=" ".join(design.doc.split()),
        search_text=words.get((), ""),
    )
    for section, each in design.declarations():
        href = addresses.member(name, section, each.name)
        yield SiteEntry(name=each.name, kind=_KINDS[section], context=name, href=href, doc=each.doc)
    for state in design.states:
        path = ("states", state.name)
        href = addresses.design_path(name, path)
        doc = " ".join(state.doc.split())
        yield SiteEntry(
            name=state.name, kind="state", context=name, href=href, doc=doc, search_text=words.get(path, "")
        )


def _interface_entries(interface: Interface, addresses: SiteUrls) -> Iterator[SiteEntry]:
    name = interface.component
    href = addresses.component(name)
    yield SiteEntry(name=name, kind="interface", context=summarize(interface.doc), href=href, doc=interface.doc)
    for section, kind in _KINDS.items():
        for each in getattr(interface, section):
            href = addresses.member(name, section, each.name)
            yield SiteEntry(name=each.name, kind=kind, context=name, href=href, doc=each.doc)


def _search_texts(design: Design) -> dict[DesignPath, str]:
    """Expressions, code and descriptions of decisions, one per line, by the path of their state, or () outside states.

    The guard of a transition is followed by its target.
    """
    found = ((each.path, each.decision) for each in iter_decisions(design))
    targets = {path: decision.to for path, decision in found if isinstance(decision, Transition)}
    words: dict[DesignPath, list[str]] = {}
    for placed in iter_texts(design):
        path = placed.path[:2] if placed.path[0] == "states" else ()
        is_own_doc = placed.kind is TextKind.DOC and len(placed.path) <= 3
        if not is_own_doc:
            target = targets.get(placed.path[:-1], "")
            text = " ".join(placed.text.split())
            words.setdefault(path, []).append(f"{text} → {target}" if target else text)
    return {path: "\n".join(lines) for path, lines in words.items()}
