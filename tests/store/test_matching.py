"""Matching of old and new list items."""

from vicode.store.matching import match_items


def _item(id_: str, target: str) -> tuple[tuple[str, str], ...]:
    return (("to", target), ("id", id_))


def test_items_with_the_same_id_match_although_all_else_changed() -> None:
    old = (_item("a", "Kick"), _item("b", "Search"))
    new = (_item("b", "GetUp"), _item("a", "Wait"))
    assert match_items(old, new) == [1, 0]


def test_items_without_id_match_in_order() -> None:
    old = ((("to", "Kick"),), (("to", "Search"),))
    new = ((("to", "GetUp"),), (("to", "Wait"),))
    assert match_items(old, new) == [0, 1]
