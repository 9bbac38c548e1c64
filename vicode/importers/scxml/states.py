"""The states of an SCXML document, and the elements that designs cannot express."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from vicode.importers.scxml.reader import ScxmlError
from vicode.importers.xml_reader import Element

STATES = ("state", "final", "parallel")
_REASONS = {
    "history": ("a design does not store the state that was left", "use a component with resume: true"),
    "invoke": ("designs start no other services", "use a separate component, and call it in the state"),
    "script": ("scripts are not translated", "use <assign>"),
    "foreach": ("designs have no collections", "use <assign> for each value"),
    "finalize": ("designs start no other services", "remove it"),
    "donedata": ("final states have no data", "assign it to a variable"),
    "param": ("events have no data", "use an input of the design"),
    "content": ("events have no data", "use an input of the design"),
}
_PARALLEL = ("with an event queue, a design is in one state at a time", "import it without --event-queue")
_RAISE = ("a design reads inputs and has no queue of events", "use --event-queue")
_EXECUTABLE = ("assign", "if", "elseif", "else", "log", "send", "cancel", "raise")
_KNOWN = {
    *("scxml", *STATES, "initial", "transition", "onentry", "onexit", "datamodel", "data"),
    *_EXECUTABLE,
}


@dataclass(slots=True, kw_only=True, eq=False)
class ScxmlState:
    """A state of a design; the root is the document, or a region of <parallel>, which is a design of its own.

    Attributes:
        initial: The target of the initial transition, with its content.
        regions: Of a parallel state, which has no children, the roots of the designs that it calls.
        caller: Of the root of a region, the parallel state.
    """

    name: str
    element: Element
    parent: "ScxmlState | None"
    children: list["ScxmlState"] = field(default_factory=list)
    initial: str = ""
    initial_content: list[Element] = field(default_factory=list)
    regions: list["ScxmlState"] = field(default_factory=list)
    caller: "ScxmlState | None" = None

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
        """The state itself, its parent, and so on up to the root."""
        state: ScxmlState | None = self
        while state is not None:
            yield state
            state = state.parent

    @property
    def root(self) -> "ScxmlState":
        return [*self.ancestors()][-1]

    def around(self) -> Iterator["ScxmlState"]:
        """The state itself and those around it, also in the designs that call its own."""
        yield from self.ancestors()
        if self.root.caller is not None:
            yield from self.root.caller.around()

    def active(self) -> set[str]:
        """The names of the states that are active whenever this one is."""
        return {each.name for state in self.around() for each in (state, *state.regions)}

    def content(self, tag: str) -> list[Element]:
        """The executable content of all blocks of a kind, `onentry` or `onexit`."""
        return [child for block in self.element.find(tag) for child in block.find()]

    def transitions(self) -> list[Element]:
        return list(self.element.find("transition"))


_Designs = dict[ScxmlState, dict[str, ScxmlState]]


def read_states(root: Element, *, has_queue: bool) -> _Designs:
    """The root of each design, that of the document first, with the states inside by id.

    Raises:
        ScxmlError: An element cannot be expressed, or a name is unknown or used twice.
    """
    _refuse_elements(root, {**_REASONS, **({"parallel": _PARALLEL} if has_queue else {"raise": _RAISE})})
    designs: _Designs = {}
    _read(root, None, designs)
    for design, by_name in designs.items():
        if not design.children:
            raise ScxmlError("S803", f"{'a region' if design.caller else 'the document'} has no states", design.line)
        for state in (design, *by_name.values()):
            if state.initial and state.initial not in by_name:
                raise ScxmlError("S803", f"unknown state '{state.initial}'", state.line)
            if state.initial and state not in by_name[state.initial].ancestors():
                raise ScxmlError("S803", f"the initial state '{state.initial}' is not inside", state.line)
    return designs


def _refuse_elements(element: Element, reasons: Mapping[str, tuple[str, str]]) -> None:
    if element.tag in reasons:
        reason, fix = reasons[element.tag]
        raise ScxmlError("S802", f"<{element.tag}>: {reason}", element.line, fix)
    if element.tag not in _KNOWN:
        raise ScxmlError("S802", f"<{element.tag}> has no meaning in designs", element.line, "remove it")
    for child in element.children:
        _refuse_elements(child, reasons)


def _read(
    element: Element, parent: ScxmlState | None, designs: _Designs, caller: ScxmlState | None = None
) -> ScxmlState:
    count = sum(map(len, designs.values())) + len(designs) - 1
    name = element.get("id", "") or (f"state_{count + 1}" if parent or caller else "")
    if any(name == root.name or name in by_name for root, by_name in designs.items()):
        raise ScxmlError("S803", f"two states have the id '{name}'", element.line)
    state = ScxmlState(name=name, element=element, parent=parent, caller=caller)
    designs.setdefault(state.root, {}).update({name: state} if parent is not None else {})
    if element.tag == "parallel":
        state.regions = [_read(child, None, designs, caller=state) for child in element.find(*STATES)]
        if not state.regions:
            raise ScxmlError("S803", "<parallel> without a region", element.line)
    else:
        state.children = [_read(child, state, designs) for child in element.find(*STATES)]
    state.initial = element.get("initial", "")
    for block in element.find("initial"):
        for transition in block.find("transition"):
            state.initial, state.initial_content = transition.get("target", ""), list(transition.find())
    if " " in state.initial.strip():
        raise ScxmlError("S802", "several initial states: a design is in one state at a time", element.line)
    return state
