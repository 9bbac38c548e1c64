"""The states of an SCXML document, and the elements that designs cannot express."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from vicode.importers.scxml.reader import ScxmlError
from vicode.importers.xml_reader import Element

_STATES = ("state", "final")
_REASONS = {
    "parallel": ("a design is in one state at a time", "make a component of each region, and call them from a state"),
    "history": ("a design does not store the state that was left", "use a component with resume: true"),
    "invoke": ("designs start no other services", "use a separate component, and call it in the state"),
    "script": ("scripts are not translated", "use <assign>"),
    "foreach": ("designs have no collections", "use <assign> for each value"),
    "finalize": ("designs start no other services", "remove it"),
    "donedata": ("final states have no data", "assign it to a variable"),
    "param": ("events have no data", "use an input of the design"),
    "content": ("events have no data", "use an input of the design"),
}
_RAISE = ("a design reads inputs and has no queue of events", "use --event-queue")
_EXECUTABLE = ("assign", "if", "elseif", "else", "log", "send", "cancel", "raise")
_KNOWN = {
    *("scxml", "state", "final", "initial", "transition", "onentry", "onexit", "datamodel", "data"),
    *_EXECUTABLE,
}


@dataclass(slots=True, kw_only=True, eq=False)
class ScxmlState:
    """A state; the root is the document. `initial` is the target of the initial transition, with its content."""

    name: str
    element: Element
    parent: "ScxmlState | None"
    children: list["ScxmlState"] = field(default_factory=list)
    initial: str = ""
    initial_content: list[Element] = field(default_factory=list)

    @property
    def is_atomic(self) -> bool:
        return not self.children

    @property
    def is_final(self) -> bool:
        return self.element.tag == "final"

    @property
    def line(self) -> int:
        return self.element.line

    def ancestors(self) -> Iterator["ScxmlState"]:
        """The state itself, its parent, and so on up to the document."""
        state: ScxmlState | None = self
        while state is not None:
            yield state
            state = state.parent

    def content(self, tag: str) -> list[Element]:
        """The executable content of all blocks of a kind, `onentry` or `onexit`."""
        return [child for block in self.element.find(tag) for child in block.find()]

    def transitions(self) -> list[Element]:
        return list(self.element.find("transition"))


def read_states(root: Element, *, has_queue: bool) -> tuple[ScxmlState, dict[str, ScxmlState]]:
    """The tree of states, and all states by id.

    Raises:
        ScxmlError: An element cannot be expressed, or a name is unknown or used twice.
    """
    _refuse_elements(root, _REASONS if has_queue else {**_REASONS, "raise": _RAISE})
    by_name: dict[str, ScxmlState] = {}
    document = _read(root, None, by_name)
    if not document.children:
        raise ScxmlError("S803", "the document has no states", root.line)
    for state in (document, *by_name.values()):
        if state.initial and state.initial not in by_name:
            raise ScxmlError("S803", f"unknown state '{state.initial}'", state.line)
        if state.initial and state not in by_name[state.initial].ancestors():
            raise ScxmlError("S803", f"the initial state '{state.initial}' is not inside", state.line)
    return document, by_name


def _refuse_elements(element: Element, reasons: Mapping[str, tuple[str, str]]) -> None:
    if element.tag in reasons:
        reason, fix = reasons[element.tag]
        raise ScxmlError("S802", f"<{element.tag}>: {reason}", element.line, fix)
    if element.tag not in _KNOWN:
        raise ScxmlError("S802", f"<{element.tag}> has no meaning in designs", element.line, "remove it")
    for child in element.children:
        _refuse_elements(child, reasons)


def _read(element: Element, parent: ScxmlState | None, by_name: dict[str, ScxmlState]) -> ScxmlState:
    name = element.get("id", "") or (f"state_{len(by_name) + 1}" if parent else "")
    if name in by_name:
        raise ScxmlError("S803", f"two states have the id '{name}'", element.line)
    state = ScxmlState(name=name, element=element, parent=parent)
    if parent is not None:
        by_name[name] = state
    state.children = [_read(child, state, by_name) for child in element.find(*_STATES)]
    state.initial = element.get("initial", "")
    for block in element.find("initial"):
        for transition in block.find("transition"):
            state.initial, state.initial_content = transition.get("target", ""), list(transition.find())
    if " " in state.initial.strip():
        raise ScxmlError("S802", "several initial states: a design is in one state at a time", element.line)
    return state
