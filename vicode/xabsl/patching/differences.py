"""Compares two versions of a program: everything but comments inside options, and the order of declarations.

This is the final check of an update: the written files are imported and generated again, and must not differ from what
was generated from the designs. It compares syntax trees and knows nothing of edits, so an error in `patching` shows
here.
"""

from collections.abc import Iterator
from dataclasses import replace

from vicode.xabsl import tree
from vicode.xabsl.patching.option_edits import OptionVersion
from vicode.xabsl.patching.program_items import declarations, namespaces, options
from vicode.xabsl.source_loader import ProgramSource


def find_differences(one: ProgramSource, other: ProgramSource) -> Iterator[tuple[str, str]]:
    """Yield the options and states that differ; other differences have no state, or neither."""
    yield from _compare_declarations(one, other)
    ours, theirs = options(one), options(other)
    for name in {**ours, **theirs}:
        if name not in ours or name not in theirs:
            yield name, ""
            continue
        (first, first_file), (second, second_file) = ours[name], theirs[name]
        yield from _compare_options(
            OptionVersion(first, first_file, tuple(first.states)),
            OptionVersion(second, second_file, tuple(second.states)),
        )


def _compare_declarations(one: ProgramSource, other: ProgramSource) -> Iterator[tuple[str, str]]:
    ours = {key: each.node for key, each in declarations(one).items()}
    theirs = {key: each.node for key, each in declarations(other).items()}
    for key in {**ours, **theirs}:
        if ours.get(key) != theirs.get(key):
            yield key[1], ""
    texts = namespaces(one), namespaces(other)
    for name in texts[0].keys() & texts[1].keys():
        first, second = texts[0][name], texts[1][name]
        if (first.title, first.doc) != (second.title, second.doc):
            yield name, ""
    mains = one.files[one.main].file, other.files[other.main].file
    if mains[0].header != mains[1].header or mains[0].body != mains[1].body:
        yield "", ""


def _compare_options(one: OptionVersion, other: OptionVersion) -> Iterator[tuple[str, str]]:
    first, second = one.option, other.option
    name = first.name.text
    heads = (
        (option.doc, option.parameters, option.common_decision, option.common_actions, _names(option))
        for option in (first, second)
    )
    if next(heads) != next(heads):
        yield name, ""
        return
    for old, new in zip(first.states, second.states, strict=True):
        if _normal(old) != _normal(new) or one.doc_of(old) != other.doc_of(new):
            yield name, old.name.text


def _normal(state: tree.StateNode) -> tree.StateNode:
    """A state without a decision that only stays, which is the default."""
    decision = state.decision
    is_default = decision is not None and isinstance(decision.tree, tree.StayNode) and not decision.else_doc
    return replace(state, decision=None) if is_default else state


def _names(option: tree.OptionNode) -> list[str]:
    return [state.name.text for state in option.states]
