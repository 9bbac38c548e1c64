"""The menu: the links that stand in each page, and the state machines by folder in a script that all pages share."""

import json
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from itertools import takewhile
from pathlib import PurePosixPath

from vicode.docsite.doc_text import summarize
from vicode.docsite.interfaces import symbol_count
from vicode.docsite.natural_sort import natural_sort_key, sorted_designs
from vicode.docsite.site_input import SiteInput
from vicode.docsite.urls import AGENTS, HOME, INTERFACES, NAME_INDEX, SYMBOLS, TYPES, SiteUrls
from vicode.docsite.views import TextSpan
from vicode.model.design import Design

MENU_SCRIPT = "menu.js"


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignFolder:
    """The designs of a folder; `name` is "" for those beside the folders."""

    name: str
    designs: tuple[Design, ...]


def group_by_folder(subject: SiteInput) -> tuple[DesignFolder, ...]:
    """Group the designs by the folders of their sources, without the folders that all of them share."""
    parents = {name: PurePosixPath(source.path).parent.parts for name, source in subject.sources.items() if name}
    own = {design.component: parents.get(design.component, ()) for design in subject.project.designs}
    shared = _shared_length(own.values())
    folders: dict[str, list[Design]] = {}
    for design in sorted_designs(subject.project):
        folders.setdefault("/".join(own[design.component][shared:]), []).append(design)
    return tuple(
        DesignFolder(name=name, designs=tuple(folders[name])) for name in sorted(folders, key=natural_sort_key)
    )


def fixed_links(subject: SiteInput, addresses: SiteUrls, *, has_file: bool) -> Iterator[TextSpan]:
    """The links to the pages about the whole project."""
    project = subject.project
    yield TextSpan(text="Home", href=HOME)
    if project.agents:
        yield TextSpan(text="Agents", href=AGENTS)
    if project.components:
        yield TextSpan(text="Interfaces", href=INTERFACES)
    if symbol_count(project):
        yield TextSpan(text="Symbols", href=SYMBOLS)
    if project.enumerations or project.constants:
        yield TextSpan(text="Types and constants", href=TYPES)
    yield TextSpan(text="Index", href=NAME_INDEX)
    if has_file:
        yield TextSpan(text="Project file", href=addresses.code("", "source"))


def menu_script(folders: Iterable[DesignFolder], addresses: SiteUrls) -> str:
    """The state machines by folder, as a script because a page opened from a file cannot read other files."""
    rows = (
        f"[{dump_json(folder.name)},{dump_rows(_menu_entry(design, addresses) for design in folder.designs)}]"
        for folder in folders
    )
    text = ",\n".join(rows)
    return f"/* vicode docs: the menu of state machines */\nwindow.vicodeMenu = [{text}];\n"


def dump_json(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"))


def dump_rows(rows: Iterable[object]) -> str:
    """A JSON array with each row on a line of its own, so that an edit changes few lines of the file."""
    return "[" + ",\n".join(map(dump_json, rows)) + "]"


def _menu_entry(design: Design, addresses: SiteUrls) -> tuple[str, str, str]:
    name = design.component
    return addresses.names.component(name), addresses.component(name), summarize(design.doc)


def _shared_length(paths: Collection[tuple[str, ...]]) -> int:
    """The number of folders with which all paths begin."""
    levels = zip(*paths, strict=False)
    return sum(1 for _level in takewhile(lambda level: len(set(level)) == 1, levels))
