"""Fixes of invalid names and ids: the nearest valid spelling."""

import re
from dataclasses import replace

from vicode.editor.session.fixes.context import Fix, FixContext
from vicode.findings import DesignPath
from vicode.model.design import Design, RunCode
from vicode.model.edits import rename_state, rename_use, replace_action, replace_decision, unique_name, update_state
from vicode.model.names import is_valid_state_name
from vicode.model.traversal import find_decision, iter_actions


def fix_bad_name(case: FixContext) -> list[Fix]:
    """D404 to D406 for states, aliases and ids; code may refer to other names, which no edit can rename reliably."""
    match case.path:
        case (*_, "id"):
            return fix_bad_id(case)
        case ("states", str(name)):
            taken = {state.name for state in case.design.states}
            new = unique_name(_valid_name(case, name), taken)
            return [Fix(label=f"Rename to {new}", edit=lambda old: rename_state(old, name, new))]
        case ("uses", str(alias)):
            taken = {use.alias for use in case.design.uses}
            taken |= {declaration.name for _section, declaration in case.design.declarations()}
            new = unique_name(_valid_name(case, alias), taken)
            return [Fix(label=f"Rename to {new}", edit=lambda old: rename_use(old, alias, new))]
        case _:
            return []


def fix_bad_id(case: FixContext) -> list[Fix]:
    return [Fix(label="Remove the id", edit=lambda old: _without_id(old, case.path[:-1]))]


def _valid_name(case: FixContext, name: str) -> str:
    """A valid name similar to an invalid one."""
    if case.finding.rule.code == "D406":
        return f"my_{name}"
    if case.finding.rule.code == "D405" and is_valid_state_name(name) and not name.startswith("_"):
        return f"{name}_value"
    cleaned = re.sub(r"[^A-Za-z0-9]+", "_", name, flags=re.ASCII).strip("_")[:76]
    if case.path[0] == "uses" and not cleaned[:1].isalpha():
        cleaned = f"component_{cleaned}".rstrip("_")
    return cleaned or "State"


def _without_id(design: Design, path: DesignPath) -> Design:
    if len(path) == 2 and path[0] == "states":
        return update_state(design, str(path[1]), lambda state: replace(state, id=""))
    located = find_decision(design, path)
    if located is not None:
        return replace_decision(design, path, replace(located.decision, id=""))
    action = next((located.action for located in iter_actions(design) if located.path == path), None)
    return replace_action(design, path, replace(action, id="")) if isinstance(action, RunCode) else design


FIXERS = {"D404": fix_bad_name, "D405": fix_bad_name, "D406": fix_bad_name, "D413": fix_bad_id}
