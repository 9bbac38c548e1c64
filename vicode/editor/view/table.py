"""The table of a design: a row for each state and each decision, as JSON values with formatted texts."""

from collections import defaultdict
from collections.abc import Iterable
from typing import Any, cast, get_args

from vicode.editor.view.scene import finding_messages
from vicode.editor.view.selection import ItemKind, ItemRef, item_at_path
from vicode.findings import DesignPath, Finding, worst_severity
from vicode.model.decision_keys import transition_key
from vicode.model.design import COMMON, Code, CommonSection, Decision, DecisionGroup, Design, State, Transition
from vicode.model.traversal import LocatedDecision, iter_decisions

RowData = dict[str, Any]
TableData = dict[str, Any]

COMMON_NAME = "every state"
_PHASES = ("enter", "actions", "leave")


def make_table(design: Design, findings: Iterable[Finding]) -> TableData:
    """The table as {"rows", "states", "uses"}, with the rows in the order in which decisions are evaluated.

    A row is {"id", "kind", "level", "lead", "cells", "severity", "messages"}. Cells that do not apply to a kind of row
    are missing; `lead` is a read-only text before the name.
    """
    found: dict[ItemRef, list[Finding]] = defaultdict(list)
    for finding in findings:
        if finding.subject is not None and finding.subject.component == design.component:
            found[item_at_path(finding.subject.path)].append(finding)
    decisions: dict[str, list[LocatedDecision]] = defaultdict(list)
    for located in iter_decisions(design):
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


def diff_tables(old: TableData, new: TableData) -> TableData:
    """The changes from one table to the next: {"upsert", "remove", "order"?, "states"?, "uses"?}."""
    before = {row["id"]: row for row in old["rows"]}
    after = {row["id"]: row for row in new["rows"]}
    changes: TableData = {
        "upsert": [row for key, row in after.items() if before.get(key) != row],
        "remove": [key for key in before if key not in after],
    }
    if list(before) != list(after):
        changes["order"] = list(after)
    changes.update({name: new[name] for name in ("states", "uses") if old[name] != new[name]})
    return changes


def item_row_id(item: ItemRef) -> str:
    return f"{item.kind}/{item.id}"


def parse_row_id(row: str) -> ItemRef:
    kind, _slash, id_ = row.partition("/")
    return ItemRef(kind=cast("ItemKind", kind) if kind in get_args(ItemKind) else "design", id=id_)


def _row(item: ItemRef, kind: str, cells: dict[str, Any], found: dict[ItemRef, list[Finding]]) -> RowData:
    severity = worst_severity(found.get(item, ()))
    return {
        "id": item_row_id(item),
        "kind": kind,
        "level": 1,
        "lead": "",
        "cells": cells,
        "severity": str(severity) if severity else None,
        "messages": finding_messages(found.get(item, ())),
    }


def _state_row(design: Design, state: State, found: dict[ItemRef, list[Finding]]) -> RowData:
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
    return _row(ItemRef(kind="states", id=state.name), "state", cells, found)


def _common_row(common: CommonSection, found: dict[ItemRef, list[Finding]]) -> RowData:
    cells = {"name": COMMON_NAME, "code": "actions" if common.actions else "", "doc": common.doc}
    return _row(ItemRef(kind="common", id=COMMON), "common", cells, found)


def _decision_row(located: LocatedDecision, found: dict[ItemRef, list[Finding]]) -> RowData:
    decision, guard = located.decision, located.decision.guard
    cells = {
        "name": decision.to if isinstance(decision, Transition) else "",
        "disabled": decision.disabled,
        "when": guard.when,
        "after": guard.after,
        "code": _predicate(guard.code),
        "doc": decision.doc,
    }
    row = _row(ItemRef(kind="transitions", id=transition_key(located.path)), _kind(decision), cells, found)
    return {**row, "level": 2 + len(located.groups), "lead": _lead(located.path, decision)}


def _kind(decision: Decision) -> str:
    if isinstance(decision, DecisionGroup):
        return "group"
    return "transition" if isinstance(decision, Transition) else "stay"


def _lead(path: DesignPath, decision: Decision) -> str:
    """Branch, order number and kind of a decision, such as "2 →", "else 1 →" or "3 stay"."""
    index = path[-1]
    assert isinstance(index, int)
    side = "else " if path[-2] == "else" else ""
    return f"{side}{index + 1} " + {"transition": "→", "stay": "stay", "group": "if"}[_kind(decision)]


def _predicate(code: Code | None) -> str:
    return "predicate" if code is not None else ""
