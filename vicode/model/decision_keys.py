"""Keys of decisions: a text for the path of a decision, as the editor, records and traces use it."""

from collections.abc import Callable
from dataclasses import replace

from vicode.findings import DesignPath
from vicode.model.design import Decision, DecisionGroup, Design


def transition_key(path: DesignPath) -> str:
    """The key of a decision: "Kick/0", "Kick/2/then/1", "@common/0"."""
    source, rest = ("@common", path[2:]) if path[0] == "common" else (path[1], path[3:])
    return "/".join(str(part) for part in (source, *rest))


def parse_transition_key(key: str) -> DesignPath:
    """The path of a decision from its key."""
    source, *rest = key.split("/")
    start: DesignPath = ("common", "transitions") if source == "@common" else ("states", source, "transitions")
    return (*start, *(int(part) if part.isdecimal() else part for part in rest))


def with_decision_ids(design: Design, key: Callable[[DesignPath], str] = transition_key) -> Design:
    """The design with the key of each decision as its id, so that records refer to it."""

    def assign(items: tuple[Decision, ...], path: DesignPath) -> tuple[Decision, ...]:
        return tuple(with_id(item, (*path, index)) for index, item in enumerate(items))

    def with_id(item: Decision, path: DesignPath) -> Decision:
        named = replace(item, id=key(path))
        if not isinstance(named, DecisionGroup):
            return named
        return replace(
            named, then=assign(named.then, (*path, "then")), otherwise=assign(named.otherwise, (*path, "else"))
        )

    common = replace(design.common, transitions=assign(design.common.transitions, ("common", "transitions")))
    states = (
        replace(state, transitions=assign(state.transitions, ("states", state.name, "transitions")))
        for state in design.states
    )
    return replace(design, common=common, states=tuple(states))
