"""What the regions of <parallel> may share.

A design decides before it calls the designs of regions, which step one after the other. SCXML chooses the transitions
of all regions first, prefers those inside, and runs <onexit> in the regions when the parallel state is left. Where that
gives another result, the document is refused.
"""

import re
from collections.abc import Iterable, Iterator, Sequence

from vicode.importers.scxml.ecmascript import IN_STATE
from vicode.importers.scxml.events import DONE, matches, plain
from vicode.importers.scxml.reader import ScxmlError
from vicode.importers.scxml.states import STATES, ScxmlState
from vicode.importers.xml_reader import Element


def done_event(state: ScxmlState) -> str:
    """The event raised when a final state is entered, or when all regions of a state are done; "" for none."""
    if state.regions:
        are_done = all(any(each.is_final for each in region.children) for region in state.regions)
        return f"{DONE}{state.name}" if are_done else ""
    return f"{DONE}{state.parent.name}" if state.is_final and state.parent and state.parent.name else ""


def check_regions(states: Sequence[ScxmlState]) -> None:
    """Check the states of all designs.

    Raises:
        ScxmlError: A region takes or reads something of another one, or is left in a way that designs cannot express.
    """
    for state in states:
        for element in _own_elements(state):
            _check_reading(state, element, states)
        for transition in state.transitions():
            _check_target(state, transition, states)
        for region in state.regions:
            leaving = [
                each for outer in state.around() for each in outer.transitions() if each.attributes.get("target")
            ]
            for inner in (each for each in states if leaving and region in each.around()):
                _check_exit(inner, leaving, state)


def data_homes(states: Sequence[ScxmlState], names: Iterable[str]) -> tuple[dict[str, list[ScxmlState]], set[str]]:
    """The designs that declare each item of the data: one if it is assigned, else all that read it; and the outputs.

    Raises:
        ScxmlError: What a region assigns is used by others than the design that calls it, or assigned there.
    """
    used, assigned = {name: dict[ScxmlState, int]() for name in names}, {name: set[ScxmlState]() for name in names}
    for state in states:
        for element in _own_elements(state):
            texts = " ".join(element.attributes.get(each, "") for each in ("cond", "expr", "location"))
            for name in used.keys() & set(re.findall(r"[A-Za-z_$][\w$]*", texts)):
                used[name].setdefault(state.root, element.line)
                assigned[name] |= {state.root} if element.attributes.get("location") == name else set()
    homes, outputs = {name: list(roots) or [states[0]] for name, roots in used.items()}, set[str]()
    for name, assigning in assigned.items():
        home = next(iter(assigning), None)
        callers = {home, home.caller.root} if home is not None and home.caller is not None else {home}
        if home is not None and (len(assigning) > 1 or not used[name].keys() <= callers):
            reason = f"'{name}' is assigned, and used in other regions or assigned around them"
            raise _refusal(reason, max(used[name].values()), "give each region its own data")
        outputs |= {name} if home is not None and len(used[name]) > 1 else set()
        homes[name] = [home] if home is not None else homes[name]
    return homes, outputs


def _refusal(reason: str, line: int, fix: str) -> ScxmlError:
    return ScxmlError("S802", f"<parallel>: {reason}", line, fix)


def _own_elements(state: ScxmlState) -> Iterator[Element]:
    waiting = [each for each in state.element.children if each.tag not in (*STATES, "datamodel")]
    while waiting:
        yield waiting[0]
        waiting = [*waiting[0].children, *waiting[1:]]


def _check_target(state: ScxmlState, transition: Element, states: Sequence[ScxmlState]) -> None:
    name = transition.attributes.get("target", "").strip()
    target = next((each for each in states if name and each.name == name), None)
    if target is None or (state.root.caller is None and target.root is state.root):
        return
    # A transition of the region itself leaves the parallel state, unless it is internal.
    is_internal = state is not state.root or transition.attributes.get("type") == "internal"
    if state.root not in target.around() or target is state.root or not is_internal:
        fix = 'use a transition of the parallel state; inside the region, type="internal"'
        raise _refusal(f"a transition to '{target.name}' leaves the region '{state.root.name}'", transition.line, fix)
    if target.root is not state.root:
        reason = f"a transition enters the region '{target.root.name}' alone"
        raise _refusal(reason, transition.line, "enter the parallel state, and start in <initial>")


def _check_reading(state: ScxmlState, element: Element, states: Sequence[ScxmlState]) -> None:
    text = f"{element.attributes.get('cond', '')} {element.attributes.get('expr', '')}"
    named = {found[1] or found[2] for found in IN_STATE.finditer(text)} - state.active()
    taken = element.attributes.get("event", "").split() if element.tag == "transition" else []
    for other in states if named or taken else ():
        around = [*other.around()]
        common = next((each for each in state.around() if each in around), None)
        # Only states around each other, or in two regions, are active at the same time.
        if other.root is not state.root and (common is None or common in (state, other) or common.regions):
            if other.name in named and other.caller not in [*state.ancestors()]:
                raise _refusal(f"In('{other.name}') is in another region", element.line, "use <data>")
            event = done_event(other)
            if event and any(matches(each, event) for each in taken):
                fix = "use done.state of the parallel state"
                raise _refusal(f"'{event}' is raised in another region", element.line, fix)


def _check_exit(inner: ScxmlState, leaving: list[Element], parallel: ScxmlState) -> None:
    for transition in inner.transitions():
        for outer in leaving:
            if _share_event(transition, outer):
                reason = f"'{inner.name}' takes an event that leaves '{parallel.name}' in line {outer.line}"
                raise _refusal(reason, transition.line, "use different events")
    for item in inner.content("onexit"):
        if item.tag not in ("log", "cancel"):
            reason = f"<onexit> of '{inner.name}' does not run when '{parallel.name}' is left"
            raise _refusal(reason, item.line, "use <onexit> of the parallel state")


def _share_event(one: Element, other: Element) -> bool:
    first, second = (each.attributes.get("event", "").split() for each in (one, other))
    return any(matches(a, plain(b)) or matches(b, plain(a)) for a in first for b in second) or first == second == []
