"""Executable content of SCXML as actions of a design, its data as variables, and delayed events as timers."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from vicode.importers.names import DesignNames
from vicode.importers.scxml.expressions import translate
from vicode.importers.scxml.reader import Element, ScxmlError
from vicode.importers.scxml.states import ScxmlState
from vicode.model.design import Action, Assign, Declaration

_DELAY = re.compile(r"(\d+\.?\d*|\.\d+)(ms|s)")


@dataclass(frozen=True, slots=True, kw_only=True)
class Timer:
    """A delayed event, sent on entry of a state; `variable` stores the time."""

    state: ScxmlState
    seconds: str
    variable: str


@dataclass(slots=True, kw_only=True)
class ActionWriter:
    """Writes actions; `names` are the data of the document."""

    names: Mapping[str, str]
    timers: Mapping[str, Timer]
    _declarations: list[Declaration] = field(default_factory=list)

    @classmethod
    def of_document(cls, document: ScxmlState, states: Sequence[ScxmlState]) -> "ActionWriter":
        """Declare the data and timers of a document.

        Raises:
            ScxmlError: A value or event cannot be expressed.
        """
        allocator, names, declarations = DesignNames(frozenset({"events"})), dict[str, str](), list[Declaration]()
        for state in (document, *states):
            for item in (data for model in state.element.find("datamodel") for data in model.find("data")):
                name = item.attributes.get("id", "")
                text = translate(item.attributes.get("expr", "0"), {}, lambda _name: False, item.line)
                type_ = "bool" if text in ("true", "false") else "float"
                names[name] = allocator.allocate(name)
                initial = "" if text in ("0", "false") else text
                declarations.append(Declaration(name=names[name], type=type_, initial=initial))
        timers = {}
        for state in states:
            for item in state.content("onentry"):
                if item.tag == "send":
                    event, seconds = _read_timer(item)
                    _check_scope(event, state, states, item)
                    variable = allocator.allocate(f"sent_{event}")
                    timers[event] = Timer(state=state, seconds=seconds, variable=variable)
                    if not state.is_atomic:
                        declarations.append(Declaration(name=variable, type="float"))
        return cls(names=names, timers=timers, _declarations=declarations)

    def declarations(self) -> tuple[Declaration, ...]:
        return tuple(self._declarations)

    def write(self, content: Iterable[Element], owner: ScxmlState) -> tuple[Action, ...]:
        """The actions of a block.

        Raises:
            ScxmlError: An element cannot be expressed there.
        """
        return tuple(action for element in content for action in self._write(element, owner))

    def _write(self, element: Element, owner: ScxmlState) -> Iterator[Action]:
        match element.tag:
            case "assign":
                yield Assign(values=(self._assignment(element, owner),))
            case "if":
                yield from self._choice(element, owner)
            case "send":
                event, _seconds = _read_timer(element)
                timer = self.timers.get(event)
                if timer is None or element not in timer.state.content("onentry"):
                    raise _refuse_send(element)
                if not timer.state.is_atomic:
                    yield Assign(values=((timer.variable, "component_time"),))
            case "log" | "cancel":
                # Neither changes anything: a timer ends with its state.
                return
            case _:
                raise ScxmlError("S802", f"<{element.tag}> is not expected here", element.line)

    def _assignment(self, element: Element, owner: ScxmlState) -> tuple[str, str]:
        location, value = element.attributes.get("location", ""), element.attributes.get("expr")
        if location not in self.names:
            raise ScxmlError("S803", f"unknown name '{location}'", element.line, "declare it in <datamodel>")
        if value is None:
            raise ScxmlError("S802", "<assign> without expr: designs have no structured data", element.line)
        return self.names[location], self._translate(value, owner, element.line)

    def _translate(self, text: str, owner: ScxmlState, line: int) -> str:
        inside = {state.name for state in owner.ancestors()}
        return translate(text, self.names, inside.__contains__, line)

    def _choice(self, element: Element, owner: ScxmlState) -> Iterator[Action]:
        """An <if> as assignments of conditional expressions; no branch may change what the conditions read."""
        condition = self._translate(element.attributes.get("cond", "false"), owner, element.line)
        held, tests = condition, [condition]
        written: list[tuple[str, str, str]] = []
        for child in element.children:
            if child.tag in ("elseif", "else"):
                others = " and ".join(f"not ({test})" for test in tests)
                own = self._translate(child.attributes["cond"], owner, child.line) if child.tag == "elseif" else ""
                held = f"{others} and ({own})" if own else others
                tests += [own] if own else []
            elif child.tag == "assign":
                written.append((*self._assignment(child, owner), held))
            elif child.tag != "log":
                raise ScxmlError("S802", f"<{child.tag}> inside <if>: only <assign> is translated", child.line)
        read = set(re.findall(r"\w+", " ".join(tests)))
        for name, value, test in written:
            if name in read and len(written) > 1:
                reason = f"<if> assigns '{name}', which its conditions read"
                raise ScxmlError("S802", reason, element.line, "assign it in a separate state")
            yield Assign(values=((name, f"({value}) if {test} else {name}"),))


def _read_timer(element: Element) -> tuple[str, str]:
    delay = _DELAY.fullmatch(element.attributes.get("delay", "").strip())
    event = element.attributes.get("event", "")
    if delay is None or not event or "target" in element.attributes or float(delay[1]) == 0:
        raise _refuse_send(element)
    seconds = float(delay[1]) / (1000 if delay[2] == "ms" else 1)
    return event, f"{seconds:g}"


def _refuse_send(element: Element) -> ScxmlError:
    reason = "<send>: only a delayed event on entry of a state, for transitions of that state, is a timer of a design"
    return ScxmlError("S802", reason, element.line, "set a variable, and test it in guards")


def _check_scope(event: str, state: ScxmlState, states: Sequence[ScxmlState], element: Element) -> None:
    for other in states:
        for transition in other.transitions():
            if event in transition.attributes.get("event", "").split() and state not in other.ancestors():
                reason = f"<send>: '{event}' is used outside of '{state.name}', and timers end with their state"
                raise ScxmlError("S802", reason, element.line, "use another name there")
