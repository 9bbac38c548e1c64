"""Texts of the session with several users or a form of their own: labels of the undo history, errors and notes.

Labels are verb phrases in lower case. Errors start in lower case, as findings do; they say what is wrong, then what to
do. Notes and announcements are sentences.
"""

from collections.abc import Collection, Sequence

from vicode.services.messages import invalid_name, quoted

_COLUMNS = {"name": "target", "when": "guard", "doc": "description"}

# Labels of the undo history.

REORDER_TRANSITIONS = "reorder transitions"
ALIGNMENTS = {
    "align-left": "align left edges",
    "align-center": "align centers",
    "align-right": "align right edges",
    "align-top": "align top edges",
    "align-middle": "align middles",
    "align-bottom": "align bottom edges",
    "distribute-across": "distribute horizontally",
    "distribute-down": "distribute vertically",
}


def rename(old: str, new: str) -> str:
    return f"rename {old} to {new}"


def undo_label(label: str) -> str:
    return f"undo {label}"


def redo_label(label: str) -> str:
    return f"redo {label}"


def add_state(name: str) -> str:
    return f"add state {name}"


def move_items(count: int, name: str) -> str:
    return f"move {name}" if count == 1 else f"move {count} items"


def delete_items(count: int) -> str:
    return "delete" if count == 1 else f"delete {count} items"


def set_disabled(names: Sequence[str], transition_count: int, *, disabled: bool) -> str:
    verb = "disable" if disabled else "enable"
    match names, transition_count:
        case [name], 0:
            return f"{verb} {name}"
        case [], 1:
            return f"{verb} transition"
        case _:
            return f"{verb} {len(names) + transition_count} items"


def connect(source: str, target: str) -> str:
    return f"connect {source.lstrip('@')} to {target}"


def set_final(state: str, *, final: bool) -> str:
    return f"mark {state} as final" if final else f"mark {state} as not final"


def add_link(state: str, kind: str, alias: str) -> str:
    return f"{state} {kind} {alias}"


def duplicate_transitions(count: int) -> str:
    return "duplicate transition" if count == 1 else f"duplicate {count} transitions"


def insert_items(verb: str, states: Sequence[str], notes: Sequence[str]) -> str:
    count = len(states) + len(notes)
    if not count:
        return f"{verb} common transitions"
    if count == 1:
        return f"{verb} {states[0] if states else 'note'}"
    return f"{verb} {count} {'items' if notes else 'states'}"


def edit_cell(column: str) -> str:
    return f"edit {_COLUMNS.get(column, column)}"


# Names.


def invalid_alias(name: str) -> str:
    return f"{invalid_name(name)}: start with a letter, then use letters, digits and underscores"


# Gestures, the clipboard and the table.

INVALID_REQUEST = "the editor cannot read this request: reload the page"
VALUE_MISSING = "this is required"
ITEM_MISSING = "this item no longer exists"
TRANSITION_GONE = "this transition no longer exists"
NOTHING_TO_PASTE = "the clipboard contains no part of a design"
ROW_GONE = "this row no longer exists"


def unused_alias(alias: str) -> str:
    return f"this design no longer uses '{quoted(alias)}'"


def unknown_alias(alias: str, known: Collection[str]) -> str:
    return f"this design uses no component '{quoted(alias)}' (it uses: {', '.join(known) or 'none'})"


def unknown_state(name: str) -> str:
    return f"there is no state '{quoted(name)}'"


def paste_note(added: Collection[str], missing: Collection[str]) -> str:
    parts = {"Also added": added, "Not in this project": missing}.items()
    return ". ".join(f"{what}: {', '.join(names)}" for what, names in parts if names)


# Numbers.
FREQUENCY_TOO_LOW = "enter a frequency above 0 Hz"
INVALID_RANGE = "enter the minimum and the maximum, such as 0, 9000"
RANGE_REVERSED = "enter the minimum before the maximum"
INVALID_COUNT = "enter a whole number of robots, such as 1, or leave this empty"


def expected(values: str) -> str:
    return f"this is not a valid value; expected: {values}"


# Undo and redo.


def cannot_undo(label: str, user: str, place: str, blocking_label: str) -> str:
    return f"Cannot undo “{label}”: {user} has since changed {place} (“{blocking_label}”)"


def cannot_redo(label: str, user: str, place: str, blocking_label: str) -> str:
    return f"Cannot redo “{label}”: {user} has since changed {place} (“{blocking_label}”)"


def not_done(reason: str) -> str:
    return f"Undo or redo failed: {reason}"


# Files.

OTHER_EDITOR = "Another editor has this folder open; the changes of both are merged when they are saved"


def project_file_unreadable(reason: str) -> str:
    return f"project.yaml cannot be read{f': {reason}' if reason else ''}"


# Announcements to the other users of a design.


def user_renamed(user: str, symbol: str, new: str, file_count: int) -> str:
    return f"{user} renamed {symbol} to {new} in {file_count} file{'s' * (file_count != 1)}"


# Code.


def no_code(reason: object, language: str) -> str:
    return f"No code{f' for {language}' if language else ''} yet: {reason}"
