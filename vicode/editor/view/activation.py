"""View models of an iteration: the activation tree, values and code errors."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from vicode.editor.view.item_labels import item_label
from vicode.editor.view.selection import ItemRef
from vicode.model.decision_keys import parse_transition_key
from vicode.model.design import Design
from vicode.model.traversal import find_decision
from vicode.runs.guard_values import format_value

_LINKS = {"requires": "requires", "modulates": "modulates"}


@dataclass(frozen=True, slots=True, kw_only=True)
class ActivationRow:
    """One step of a component; `depth` is the level in the activation tree."""

    depth: int
    link: str
    component: str
    state: str
    detail: str
    has_run: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeErrorView:
    """An error of user code, and the item it belongs to (None: it is in another component)."""

    text: str
    item: ItemRef | None = None


def activation_rows(tree: Sequence[Mapping[str, Any]]) -> tuple[ActivationRow, ...]:
    """The steps of an iteration, each one level below the component that activated it."""
    depths: dict[str, int] = {}
    rows = []
    for step in tree:
        component = str(step.get("component", ""))
        depth = depths.get(str(step.get("by")), -1) + 1
        depths[component] = depth
        rows.append(
            ActivationRow(
                depth=depth,
                link=_LINKS.get(str(step.get("link")), ""),
                component=component,
                state=str(step.get("state", "")),
                detail=_pairs(step.get("parameters")),
                has_run=bool(step.get("worked")),
            )
        )
    return tuple(rows)


def code_error_view(design: Design, record: Mapping[str, Any]) -> CodeErrorView:
    """Describe an error record by component, state, body and line instead of the generated file."""
    component, state = str(record.get("component", "")), str(record.get("state", ""))
    region, body, line = (str(record.get(name, "")) for name in ("region", "body", "line"))
    decision = find_decision(design, parse_transition_key(region)) if region and component == design.component else None
    place = region or body if decision is None else f"guard of {item_label(design, decision.path)}"
    location = ", ".join(part for part in (component, f"state {state}" if state else "", place) if part)
    text = f"{location}, line {line}: {record.get('message', '')}"
    if component != design.component:
        return CodeErrorView(text=text)
    if decision is not None:
        return CodeErrorView(text=text, item=ItemRef(kind="transitions", id=region))
    return CodeErrorView(text=text, item=ItemRef(kind="states", id=state) if design.state(state) else None)


def value_rows(tree: Sequence[Mapping[str, Any]], component: str) -> tuple[tuple[str, str], ...]:
    """The values of a component after its latest step in an iteration."""
    values: Mapping[str, Any] = {}
    for step in tree:
        if step.get("component") == component:
            values = step.get("values") or {}
    return tuple((name, format_value(value)) for name, value in values.items())


def _pairs(values: Any) -> str:
    pairs = values.items() if isinstance(values, dict) else ()
    return ", ".join(f"{name} {format_value(value)}" for name, value in pairs)
