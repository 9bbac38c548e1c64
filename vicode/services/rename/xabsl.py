"""Renames symbols in hand-written XABSL, where names are derived from those of the project."""

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace

from vicode.model.design import Code, Design
from vicode.model.project import Interface, Project
from vicode.model.rename import map_code
from vicode.model.xabsl.names import component_name, element_name, list_symbols, symbol_name, unqualified_name
from vicode.xabsl.embedded_code import parse_embedded_actions, parse_embedded_expression
from vicode.xabsl.lexer import Tokens, tokenize
from vicode.xabsl.tokens import NAME

_Names = Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class XabslRenames:
    """The renamed XABSL names, old to new.

    `shared` are symbols, constants, options and behaviors; `own_parameters` parameters by the component that declares
    them; `call_parameters` parameters by the option or function that is called with them; `elements` enumeration
    elements, which may be used without their enumeration.
    """

    shared: dict[str, str] = field(default_factory=dict)
    own_parameters: dict[str, dict[str, str]] = field(default_factory=dict)
    call_parameters: dict[str, dict[str, str]] = field(default_factory=dict)
    elements: dict[str, str] = field(default_factory=dict)
    ambiguous: set[str] = field(default_factory=set)
    """Renamed elements that have the same name as another symbol."""

    @property
    def old_names(self) -> frozenset[str]:
        """All old names, without the @ of own parameters."""
        inner = (name for names in (*self.own_parameters.values(), *self.call_parameters.values()) for name in names)
        names = (*self.shared, *self.elements, *self.ambiguous, *inner)
        return frozenset(name.removeprefix("@") for name in names)


def rename_in_xabsl(before: Project, after: Project) -> Project:
    """The renamed project with its hand-written XABSL renamed where the meaning is certain."""
    renames = collect_xabsl_renames(before, after)
    if not renames.old_names:
        return after
    return replace(after, designs=tuple(_rename_in_design(design, renames) for design in after.designs))


def _rename_in_design(design: Design, renames: XabslRenames) -> Design:
    own = renames.own_parameters.get(design.component, {})

    def renamed(code: Code, role: str) -> Code:
        texts = ((name, _in_text(text, role, own, renames) if name == "xabsl" else text) for name, text in code.texts)
        return replace(code, texts=tuple(texts))

    return map_code(design, renamed)


def count_names_in_xabsl(text: str, names: Collection[str]) -> int:
    """Count the occurrences of names in a text, regardless of their meaning."""
    tokens, _findings = tokenize(text, "")
    pairs = zip(tokens.kinds, tokens.texts, strict=True)
    return sum(kind == NAME and word.removeprefix("@") in names for kind, word in pairs)


def collect_xabsl_renames(before: Project, after: Project) -> XabslRenames:
    """The renamed XABSL names after a rename, which keeps the order of all declarations."""
    renames = XabslRenames()
    symbols = zip(list_symbols(before), list_symbols(after), strict=True)
    _record(renames.shared, ((was.name, now.name) for was, now in symbols))
    was_parts: list[Design | Interface] = [*before.components, *before.designs]
    now_parts: list[Design | Interface] = [*after.components, *after.designs]
    for old, new in zip(was_parts, now_parts, strict=True):
        _record(renames.shared, [(component_name(old), component_name(new))])
        _record_parameters(renames, old, new)
    taken = [symbol.name for symbol in list_symbols(before)]
    taken += [
        element_name(enumeration, name) for enumeration in before.enumerations for name in enumeration.element_names
    ]
    for was, now in zip(before.enumerations, after.enumerations, strict=True):
        pairs = zip(was.element_names, now.element_names, strict=True)
        for old_name, new_name in ((element_name(was, one), element_name(now, other)) for one, other in pairs):
            _record(renames.shared, [(f"{unqualified_name(was)}.{old_name}", f"{unqualified_name(now)}.{new_name}")])
            if old_name != new_name and taken.count(old_name) > 1:
                renames.ambiguous.add(old_name)
            else:
                _record(renames.elements, [(old_name, new_name)])
    return renames


def _record(names: dict[str, str], pairs: Iterable[tuple[str, str]]) -> None:
    names.update((old, new) for old, new in pairs if old != new)


def _record_parameters(renames: XabslRenames, old: Design | Interface, new: Design | Interface) -> None:
    """Record the renamed parameters of a component and of its functions."""
    pairs = [(unqualified_name(a), unqualified_name(b)) for a, b in zip(old.parameters, new.parameters, strict=True)]
    _record(renames.own_parameters.setdefault(new.component, {}), [(f"@{a}", f"@{b}") for a, b in pairs])
    _record(renames.call_parameters.setdefault(component_name(old), {}), pairs)
    for was, now in zip(old.outputs, new.outputs, strict=True):
        arguments = zip(was.arguments or (), now.arguments or (), strict=True)
        inner = [(unqualified_name(a), unqualified_name(b)) for a, b in arguments]
        _record(renames.call_parameters.setdefault(symbol_name(old.component, was), {}), inner)


def _in_text(text: str, role: str, own: _Names, renames: XabslRenames) -> str:
    """Rename in a text; one that does not parse is unchanged."""
    if role not in ("action", "predicate"):
        return text
    if (parse_embedded_actions(text) if role == "action" else parse_embedded_expression(text)).diagnostics:
        return text
    tokens, _findings = tokenize(text, "")
    pieces, end = [], 0
    for index, new in _renamed_tokens(tokens, own, renames):
        pieces += [text[end : tokens.starts[index]], new]
        end = tokens.starts[index] + len(tokens.texts[index])
    return "".join([*pieces, text[end:]])


def _renamed_tokens(tokens: Tokens, own: _Names, renames: XabslRenames) -> Iterator[tuple[int, str]]:
    """The indices of renamed tokens with their new texts."""
    kinds, calls = tokens.kinds, list[str]()
    for index, (kind, text) in enumerate(zip(kinds, tokens.texts, strict=True)):
        if kind == "(":
            calls.append(tokens.texts[index - 1] if index and kinds[index - 1] == NAME else "")
        elif kind == ")" and calls:
            calls.pop()
        if kind != NAME:
            continue
        is_given = bool(calls) and kinds[index + 1] == "=" and kinds[index - 1] in ("(", ",")
        names: _Names = (
            renames.call_parameters.get(calls[-1], {}) if is_given else {**renames.elements, **renames.shared, **own}
        )
        if text in names:
            yield index, names[text]
