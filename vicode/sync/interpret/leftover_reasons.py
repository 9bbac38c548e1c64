"""Says in one sentence why a unit of an edited file stays in the patch."""

import ast
from difflib import SequenceMatcher

from vicode.sync.code_items import CODE, COMMENT, REGION, CodeItem
from vicode.sync.interpret.import_edits import ImportEdits
from vicode.sync.interpret.leftover import import_statement
from vicode.sync.interpret.units import Items

_MAX_LENGTH = 80
DEPENDENT = "it belongs to code that stays in the patch"


def describe_difference(own: Items, target: Items) -> str:
    """Say which statement no edit of the design explains: the first one in which two versions of a unit differ.

    Args:
        own: The generated unit.
        target: The unit of the edited file.
    """
    keys, others = ([item.key for item in items] for items in (own, target))
    for tag, first, last, start, end in SequenceMatcher(None, keys, others, autojunk=False).get_opcodes():
        if tag != "equal" and end > start:
            return f"no edit of the design produces {_shown(target[start])}"
        if tag != "equal" and last > first:
            return f"no edit of the design removes {_shown(own[first])}"
    return DEPENDENT


def _shown(item: CodeItem) -> str:
    if item.kind == REGION:
        return f"the region '{item.code}'"
    code = ast.unparse(item.node) if item.kind == CODE and item.node is not None else item.code
    line = next((line for line in code.split("\n") if line.strip()), "")
    shown = line if len(line) <= _MAX_LENGTH else f"{line[:_MAX_LENGTH]} …"
    mark = "# " if item.kind == COMMENT else ""
    return f"'{mark}{shown}{''.join(f'  {comment}' for comment in item.comments)}'"


def describe_unit(name: str) -> str:
    """Return a unit as a person calls it: `_in_kick()`, `state Kick`, `class Player`."""
    owner, colon, rest = name.partition(":")
    if owner.endswith(".__init__") and colon:
        return "the list of states" if rest == "states" else f"state {rest.strip(chr(39))}"
    if not colon:
        return f"{owner.rpartition('.')[2]}()"
    if not rest:
        return f"class {owner}"
    if rest == "doc":
        return f"docstring of {owner or 'the module'}"
    place = f"class {owner}" if owner else "the module"
    return rest if rest.isidentifier() else place


def describe_imports(imports: ImportEdits) -> tuple[str, ...]:
    """Say which import statements no edit of the design explains."""
    added, removed = (
        sorted(import_statement(*name) for name in names)
        for names in (imports.wanted - imports.shown, imports.shown - imports.wanted)
    )
    return (
        *(f"no edit of the design produces '{statement}'" for statement in added),
        *(f"no edit of the design removes '{statement}'" for statement in removed),
    )
