"""Messages about names, files, renames and generated code, which the command line and the editor show."""

from collections.abc import Collection, Sequence

from vicode.model.names import MAX_NAME_LENGTH, name_from_text

_MAX_QUOTED_LENGTH = 40

NAME_MISSING = "enter a name"
PLAN_OUTDATED = "a file has changed: check the list again"


def quoted(text: str) -> str:
    """The start of a text that may be long."""
    return text[:_MAX_QUOTED_LENGTH]


def invalid_name(name: str) -> str:
    return f"'{quoted(name)}' is not a valid name"


def invalid_state_name(name: str) -> str:
    if len(name) > MAX_NAME_LENGTH:
        return f"{invalid_name(name)}: use at most {MAX_NAME_LENGTH} characters"
    return f"{invalid_name(name)}: use letters, digits and underscores{_example(name_from_text(name))}"


def invalid_component_name(name: str) -> str:
    return f"use letters, digits and underscores{_example(name_from_text(name) or 'FollowBall')}"


def invalid_identifier(name: str) -> str:
    example = name_from_text(name)
    return f"use letters, digits and underscores, a letter first{_example(example[:1].lower() + example[1:])}"


def name_exists(kind: str, name: str) -> str:
    return f"there is already {'an' if kind[0] in 'aeio' else 'a'} {kind} {name}"


def derived_name(name: str, origin: str) -> str:
    return f"{name} is derived from {origin}, which determines its name"


def not_representable(reason: object) -> str:
    return f"this cannot be saved in a file: {reason}"


def read_only(files: Collection[str]) -> str:
    return f"{', '.join(files)} {'is' if len(files) == 1 else 'are'} read-only"


def unsaved_changes(components: Sequence[str]) -> str:
    verb = "has" if len(components) == 1 else "have"
    return f"{', '.join(components)} {verb} unsaved changes: save or undo them first"


def changed_on_disk(file: str) -> str:
    return f"another program has just changed {file}: check it and try again"


def file_exists(file: str) -> str:
    return f"there is already a file {file}"


def no_design(component: str) -> str:
    return f"there is no design of {component}"


def name_used_in_code(component: str, expression: str) -> str:
    return f"the code of {component} already uses {expression} for something else"


def component_summary(old: str, new: str) -> str:
    return f"component {old} → {new}"


def file_summary(old: str, new: str) -> str:
    return f"{old} is renamed to {new}"


def user_summary(component: str, used: str, aliases: Collection[str]) -> str:
    return f"{component} uses {used} as {', '.join(aliases)}" if aliases else f"{component} refers to {used}"


def line_summary(what: str, count: int) -> str:
    return f"{what}: {count} line{'s' * (count != 1)}"


# Generated code.


def nothing_generated(reason: str, languages: Collection[str] = ()) -> str:
    scope = f" for {' and '.join(languages)}" if languages else ""
    return f"Nothing generated{scope}. {reason}"


def generated(files: Sequence[str], folder: object) -> str:
    return f"Generated {', '.join(files[:4])}{', …' if len(files) > 4 else ''} in {folder}"


def _example(name: str) -> str:
    return f", such as {name}" if name else ""
