"""Fields in words: one without an entry is compared and described by its name."""

from dataclasses import dataclass

from vicode.model.design import DecisionGroup, Declaration, Guard, State, Stay
from vicode.model.diff import describe_changes
from vicode.model.diff.item_diff import diff_fields
from vicode.model.words import describe_fields


@dataclass(frozen=True, slots=True, kw_only=True)
class Gadget:
    """A record of which nothing else knows."""

    name: str
    spare_parts: int = 0
    is_blue: bool = False


def test_a_field_without_words_is_compared() -> None:
    old, new = Gadget(name="a"), Gadget(name="b", spare_parts=3)
    assert describe_changes(diff_fields((), "gadget", old, new)) == ("~ spare parts of gadget: 0 → 3",)


def test_fields_with_their_defaults_are_not_described() -> None:
    assert list(describe_fields(Gadget(name="a", spare_parts=3, is_blue=True))) == [
        "spare parts 3",
        "is blue",
    ]
    assert list(describe_fields(State(name="Kick"))) == []


def test_parts_and_empty_lists_are_not_described() -> None:
    group = DecisionGroup(guard=Guard(when="near"), then=(), otherwise=(Stay(),), id="n1", disabled=True)
    assert list(describe_fields(group)) == ["disabled"]
    assert list(describe_fields(Declaration(name="distance_to", arguments=()))) == []


def test_words_may_depend_on_the_record() -> None:
    declaration = Declaration(name="speed", initial="2", xabsl_name="v", range=(0, 2.5))
    assert list(describe_fields(declaration)) == ["value 2", "range 0, 2.5", "XABSL name v"]
