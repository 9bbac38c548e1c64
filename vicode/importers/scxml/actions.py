"""Executable content of SCXML as actions of a design, its data as variables, and delayed events as timers."""

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from vicode.importers.design_names import DesignNames
from vicode.importers.scxml.ecmascript import translate
from vicode.importers.scxml.events import KEYWORDS, matches
from vicode.importers.scxml.queue import EVENTS_ALIAS, EventComponent
from vicode.importers.scxml.reader import ScxmlError
from vicode.importers.scxml.states import STATES, ScxmlState
from vicode.importers.xml_reader import Element
from vicode.model.design import Action, Assign, Declaration

_INTERNAL = "#_internal"
_PROCESSOR = "http://www.w3.org/TR/scxml/#SCXMLEventProcessor"
_DELAY = re.compile(r"(\d+\.?\d*|\.\d+)(ms|s)")


@dataclass(frozen=True, slots=True, kw_only=True)
class Timer:
    """A delayed event, sent on entry of a state; `variable` stores the time."""

    state: ScxmlState
    event: str
    seconds: str
    variable: str
    send_id: str

    @property
    def is_cancelled_on_exit(self) -> bool:
        cancels = (each for each in self.state.content("onexit") if each.tag == "cancel")
        return any(each.get("sendid") == self.send_id != "" for each in cancels)


@dataclass(slots=True, kw_only=True)
class ActionWriter:
    """Writes actions.

    Attributes:
        names: The data of the document.
        timers: The delayed events, without a queue.
        events: The queue; None if there is none.
        sent_at_once: The events that the document sends to itself without delay.
    """

    names: Mapping[str, str]
    timers: Mapping[str, Timer]
    events: EventComponent | None = None
    sent_at_once: frozenset[str] = frozenset()
    _declarations: list[Declaration] = field(default_factory=list)
    _send_ids: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def of_document(cls, states: Sequence[ScxmlState], *, has_queue: bool) -> "ActionWriter":
        """Declare the data of a document, and its timers unless delayed events are sent to a queue.

        Raises:
            ScxmlError: A value or event cannot be expressed.
        """
        allocator = DesignNames(frozenset({EVENTS_ALIAS}), KEYWORDS)
        names, declarations = dict[str, str](), list[Declaration]()
        for state in states:
            for item in (data for model in state.element.find("datamodel") for data in model.find("data")):
                name = item.get("id", "")
                text = translate(item.get("expr", "0"), {}, lambda _name: False, item.line)
                type_ = "bool" if text in ("true", "false") else "float"
                names[name] = allocator.allocate(name)
                initial = "" if text in ("0", "false") else text
                declarations.append(Declaration(name=names[name], type=type_, initial=initial))
        if has_queue:
            sent = [each for state in states for each in _iter_sends(state.element)]
            at_once = frozenset(_event_name(each) for each in sent if "delay" not in each.attributes)
            ids = _read_send_ids(each for each in sent if each.tag == "send")
            return cls(names=names, timers={}, sent_at_once=at_once, _declarations=declarations, _send_ids=ids)
        timers = _read_timers(states, allocator)
        return cls(names=names, timers=timers, _declarations=declarations)

    def for_design(
        self, root: ScxmlState, homes: Mapping[str, Sequence[ScxmlState]], aliases: Mapping[str, str]
    ) -> "ActionWriter":
        """The writer of one design; `homes` are the designs that declare data, `aliases` those of regions."""
        declared = {each.name: each for each in self._declarations}
        names = {
            name: own if root in homes[name] else f"{aliases.get(homes[name][0].name, '')}.{own}"
            for name, own in self.names.items()
        }
        own = [declared[each] for each in names.values() if each in declared]
        timers = (each for each in self.timers.values() if each.state.root is root and not each.state.is_atomic)
        own += (Declaration(name=each.variable, type="float") for each in timers)
        return replace(self, names=names, _declarations=own)

    def declarations(self, outputs: Collection[str], *, of_outputs: bool = False) -> tuple[Declaration, ...]:
        """The variables; or the data in `outputs`, which other designs read."""
        names = {self.names[each] for each in outputs}
        return tuple(each for each in self._declarations if (each.name in names) == of_outputs)

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
            case "raise" | "send" | "cancel":
                events = self.events
                yield from self._write_timer(element) if events is None else self._write_event(events, element)
            case "log":
                return
            case _:
                raise ScxmlError("S802", f"<{element.tag}> is not expected here", element.line)

    def _write_event(self, events: EventComponent, element: Element) -> Iterator[Action]:
        match element.tag:
            case "raise":
                return events.sending(_event_name(element), internal=True)
            case "cancel":
                return events.sending(_cancelled(element, self._send_ids), cancel=True)
            case _:
                return _write_send(events, element)

    def _write_timer(self, element: Element) -> Iterator[Action]:
        if element.tag == "cancel":
            # A timer ends with its state.
            ids = [timer.send_id for timer in self.timers.values() if element in timer.state.content("onexit")]
            if element.get("sendid") not in (ids if "sendid" in element.attributes else []):
                reason = "<cancel>: only a delayed event of a state is cancelled, on exit of this state"
                raise ScxmlError("S802", reason, element.line, "use --event-queue")
            return
        timer = self.timers.get(element.get("event", ""))
        if timer is None or element not in timer.state.content("onentry"):
            raise _refuse_send(element)
        if not timer.state.is_atomic:
            yield Assign(values=((timer.variable, "component_time"),))

    def _assignment(self, element: Element, owner: ScxmlState) -> tuple[str, str]:
        location, value = element.get("location"), element.get("expr")
        if location not in self.names:
            raise ScxmlError("S803", f"unknown name '{location}'", element.line, "declare it in <datamodel>")
        if "expr" not in element.attributes:
            raise ScxmlError("S802", "<assign> without expr: designs have no structured data", element.line)
        return self.names[location], self._translate(value, owner, element.line)

    def _translate(self, text: str, owner: ScxmlState, line: int) -> str:
        return translate(text, self.names, owner.active().__contains__, line)

    def _choice(self, element: Element, owner: ScxmlState) -> Iterator[Action]:
        """An <if> as assignments of conditional expressions; no branch may change what the conditions read."""
        condition = self._translate(element.get("cond", "false"), owner, element.line)
        held, tests = condition, [condition]
        written: list[tuple[str, str, str]] = []
        for child in element.find():
            if child.tag in ("elseif", "else"):
                others = " and ".join(f"not ({test})" for test in tests)
                own = self._translate(child.get("cond"), owner, child.line) if child.tag == "elseif" else ""
                held = f"{others} and ({own})" if own else others
                tests += [own] if own else []
            elif child.tag == "assign":
                written.append((*self._assignment(child, owner), held))
            elif child.tag != "log":
                raise ScxmlError("S802", f"<{child.tag}> inside <if>: only <assign> is translated", child.line)
        read = set(re.findall(r"[\w.]+", " ".join(tests)))
        for name, value, test in written:
            if name in read and len(written) > 1:
                reason = f"<if> assigns '{name}', which its conditions read"
                raise ScxmlError("S802", reason, element.line, "assign it in a separate state")
            yield Assign(values=((name, f"({value}) if {test} else {name}"),))


