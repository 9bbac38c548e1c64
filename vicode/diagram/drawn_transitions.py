"""The transitions that a diagram shows: one for each rule, although it means a transition of each state.

An interrupt leads from every state to the one that handles it, and a step of a competence from all less urgent steps:
each is drawn once, with an arrowhead at both ends if it also leads back.
"""

from collections.abc import Collection, Iterable
from dataclasses import dataclass

from vicode.diagram.transition_labels import GuardKind, guard_kind, is_short, short_transition_label, transition_label
from vicode.findings import DesignPath
from vicode.model.decision_keys import transition_key
from vicode.model.design import COMMON, Action, Assign, Design, RunCode, Transition
from vicode.model.disabled import disabled_states, is_enabled
from vicode.model.traversal import LocatedDecision, iter_transitions
from vicode.model.words import describe_construct


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnTransition:
    """A transition as it is drawn; `located` is the first of those that it stands for.

    Attributes:
        source: A state, or COMMON.
        paths: The paths of all transitions that it stands for.
        leads_back: Whether some of them lead from the target to the source.
        label: The guard in one line, or a short description.
        full_label: The guard in one line, with times in words.
        text: What a tooltip says.
        disabled: Whether none of them is generated.
    """

    located: LocatedDecision
    source: str
    target: str
    paths: tuple[DesignPath, ...]
    label: str
    full_label: str
    text: str
    guard_kind: GuardKind
    leads_back: bool = False
    derived: bool = False
    disabled: bool = False

    @property
    def keys(self) -> tuple[str, ...]:
        return tuple(map(transition_key, self.paths))


def draw_transitions(design: Design, only: Collection[str] | None = None) -> tuple[DrawnTransition, ...]:
    """The transitions of a design in the order of their sources, or those of some states."""
    rules: dict[tuple[object, ...], list[LocatedDecision]] = {}
    for located in iter_transitions(design):
        if only is None or located.source == COMMON or located.source in only:
            rules.setdefault(_rule_of(design, located, is_part=only is not None), []).append(located)
    off = disabled_states(design)
    drawn = [_draw_rule(design, group, off) for group in rules.values()]
    return tuple(sorted(drawn, key=_rank_of_shared))


def shows_common(design: Design) -> bool:
    """Whether a diagram needs the box "every state", which derived actions alone do not."""
    if design.common.transitions or has_written(design.common.actions):
        return True
    return bool(design.interrupts) and any(each.source == COMMON for each in draw_transitions(design))


def has_written(actions: Iterable[Action]) -> bool:
    """Whether there are other actions than derived ones."""
    return any(not getattr(each, "origin", ()) for each in actions)


def has_work(actions: Iterable[Action]) -> bool:
    """Whether there are other actions than calls and derived ones, which have signs of their own or none."""
    return any(isinstance(each, RunCode) or (isinstance(each, Assign) and not each.origin) for each in actions)


def _rank_of_shared(drawn: DrawnTransition) -> int:
    """Rules for many states come last, by their urgency, which is not the order of the states."""
    match getattr(drawn.located.decision, "origin", ()):
        case ("interrupts", int(number)) if drawn.source == COMMON:
            return number + 1
        case _:
            return 0


def _rule_of(design: Design, located: LocatedDecision, *, is_part: bool) -> tuple[object, ...]:
    """What transitions that are drawn as one have in common."""
    transition = located.decision
    assert isinstance(transition, Transition)
    match transition.origin:
        case ("interrupts", int(number)):
            interrupt = design.interrupts[number]
            leads_back = _leads_back(design, located)
            if leads_back and (is_part or interrupt.then not in ("", "resume")):
                return (*transition.origin, "", transition.to)
            return (*transition.origin, located.source if is_part else "")
        case ("competence", "steps", str(name)):
            # From each less urgent state to the step, and from the step back to the choice of the next one.
            return ("competence", name)
        case ("competence",):
            return ("competence", "", transition.to)
        case _:
            return located.path


def _leads_back(design: Design, located: LocatedDecision) -> bool:
    """Whether a derived transition leaves what its construct leads to."""
    match getattr(located.decision, "origin", ()):
        case ("interrupts", int(number)):
            return located.source == design.interrupts[number].do
        case ("competence", "steps", str(name)):
            return located.source == name
        case _:
            return False


def _draw_rule(design: Design, group: list[LocatedDecision], off: Collection[str]) -> DrawnTransition:
    group = sorted(group, key=lambda each: _leads_back(design, each))
    first = group[0]
    decision = first.decision
    assert isinstance(decision, Transition)
    ways_in = [each for each in group if isinstance(each.decision, Transition) and each.decision.to == decision.to]
    is_shared = _is_shared(design, first, len(ways_in))
    rule = _rule_label(design, first, is_shared=is_shared)
    full, described = transition_label(first, design.time_unit), describe_construct(design, decision.origin)
    return DrawnTransition(
        located=first,
        source=COMMON if is_shared else first.source,
        target=decision.to,
        paths=tuple(each.path for each in group),
        label=short_transition_label(first, design.time_unit) if rule is None else rule,
        full_label=transition_label(first, design.time_unit, spell_out=True) if rule is None else rule,
        text="\n".join(part for part in (described or full, "" if described else decision.doc) if part),
        guard_kind=guard_kind(first) if rule is None else GuardKind.GUARD if rule else GuardKind.ALWAYS,
        leads_back=len(ways_in) < len(group),
        derived=bool(decision.origin),
        disabled=not any(is_enabled(each, off) for each in group),
    )


def _is_shared(design: Design, located: LocatedDecision, count: int) -> bool:
    """Whether a transition is drawn from the box "every state": an interrupt of all states, or of several."""
    match getattr(located.decision, "origin", ()):
        case ("interrupts", int(number)) if not _leads_back(design, located):
            return count > 1 or not design.interrupts[number].during
        case _:
            return False


def _rule_label(design: Design, located: LocatedDecision, *, is_shared: bool) -> str | None:
    """The condition of the construct that a transition leads to; None if its guard is what is written."""
    unit = design.time_unit or "s"
    match getattr(located.decision, "origin", ()):
        case _ if _leads_back(design, located):
            return None
        case ("interrupts", int(number)):
            interrupt = design.interrupts[number]
            states = f"in {', '.join(interrupt.during)}: " if is_shared and interrupt.during else ""
            every = f", every {interrupt.every} {unit}" if interrupt.every else ""
            return states + (interrupt.doc if is_short(interrupt.doc) else f"{interrupt.when}{every}")
        case ("competence", "steps", str(name)) if design.competence is not None:
            step = next(each for each in design.competence.steps if each.name == name)
            tries = "" if step.retries is None else f"{step.retries} tries"
            return ", ".join(part for part in (step.when, tries) if part)
        case ("layers", str(name)):
            layer = next(each for each in design.layers if each.name == name)
            return f"{layer.when}, for {layer.hold} {unit}" if layer.when and layer.hold else layer.when
        case _:
            return None
