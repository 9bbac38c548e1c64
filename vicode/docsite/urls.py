"""URLs of pages and anchors. All pages are in one folder, so relative URLs are the same on each page."""

import re
from collections.abc import Iterable

from vicode.docsite.site_names import SiteNames
from vicode.findings import DesignPath
from vicode.model.design import COMMON
from vicode.model.project import Project

HOME, AGENTS, INTERFACES = "index.html", "agents.html", "interfaces.html"
SYMBOLS, TYPES, NAME_INDEX = "symbols.html", "types.html", "all.html"
_MAX_SLUG_LENGTH = 60
_SINGULAR = {"parameters": "parameter", "outputs": "output", "variables": "variable"}


def slug(name: str) -> str:
    """Convert a name to a part of a URL."""
    return re.sub(r"[^A-Za-z0-9_-]+", "-", name)[:_MAX_SLUG_LENGTH].strip("-") or "x"


def path_anchor(path: DesignPath) -> str:
    """The anchor of the node at a path on the page of its component; "" for the page itself."""
    match path:
        case ("states", str(name), "transitions", int(), *_):
            return f"{state_anchor(name)}-{_decision_steps(path[3:])}"
        case ("states", str(name), *_):
            return state_anchor(name)
        case ("common", "transitions", int(), *_):
            return f"common-{_decision_steps(path[2:])}"
        case ("common", *_):
            return "common"
        case (str(section), str(name), *_) if section in _SINGULAR:
            return f"{_SINGULAR[section]}-{slug(name)}"
        case _:
            return ""


def state_anchor(name: str) -> str:
    return "common" if name == COMMON else f"state-{slug(name)}"


def _decision_steps(path: DesignPath) -> str:
    """The part of a path that leads to a decision, without the keys inside it."""
    steps = []
    for step in path:
        if not isinstance(step, int) and step not in ("then", "else"):
            break
        steps.append(str(step))
    return "-".join(steps)


class SiteUrls:
    """The URLs of a project, and the names that links show.

    File names are unique on case-insensitive file systems, too.
    """

    def __init__(self, project: Project) -> None:
        self._project = project
        self.names = SiteNames(project)
        self._stems = unique_slugs(design.component for design in project.designs)
        self._interfaces = unique_slugs(each.component for each in project.components)
        self._agents = unique_slugs(each.name for each in project.agents)
        self.key = (
            tuple(self._stems.items()),
            tuple(self._interfaces.items()),
            tuple(each.name for each in project.enumerations),
            tuple(self._agents.items()),
            self.names.key,
        )
        """The inputs of all URLs and names."""

    def component(self, name: str) -> str:
        """The page of a component; "" for an unknown one."""
        if name in self._stems:
            return f"component-{self._stems[name]}.html"
        return f"interface-{self._interfaces[name]}.html" if name in self._interfaces else ""

    def has_design(self, name: str) -> bool:
        """Whether a component is a state machine."""
        return name in self._stems

    def design_path(self, component: str, path: DesignPath) -> str:
        anchor = path_anchor(path)
        return self.component(component) + (f"#{anchor}" if anchor else "")

    def member(self, component: str, section: str, name: str) -> str:
        page = self.component(component)
        return f"{page}#{_SINGULAR[section]}-{slug(name)}" if page else ""

    def symbols(self, component: str) -> str:
        """The symbols of a component on the page of all symbols."""
        return f"{SYMBOLS}#symbols-{(self._stems | self._interfaces)[component]}"

    def code(self, component: str, variant: str) -> str:
        """The code page of a component; `variant` is "source" or a language."""
        return f"{variant}-{self._stems[component]}.html" if component else f"{variant}.html"

    def try_script(self, component: str) -> str:
        """The script that runs a design."""
        return f"try-{self._stems[component]}.js"

    def enumeration(self, name: str, element: str = "") -> str:
        """The description of an enumeration or of one of its elements; "" if unknown."""
        if self._project.enumeration(name) is None:
            return ""
        return f"{TYPES}#enum-{slug(name)}" + (f"-{slug(element)}" if element else "")

    def constant(self, name: str) -> str:
        return f"{TYPES}#constant-{slug(name)}"

    def agent(self, name: str) -> str:
        return f"agent-{self._agents[name]}.html"


def unique_slugs(names: Iterable[str]) -> dict[str, str]:
    """Convert names to URL parts that differ in more than case."""
    stems: dict[str, str] = {}
    taken: set[str] = set()
    for name in names:
        stem, number = slug(name), 1
        while stem.casefold() in taken:
            number += 1
            stem = f"{slug(name)}-{number}"
        taken.add(stem.casefold())
        stems[name] = stem
    return stems
