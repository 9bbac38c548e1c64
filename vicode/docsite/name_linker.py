"""Converts expressions to rich text in which names link to their declarations."""

import re
from collections.abc import Iterable, Iterator

from vicode.docsite.doc_text import summarize
from vicode.docsite.urls import SiteUrls
from vicode.docsite.views import RichText, TextSpan
from vicode.model.design import Declaration, Design
from vicode.model.expressions import FUNCTIONS
from vicode.model.project import Project

_WORDS = re.compile(r"(?<![\w.])[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)?|\d+(?:\.\d+)?|\s+|.", re.DOTALL)
_KEYWORDS = frozenset({"and", "or", "not", "if", "else", "True", "False", "true", "false"})
_SECTIONS = ("parameters", "outputs", "variables")


def plain_text(text: str) -> RichText:
    """Rich text without links."""
    return (TextSpan(text=text),) if text else ()


def join_spans(parts: Iterable[TextSpan], separator: str = ", ") -> RichText:
    """Join spans with a separator."""
    line: list[TextSpan] = []
    for part in parts:
        line += [TextSpan(text=separator), part] if line else [part]
    return tuple(line)


class NameLinker:
    """Links the names that are visible in a design, or in the project file."""

    def __init__(self, project: Project, addresses: SiteUrls, design: Design | None = None) -> None:
        self._project, self._addresses, self._design = project, addresses, design
        self._own = self._own_names(design) if design else {}
        self._constants = {each.name: each for each in project.constants}

    def expression(self, text: str) -> RichText:
        """An expression with linked and highlighted names."""
        parts: list[TextSpan] = []
        for part in self._parts(" ".join(text.split())):
            if parts and not part.href and not parts[-1].href and part.css_class == parts[-1].css_class:
                parts[-1] = TextSpan(text=parts[-1].text + part.text, css_class=part.css_class)
            else:
                parts.append(part)
        return tuple(parts)

    def duration(self, text: str) -> RichText:
        """A time with its unit."""
        unit = (self._design.time_unit if self._design else "") or "s"
        return (*self.expression(text), TextSpan(text=f" {unit}"))

    def component(self, name: str, text: str = "") -> TextSpan:
        interface = self._project.interface(name)
        doc = summarize(interface.doc) if interface else ""
        return TextSpan(text=text or name, href=self._addresses.component(name), title=doc)

    def alias(self, alias: str) -> TextSpan:
        """The component with this alias."""
        use = self._design.use(alias) if self._design else None
        return self.component(use.component, alias) if use else TextSpan(text=alias)

    def parameter(self, alias: str, name: str) -> TextSpan:
        """A parameter of the component with this alias."""
        use = self._design.use(alias) if self._design else None
        interface = self._project.interface(use.component) if use else None
        parameter = interface.parameter(name) if interface else None
        if parameter is None or use is None:
            return TextSpan(text=name)
        href = self._addresses.member(use.component, "parameters", name)
        return TextSpan(text=name, href=href, title=_tooltip(parameter))

    def state(self, name: str, text: str = "") -> TextSpan:
        assert self._design is not None
        state = self._design.state(name)
        if state is None:
            return TextSpan(text=text or name)
        href = self._addresses.design_path(self._design.component, ("states", name))
        return TextSpan(text=text or name, href=href, title=summarize(state.doc))

    def declared_type(self, declaration: Declaration) -> RichText:
        href = self._addresses.enumeration(declaration.type)
        return (TextSpan(text=declaration.type, href=href, css_class="code"),) if declaration.type else ()

    def _own_names(self, design: Design) -> dict[str, tuple[str, Declaration]]:
        names: dict[str, tuple[str, Declaration]] = {}
        for section, each in design.declarations():
            names.setdefault(each.name, (self._addresses.member(design.component, section, each.name), each))
        return names

    def _parts(self, text: str) -> Iterator[TextSpan]:
        for match in _WORDS.finditer(text):
            word = match.group()
            is_argument = re.match(r"\s*=(?!=)", text[match.end() :]) is not None
            if word in _KEYWORDS:
                yield TextSpan(text=word, css_class="k")
            elif word[0].isdigit():
                yield TextSpan(text=word, css_class="m")
            elif (word[0].isalpha() or word[0] == "_") and not is_argument:
                yield from self._name(word)
            else:
                yield TextSpan(text=word)

    def _name(self, word: str) -> Iterator[TextSpan]:
        first, _dot, rest = word.partition(".")
        found = self._own.get(first)
        if found:
            yield TextSpan(text=first, href=found[0], title=_tooltip(found[1]))
            yield from plain_text(word[len(first) :])
        elif self._design and self._design.use(first):
            yield self.alias(first)
            yield from self._member(first, rest)
        elif self._project.enumeration(first):
            yield TextSpan(text=word, href=self._addresses.enumeration(first, rest))
        elif first in self._constants:
            yield TextSpan(text=word, href=self._addresses.constant(first), title=_tooltip(self._constants[first]))
        elif first in FUNCTIONS:
            yield TextSpan(text=word, title=FUNCTIONS[first].doc, css_class="f")
        else:
            yield TextSpan(text=word)

    def _member(self, alias: str, name: str) -> Iterator[TextSpan]:
        if not name:
            return
        yield TextSpan(text=".")
        use = self._design.use(alias) if self._design else None
        interface = self._project.interface(use.component) if use else None
        for section in _SECTIONS if interface else ():
            for each in getattr(interface, section):
                if each.name == name and use:
                    href = self._addresses.member(use.component, section, name)
                    yield TextSpan(text=name, href=href, title=_tooltip(each))
                    return
        yield TextSpan(text=name)


def _tooltip(declaration: Declaration) -> str:
    unit = f" in {declaration.unit}" if declaration.unit else ""
    about = f"{declaration.name}: {declaration.type}{unit}" if declaration.type else f"{declaration.name}{unit}"
    return " · ".join(part for part in (about, summarize(declaration.doc)) if part)
