"""Converts expressions to rich text in which names link to their declarations."""

import re
from collections.abc import Iterable, Iterator

from vicode.docsite.doc_text import summarize
from vicode.docsite.site_names import NamedSymbol
from vicode.docsite.urls import SiteUrls
from vicode.docsite.views import RichText, TextSpan
from vicode.model.design import Declaration, Design, State
from vicode.model.expressions import FUNCTIONS
from vicode.model.project import Interface, Project

_WORDS = re.compile(r"(?<![\w.])[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)?|\d+(?:\.\d+)?|\s+|.", re.DOTALL)
_XABSL_WORDS = re.compile(r"@?[A-Za-z_][\w.]*|\d+(?:\.\d+)?|\s+|&&|\|\||[!=<>]=|.", re.DOTALL)
_XABSL_KEYWORDS = frozenset({"&&", "||", "!", "?", ":", "true", "false"})
_XABSL_SYMBOLS = {
    "state_time": "Time in this state, in ms",
    "option_time": "Time since the option started, in ms",
    "action_done": "Whether an option that is called has reached a target state",
    "conflict": "Whether other robots are in the state",
}
_KEYWORDS = frozenset({"and", "or", "not", "if", "else", "True", "False", "true", "false"})
_SECTIONS = ("parameters", "outputs", "variables")


def plain_text(text: str) -> RichText:
    """Rich text without links."""
    return (TextSpan(text=text),) if text else ()


def join_spans(parts: Iterable[TextSpan]) -> RichText:
    """Join spans with commas."""
    line: list[TextSpan] = []
    for part in parts:
        line += [TextSpan(text=", "), part] if line else [part]
    return tuple(line)


