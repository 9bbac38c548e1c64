"""Every list of named records: an item that one side removed and the other one changed is a conflict."""

from collections.abc import Iterator
from dataclasses import MISSING, Field, fields, is_dataclass, replace
from types import UnionType
from typing import Any, get_args, get_origin, get_type_hints

import pytest

from vicode.model.design import (
    Competence,
    CompetenceStep,
    Design,
    Interrupt,
    Layer,
    ReachProperty,
)
from vicode.model.lowering import lift_design
from vicode.model.merge import merge_designs, merge_projects
from vicode.model.merge.design_merge import _ORDERED
from vicode.model.project import Project

_KEYS = ("name", "alias", "component")
_Chain = tuple[tuple[type, str], ...]


def _records(hint: Any) -> Iterator[type]:
    if get_origin(hint) in (tuple, UnionType):
        for each in get_args(hint):
            yield from _records(each)
    elif is_dataclass(hint) and isinstance(hint, type):
        yield hint


def _chains(root: type, item: type, before: _Chain = ()) -> Iterator[tuple[_Chain, type]]:
    """The fields that lead from a root to each list of named records, with the class of the records."""
    for field in fields(item):
        hint = get_type_hints(item)[field.name]
        here = (*before, (item, field.name))
        for record in _records(hint):
            if record in (owner for owner, _name in here) or (root is Project and record is Design):
                continue
            if "tuple" in str(hint) and field.name not in _ORDERED and any(hasattr(record, key) for key in _KEYS):
                yield here, record
            yield from _chains(root, record, here)


def _is_tuple(owner: type, name: str) -> bool:
    return "tuple" in str(get_type_hints(owner)[name])


def _value(field: Field[Any], hint: Any) -> Any:
    is_list = get_origin(hint) is tuple
    return () if is_list else next((_build(each) for each in _records(hint)), "x")


def _build(record: type, **values: Any) -> Any:
    hints = get_type_hints(record)
    needed = [each for each in fields(record) if each.default is MISSING and each.default_factory is MISSING]
    return record(**{each.name: _value(each, hints[each.name]) for each in needed} | values)


def _wrap(chain: _Chain, items: tuple[Any, ...]) -> Any:
    value: Any = items
    for owner, name in reversed(chain):
        value = _build(owner, **{name: value})
        inner = next((at for at, each in enumerate(chain) if each == (owner, name)), 0)
        if inner and _is_tuple(*chain[inner - 1]):
            value = (value,)
    return value


def _changed(item: Any) -> Any:
    """The item with another value of one field that is no name."""
    hints = get_type_hints(type(item))
    field = next(each for each in fields(item) if each.name not in (*_KEYS, "origin") and hints[each.name] is str)
    return replace(item, **{field.name: "other"})


def _written(result: Any) -> Design | None:
    return lift_design(result.design) if hasattr(result, "design") else None


_LISTS = sorted(
    {
        (tuple((owner.__name__, name) for owner, name in chain), record.__name__): (chain, record)
        for root in (Design, Project)
        for chain, record in _chains(root, root)
        if any(each.type is str and each.name not in _KEYS for each in fields(record))
    }.items()
)


@pytest.mark.parametrize(("chain", "record"), [pair for _name, pair in _LISTS], ids=[str(name) for name, _p in _LISTS])
def test_removed_against_changed_is_a_conflict(chain: _Chain, record: type) -> None:
    merge: Any = merge_designs if chain[0][0] is Design else merge_projects
    base, kept = _wrap(chain, (_build(record),)), _wrap(chain, (_changed(_build(record)),))
    removed = _wrap(chain, ())
    for ours, theirs in ((kept, removed), (removed, kept)):
        result = merge(base, ours, theirs)
        assert len(result.conflicts) == 1, result
        assert _written(result) in (None, ours)
        chosen = merge(base, ours, theirs, theirs_at=[each.path for each in result.conflicts])
        assert _written(chosen) in (None, theirs)


def test_the_law_covers_the_constructs() -> None:
    names = {chain[-1][1] for _name, (chain, _record) in _LISTS}
    assert {"states", "variables", "latches", "layers", "steps", "enumerations"} <= names


STEPS = Design(
    component="A",
    competence=Competence(
        goal="s.b", steps=(CompetenceStep(name="Grab", when="s.a", retries=3), CompetenceStep(name="Go"))
    ),
    interrupts=(Interrupt(do="Go", during=("Grab",), when="s.c"),),
    properties=(ReachProperty(reach="Grab"),),
)
LAYERS = Design(component="A", layers=(Layer(name="Grab", when="s.a", hold="1"), Layer(name="Go", requires=("s",))))


def _with_retries(design: Design, retries: int) -> Design:
    assert design.competence is not None
    first, *others = design.competence.steps
    return replace(design, competence=replace(design.competence, steps=(replace(first, retries=retries), *others)))


def _renamed(design: Design) -> Design:
    assert design.competence is not None
    first, *others = design.competence.steps
    return replace(
        design,
        competence=replace(design.competence, steps=(replace(first, name="Take"), *others)),
        interrupts=(replace(design.interrupts[0], during=("Take",)),),
        properties=(ReachProperty(reach="Take"),),
    )


def test_a_renamed_step_has_the_change_and_the_new_references_of_the_other_side() -> None:
    ours = replace(
        _with_retries(STEPS, 5), properties=(ReachProperty(reach="Grab"), ReachProperty(reach="Go", after="Grab"))
    )
    for first, second in ((ours, _renamed(STEPS)), (_renamed(STEPS), ours)):
        result = merge_designs(STEPS, first, second)
        assert result.conflicts == ()
        assert result.design.competence is not None
        assert [(each.name, each.retries) for each in result.design.competence.steps] == [("Take", 5), ("Go", None)]
        assert result.design.interrupts[0].during == ("Take",)
        assert result.design.properties == (ReachProperty(reach="Take"), ReachProperty(reach="Go", after="Take"))


def test_a_renamed_layer_has_the_change_of_the_other_side() -> None:
    theirs = replace(LAYERS, layers=(replace(LAYERS.layers[0], name="Take"), LAYERS.layers[1]))
    ours = replace(LAYERS, layers=(replace(LAYERS.layers[0], hold="2"), LAYERS.layers[1]))
    result = merge_designs(LAYERS, ours, theirs)
    assert result.conflicts == ()
    assert [(each.name, each.hold) for each in result.design.layers] == [("Take", "2"), ("Go", "")]


def test_different_orders_of_layers_are_a_conflict() -> None:
    three = replace(LAYERS, layers=(*LAYERS.layers, Layer(name="Rest")))
    a, b, c = three.layers
    result = merge_designs(three, replace(three, layers=(b, a, c)), replace(three, layers=(a, c, b)))
    assert [each.path for each in result.conflicts] == [("layers",)]
