"""Ids for states in text formats: the name itself where the format allows it."""

from collections.abc import Collection, Iterable

from vicode.model.names import is_valid_state_name


def assign_ids(names: Iterable[str], reserved: Collection[str]) -> dict[str, str]:
    """An id for every name; reserved words and names that start with a digit get a prefix.

    Args:
        names: display names; of duplicates the first counts.
        reserved: words that are not valid ids, in lower case.
    """
    wanted = tuple(dict.fromkeys(names))
    plain = {name for name in wanted if _is_valid_id(name, reserved)}
    ids = {name: name for name in plain}
    taken = set(plain)
    for number, name in enumerate(name for name in wanted if name not in plain):
        id_ = f"s_{name}" if is_valid_state_name(name) else f"s_{number}"
        while id_ in taken:
            id_ += "_"
        ids[name] = id_
        taken.add(id_)
    return ids


def _is_valid_id(name: str, reserved: Collection[str]) -> bool:
    return is_valid_state_name(name) and name[0].isalpha() and name.casefold() not in reserved
