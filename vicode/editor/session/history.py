"""Undo and redo as a list of values."""

from dataclasses import dataclass, replace

from vicode.model.design import Design

LIMIT = 500


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """A design with the label of the edit that made it."""

    label: str
    design: Design


@dataclass(frozen=True, slots=True, kw_only=True)
class History:
    """Where a design has been: `past` the oldest first, `future` what undo took back, the nearest first."""

    present: Step
    past: tuple[Step, ...] = ()
    future: tuple[Step, ...] = ()

    def then(self, label: str, design: Design) -> "History":
        """The history after an edit; edits that change nothing leave it as it is."""
        if design == self.present.design:
            return self
        past = (*self.past, self.present)[-LIMIT:]
        return History(present=Step(label=label, design=design), past=past)

    def undone(self) -> "History":
        """One step back, the same at the start."""
        if not self.past:
            return self
        return History(present=self.past[-1], past=self.past[:-1], future=(self.present, *self.future))

    def redone(self) -> "History":
        """One step forward again, the same at the end."""
        if not self.future:
            return self
        return History(present=self.future[0], past=(*self.past, self.present), future=self.future[1:])

    def replaced(self, design: Design) -> "History":
        """The same history with another present, for typing that is one edit."""
        return replace(self, present=replace(self.present, design=design), future=())

    @property
    def undo_label(self) -> str:
        """What undo would take back, empty if nothing."""
        return self.present.label if self.past else ""

    @property
    def redo_label(self) -> str:
        """What redo would do again, empty if nothing."""
        return self.future[0].label if self.future else ""
