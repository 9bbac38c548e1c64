"""The texts of the session that users read: labels of the undo history, errors and notes.

Labels are verb phrases in lower case. Errors start in lower case, as findings do; they say what is wrong, then what to
do. Notes and announcements are sentences. The labels of quick fixes stand next to the edits, in `session/fixes`.
"""

from collections.abc import Collection, Sequence

from vicode.services.messages import invalid_name, quoted

_COLUMNS = {"name": "target", "when": "guard", "doc": "description"}

# Labels of the undo history.

OPEN = "open"
SAVE = "save"
RELOAD = "reload from disk"
MERGE = "merge from disk"
RESOLVE_CONFLICT = "resolve conflict with disk"
VERSION_ON_DISK = "version on disk"
RECOVER = "recover unsaved changes"
MOVE_LABEL = "move label"
REORDER_STATES = "reorder states"
REORDER_TRANSITIONS = "reorder transitions"
REMOVE_TRANSITION = "remove transition"
PASTE_TRANSITIONS = "paste transitions"
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


def remove(name: str) -> str:
    return f"remove {name}"


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


def change_target(state: str) -> str:
    return f"change target to {state}"


def change_source(state: str) -> str:
    return f"change source to {state.lstrip('@')}"


def set_initial(state: str) -> str:
    return f"make {state} the initial state"


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


def edit_project_file(summary: str) -> str:
    return f"project.yaml: {summary}"


# Names.


def invalid_alias(name: str) -> str:
    return f"{invalid_name(name)}: start with a letter, then use letters, digits and underscores"


def alias_exists(name: str) -> str:
    return f"there is already a component with the alias {name}"


# Gestures, the clipboard and the table.

INVALID_REQUEST = "the editor cannot read this request: reload the page"
STATE_NOT_ADDED = "the state was not added"
ITEM_MISSING = "this item no longer exists"
TRANSITION_GONE = "this transition no longer exists"
TREE_SOURCE = "the source of a transition in a decision tree cannot be changed"
TREE_ORDER = "a transition in a decision tree can only be reordered within its branch"
SELECT_TO_DISABLE = "select states or transitions to disable"
SELECT_TO_DUPLICATE = "select states or transitions to duplicate"
SELECT_TO_FRAME = "select the states to draw a frame around"
FRAME_WITHOUT_TITLE = "a frame needs a title"
SELECT_TO_PASTE = "select the states to add these transitions to, then paste"
NOTHING_TO_PASTE = "the clipboard contains no part of a design"
CELL_TOO_LONG = "this text is too long for a cell"
CELL_READ_ONLY = "this cannot be changed here"
CELL_IN_INSPECTOR = "edit this in the inspector"
ROW_GONE = "this row no longer exists"
ROW_NOT_REMOVABLE = "this row cannot be removed"
ROW_NOT_MOVABLE = "this row cannot be moved"
NO_TARGET = "only a transition has a target"
NO_STATE_TO_CONNECT = "there is no state to connect to: add one first"
INITIAL_REQUIRED = "a design needs an initial state: mark another state instead"


def unused_alias(alias: str) -> str:
    return f"this design no longer uses '{quoted(alias)}'"


def unknown_alias(alias: str, known: Collection[str]) -> str:
    return f"this design uses no component '{quoted(alias)}' (it uses: {', '.join(known) or 'none'})"


def unknown_state(name: str) -> str:
    return f"there is no state '{quoted(name)}'"


def cell_changed(value: str) -> str:
    return f"the cell has changed to '{value[:60]}': press Enter again to overwrite it"


def paste_note(added: Collection[str], missing: Collection[str]) -> str:
    parts = {"Also added": added, "Not in this project": missing}.items()
    return ". ".join(f"{what}: {', '.join(names)}" for what, names in parts if names)


# Numbers.
FREQUENCY_TOO_LOW = "enter a frequency above 0 Hz"
INVALID_RANGE = "enter the minimum and the maximum, such as 0, 9000"
RANGE_REVERSED = "enter the minimum before the maximum"
INVALID_COUNT = "enter a whole number of robots, such as 1, or leave this empty"


def invalid_frequency(text: str) -> str:
    return f"'{text[:20]}' is not a number: enter Hz, such as 10 or 0.5"


def expected(values: str) -> str:
    return f"this is not a valid value; expected: {values}"


# Undo and redo.


def cannot_undo(label: str, user: str, place: str, blocking_label: str) -> str:
    return f"Cannot undo “{label}”: {user} has since changed {place} (“{blocking_label}”)"


def cannot_redo(label: str, user: str, place: str, blocking_label: str) -> str:
    return f"Cannot redo “{label}”: {user} has since changed {place} (“{blocking_label}”)"


def edit_kept(label: str, reason: str) -> str:
    return f"“{label}” was kept. {reason}"


def not_done(reason: str) -> str:
    return f"Undo or redo failed: {reason}"


# Files.

DESIGN_CHANGED = "these parts of the design have changed in the meantime"
PROJECT_LINES_CHANGED = "these lines of project.yaml have changed in the meantime"
NO_READABLE_DESIGN = "the file contains no readable design"


OTHER_EDITOR = "Another editor has this folder open; the changes of both are merged when they are saved"
NO_OTHER_EDITOR = "No other editor has this folder open any more"


def cannot_save(file: str, reason: str) -> str:
    return f"{file} cannot be saved: {reason}"


def edit_refused(reason: str) -> str:
    return f"Not changed: {reason}"


def project_file_unreadable(reason: str) -> str:
    return f"project.yaml cannot be read{f': {reason}' if reason else ''}"


def design_gone(file: str, component: str) -> str:
    return f"{file} no longer contains a design of {component}"


def cannot_restore(file: str, component: str) -> str:
    return f"{file} already exists: {component} stays in the trash"


# Announcements to the other users of a design.


def user_jumped(user: str, label: str) -> str:
    return f"{user} went to “{label}” in the undo history"


def user_renamed(user: str, symbol: str, new: str, file_count: int) -> str:
    return f"{user} renamed {symbol} to {new} in {file_count} file{'s' * (file_count != 1)}"


def merged_from_disk(file: str) -> str:
    return f"Merged changes that another program wrote to {file}"


# Code.


def no_generator(languages: Collection[str]) -> str:
    return f"No code: this project generates {', '.join(languages) or 'nothing'}"


def no_code(reason: object, language: str) -> str:
    return f"No code{f' for {language}' if language else ''} yet: {reason}"
