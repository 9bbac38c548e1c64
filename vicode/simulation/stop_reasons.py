"""Decides after each iteration whether a run rests, for a run under way and for a past that is looked at again."""

from vicode.simulation.messages import IterationResult, StopConditions

COUNT_REACHED = "count"
"""The reason of a run that made all its steps."""


def stop_reason(moment: IterationResult, stops: StopConditions, *, was_done: bool) -> str:
    """Why to rest after a moment, "" to go on; `was_done` whether the moment before was in a final state."""
    entered = moment.changed_from is not None or moment.iteration == 1
    reasons = {
        "transition": moment.transition is not None and moment.transition in stops.transitions,
        "state": entered and moment.state in stops.states,
        "error": stops.errors and bool(moment.errors),
        "done": moment.done and not was_done,
        "finished": moment.finished,
        "change": stops.changes and moment.changed_from is not None,
    }
    return next((reason for reason, holds in reasons.items() if holds), "")