def _read_timers(states: Sequence[ScxmlState], allocator: DesignNames) -> dict[str, Timer]:
    timers: dict[str, Timer] = {}
    for state in states:
        for item in state.content("onentry"):
            if item.tag == "send":
                event, seconds = _read_timer(item)
                _check_scope(event, state, states, item)
                if event in timers:
                    raise _refuse_send(item)
                variable = allocator.allocate(f"sent_{event}")
                send_id = item.get("id", "")
                timers[event] = Timer(state=state, event=event, seconds=seconds, variable=variable, send_id=send_id)
    return timers


def _read_delay(text: str) -> str | None:
    """Seconds as text; None if it is not a time."""
    delay = _DELAY.fullmatch(text)
    if delay is None:
        return None
    return f"{float(delay[1]) / (1000 if delay[2] == 'ms' else 1):.9f}".rstrip("0").removesuffix(".")


def _read_timer(element: Element) -> tuple[str, str]:
    seconds = _read_delay(element.get("delay", "").strip())
    event = element.get("event", "")
    if seconds in (None, "0") or not event or element.attributes.keys() - {"event", "delay", "id"}:
        raise _refuse_send(element)
    assert seconds is not None
    return event, seconds


def _write_send(events: EventComponent, element: Element) -> Iterator[Action]:
    delay = _read_delay(element.get("delay", "0s").strip())
    target = element.get("target", "")
    others = sorted(element.attributes.keys() - {"event", "delay", "id", "target", "type"})
    if delay is None or others or target not in ("", _INTERNAL) or not _is_own_type(element):
        reason = f"<send> with {others[0]}" if others else "<send>: only events to the document itself are sent"
        raise ScxmlError("S802", reason, element.line, "send an event with a name to the document itself")
    return events.sending(
        _event_name(element), internal=target == _INTERNAL, delay="" if delay == "0" or target else delay
    )


def _event_name(element: Element) -> str:
    event = element.get("event", "")
    if not event:
        raise ScxmlError("S802", f"<{element.tag}> without event: names of events are fixed", element.line)
    return event


def _is_own_type(element: Element) -> bool:
    return element.get("type", "scxml") in ("scxml", _PROCESSOR, f"{_PROCESSOR}/")


def _read_send_ids(sends: Iterable[Element]) -> dict[str, str]:
    """The event of each id of <send>; "" if an event has several ids or none, or an id several events."""
    ids, events = dict[str, set[str]](), dict[str, set[str]]()
    for send in sends:
        event, send_id = _event_name(send), send.get("id", "")
        ids.setdefault(send_id, set()).add(event)
        events.setdefault(event, set()).add(send_id)
    pairs = {send_id: next(iter(found)) if len(found) == 1 else "" for send_id, found in ids.items() if send_id}
    return {send_id: event if len(events.get(event, ())) == 1 else "" for send_id, event in pairs.items()}


def _iter_sends(element: Element) -> Iterator[Element]:
    """The <send> and <raise> elements in the content of a state, but not in the states inside it."""
    for child in element.children:
        if child.tag in ("send", "raise"):
            yield child
        elif child.tag not in STATES:
            yield from _iter_sends(child)


def _cancelled(element: Element, sent: Mapping[str, str]) -> str:
    event = sent.get(element.get("sendid", ""), "")
    if not event:
        reason = "<cancel>: its sendid is not that of all <send> of one event"
        raise ScxmlError("S802", reason, element.line, "give all of them this id, and no other event")
    return event


def _refuse_send(element: Element) -> ScxmlError:
    reason = "<send>: only a delayed event on entry of a state, for transitions of that state, is a timer of a design"
    return ScxmlError("S802", reason, element.line, "use --event-queue")


def _check_scope(event: str, state: ScxmlState, states: Sequence[ScxmlState], element: Element) -> None:
    for other in states:
        for transition in other.transitions():
            descriptors = transition.get("event", "").split()
            if any(matches(each, event) for each in descriptors) and state not in other.ancestors():
                reason = f"<send>: '{event}' is used outside of '{state.name}', and timers end with their state"
                raise ScxmlError("S802", reason, element.line, "use another name there, or --event-queue")
