"""Texts of the panels that have several users, and sentences that depend on what happened."""

from collections.abc import Sequence

NO_PROBLEMS = "No problems found"
RUN_IS_OLD = "The designs have changed since this run was found; the deep check will find it again"
FIX_OUTDATED = "The text has changed. Choose the fix again."
NO_SUCH_COMPONENT = "No such component."
SAVED = "Saved"
EDITED_ITEM_REMOVED = "Another user removed what you were editing"
DESIGN_CHANGED_RENAME_AGAIN = "The design changed. Rename again."
CHECK_MANUALLY = "Check manually: code that uses this name, possibly with another meaning"
SAVED_IMMEDIATELY = "Changes (saved immediately)"
CONFLICT_CHANGED = "The file changed again. Review the conflicts."
CHANGED_OUTSIDE = "Code of this state was changed outside the editor"


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


def skipped_files(files: Sequence[str]) -> str:
    return f"Skipped (unreadable): {', '.join(files)}"


def others_typing(names: Sequence[str]) -> str:
    return f"{' and '.join(names)} {'is' if len(names) == 1 else 'are'} also typing here"


def replaced(number: int) -> str:
    return f"Replaced {pluralize(number, 'result')}. Undo with Ctrl+Z."


def still_used_by(users: Sequence[str]) -> str:
    return (
        f"Still used by {', '.join(users)}. {'This design' if len(users) == 1 else 'These designs'} will report errors."
    )


def project_saved(change: str, broken_designs: Sequence[str]) -> str:
    errors = f"; new errors in {', '.join(broken_designs)}" if broken_designs else ""
    return f"project.yaml saved: {change}{errors}"


def not_written(reason: str) -> str:
    return f"not saved: {reason}"


def files_to_write(number: int, folder: str, unchanged: int) -> str:
    rest = f"; {unchanged} up to date" if unchanged else ""
    return f"{pluralize(number, 'file')} will change in {folder}/{rest}."


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


def recovery_question(component: str, time: str, *, is_deleted: bool) -> str:
    again = " Its file was deleted and will be created again." if is_deleted else ""
    return f"Recover the unsaved changes to {component} from {time}?{again}"


def recovered(component: str, overruled: int) -> str:
    rest = f"; they replace {pluralize(overruled, 'change')} on disk (undo restores them)" if overruled else ""
    return f"Recovered the changes to {component}{rest}"


def typed_text_lost(item: str, text: str) -> str:
    return f"The editor was started again. This text was typed for {item}, whose field has changed: {text}"


def invalid_event(reason: str) -> str:
    return f"The page sent an invalid event ({reason}). Reload the page."


def comparing(language: str, number: int, count: int) -> str:
    return f"{language} ({number} of {count})…" if language else "Starting…"


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


def edited_outside_regions(name: str, *, known: bool) -> str:
    return f"{name} {'was' if known else 'may have been'} edited outside regions"


def apply_edits_label(number: int) -> str:
    return f"Apply {pluralize(number, 'edit')} to the design"
