"""Links in lines: the names in expressions lead to what declares them."""

import re
from collections.abc import Iterable, Iterator

from vicode.docsite.addresses import Addresses
from vicode.docsite.docs import summary_of
from vicode.docsite.views import Line, Part
from vicode.model.design import Declaration, Design
from vicode.model.expressions import FUNCTIONS
from vicode.model.project import Project

_WORDS = re.compile(r"(?<![\w.])[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)?|\d+(?:\.\d+)?|\s+|.", re.DOTALL)
_KEYWORDS = frozenset({"and", "or", "not", "if", "else", "True", "False", "true", "false"})
_SECTIONS = ("parameters", "outputs", "variables")


def plain(text: str) -> Line:
    """A line of words only."""
    return (Part(text=text),) if text else ()


def listed(parts: Iterable[Part], separator: str = ", ") -> Line:
    """Parts in a row."""
    line: list[Part] = []
    for part in parts:
        line += [Part(text=separator), part] if line else [part]
    return tuple(line)


class Linker:
    """Knows the names that a design, or the project alone, can say."""

    def __init__(self, project: Project, addresses: Addresses, design: Design | None = None) -> None:
        self._project, self._addresses, self._design = project, addresses, design
        self._own = self._own_names(design) if design else {}
        self._constants = {each.name: each for each in project.constants}

    def expression(self, text: str) -> Line:
        """An expression in a line, its names linked and coloured."""
        parts: list[Part] = []
        for part in self._parts(" ".join(text.split())):
            if parts and not part.href and not parts[-1].href and part.kind == parts[-1].kind:
                parts[-1] = Part(text=parts[-1].text + part.text, kind=part.kind)
            else:
                parts.append(part)
        return tuple(parts)

    def time(self, text: str) -> Line:
        """An expression that is a time, with its unit."""
        unit = (self._design.time_unit if self._design else "") or "s"
        return (*self.expression(text), Part(text=f" {unit}"))

    def component(self, name: str, shown: str = "") -> Part:
        """A component by name."""
        interface = self._project.interface(name)
        doc = summary_of(interface.doc) if interface else ""
        return Part(text=shown or name, href=self._addresses.component(name), title=doc)

    def alias(self, alias: str) -> Part:
        """A component by what this design calls it."""
        use = self._design.use(alias) if self._design else None
        return self.component(use.component, alias) if use else Part(text=alias)

    def parameter(self, alias: str, name: str) -> Part:
        """A parameter of a component by what this design calls it."""
        use = self._design.use(alias) if self._design else None
        interface = self._project.interface(use.component) if use else None
        parameter = interface.parameter(name) if interface else None
        if parameter is None or use is None:
            return Part(text=name)
        href = self._addresses.member(use.component, "parameters", name)
        return Part(text=name, href=href, title=_tip(parameter))

    def state(self, name: str, shown: str = "") -> Part:
        """A state of the design."""
        assert self._design is not None
        state = self._design.state(name)
        if state is None:
            return Part(text=shown or name)
        href = self._addresses.thing(self._design.component, ("states", name))
        return Part(text=shown or name, href=href, title=summary_of(state.doc))

    def type_of(self, declaration: Declaration) -> Line:
        """The type of a declaration, as it is written."""
        href = self._addresses.enumeration(declaration.type)
        return (Part(text=declaration.type, href=href, kind="code"),) if declaration.type else ()

    def _own_names(self, design: Design) -> dict[str, tuple[str, Declaration]]:
        names: dict[str, tuple[str, Declaration]] = {}
        for section, each in design.declarations():
            names.setdefault(each.name, (self._addresses.member(design.component, section, each.name), each))
        return names

    def _parts(self, text: str) -> Iterator[Part]:
        for match in _WORDS.finditer(text):
            word = match.group()
            is_argument = re.match(r"\s*=(?!=)", text[match.end() :]) is not None
            if word in _KEYWORDS:
                yield Part(text=word, kind="k")
            elif word[0].isdigit():
                yield Part(text=word, kind="m")
            elif (word[0].isalpha() or word[0] == "_") and not is_argument:
                yield from self._name(word)
            else:
                yield Part(text=word)

    def _name(self, word: str) -> Iterator[Part]:
        first, _dot, rest = word.partition(".")
        found = self._own.get(first)
        if found:
            yield Part(text=first, href=found[0], title=_tip(found[1]))
            yield from plain(word[len(first) :])
        elif self._design and self._design.use(first):
            yield self.alias(first)
            yield from self._member(first, rest)
        elif self._project.enumeration(first):
            yield Part(text=word, href=self._addresses.enumeration(first, rest))
        elif first in self._constants:
            yield Part(text=word, href=self._addresses.constant(first), title=_tip(self._constants[first]))
        elif first in FUNCTIONS:
            yield Part(text=word, title=FUNCTIONS[first].doc, kind="f")
        else:
            yield Part(text=word)

    def _member(self, alias: str, name: str) -> Iterator[Part]:
        if not name:
            return
        yield Part(text=".")
        use = self._design.use(alias) if self._design else None
        interface = self._project.interface(use.component) if use else None
        for section in _SECTIONS if interface else ():
            for each in getattr(interface, section):
                if each.name == name and use:
                    href = self._addresses.member(use.component, section, name)
                    yield Part(text=name, href=href, title=_tip(each))
                    return
        yield Part(text=name)


def _tip(declaration: Declaration) -> str:
    unit = f" in {declaration.unit}" if declaration.unit else ""
    about = f"{declaration.name}: {declaration.type}{unit}" if declaration.type else f"{declaration.name}{unit}"
    return " · ".join(part for part in (about, summary_of(declaration.doc)) if part)
