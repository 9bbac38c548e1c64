"""Messages, dialog texts and empty states of the panels, and format functions for texts with values.

Labels of single widgets stay where the widget is built.
"""

from collections.abc import Sequence

NO_PROBLEMS = "No problems found"
NO_FIX = "No automatic fix available"
FIX_OUTDATED = "The text has changed. Choose the fix again."
NO_SUCH_COMPONENT = "No such component."
NO_MATCHING_DESIGNS = "No designs match the filter."
NO_DESCRIPTION = "No description"
NO_RESULTS = "No results."
NO_MATCHES_TO_REPLACE = "No matches to replace"
ENTER_SEARCH_TERM = "Enter a search term"
SELECT_ROW_FIRST = "Select a row first"
RENDERING = "Rendering…"
SAVED = "Saved"
TRUST_TITLE = "Trust this folder?"
TRUST_QUESTION = (
    "Simulate runs the Python code of this folder. Trust it only if you know where it comes from; "
    "the answer is remembered for this user."
)
TRUST_TO_REPLAY = (
    "To show what the value changes, the design runs with recorded inputs, and so does the Python code in it. Trust "
    "the folder only if you know where it comes from; the answer is remembered for this user."
)
TRUST_TO_COMPARE = (
    "Comparing languages runs the Python and C++ code of this folder. Trust it only if you know where it comes from; "
    "the answer is remembered for this user."
)
SANDBOXED = (
    "It runs in a sandbox: it can read this folder and installed software, write nothing but temporary files, and has "
    "no network. It may still use up memory, disk space and processor time."
)
TRUST_NOT_REMEMBERED = "The folder is trusted until the editor ends: the state folder cannot be written"
NOT_TRUSTED = "The folder is not trusted, so its code does not run. Restart to be asked again."
NOT_TRUSTED_TO_COMPARE = "The folder is not trusted, so its code does not run. Compare again to be asked again."
NOT_TRUSTED_TO_REPLAY = "The folder is not trusted, so its code does not run and nothing is replayed."
EDITS_BEFORE_REPLAY = "Generated code has edits that the design lacks: apply them (Generate) to replay recorded runs."
REPLAYING = "Replaying recorded runs…"
NO_RECORDS = "No recorded run depends on this value. Record one with: vicode run DESIGN --trace FILE --values"
COMPARING_IN_BACKGROUND = "Edits made from now on are not part of this comparison."
COMPARISON_OUTDATED = "The design has changed since this comparison."
ALSO_OPEN_ELSEWHERE = " · Open in another editor"

INTERNAL_ERROR = "Internal error; the change may not be saved. See the server log."
CLIPBOARD_DENIED = "Clipboard access denied. Select the text and copy it, or download the file."
COMMAND_COPIED = "Command copied."

NOT_IMPLEMENTED = "Not implemented yet"
LAST_ELEMENT = "An enumeration needs at least one element. Remove the enumeration instead."
USER_NAME_HELP = "Other users see this name next to your selection and in the history."

EDITED_ITEM_REMOVED = "Another user removed what you were editing"
DESIGN_CHANGED_RENAME_AGAIN = "The design changed. Rename again."
USED_BY_FOLLOWING = "It is used in these places, which will report errors:"
CHECK_MANUALLY = "Check manually: code that uses this name, possibly with another meaning"
SAVED_IMMEDIATELY = "Changes (saved immediately)"

MERGED_WITH_DISK = "Merged with the changes on disk"
LOADED_DISK_VERSION = "Loaded the version on disk"
SAVED_YOUR_VERSION = "Saved your version"
SAVED_MERGED_VERSION = "Saved the merged version"
CONFLICT_ALREADY_RESOLVED = "The conflict is already resolved. See History for the other version."
CONFLICT_CHANGED = "The file changed again. Review the conflicts."
CHANGED_OUTSIDE = "Code of this state was changed outside the editor"
EDITED_OUTSIDE = "Generated code was edited"
CHOOSE_TEXTS = "Choose a text for each. The other one stays in the undo history or in the file until Generate."
IN_FILE = "In the generated file"
IN_DESIGN = "In the design"
GENERATED_BEFORE = "Generated before"
STATEMENTS_CHANGED = "The file and the design changed the same lines."
CODE_GONE = "This code was removed from the design. Copy what you need; the edit is dropped with the next Generate."
SAME_LINES_CHANGED = "Both sides changed the same lines."
DESIGN_CHANGED_GENERATE_AGAIN = "The design has changed. Generate again."
NOT_UNDERSTOOD = "The rest cannot be expressed in the design. It stays in the copy of the file."
NOTHING_UNDERSTOOD = "The design cannot express these edits. They stay in the copy of the file."
EDITED_OUTSIDE_REGIONS = "Edited outside regions. Generate lists the edits that the design can express."
EDIT_WAS_UNDONE = "The edit was applied and undone."
RESOLVED = "Applied"
RECOVERY_TITLE = "Recover unsaved changes?"
RECOVERY_REASON = "The editor stopped before these changes were saved."


def pluralize(number: int, noun: str) -> str:
    """Format a count: "1 state", "2 states"."""
    return f"{number} {noun}{'s' * (number != 1)}"


def sentence(text: str) -> str:
    """Capitalize the first letter of a reason that is shown on its own."""
    return text[:1].upper() + text[1:]


def more(number: int, noun: str = "") -> str:
    """Format the number of rows that a list leaves out."""
    return f"and {number} more{f' {noun}' if noun else ''}"


def more_findings(number: int) -> str:
    return f"{more(number)}. Use the filter to narrow the list."


def not_saved(file: str, reason: str) -> str:
    return f"Could not save {file}: {reason}"


def operation_failed(reason: object) -> str:
    return f"Operation failed: {reason}"


