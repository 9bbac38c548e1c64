"""Where a design has been: a tree of steps, each with who made it; undo takes back a person's own steps only."""

from bisect import bisect_left
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Protocol

from vicode.findings import Path
from vicode.model.design import Design
from vicode.model.merging import merge

LIMIT = 500
_RUN = 12
_PAUSE_S = 60.0


class Whole(Protocol):
    """An edit of other files, too, or of others alone; a step that has one is its part in one design.

    Equal ones are the same. The design of the step may be that of the step before.
    """

    @property
    def label(self) -> str:
        """What the histories call it."""
        ...

    def take_back(self, person: str) -> str:
        """Take it back in all files; returns why not."""
        ...

    def do_again(self, person: str) -> str:
        """Do it again in all files; returns why not."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """A design with the edit that made it.

    `undoes` is the step whose change it takes out although others worked since, 0 for none; `typing_in` the field
    it was typed into; `at_s` the time of day, in seconds since 1970; `whole` the edit of several files it is part of.
    """

    id: int = 0
    parent: int = -1
    person: str = ""
    label: str
    at_s: float = 0.0
    undoes: int = 0
    typing_in: str = ""
    whole: Whole | None = None
    design: Design


@dataclass(frozen=True, slots=True, kw_only=True)
class Refusal:
    """Why a step cannot be taken back: `by` changed, at `path`, what `step` had done."""

    step: Step
    by: Step
    path: Path


@dataclass(frozen=True, kw_only=True)
class History:
    """All steps by id, and the one the design is `at`. `taken_back` holds what each person may do again, newest last.

    The first step has id 0.
    """

    steps: Mapping[int, Step]
    at: int = 0
    taken_back: Mapping[str, tuple[int, ...]] = field(default_factory=dict)

    @staticmethod
    def begin(design: Design, at_s: float = 0.0) -> "History":
        """A history with nothing but a start."""
        return History(steps={0: Step(label="open", design=design, at_s=at_s)})

    @property
    def present(self) -> Step:
        """The step that holds the design as it is now."""
        return self.steps[self.at]

    @cached_property
    def path(self) -> tuple[Step, ...]:
        """The steps from the start to now."""
        path = [self.present]
        while path[-1].parent in self.steps:
            path.append(self.steps[path[-1].parent])
        return tuple(reversed(path))

    def then(self, step: Step) -> "History":
        """The history after an edit; what is typed into one field goes on as one step."""
        if step.design == self.present.design and not (step.whole or step.undoes):
            return self
        going_on = self._typed_on(step) if step.typing_in else None
        taken_back = {**self.taken_back, step.person: self._left_to_redo(step)}
        return replace(going_on or self._appended(step), taken_back=taken_back)

    def beside(self, step: Step) -> "History":
        """The history with a step that leads nowhere: a design that somebody may want to go back to."""
        appended = self._appended(step)
        return replace(appended, at=self.at)

    def jumped(self, to: int) -> "History":
        """The history at another of its steps."""
        return replace(self, at=to) if to in self.steps else self

    def undone(self, person: str, at_s: float = 0.0) -> "History | Refusal":
        """One's own newest step taken back: by going back to before it, or out of what others did since."""
        step = self.undo_step(person)
        if step is None:
            return self
        taken_back = {**self.taken_back, person: (*self.taken_back.get(person, ()), step.id)}
        if step.id == self.at:
            return replace(self, at=step.parent, taken_back=taken_back)
        parent = self.steps[step.parent]
        merged = merge(step.design, self.present.design, parent.design)
        if merged.conflicts:
            return Refusal(step=step, by=self._culprit(step, parent), path=merged.conflicts[0].path)
        undoing = Step(person=person, label=f"undo {step.label}", at_s=at_s, undoes=step.id, design=merged.design)
        return replace(self._appended(undoing), taken_back=taken_back)

    def redone(self, person: str, at_s: float = 0.0) -> "History | Refusal":
        """What a person took back last, done again: by going forward to it, or into what others did since."""
        step = self.redo_step(person)
        if step is None:
            return self
        stack = self.taken_back.get(person, ())
        taken_back = {**self.taken_back, person: stack[: stack.index(step.id)]}
        if step.parent == self.at:
            return replace(self, at=step.id, taken_back=taken_back)
        parent = self.steps[step.parent]
        merged = merge(parent.design, self.present.design, step.design)
        if merged.conflicts:
            return Refusal(step=step, by=self.present, path=merged.conflicts[0].path)
        again = Step(person=person, label=f"redo {step.label}", at_s=at_s, design=merged.design)
        return replace(self._appended(again), taken_back=taken_back)

    def undo_step(self, person: str) -> Step | None:
        """What undo would take back for a person."""
        path = self.path[1:]
        gone = {step.undoes for step in path}
        own = (step for step in reversed(path) if step.person == person and not step.undoes and step.id not in gone)
        return next(own, None)

    def redo_step(self, person: str) -> Step | None:
        """What redo would do again for a person."""
        path = self.path
        undone = {step.undoes for step in path}
        done = {step.id for step in path} - undone
        stack = (self.steps.get(id_) for id_ in reversed(self.taken_back.get(person, ())))
        return next((step for step in stack if step and step.id not in done and step.parent in self.steps), None)

    def wholes(self) -> tuple[Step, ...]:
        """The steps on the way to now that edited several files, and were not taken back."""
        gone = {step.undoes for step in self.path}
        return tuple(step for step in self.path if step.whole and not step.undoes and step.id not in gone)

    def _left_to_redo(self, step: Step) -> tuple[int, ...]:
        """What the person may do again after a step; doing something new gives up the rest."""
        stack = self.taken_back.get(step.person, ())
        if step.undoes:
            return (*stack, step.undoes)
        known = (at for at, each in enumerate(stack) if each in self.steps and self.steps[each].whole == step.whole)
        again = max(known, default=0) if step.whole else 0
        return stack[:again]

    def _appended(self, step: Step) -> "History":
        id_ = max(self.steps) + 1
        steps = {**self.steps, id_: replace(step, id=id_, parent=self.at)}
        return replace(self, steps=_without_oldest(steps, id_), at=id_)

    def _typed_on(self, step: Step) -> "History | None":
        """The history in which `step` belongs to the person's last one, if that was typed into the same field.

        What others typed meanwhile stands above it, so each of their steps is given the new text, too.
        """
        since: list[Step] = []
        for last in reversed(self.path[-_RUN:]):
            if last.person == step.person:
                break
            since.append(last)
        goes_on = (last.person, last.typing_in) == (step.person, step.typing_in) and step.at_s - last.at_s < _PAUSE_S
        has_branch = any(each.parent == self.at for each in self.steps.values())
        if not goes_on or has_branch or not all(each.typing_in for each in since):
            return None
        grown = {}
        for each in (last, *since[1:]):
            merged = merge(self.present.design, each.design, step.design)
            if merged.conflicts:
                return None
            grown[each.id] = replace(each, design=merged.design)
        grown[last.id] = replace(grown[last.id], at_s=step.at_s)
        grown[self.at] = replace(grown.get(self.at, self.present), design=step.design)
        return replace(self, steps={**self.steps, **grown})

    def _culprit(self, step: Step, parent: Step) -> Step:
        """The first later step with which `step` can no longer be taken out."""
        later = [each for each in self.path if each.id > step.id]

        def touches(each: Step) -> bool:
            return bool(merge(step.design, each.design, parent.design).conflicts)

        return later[min(bisect_left(later, True, key=touches), len(later) - 1)]


def _without_oldest(steps: dict[int, Step], newest: int) -> dict[int, Step]:
    """The steps without the oldest, once there are too many; the next one becomes the start of its branch."""
    if len(steps) <= LIMIT:
        return steps
    path = [newest]
    while steps[path[-1]].parent in steps:
        path.append(steps[path[-1]].parent)
    # A step beside the way that leads here is given up first.
    oldest = min(steps, key=lambda id_: (id_ in path, id_))
    return {id_: step for id_, step in steps.items() if id_ != oldest}
