"""Reads state machines of YASMIN, which are XML."""

from pathlib import Path

from vicode.importers.outcomes import OutcomeMachine, OutcomeState, OutcomeTransition
from vicode.importers.sources import SourceError, Sources
from vicode.importers.xml_reader import Element, read_position, read_xml

_PARALLEL = ("Concurrence", "OrthogonalState")
_STATES = ("State", "StateMachine", *_PARALLEL)
# The language of a class is that of the component to be written.
_KNOWN = ("type",)
_DATA = ("Key", "Param", "Remap", "ParamRemap")


class YasminReader:
    """Collects the machines of files by key."""

    def __init__(self, sources: Sources) -> None:
        self.machines: dict[str, OutcomeMachine] = {}
        self._sources = sources

    def read(self, path: Path, data: bytes) -> None:
        """Read a file, and those that it includes.

        Raises:
            SourceError: It cannot be read.
        """
        root = read_xml(data, ("StateMachine",))
        self._read_machine(root, path, str(path), root.get("name") or path.stem)
        for line, text in root.unread(_KNOWN):
            self._sources.note(path, line, text)

    def _read_machine(self, element: Element, path: Path, key: str, name: str) -> None:
        self._note_data(element, path, name)
        outcomes = tuple(dict.fromkeys(element.get("outcomes", "").split()))
        names = {each.get("name", "") for each in element.find(*_STATES)}
        states = tuple(self._read_state(each, path, names | {*outcomes}) for each in element.find(*_STATES))
        if not states:
            raise SourceError("S805", f"the state machine '{name}' has no states", element.line)
        ends = {each.get("name", ""): read_position(each) for each in element.find("FinalOutcome")}
        self.machines[key] = OutcomeMachine(
            name=name,
            place=(path, element.line),
            outcomes=outcomes,
            start=element.get("start_state") or states[0].name,
            states=states,
            doc=element.get("description", ""),
            ends={outcome: at for outcome, at in ends.items() if at},
        )

    def _note_data(self, element: Element, path: Path, name: str) -> None:
        data = [each for each in element.children if each.tag in _DATA]
        for each in data[:1]:
            self._sources.note(path, each.line, f"keys, parameters and remappings of '{name}' are left out")
        for each in data:
            each.is_reported = True

    def _read_state(self, element: Element, path: Path, names: set[str]) -> OutcomeState:
        name, transitions = element.get("name"), dict[str, OutcomeTransition]()
        for each in element.find("Transition"):
            outcome, to = each.get("from", ""), each.get("to", "")
            if not outcome or not to:
                raise SourceError("S805", "a transition needs 'from' and 'to'", each.line)
            doc = each.get("description", "")
            if outcome in transitions:
                text = f"another transition of '{name}' from '{outcome}' follows: this one is left out"
                self._sources.note(*transitions[outcome].place, text)
            transitions[outcome] = OutcomeTransition(outcome=outcome, to=to, place=(path, each.line), doc=doc)
        if not name:
            raise SourceError("S805", f"<{element.tag}> has no name", element.line)
        machine = self._machine_of(element, path, name) if element.tag == "StateMachine" else ""
        if element.tag in _PARALLEL:
            text = f"what '{name}' runs in parallel is left out: it is one component to be written"
            self._sources.note(path, element.line, text)
            element.is_reported = True
        if element.tag != "StateMachine":
            self._note_data(element, path, name)
        # YASMIN follows an outcome without transition to the state or outcome of the same name.
        for outcome in self.machines[machine].outcomes if machine in self.machines else ():
            if outcome in names:
                plain = OutcomeTransition(outcome=outcome, to=outcome, place=(path, element.line))
                transitions.setdefault(outcome, plain)
        kind = ".".join(each for each in (element.get("module"), element.get("class")) if each)
        return OutcomeState(
            name=name,
            place=(path, element.line),
            transitions=tuple(transitions.values()),
            machine=machine,
            doc="\n".join(each for each in (element.get("description"), kind) if each),
            at=read_position(element),
        )

    def _machine_of(self, element: Element, path: Path, name: str) -> str:
        """The key of the machine in an element, or in the file that it names; "" if that is not found."""
        file, key = (
            element.get("file_path") or element.get("file_name"),
            f"{path}:{element.line}:{name}",
        )
        found = self._sources.find(file, path, element.line) if file else None
        if not file:
            self._read_machine(element, path, key, name)
        elif found is None:
            self._sources.note(path, element.line, f"'{file}' is not found: '{name}' is one component to be written")
        return self._sources.load(found, self.read) if found else "" if file else key
