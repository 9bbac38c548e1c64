"""New names in hand-written XABSL: what a thing is called there follows from its name, unless it was given another."""

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
    """The words of XABSL that are others, old to new.

    `shared` are symbols, constants, options and behaviors; `own` parameters by the component that has them; `call_parameters`
    parameters by what is called with them; `elements` those that may stand without their enumeration.
    """

    shared: dict[str, str] = field(default_factory=dict)
    own_parameters: dict[str, dict[str, str]] = field(default_factory=dict)
    call_parameters: dict[str, dict[str, str]] = field(default_factory=dict)
    elements: dict[str, str] = field(default_factory=dict)
    ambiguous: set[str] = field(default_factory=set)
    """Words of which it cannot be told what they mean."""

    @property
    def old_names(self) -> frozenset[str]:
        """All words that are others, as they were, without the sign of own parameters."""
        inner = (name for names in (*self.own_parameters.values(), *self.call_parameters.values()) for name in names)
        words = (*self.shared, *self.elements, *self.ambiguous, *inner)
        return frozenset(word.removeprefix("@") for word in words)


def rename_in_xabsl(before: Project, after: Project) -> Project:
    """The project after a rename, with the hand-written XABSL of its designs following where it is certain."""
    words = collect_xabsl_renames(before, after)
    if not words.old_names:
        return after
    return replace(after, designs=tuple(_followed(design, words) for design in after.designs))


def _followed(design: Design, words: XabslRenames) -> Design:
    own = words.own_parameters.get(design.component, {})

    def renamed(code: Code, role: str) -> Code:
        texts = ((name, _in_text(text, role, own, words) if name == "xabsl" else text) for name, text in code.texts)
        return replace(code, texts=tuple(texts))

    return map_code(design, renamed)


def count_names_in_xabsl(text: str, names: Collection[str]) -> int:
    """How often names stand in a text, whatever they mean there."""
    tokens, _findings = tokenize(text, "")
    pairs = zip(tokens.kinds, tokens.texts, strict=True)
    return sum(kind == NAME and word.removeprefix("@") in names for kind, word in pairs)


def collect_xabsl_renames(before: Project, after: Project) -> XabslRenames:
    """What is said otherwise in XABSL after a rename, which keeps the order of all things."""
    words = XabslRenames()
    symbols = zip(list_symbols(before), list_symbols(after), strict=True)
    _record(words.shared, ((was.name, now.name) for was, now in symbols))
    was_parts: list[Design | Interface] = [*before.components, *before.designs]
    now_parts: list[Design | Interface] = [*after.components, *after.designs]
    for old, new in zip(was_parts, now_parts, strict=True):
        _record(words.shared, [(component_name(old), component_name(new))])
        _record_parameters(words, old, new)
    taken = [each.name for each in list_symbols(before)]
    taken += [element_name(each, name) for each in before.enumerations for name in each.element_names]
    for was, now in zip(before.enumerations, after.enumerations, strict=True):
        pairs = zip(was.element_names, now.element_names, strict=True)
        for old_name, new_name in ((element_name(was, one), element_name(now, other)) for one, other in pairs):
            _record(words.shared, [(f"{unqualified_name(was)}.{old_name}", f"{unqualified_name(now)}.{new_name}")])
            if old_name != new_name and taken.count(old_name) > 1:
                words.ambiguous.add(old_name)
            else:
                _record(words.elements, [(old_name, new_name)])
    return words


def _record(names: dict[str, str], pairs: Iterable[tuple[str, str]]) -> None:
    names.update((old, new) for old, new in pairs if old != new)


def _record_parameters(words: XabslRenames, old: Design | Interface, new: Design | Interface) -> None:
    """What a component is called with, and what its functions are asked with."""
    pairs = [(unqualified_name(a), unqualified_name(b)) for a, b in zip(old.parameters, new.parameters, strict=True)]
    _record(words.own_parameters.setdefault(new.component, {}), [(f"@{a}", f"@{b}") for a, b in pairs])
    _record(words.call_parameters.setdefault(component_name(old), {}), pairs)
    for was, now in zip(old.outputs, new.outputs, strict=True):
        arguments = zip(was.arguments or (), now.arguments or (), strict=True)
        inner = [(unqualified_name(a), unqualified_name(b)) for a, b in arguments]
        _record(words.call_parameters.setdefault(symbol_name(old.component, was), {}), inner)


def _in_text(text: str, role: str, own: _Names, words: XabslRenames) -> str:
    """The text with new words; what is no XABSL stays as it is."""
    if role not in ("action", "predicate"):
        return text
    if (parse_embedded_actions(text) if role == "action" else parse_embedded_expression(text)).diagnostics:
        return text
    tokens, _findings = tokenize(text, "")
    pieces, end = [], 0
    for at, new in _renamed_tokens(tokens, own, words):
        pieces += [text[end : tokens.starts[at]], new]
        end = tokens.starts[at] + len(tokens.texts[at])
    return "".join([*pieces, text[end:]])


def _renamed_tokens(tokens: Tokens, own: _Names, words: XabslRenames) -> Iterator[tuple[int, str]]:
    """The tokens that are others, each with its new text."""
    kinds, calls = tokens.kinds, list[str]()
    for at, (kind, text) in enumerate(zip(kinds, tokens.texts, strict=True)):
        if kind == "(":
            calls.append(tokens.texts[at - 1] if at and kinds[at - 1] == NAME else "")
        elif kind == ")" and calls:
            calls.pop()
        if kind != NAME:
            continue
        is_given = bool(calls) and kinds[at + 1] == "=" and kinds[at - 1] in ("(", ",")
        names: _Names = (
            words.call_parameters.get(calls[-1], {}) if is_given else {**words.elements, **words.shared, **own}
        )
        if text in names:
            yield at, names[text]
