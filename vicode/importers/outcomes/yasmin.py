"""Reads state machines of YASMIN, which are XML."""

from collections.abc import Callable, Iterator
from pathlib import Path

from vicode.findings import Finding
from vicode.importers.notes import ImportNote
from vicode.importers.outcomes import OutcomeMachine, OutcomeState, OutcomeTransition
from vicode.importers.xml_reader import Element, SourceError, read_position, read_xml

_PARALLEL = ("Concurrence", "OrthogonalState")
_STATES = ("State", "StateMachine", *_PARALLEL)
_DATA = ("Key", "Param", "Remap", "ParamRemap")
_KNOWN = (*_STATES, *_DATA, "Transition", "FinalOutcome")


class YasminReader:
    """Collects the machines of files.

    Args:
        find: Returns a file that another file names, by its name and the file.
    """

    def __init__(self, find: Callable[[str, Path], Path | None]) -> None:
        self.machines: dict[str, OutcomeMachine | None] = {}
        self.notes: list[ImportNote] = []
        self.errors: list[Finding] = []
        self._find = find

    def read_file(self, path: Path) -> str:
        """Read a file, with those that it includes, and return the key of its machine.

        Raises:
            SourceError: It cannot be read.
            OSError: The same.
        """
        key = str(path)
        if key not in self.machines:
            # Machines that include each other end here.
            self.machines[key] = None
            try:
                root = read_xml(path.read_bytes(), ("StateMachine",))
                self._read_machine(root, path, key, root.attributes.get("name") or path.stem)
            except (SourceError, OSError):
                del self.machines[key]
                raise
        return key

    def _note(self, path: Path, line: int, text: str) -> None:
        self.notes.append(ImportNote(file=path, line=line, text=text))

    def _read_machine(self, element: Element, path: Path, key: str, name: str) -> None:
        self.machines[key] = None
        elements = list(element.find(*_STATES))
        if not elements:
            raise SourceError("S805", f"the state machine '{name}' has no states", element.line)
        for each in element.children:
            if each.tag not in _KNOWN:
                self._note(path, each.line, f"<{each.tag}> is left out")
        data = next(element.find(*_DATA), None)
        if data is not None:
            self._note(path, data.line, f"keys, parameters and remappings of '{name}' are not in the design")
        outcomes = tuple(dict.fromkeys(element.attributes.get("outcomes", "").split()))
        names = {_name(each) for each in elements} | set(outcomes)
        states = tuple(self._read_state(each, path, names) for each in elements)
        self.machines[key] = OutcomeMachine(
            name=name,
            place=(path, element.line),
            outcomes=outcomes,
            start=element.attributes.get("start_state") or states[0].name,
            states=states,
            doc=element.attributes.get("description", ""),
            ends={_name(each): at for each in element.find("FinalOutcome") if (at := read_position(each))},
        )

    def _read_state(self, element: Element, path: Path, names: set[str]) -> OutcomeState:
        name, about = _name(element), element.attributes
        if not name:
            raise SourceError("S805", f"<{element.tag}> has no name", element.line)
        transitions = list(_transitions(element, path))
        machine = self._machine_of(element, path, name) if element.tag == "StateMachine" else ""
        if element.tag in _PARALLEL:
            self._note(
                path, element.line, f"what '{name}' runs in parallel is left out: it is one component to be written"
            )
        if machine:
            inner, known = self.machines[machine], {each.outcome for each in transitions}
            # YASMIN follows an outcome without transition to the state or outcome of the same name.
            more = [each for each in (inner.outcomes if inner else ()) if each in names and each not in known]
            transitions += (OutcomeTransition(outcome=each, to=each, place=(path, element.line)) for each in more)
        kind = ".".join(each for each in (about.get("module"), about.get("class")) if each)
        return OutcomeState(
            name=name,
            place=(path, element.line),
            transitions=tuple(transitions),
            machine=machine,
            doc="\n".join(each for each in (about.get("description"), kind) if each),
            at=read_position(element),
        )

    def _machine_of(self, element: Element, path: Path, name: str) -> str:
        """The key of the machine in an element; "" if its file is not found."""
        file = element.attributes.get("file_path") or element.attributes.get("file_name")
        if not file:
            key = f"{path}:{element.line}:{name}"
            self._read_machine(element, path, key, name)
            return key
        found = self._find(file, path)
        if found is None:
            self._note(path, element.line, f"'{file}' is not found: '{name}' is one component to be written")
            return ""
        try:
            return self.read_file(found)
        except SourceError as error:
            self.errors.append(error.finding(found))
            return ""


def _name(element: Element) -> str:
    return element.attributes.get("name", "")


def _transitions(element: Element, path: Path) -> Iterator[OutcomeTransition]:
    found = dict[str, OutcomeTransition]()
    for each in element.find("Transition"):
        outcome, to = each.attributes.get("from", ""), each.attributes.get("to", "")
        if not outcome or not to:
            raise SourceError("S805", "a transition needs 'from' and 'to'", each.line)
        # The last one with an outcome replaces those before.
        doc = each.attributes.get("description", "")
        found[outcome] = OutcomeTransition(outcome=outcome, to=to, place=(path, each.line), doc=doc)
    yield from found.values()
