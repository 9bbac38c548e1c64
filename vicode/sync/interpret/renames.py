"""Recognizes states that were renamed in generated code.

A renamed state changes its entry, its methods and every transition to it: far more than any single proposal explains.
So renames are tried first. The words that a rename changes in generated code are then changed in the edited file, too,
and the other edits are compared under the new names.
"""

import ast
import io
import re
import tokenize
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from vicode.model.design import Design
from vicode.model.edits import rename_state, update_state
from vicode.model.names import is_valid_state_name
from vicode.regions import find_regions
from vicode.sync.code_items import CodeItem, split_items
from vicode.sync.interpret.normal_form import GeneratedParts
from vicode.sync.interpret.units import Items

_WORD = re.compile(r"'(?:[^'\\]|\\.)*'|\"(?:[^\"\\]|\\.)*\"|\w+")


def list_states(items: Iterable[CodeItem]) -> Iterator[tuple[str, str]]:
    """Yield the name of each state and the part of method names that stands for it."""
    for item in items:
        match item.node:
            case ast.Expr(
                value=ast.Call(
                    func=ast.Name(id="State"), args=[ast.Constant(value=str(name)), ast.Attribute(attr=method), *_]
                )
            ):
                yield name, method.removeprefix("_in_")


def propose_renames(design: Design, old: Items, new: Items) -> Iterator[Design]:
    """Propose renames of states for changed entries of the list of states."""
    before, after = list(list_states(old)), list(list_states(new))
    old_names, new_names = {name for name, _stem in before}, {name for name, _stem in after}
    gone = [pair for pair in before if pair[0] not in new_names]
    come = [pair for pair in after if pair[0] not in old_names and is_valid_state_name(pair[0])]
    for index, (name, stem) in enumerate(gone):
        same_method = [other for other, other_stem in come if other_stem == stem]
        same_place = [other for other, _stem in come[index : index + 1] if len(come) == len(gone)]
        for other in dict.fromkeys((*same_method, *same_place)):
            renamed = rename_state(design, name, other)
            yield renamed
            # With an id, the regions of other states that name this one stay as they are.
            yield update_state(renamed, other, lambda state, id_=name: replace(state, id=state.id or id_))  # type: ignore[misc]


def find_word_mapping(old: str, new: str) -> dict[str, str] | None:
    """Return how the words of a generated module changed by a rename; None if something else changed."""
    old_items, new_items = split_items(old), split_items(new)
    if len(old_items) != len(new_items):
        return None
    mapping: dict[str, str] = {}
    for before, after in zip(old_items, new_items, strict=True):
        words = [_WORD.findall(f"{item.scope} {item.code}") for item in (before, after)]
        if len(words[0]) != len(words[1]):
            return None
        for one, other in zip(*words, strict=True):
            if one != other and mapping.setdefault(one, other) != other:
                return None
    return mapping


def map_parts(parts: GeneratedParts, mapping: Mapping[str, str]) -> GeneratedParts:
    """Return the parts with renamed methods."""

    def mapped(scope: str) -> str:
        return ".".join(mapping.get(name, name) for name in scope.split("."))

    comments = frozenset((mapped(scope), comment) for scope, comment in parts.time_comments)
    return replace(parts, time_comments=comments)


def map_words(text: str, mapping: Mapping[str, str]) -> str:
    """Replace names and strings in a module, but not in its comments and regions."""
    lines = text.split("\n")
    fixed = {line for region in find_regions(text).regions for line in range(region.line, region.end_line + 1)}
    masked = "\n".join("" if number in fixed else line for number, line in enumerate(lines, start=1))
    tokens = list(tokenize.generate_tokens(io.StringIO(masked).readline))
    for token in reversed(tokens):
        replacement = _mapped(token, mapping)
        if replacement is not None:
            row, start, end = token.start[0] - 1, token.start[1], token.end[1]
            lines[row] = lines[row][:start] + replacement + lines[row][end:]
    return "\n".join(lines)


def _mapped(token: tokenize.TokenInfo, mapping: Mapping[str, str]) -> str | None:
    if token.start[0] != token.end[0]:
        return None
    if token.type == tokenize.NAME:
        return mapping.get(token.string)
    if token.type == tokenize.STRING and token.string[:1] in "\"'":
        return mapping.get(repr(token.string[1:-1]))
    return None
