"""New names in hand-written XABSL: what a thing is called there follows from its name, unless it was given another."""

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace

from vicode.model.design import Code, Design
from vicode.model.project import Interface, Project
from vicode.model.renaming import map_code
from vicode.model.xabsl.names import component_name, element_name, list_symbols, plain_name, symbol_name
from vicode.xabsl.lexer import Tokens, tokenize
from vicode.xabsl.pieces import read_actions, read_expression
from vicode.xabsl.tokens import NAME

_Names = Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class NewWords:
    """The words of XABSL that are others, old to new.

    `shared` are symbols, constants, options and behaviors; `own` parameters by the component that has them; `given`
    parameters by what is called with them; `elements` those that may stand without their enumeration.
    """

    shared: dict[str, str] = field(default_factory=dict)
    own: dict[str, dict[str, str]] = field(default_factory=dict)
    given: dict[str, dict[str, str]] = field(default_factory=dict)
    elements: dict[str, str] = field(default_factory=dict)
    unclear: set[str] = field(default_factory=set)
    """Words of which it cannot be told what they mean."""

    @property
    def old(self) -> frozenset[str]:
        """All words that are others, as they were, without the sign of own parameters."""
        inner = (name for names in (*self.own.values(), *self.given.values()) for name in names)
        words = (*self.shared, *self.elements, *self.unclear, *inner)
        return frozenset(word.removeprefix("@") for word in words)


def follow_in_xabsl(before: Project, after: Project) -> Project:
    """The project after a rename, with the hand-written XABSL of its designs following where it is certain."""
    words = new_words(before, after)
    if not words.old:
        return after
    return replace(after, designs=tuple(_followed(design, words) for design in after.designs))


def _followed(design: Design, words: NewWords) -> Design:
    own = words.own.get(design.component, {})

    def renamed(code: Code, role: str) -> Code:
        texts = ((name, _in_text(text, role, own, words) if name == "xabsl" else text) for name, text in code.texts)
        return replace(code, texts=tuple(texts))

    return map_code(design, renamed)


def count_in_xabsl(text: str, names: Collection[str]) -> int:
    """How often names stand in a text, whatever they mean there."""
    tokens, _findings = tokenize(text, "")
    pairs = zip(tokens.kinds, tokens.texts, strict=True)
    return sum(kind == NAME and word.removeprefix("@") in names for kind, word in pairs)


def new_words(before: Project, after: Project) -> NewWords:
    """What is said otherwise in XABSL after a rename, which keeps the order of all things."""
    words = NewWords()
    symbols = zip(list_symbols(before), list_symbols(after), strict=True)
    _note(words.shared, ((was.name, now.name) for was, now in symbols))
    was_parts: list[Design | Interface] = [*before.components, *before.designs]
    now_parts: list[Design | Interface] = [*after.components, *after.designs]
    for old, new in zip(was_parts, now_parts, strict=True):
        _note(words.shared, [(component_name(old), component_name(new))])
        _note_parameters(words, old, new)
    taken = [each.name for each in list_symbols(before)]
    taken += [element_name(each, name) for each in before.enumerations for name in each.element_names]
    for was, now in zip(before.enumerations, after.enumerations, strict=True):
        pairs = zip(was.element_names, now.element_names, strict=True)
        for old_name, new_name in ((element_name(was, one), element_name(now, other)) for one, other in pairs):
            _note(words.shared, [(f"{plain_name(was)}.{old_name}", f"{plain_name(now)}.{new_name}")])
            if old_name != new_name and taken.count(old_name) > 1:
                words.unclear.add(old_name)
            else:
                _note(words.elements, [(old_name, new_name)])
    return words


def _note(names: dict[str, str], pairs: Iterable[tuple[str, str]]) -> None:
    names.update((old, new) for old, new in pairs if old != new)


def _note_parameters(words: NewWords, old: Design | Interface, new: Design | Interface) -> None:
    """What a component is called with, and what its functions are asked with."""
    pairs = [(plain_name(a), plain_name(b)) for a, b in zip(old.parameters, new.parameters, strict=True)]
    _note(words.own.setdefault(new.component, {}), [(f"@{a}", f"@{b}") for a, b in pairs])
    _note(words.given.setdefault(component_name(old), {}), pairs)
    for was, now in zip(old.outputs, new.outputs, strict=True):
        arguments = zip(was.arguments or (), now.arguments or (), strict=True)
        inner = [(plain_name(a), plain_name(b)) for a, b in arguments]
        _note(words.given.setdefault(symbol_name(old.component, was), {}), inner)


def _in_text(text: str, role: str, own: _Names, words: NewWords) -> str:
    """The text with new words; what is no XABSL stays as it is."""
    if role not in ("action", "predicate"):
        return text
    if (read_actions(text) if role == "action" else read_expression(text)).mistakes:
        return text
    tokens, _findings = tokenize(text, "")
    pieces, end = [], 0
    for at, new in _places(tokens, own, words):
        pieces += [text[end : tokens.starts[at]], new]
        end = tokens.starts[at] + len(tokens.texts[at])
    return "".join([*pieces, text[end:]])


def _places(tokens: Tokens, own: _Names, words: NewWords) -> Iterator[tuple[int, str]]:
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
        names: _Names = words.given.get(calls[-1], {}) if is_given else {**words.elements, **words.shared, **own}
        if text in names:
            yield at, names[text]
