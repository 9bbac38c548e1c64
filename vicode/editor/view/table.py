"""The table of a design: a row for every state and every decision, as plain dicts with finished texts."""

from collections import defaultdict
from collections.abc import Iterable
from typing import Any

from vicode.editor.view.selection import Selected, thing_of_path, transition_key
from vicode.findings import Finding, Path, worst_severity
from vicode.model.design import COMMON, Code, Common, Decision, Design, Group, State, Transition
from vicode.model.walks import Located, walk_decisions

Row = dict[str, Any]
Table = dict[str, Any]

COMMON_NAME = "every state"
_PHASES = ("enter", "actions", "leave")


def table_of(design: Design, findings: Iterable[Finding]) -> Table:
    """Tabulate a design: {"rows", "states", "uses"}, the rows in the order in which decisions are tested.

    A row is {"id", "kind", "level", "lead", "cells", "severity", "messages"}. A cell that is left out means nothing
    in this kind of row; `lead` stands before the name and cannot be changed.
    """
    found: dict[Selected, list[Finding]] = defaultdict(list)
    for finding in findings:
        if finding.thing is not None and finding.thing.component == design.component:
            found[thing_of_path(finding.thing.path)].append(finding)
    decisions: dict[str, list[Located]] = defaultdict(list)
    for located in walk_decisions(design):
        decisions[located.source].append(located)
    rows = [_common_row(design.common, found)] if decisions[COMMON] or design.common.actions else []
    rows += [_decision_row(located, found) for located in decisions[COMMON]]
    for state in design.states:
        rows.append(_state_row(design, state, found))
        rows += [_decision_row(located, found) for located in decisions[state.name]]
    return {
        "rows": rows,
        "states": [state.name for state in design.states],
        "uses": [use.alias for use in design.uses],
    }


def table_difference(old: Table, new: Table) -> Table:
    """What changed between two tables: {"upsert", "remove", "order"?, "states"?, "uses"?}."""
    before = {row["id"]: row for row in old["rows"]}
    after = {row["id"]: row for row in new["rows"]}
    changes: Table = {
        "upsert": [row for key, row in after.items() if before.get(key) != row],
        "remove": [key for key in before if key not in after],
    }
    if list(before) != list(after):
        changes["order"] = list(after)
    changes.update({name: new[name] for name in ("states", "uses") if old[name] != new[name]})
    return changes


def row_of(thing: Selected) -> str:
    """The id of the row that shows a thing."""
    return f"{thing.of}/{thing.id}"


def thing_of_row(row: str) -> Selected:
    """The thing a row shows."""
    of, _slash, identity = row.partition("/")
    return Selected(of=of, id=identity)


def _row(thing: Selected, kind: str, cells: dict[str, Any], found: dict[Selected, list[Finding]]) -> Row:
    severity = worst_severity(found.get(thing, ()))
    return {
        "id": row_of(thing),
        "kind": kind,
        "level": 1,
        "lead": "",
        "cells": cells,
        "severity": str(severity) if severity else None,
        "messages": [finding.message for finding in found.get(thing, ())],
    }


def _state_row(design: Design, state: State, found: dict[Selected, list[Finding]]) -> Row:
    cells = {
        "name": state.name,
        "initial": state.name == design.initial,
        "final": state.final,
        "disabled": state.disabled,
        "requires": ", ".join(state.requires),
        "modulates": ", ".join(call.alias for call in state.modulates),
        "code": ", ".join(phase for phase in _PHASES if getattr(state, phase)),
        "doc": state.doc,
    }
    return _row(Selected(of="states", id=state.name), "state", cells, found)


def _common_row(common: Common, found: dict[Selected, list[Finding]]) -> Row:
    cells = {"name": COMMON_NAME, "code": "actions" if common.actions else "", "doc": common.doc}
    return _row(Selected(of="common", id=COMMON), "common", cells, found)


def _decision_row(located: Located, found: dict[Selected, list[Finding]]) -> Row:
    decision, guard = located.decision, located.decision.guard
    cells = {
        "name": decision.to if isinstance(decision, Transition) else "",
        "disabled": decision.disabled,
        "when": guard.when,
        "after": guard.after,
        "code": _predicate(guard.code),
        "doc": decision.doc,
    }
    row = _row(Selected(of="transitions", id=transition_key(located.path)), _kind(decision), cells, found)
    return {**row, "level": 2 + len(located.groups), "lead": _lead(located.path, decision)}


def _kind(decision: Decision) -> str:
    if isinstance(decision, Group):
        return "group"
    return "transition" if isinstance(decision, Transition) else "stay"


def _lead(path: Path, decision: Decision) -> str:
    """Order number, side of its group, and what is decided: "2 →", "else 1 →", "3 stay"."""
    index = path[-1]
    assert isinstance(index, int)
    side = "else " if path[-2] == "else" else ""
    return f"{side}{index + 1} " + {"transition": "→", "stay": "stay", "group": "if"}[_kind(decision)]


def _predicate(code: Code | None) -> str:
    return "predicate" if code is not None else ""