def renamed(old: str, new: str) -> str:
    return f"Renamed {old} to {new}"


def renamed_back(name: str) -> str:
    return f"Renamed back to {name}"


def cannot_rename(reason: str) -> str:
    return f"Cannot rename: {reason}"


def skipped_files(files: Sequence[str]) -> str:
    return f"Skipped (unreadable): {', '.join(files)}"


def changed_by_another_user(name: str) -> str:
    return f"Another user removed, renamed or moved {name}. Check and try again."


def others_typing(names: Sequence[str]) -> str:
    return f"{' and '.join(names)} {'is' if len(names) == 1 else 'are'} also typing here"


def fix_applied(label: str) -> str:
    return f"Applied: {label}. Undo with Ctrl+Z."


def replaced(number: int) -> str:
    return f"Replaced {pluralize(number, 'result')}. Undo with Ctrl+Z."


def duplicated(component: str, copy: str) -> str:
    return f"Duplicated {component} as {copy}"


def moved_to_trash(component: str) -> str:
    return f"{component} moved to trash"


def restored(component: str) -> str:
    return f"{component} restored"


def trash_explanation(file: str) -> str:
    return f"{file} is moved to the system trash. You can undo this."


def still_used_by(users: Sequence[str]) -> str:
    return (
        f"Still used by {', '.join(users)}. {'This design' if len(users) == 1 else 'These designs'} will report errors."
    )


def unreadable_file(file: str) -> str:
    return f"{file} cannot be read. Open it to fix the errors."


def project_saved(change: str, broken_designs: Sequence[str]) -> str:
    errors = f"; new errors in {', '.join(broken_designs)}" if broken_designs else ""
    return f"project.yaml saved: {change}{errors}"


def not_written(reason: str) -> str:
    return f"not saved: {reason}"


def files_to_write(number: int, folder: str, unchanged: int) -> str:
    rest = f"; {unchanged} up to date" if unchanged else ""
    return f"{pluralize(number, 'file')} will change in {folder}/{rest}."


def copied(component: str, form: str) -> str:
    return f"Copied {component} as {form}"


def preview_too_large(states: int) -> str:
    return f"No preview for {pluralize(states, 'state')}. You can still download the file."


def changed_by_another_program(file: str) -> str:
    return f"{file} was changed by another program"


def file_missing(file: str, *, is_deleted: bool) -> str:
    what = "was deleted by another program" if is_deleted else "no longer contains a design"
    return f"{file} {what}"


def save_again(file: str, *, is_deleted: bool) -> str:
    backup = "" if is_deleted else f" Its current content is kept as {file}.edited."
    return f"Your version is still open. Saving writes the file again.{backup}"


def conflict_count(number: int) -> str:
    return f"{pluralize(number, 'conflict')}; everything else is merged."


def history_jump_warning(left: str) -> str:
    return f"This undoes {left} for all users. The steps stay in the history."


def recovery_question(component: str, time: str, *, is_deleted: bool) -> str:
    again = " Its file was deleted and will be created again." if is_deleted else ""
    return f"Recover the unsaved changes to {component} from {time}?{again}"


def recovered(component: str, overruled: int) -> str:
    rest = f"; they replace {pluralize(overruled, 'change')} on disk (undo restores them)" if overruled else ""
    return f"Recovered the changes to {component}{rest}"


def typed_text_lost(item: str, text: str) -> str:
    return f"The editor was started again. This text was typed for {item}, whose field has changed: {text}"


def not_recovered(reason: str) -> str:
    return f"Could not recover: {reason}"


def discarded(component: str) -> str:
    return f"Discarded the changes to {component}"


def invalid_event(reason: str) -> str:
    return f"The page sent an invalid event ({reason}). Reload the page."


def comparing(language: str, number: int, count: int) -> str:
    return f"{language} ({number} of {count})…" if language else "Starting…"


def comparison_failed(reason: str) -> str:
    return f"The languages were not compared: {reason}"


def comparison_inputs(seed: int) -> str:
    """What the runs have read."""
    return f"Inputs chosen to reach the parts of the design, with the seed {seed}"


def traces_differ(languages: Sequence[str], run: int, iteration: int, time_ns: int) -> str:
    place = f"iteration {iteration}, {time_ns / 1e9:.3f} s" if iteration else "the end"
    return f"{' and '.join(languages)} differ in run {run + 1}, {place}"


def not_sandboxed(problem: str) -> str:
    return f"It runs without a sandbox, with all rights of your user account: {problem}."


def edits_before_simulation(waiting: int, problem: str, file: str) -> str:
    """Why code with edits missing from the design is not simulated."""
    if waiting:
        return f"Missing from the design: {pluralize(waiting, 'edit')} of the generated code. Resolve, then restart."
    if problem:
        return f"The generated code cannot be compared with the design: {problem}"
    return f"{file} was edited outside regions. Generate lists the edits that the design can express; then restart."


def edited_files(names: Sequence[str]) -> str:
    return f"Edited by hand: {', '.join(names)}. 'Overwrite' keeps a copy as NAME.edited."


def applied_to(name: str, component: str) -> str:
    return f"{name}: the edit is applied to {component}"


def edited_outside_regions(name: str, *, known: bool) -> str:
    return f"{name} {'was' if known else 'may have been'} edited outside regions"


def apply_edits_label(number: int) -> str:
    return f"Apply {pluralize(number, 'edit')} to the design"


def opens_with(name: str) -> str:
    return f"Code opens with {name}"


def place_copied(place: str) -> str:
    return f"Copied {place}"


def editor_not_started(name: str, reason: object) -> str:
    return f"{name} could not be started: {reason}"


def nothing_to_open(reason: object) -> str:
    return f"The code is not generated yet: {reason}"
