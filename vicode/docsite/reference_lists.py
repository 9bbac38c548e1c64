"""Lists of the places that read, set or use something: by component or value, with states and lines."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from vicode.docsite.natural_sort import natural_sort_key
from vicode.docsite.references import CALL, READ, SET, Reference, SymbolReferences
from vicode.docsite.site_input import SiteInput
from vicode.docsite.urls import SiteUrls
from vicode.docsite.views import ReferenceLine, ReferenceList, RichText, TextSpan
from vicode.model.design import COMMON, Declaration
from vicode.model.project import Enumeration


@dataclass(frozen=True, slots=True, kw_only=True)
class ReferenceIndex:
    """All references of a project, as lists of links."""

    site_input: SiteInput
    urls: SiteUrls
    references: SymbolReferences

    def of_member(self, component: str, section: str, declaration: Declaration) -> tuple[ReferenceList, ...]:
        """The places that set and read a declaration of a component."""
        name = declaration.name
        key = f"{name}()" if section == "parameters" else name
        has_few_values = declaration.type == "bool" or self.site_input.project.enumeration(declaration.type) is not None
        return (
            *self._list("Set in", self.references.places(SET, component, key), by_value=has_few_values),
            *self._list("Read in", self.references.places(READ, component, name)),
        )

    def of_constant(self, name: str) -> tuple[ReferenceList, ...]:
        return tuple(self._list("Read in", self.references.places(READ, "", name)))

    def of_element(self, enumeration: Enumeration, element: str) -> tuple[ReferenceList, ...]:
        return tuple(self._list("Used in", self.references.places(READ, "", f"{enumeration.name}.{element}")))

    def calls(self, user: str, component: str) -> RichText:
        """The states of a design that call a component."""
        places = self.references.places(CALL, component, "")
        return tuple(self._states([each for each in places if each.component == user]))

    def _list(self, title: str, places: tuple[Reference, ...], *, by_value: bool = False) -> Iterator[ReferenceList]:
        groups = _grouped(places, lambda place: place.value if by_value else place.component)
        lines = tuple(
            ReferenceLine(
                value=(name or "in code") if by_value else "",
                place_count=len(group),
                places=tuple(self._components(group, has_values=not by_value)),
            )
            for name, group in groups.items()
        )
        if lines:
            yield ReferenceList(title=title, place_count=len(places), lines=lines)

    def _components(self, places: Iterable[Reference], *, has_values: bool) -> Iterator[TextSpan]:
        for index, (name, group) in enumerate(_grouped(places, lambda place: place.component).items()):
            if index:
                yield TextSpan(text="; ")
            yield from self._component(name)
            yield from self._states(group, has_values=has_values)

    def _component(self, name: str) -> RichText:
        return (
            TextSpan(text=self.urls.names.component(name), href=self.urls.component(name)),
            TextSpan(text=" › "),
        )

    def _states(self, places: Iterable[Reference], *, has_values: bool = False) -> Iterator[TextSpan]:
        """The states with their lines and values; all places are in one component."""
        for index, (state, group) in enumerate(_grouped(places, lambda place: place.state).items()):
            if index:
                yield TextSpan(text=", ")
            yield self._state(state, group[0])
            shown: set[tuple[int, str]] = set()
            for place in group:
                source = self.site_input.sources.get(place.component)
                line, value = source.nearest_line(place.path) if source else 0, place.value if has_values else ""
                if (line, value) in shown:
                    continue
                shown.add((line, value))
                if value:
                    yield TextSpan(text=" = ")
                    yield TextSpan(text=value, css_class="code")
                if source and line:
                    # A line does not begin with a number.
                    yield TextSpan(text="\N{NO-BREAK SPACE}")
                    href = f"{self.urls.code(place.component, 'source')}#L{line}"
                    yield TextSpan(
                        text=str(line), href=href, title=f"{source.path}, line {line}", css_class="line-link"
                    )

    def _state(self, name: str, place: Reference) -> TextSpan:
        if name == COMMON:
            return TextSpan(text="every state", href=self.urls.design_path(place.component, ("common",)))
        if not name:
            return TextSpan(text="declarations", href=self.urls.design_path(place.component, place.path[:2]))
        design = self.site_input.project.design(place.component)
        text = self.urls.names.state_of(design, name) if design else name
        return TextSpan(text=text, href=self.urls.design_path(place.component, ("states", name)))


def _grouped(places: Iterable[Reference], key: Callable[[Reference], str]) -> dict[str, list[Reference]]:
    """Group places, sorted by component."""
    groups: dict[str, list[Reference]] = {}
    for place in sorted(places, key=lambda place: natural_sort_key(place.component)):
        groups.setdefault(key(place), []).append(place)
    return groups
