"""Reads edits outside regions back as edits of designs."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.model.design import Design
from vicode.model.lowering import describe_origin, find_lost_edit
from vicode.model.project import Project
from vicode.sync.choices import NO_CHOICES, Choices, SettledConflict
from vicode.sync.file_edits import FileEdits, History
from vicode.sync.outside_edits import OutsideConflict, rebase_outside_edits

if TYPE_CHECKING:
    from vicode.sync.interpret import InterpretedEdit


@dataclass(frozen=True, slots=True, kw_only=True)
class OutsideReading:
    """The edits outside regions of one file.

    Attributes:
        file: The file.
        edits: What the design can express.
        leftover: A patch of the rest.
        reasons: Why it is left.
        conflicts: Lines that the design changed as well, for which no side was chosen. The rest is read without them.
        settled: Those for which a side was chosen.
        is_read: Whether the language has an interpreter; otherwise, the edits stay in the file.
    """

    file: FileEdits
    edits: "tuple[InterpretedEdit, ...]" = ()
    leftover: str = ""
    reasons: tuple[str, ...] = ()
    conflicts: tuple[OutsideConflict, ...] = ()
    settled: tuple[SettledConflict, ...] = ()
    is_read: bool = False

    @property
    def is_empty(self) -> bool:
        """Whether the file differs from the design in nothing that has a meaning."""
        return self.is_read and not (self.edits or self.leftover or self.conflicts)


@dataclass(frozen=True, slots=True, kw_only=True)
class OutsideReader:
    """Interprets files with edits outside regions.

    Attributes:
        texts: The texts generated from the project, by path.
        history: Returns earlier generated texts.
        choices: The sides that win conflicts.
        prefix: The folder of the files in patches.
    """

    texts: Mapping[str, str]
    history: History
    choices: Choices = NO_CHOICES
    prefix: str = ""

    def read_all(
        self, project: Project, files: Iterable[FileEdits]
    ) -> tuple[dict[str, Design], tuple[OutsideReading, ...]]:
        """Interpret all files with edits outside regions.

        Returns:
            The changed designs by component, and the edits.
        """
        designs: dict[str, Design] = {}
        found: list[OutsideReading] = []
        for file in files:
            if not file.is_edited_outside or file.path not in self.texts:
                continue
            design, reading = self.read(project, file)
            found.append(reading)
            if design is not None and reading.edits:
                designs[file.component] = design
                changed = (design if each.component == file.component else each for each in project.designs)
                project = replace(project, designs=tuple(changed))
        return designs, tuple(found)

    def read(self, project: Project, file: FileEdits) -> tuple[Design | None, OutsideReading]:
        """Interpret one file; returns the changed design."""
        from vicode.sync.interpret import INTERPRETERS  # noqa: PLC0415 - most files have no such edits
        from vicode.sync.interpret.leftover import make_patch  # noqa: PLC0415

        rebased = rebase_outside_edits(
            replace(file, new=self.texts[file.path]), next(iter(self.history(file.path)), None)
        )
        if rebased is None or not (file.component and file.language in INTERPRETERS):
            return None, OutsideReading(file=file)
        settled = tuple(each for conflict in rebased.conflicts if (each := self._settle(file, conflict)) is not None)
        chosen = {name: each.side for each in settled for name in each.names}
        edited = rebased.resolve(
            lambda each: each.file_text if chosen.get(conflict_name(file, each)) == "file" else each.design_text
        )
        shown = Path(self.prefix, file.path).as_posix()
        interpret = INTERPRETERS[file.language]
        generated = self.texts[file.path]
        result = interpret(project, file.component, generated=generated, edited=edited, file=shown)
        if origin := find_lost_edit(result.design):
            result = replace(
                result,
                edits=(),
                leftover=make_patch(generated, edited, shown),
                reasons=(
                    f"it changes a part that is derived from {describe_origin(origin)}; change that in the design",
                ),
            )
        reading = OutsideReading(
            file=file,
            edits=result.edits,
            leftover=result.leftover,
            reasons=result.reasons,
            conflicts=tuple(each for each in rebased.conflicts if conflict_name(file, each) not in chosen),
            settled=settled,
            is_read=True,
        )
        return result.design, reading

    def _settle(self, file: FileEdits, conflict: OutsideConflict) -> SettledConflict | None:
        names = (conflict_name(file, conflict),)
        side = self.choices.find(names)
        if side is None:
            return None
        dropped = conflict.design_text if side == "file" else conflict.file_text
        return SettledConflict(path=file.path, names=names, side=side, dropped=dropped)


def conflict_name(file: FileEdits, conflict: OutsideConflict) -> str:
    return f"{file.path}:{conflict.line}"
