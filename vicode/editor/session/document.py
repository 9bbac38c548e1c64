"""One open design: the sheet that all windows share, and the hold of one person on it."""

import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from vicode.editor.session.history import History, Refusal, Step, Whole
from vicode.editor.session.people import DISK, Company, People
from vicode.editor.session.wording import words_of_path
from vicode.editor.view import Scene, difference, path_of_key, scene_of
from vicode.findings import Finding
from vicode.model.design import Design
from vicode.model.merging import Conflict, merge
from vicode.model.project import Project
from vicode.model.walks import decision_at

Watcher = Callable[["Document"], None]
Checker = Callable[[Design], tuple[Finding, ...]]
_RECENT = 60


@dataclass(frozen=True, slots=True, kw_only=True)
class OnDisk:
    """What a file holds: its text, the design in it (None when there is none), what was wrong with the text."""

    text: str
    design: Design | None
    reading: tuple[Finding, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Act:
    """What somebody here did to the files of several designs, as their histories tell it.

    `undoes` is the edit that it takes back.
    """

    files: frozenset[Path]
    label: str
    person: str = ""
    whole: Whole | None = None
    undoes: Whole | None = None


@dataclass(frozen=True, slots=True)
class News:
    """What somebody did to the whole design, to be told to the others."""

    text: str = ""
    person: str = ""
    rev: int = 0


@dataclass(eq=False, kw_only=True)
class Sheet:
    """What all windows on a design share: its history, what is wrong with it, who watches it, who is here.

    `rev` counts the changes. `disk_text` is the text last read from or written to `file`, `saved` the design in it,
    `reading` what is wrong with it: keys that mean nothing are not in the design, but they are in the file. `clash` is
    what another program wrote into the file where unsaved work is, until somebody chooses.
    """

    file: Path
    disk_text: str
    saved: Design
    check: Checker
    reading: tuple[Finding, ...] = ()
    people: People = field(default_factory=People)
    clock: Callable[[], float] = time.time
    company: Company = field(init=False, default_factory=Company)
    history: History = field(init=False)
    findings: tuple[Finding, ...] = field(init=False, default=())
    rev: int = field(init=False, default=0)
    clash: OnDisk | None = field(init=False, default=None)
    news: News = field(init=False, default=News())
    watchers: list[Watcher] = field(init=False, default_factory=list)
    _drawn: tuple[Project, tuple[Finding, ...], Scene] | None = field(init=False, default=None)
    _recent: dict[int, Design] = field(init=False, default_factory=dict)
    _differences: deque[tuple[Scene, Scene, dict[str, Any]]] = field(
        init=False, default_factory=lambda: deque(maxlen=8)
    )

    def __post_init__(self) -> None:
        """Begin with what is on disk."""
        self.history = History.begin(self.saved, self.clock())
        self.findings = self._find()

    def become(self, history: History, by: "Document") -> None:
        """Go on with another history, and tell everybody."""
        if history is self.history:
            return
        self._recent[self.rev] = self.history.present.design
        self._recent.pop(self.rev - _RECENT, None)
        self.history = history
        self.rev += 1
        self.findings = self._find()
        self.tell(by)

    def scene(self, project: Project) -> Scene:
        """What the canvas draws; worked out once for all windows."""
        drawn = self._drawn
        if drawn is None or drawn[0] is not project or drawn[1] is not self.findings or drawn[2]["rev"] != self.rev:
            scene = scene_of(project, self.history.present.design, self.findings, self.rev)
            self._drawn = drawn = (project, self.findings, scene)
        return drawn[2]

    def changes(self, before: Scene, now: Scene) -> dict[str, Any]:
        """What differs between two scenes; worked out once for all windows that show the first."""
        for old, new, changes in self._differences:
            if old is before and new is now:
                return changes
        changes = difference(before, now)
        self._differences.append((before, now, changes))
        return changes

    def design_at(self, rev: int) -> Design:
        """The design as it was at a recent `rev`, as it is now for any other."""
        return self._recent.get(rev, self.history.present.design)

    def stands_on_disk(self, disk: OnDisk) -> None:
        """Note what the file holds now."""
        assert disk.design is not None
        self.saved, self.disk_text, self.reading, self.clash = disk.design, disk.text, disk.reading, None
        self.findings = self._find()

    @property
    def conflicts(self) -> tuple[Conflict, ...]:
        """What both sides of a clash touched by now: whoever works on may touch more, or take something back."""
        if self.clash is None or self.clash.design is None:
            return ()
        return merge(self.saved, self.history.present.design, self.clash.design).conflicts

    def check_again(self) -> None:
        """Check once more, because another design of the project has changed."""
        findings = self._find()
        if findings != self.findings:
            self.findings = findings
            self.tell(Document(self, DISK))

    def tell(self, by: "Document") -> None:
        """Tell every watcher that `by` changed something."""
        for watcher in tuple(self.watchers):
            watcher(by)

    def _find(self) -> tuple[Finding, ...]:
        return tuple(dict.fromkeys((*self.reading, *self.check(self.history.present.design))))


@dataclass(eq=False)
class Document:
    """An open design in the hands of one person; what others do to the sheet is seen here at once.

    Every change goes through `edit`, `undo`, `redo` or `jump`; watchers are told after each.
    """

    sheet: Sheet
    person: str = ""

    @property
    def design(self) -> Design:
        """The design as it is now."""
        return self.sheet.history.present.design

    @property
    def history(self) -> History:
        """Where it has been."""
        return self.sheet.history

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What is wrong with it."""
        return self.sheet.findings

    @property
    def rev(self) -> int:
        """How often it has changed."""
        return self.sheet.rev

    @property
    def file(self) -> Path:
        """Where it is saved."""
        return self.sheet.file

    @property
    def file_is_gone(self) -> bool:
        """Whether there is no such file any more, or nothing in it; one that is no text is there."""
        return not self.file.is_file() or not self.file.stat().st_size

    @property
    def is_saved(self) -> bool:
        """Whether the file holds the design as it is now."""
        return self.design == self.sheet.saved

    def edit(self, label: str, change: Callable[[Design], Design], *, typing_in: str = "") -> None:
        """Change the design; `label` names the edit in the history.

        A person's edits that follow each other with the same `typing_in` (a field being typed in) are one step of it.
        """
        self._do(self._step(label, change(self.design), typing_in))

    def undo(self) -> str:
        """Take one's own last edit back; returns why not, if what it did was changed by another since."""
        step = self.history.undo_step(self.person)
        if step is not None and step.whole is not None:
            return self.take_back(step.whole)
        return self._take(self.history.undone(self.person, self.sheet.clock()), "taken back")

    def redo(self) -> str:
        """Do again what undo took back; returns why not."""
        step = self.history.redo_step(self.person)
        if step is not None and step.whole is not None:
            refused = step.whole.do_again(self.person)
            if not refused:
                self.note(step.whole, f"redo {step.whole.label}")
            return refused
        return self._take(self.history.redone(self.person, self.sheet.clock()), "done again")

    def take_back(self, whole: Whole) -> str:
        """Take an edit of other files back, as a step if it was one here; returns why not."""
        refused = whole.take_back(self.person)
        step = next((each for each in reversed(self.history.wholes()) if each.whole == whole), None)
        if not refused and step is not None:
            self._do(replace(self._step(f"undo {whole.label}", self.design), undoes=step.id))
        return refused

    def note(self, whole: Whole, label: str = "") -> None:
        """Have an edit of other files that was done from here as a step, if it is none yet."""
        if all(each.whole != whole for each in self.history.wholes()):
            self._do(replace(self._step(label or whole.label, self.design), whole=whole))

    @property
    def undo_label(self) -> str:
        """What undo would take back, empty if nothing."""
        step = self.history.undo_step(self.person)
        return step.label if step else ""

    @property
    def redo_label(self) -> str:
        """What redo would do again, empty if nothing."""
        step = self.history.redo_step(self.person)
        return step.label if step else ""

    def jump(self, step: int) -> str:
        """Go to any point of the history; what is left stays in it, one jump away.

        What was one edit of several files on the way is taken back, or done again, in all of them; returns why not.
        One that changed nothing of this design keeps nobody from going: that it stays as it is, is told.
        """
        start = self.history.at
        before, after = self.history.wholes(), self.history.jumped(step).wholes()
        left = [each for each in reversed(before) if each.whole not in {other.whole for other in after}]
        entered = [each for each in after if each.whole not in {other.whole for other in before}]
        told: list[str] = []
        for number, each in enumerate((*left, *entered)):
            refused = self._pass(each, is_back=number < len(left))
            if refused and each.whole and self._is_beside(each):
                told.append(f"{each.whole.label} stays as it is. {refused}")
            elif refused:
                if not number:
                    self.sheet.become(self.history.jumped(start), self)
                return refused
        self.announce(f"{self.sheet.people.name_of(self.person)} went to “{self.history.jumped(step).present.label}”")
        self.sheet.become(self.history.jumped(step), self)
        return "; ".join(told)

    def _is_beside(self, step: Step) -> bool:
        """Whether a step changed other files alone."""
        parent = self.history.steps.get(step.parent)
        return parent is not None and parent.design == step.design

    def _pass(self, step: Step, *, is_back: bool) -> str:
        """Take an edit of several files back, or do it again: from here, or where the design is as the file has it."""
        assert step.whole is not None
        if not self.is_saved and not self._is_beside(step):
            self.sheet.become(self.history.jumped(step.id if is_back else step.parent), self)
        return step.whole.take_back(self.person) if is_back else step.whole.do_again(self.person)

    def take_disk(self, disk: OnDisk, label: str, design: Design | None = None) -> None:
        """Note what the file holds now, and go on with that, or with `design`; the file's own stays in the history."""
        assert disk.design is not None
        self.sheet.stands_on_disk(disk)
        history = self.history
        if design is not None and design != disk.design:
            theirs = Step(person=DISK, label="as it was on disk", at_s=self.sheet.clock(), design=disk.design)
            history = history.beside(theirs)
            self.announce(f"Merged with what another program wrote into {self.file.name}")
        grown = history.then(self._step(label, design if design is not None else disk.design))
        if grown is self.history:
            self.sheet.tell(self)
        else:
            self.sheet.become(grown, self)

    def follow_act(self, act: Act, design: Design) -> None:
        """Go on with what an edit of several files made of this one, as a step of who did it."""
        undone = next((step.id for step in reversed(self.history.wholes()) if step.whole == act.undoes), 0)
        whole = None if undone else act.whole
        step = replace(self._step(act.label, design), person=act.person, whole=whole, undoes=undone)
        grown = self.history.then(step)
        if grown is self.history:
            self.sheet.tell(self)
        else:
            self.sheet.become(grown, self)

    def has_decision(self, key: str) -> bool:
        """Whether there is a decision with this canvas id."""
        return decision_at(self.design, path_of_key(key)) is not None

    def announce(self, text: str) -> None:
        """Say to the others what was done to the whole design."""
        self.sheet.news = News(text, self.person, self.sheet.rev)

    def watch(self, watcher: Watcher) -> Callable[[], None]:
        """Tell `watcher` after every change, and by whom; what is returned ends it."""
        watchers = self.sheet.watchers
        watchers.append(watcher)
        return lambda: watchers.remove(watcher) if watcher in watchers else None

    def _step(self, label: str, design: Design, typing_in: str = "") -> Step:
        return Step(person=self.person, label=label, at_s=self.sheet.clock(), typing_in=typing_in, design=design)

    def _do(self, step: Step) -> None:
        self.sheet.become(self.history.then(step), self)

    def _take(self, outcome: History | Refusal, done: str) -> str:
        if isinstance(outcome, Refusal):
            who, what = self.sheet.people.name_of(outcome.by.person), words_of_path(outcome.path)
            return f"“{outcome.step.label}” cannot be {done}: {who} changed {what} since (“{outcome.by.label}”)"
        self.sheet.become(outcome, self)
        return ""
