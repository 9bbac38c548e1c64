"""Decides after each iteration whether a run stops; used for live runs and for recorded ones."""

from vicode.simulation.messages import IterationResult, StopConditions

COUNT_REACHED = "count"
"""The reason of a run that made all its steps."""


def stop_reason(iteration: IterationResult, stops: StopConditions, *, was_done: bool) -> str:
    """Why a run stops after this iteration, "" to continue. `was_done`: the previous iteration was in a final state."""
    entered = iteration.changed_from is not None or iteration.iteration == 1
    reasons = {
        "transition": iteration.transition is not None and iteration.transition in stops.transitions,
        "state": entered and iteration.state in stops.states,
        "error": stops.errors and bool(iteration.errors),
        "done": iteration.done and not was_done,
        "finished": iteration.finished,
        "change": stops.changes and iteration.changed_from is not None,
    }
    return next((reason for reason, holds in reasons.items() if holds), "")