class NameLinker:
    """Links the names that are visible in a design, or in the project file."""

    def __init__(self, project: Project, addresses: SiteUrls, design: Design | None = None) -> None:
        self._project, self._addresses, self._design = project, addresses, design
        self._names = addresses.names
        self._own = self._own_names(design) if design else {}
        self._constants = {each.name: each for each in project.constants}

    @property
    def is_xabsl(self) -> bool:
        """Whether expressions and names are those of XABSL."""
        return self._names.is_xabsl

    def expression(self, text: str, type_: str = "") -> RichText:
        """An expression with linked and highlighted names; `type_` is its type, if known."""
        parts: list[TextSpan] = []
        line = " ".join(text.split())
        for part in self._xabsl_parts(line, type_) if self.is_xabsl else self._parts(line):
            if parts and not part.href and not parts[-1].href and part.css_class == parts[-1].css_class:
                parts[-1] = TextSpan(text=parts[-1].text + part.text, css_class=part.css_class)
            else:
                parts.append(part)
        return tuple(parts)

    def duration(self, text: str) -> RichText:
        """A time with its unit."""
        unit = (self._design.time_unit if self._design else "") or "s"
        return (*self.expression(text), TextSpan(text=f" {unit}"))

    def timer(self, time: str) -> RichText:
        """The condition that the state has been active for a time."""
        if self.is_xabsl and self._design and self._design.time_unit == "ms":
            return self.expression(f"state_time >= {time}")
        return (TextSpan(text="after ", css_class="k"), *self.duration(time))

    def component(self, name: str, text: str = "") -> TextSpan:
        interface = self._project.interface(name)
        doc = summarize(interface.doc) if interface else ""
        return TextSpan(text=text or self._names.component(name), href=self._addresses.component(name), title=doc)

    def alias(self, alias: str) -> TextSpan:
        """The component with this alias."""
        use = self._design.use(alias) if self._design else None
        if use is None:
            return TextSpan(text=alias)
        # XABSL has no aliases.
        return self.component(use.component, "" if self.is_xabsl else alias)

    def parameter(self, alias: str, name: str) -> TextSpan:
        """A parameter of the component with this alias."""
        use = self._design.use(alias) if self._design else None
        interface = self._project.interface(use.component) if use else None
        parameter = interface.parameter(name) if interface else None
        if parameter is None or use is None:
            return TextSpan(text=name)
        href = self._addresses.member(use.component, "parameters", name)
        return TextSpan(text=self._names.argument(parameter), href=href, title=_tooltip(parameter))

    def parameter_type(self, alias: str, name: str) -> str:
        use = self._design.use(alias) if self._design else None
        interface = self._project.interface(use.component) if use else None
        parameter = interface.parameter(name) if interface else None
        return parameter.type if parameter else ""

    def state(self, name: str, text: str = "") -> TextSpan:
        assert self._design is not None
        state = self._design.state(name)
        if state is None:
            return TextSpan(text=text or name)
        href = self._addresses.design_path(self._design.component, ("states", name))
        return TextSpan(text=text or self._names.state(state), href=href, title=summarize(state.doc))

    def state_name(self, state: State) -> str:
        return self._names.state(state)

    def declaration_name(self, owner: Design | Interface | None, section: str, declaration: Declaration) -> str:
        return self._names.declaration(owner, section, declaration)

    def declaration_kind(self, owner: Design | Interface, section: str) -> str:
        return self._names.declaration_kind(owner, section)

    def argument_name(self, declaration: Declaration) -> str:
        return self._names.argument(declaration)

    def declared_type(self, declaration: Declaration) -> RichText:
        href = self._addresses.enumeration(declaration.type)
        text = self._names.enumeration(declaration.type)
        return (TextSpan(text=text, href=href, css_class="code"),) if text else ()

    def _own_names(self, design: Design) -> dict[str, tuple[str, Declaration]]:
        names: dict[str, tuple[str, Declaration]] = {}
        for section, each in design.declarations():
            names.setdefault(each.name, (self._addresses.member(design.component, section, each.name), each))
            if section == "parameters" and self.is_xabsl:
                names[self._names.declaration(design, section, each)] = names[each.name]
        return names

    def _xabsl_parts(self, text: str, type_: str) -> Iterator[TextSpan]:
        """An element is that of the type of the name before it, if several types have such an element."""
        for match in _XABSL_WORDS.finditer(text):
            word = match.group()
            own = self._own.get(word)
            symbol = self._names.find_symbol(word)
            if word in _XABSL_KEYWORDS:
                yield TextSpan(text=word, css_class="k")
            elif word in _XABSL_SYMBOLS:
                yield TextSpan(text=word, title=_XABSL_SYMBOLS[word], css_class="f")
            elif word[0].isdigit():
                yield TextSpan(text=word, css_class="m")
            elif not (word[0].isalpha() or word[0] in "_@") or re.match(r"\s*=(?!=)", text[match.end() :]):
                yield TextSpan(text=word)
            elif own and word[0] == "@":
                type_ = own[1].type or type_
                yield TextSpan(text=word, href=own[0], title=_tooltip(own[1]))
            elif symbol:
                type_ = symbol.declaration.type or type_
                yield self._symbol(word, symbol)
            else:
                yield from self._xabsl_element(word, type_)

    def _symbol(self, name: str, symbol: NamedSymbol) -> TextSpan:
        is_constant = symbol.section == "constants"
        member = symbol.component, symbol.section, symbol.declaration.name
        href = self._addresses.constant(member[2]) if is_constant else self._addresses.member(*member)
        return TextSpan(text=name, href=href, title=_tooltip(symbol.declaration, name))

    def _xabsl_element(self, name: str, type_: str) -> Iterator[TextSpan]:
        found = self._names.find_element(name, type_)
        if found:
            href = self._addresses.enumeration(found[0].name, found[1])
            yield TextSpan(text=name, href=href, title=self._names.enumeration(found[0].name))
        else:
            # An expression that XABSL cannot express.
            yield from self._parts(name)

    def symbol(self, name: str) -> RichText:
        """A symbol that is set."""
        symbol = self._names.find_symbol(name)
        return (self._symbol(name, symbol),) if symbol else self.expression(name)

    def symbol_type(self, name: str) -> str:
        symbol = self._names.find_symbol(name)
        return symbol.declaration.type if symbol else ""

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


def _tooltip(declaration: Declaration, name: str = "") -> str:
    name = name or declaration.name
    unit = f" in {declaration.unit}" if declaration.unit else ""
    about = f"{name}: {declaration.type}{unit}" if declaration.type else f"{name}{unit}"
    return " · ".join(part for part in (about, summarize(declaration.doc)) if part)
