"""Why a name cannot be used, in the words of the user."""

from collections.abc import Collection

from vicode.model.names import is_valid_name, is_valid_state_name
from vicode.services import messages


def state_name_error(name: str, taken: Collection[str]) -> str:
    """Why a state cannot get this name; "" if it can."""
    if not is_valid_state_name(name):
        return messages.invalid_state_name(name)
    return messages.name_exists("state", name) if name in taken else ""


def validate_identifier(name: str) -> str:
    """An error message if a text is not a valid name, else an empty string."""
    wanted = name.strip()
    if not wanted:
        return messages.NAME_MISSING
    return "" if is_valid_name(wanted) else messages.invalid_identifier(wanted)
