"""The event queue of an imported document: a hand-written component, so that the design itself needs no queue.

A design reads inputs and takes one transition per iteration; SCXML takes all transitions without event before the next
event. So the component `Events` hands out one event per iteration, internal ones first, and none while the design
holds it because a transition without event comes first. A design sends an event by setting a variable of this
component, which the next step reads: calls are not allowed on entry and exit. A block of actions that sends several
events needs a variable for each.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace

from vicode.importers.design_names import DesignNames
from vicode.importers.scxml.events import EventInputs
from vicode.model.design import Action, Assign, Declaration, State, Use
from vicode.model.project import Enumeration, Interface

EVENTS_ALIAS = "events"
EVENTS_MODULE = "events"
HOLD, SEND = "hold", "send"
_NONE = "none"


@dataclass(frozen=True, slots=True, kw_only=True)
class SentEvent:
    """What a design can send; `output` is that of the event, `delay` is in seconds.

    An internal event comes before all others; `is_cancel` removes delayed events instead.
    """

    output: str
    delay: str = ""
    is_internal: bool = False
    is_cancel: bool = False

    @property
    def stem(self) -> str:
        verb = "cancel" if self.is_cancel else "raise" if self.is_internal else "send"
        return f"{verb}_{self.output}" + (f"_after_{self.delay}" if self.delay else "")


@dataclass(slots=True, kw_only=True)
class EventComponent:
    """The component that provides the events; `has_queue` says whether they arrive through a queue.

    Attributes:
        name: The name of the component.
        sent: What the design sends, with its element in the enumeration `sent_type`.
        slots: The number of variables through which the design sends events.
    """

    inputs: EventInputs
    has_queue: bool
    name: str
    sent_type: str
    sent: dict[SentEvent, str] = field(default_factory=dict)
    slots: int = 0
    _elements: DesignNames = field(default_factory=lambda: DesignNames(frozenset({_NONE})))

    @classmethod
    def of_inputs(cls, inputs: EventInputs, component: str, *, has_queue: bool) -> "EventComponent":
        """Name the component; `component` is the name of the design."""
        names = DesignNames(frozenset({component}))
        name, sent_type = names.allocate("Events"), names.allocate("SentEvent")
        return cls(inputs=inputs, has_queue=has_queue and bool(inputs.names), name=name, sent_type=sent_type)

    def uses(self) -> tuple[Use, ...]:
        return (Use(alias=EVENTS_ALIAS, component=self.name),) if self.inputs.names else ()

    def interfaces(self) -> tuple[Interface, ...]:
        if not self.inputs.names:
            return ()
        outputs = self.inputs.declarations()
        if not self.has_queue:
            return (Interface(component=self.name, outputs=outputs),)
        hold = Declaration(name=HOLD, type="bool", doc="Whether the next step hands out no event.")
        slots = (
            Declaration(name=name, type=self.sent_type, doc="What the design sends; read by the next step.")
            for name in self.slot_names
        )
        return (
            Interface(
                component=self.name,
                implementation=f"{EVENTS_MODULE}:{self.name}",
                doc="Hands out one queued event per iteration.",
                outputs=outputs,
                variables=(hold, *slots),
            ),
        )

    @property
    def slot_names(self) -> tuple[str, ...]:
        return tuple(f"{SEND}_{number + 1}" for number in range(self.slots))

    def enumerations(self) -> tuple[Enumeration, ...]:
        elements = tuple((element, "") for element in (_NONE, *self.sent.values()))
        return (Enumeration(name=self.sent_type, elements=elements),) if self.sent else ()

    def sending(self, event: str, *, delay: str = "", internal: bool = False, cancel: bool = False) -> Iterator[Assign]:
        """The action that sends an event; none if no transition could take it. `number_sent` completes it."""
        output = self.inputs.of_event(event) if event else None
        if output is not None:
            sent = SentEvent(output=output, delay=delay, is_internal=internal, is_cancel=cancel)
            if sent not in self.sent:
                self.sent[sent] = self._elements.allocate(sent.stem)
            yield Assign(values=((_SENT, f"{self.sent_type}.{self.sent[sent]}"),))

    def holding(self, condition: str = "true") -> Assign:
        """Keeps the next event in the queue for one iteration, if the condition holds."""
        return Assign(values=((f"{EVENTS_ALIAS}.{HOLD}", condition),))

    def number_sent(self, states: Iterable[State]) -> list[State]:
        """Give each event that is sent in one iteration a variable: first those sent on exit, then those on entry."""
        states = list(states)
        on_exit = max((_count_sent(state.leave) for state in states), default=0)
        self.slots = on_exit + max((_count_sent(state.enter) for state in states), default=0)
        return [
            replace(state, leave=_number(state.leave, 1), enter=_number(state.enter, on_exit + 1)) for state in states
        ]


_SENT = f"{EVENTS_ALIAS}.{SEND}"


def _count_sent(actions: Iterable[Action]) -> int:
    return sum(isinstance(action, Assign) and action.values[0][0] == _SENT for action in actions)


def _number(actions: Iterable[Action], number: int) -> tuple[Action, ...]:
    numbered = list[Action]()
    for action in actions:
        if isinstance(action, Assign) and action.values[0][0] == _SENT:
            numbered.append(Assign(values=((f"{_SENT}_{number}", action.values[0][1]),)))
            number += 1
        else:
            numbered.append(action)
    return tuple(numbered)
