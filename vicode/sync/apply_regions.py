"""Applies edits of regions to designs."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace

from vicode.findings import DesignPath
from vicode.generators import list_regions
from vicode.model.design import Code, Design, RunCode
from vicode.model.edits import replace_decision, update_actions
from vicode.model.project import Project
from vicode.model.traversal import find_decision
from vicode.sync.choices import NO_CHOICES, Choices, SettledConflict
from vicode.sync.file_edits import FileEdits
from vicode.sync.region_merge import RegionEdit

_EMPTY = {"python": "pass", "cpp": ";"}
"""Code without an effect, in the languages with regions: the design has no empty code."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AppliedEdit:
    """An edit of a region that a design now contains."""

    file: FileEdits
    region: RegionEdit
    path: DesignPath


@dataclass(frozen=True, slots=True, kw_only=True)
class AppliedEdits:
    """The designs with the edits, by component, the edits that could not be applied, and the chosen sides."""

    designs: Mapping[str, Design]
    applied: tuple[AppliedEdit, ...]
    conflicts: tuple[tuple[FileEdits, RegionEdit, DesignPath], ...]
    settled: tuple[SettledConflict, ...] = ()


def apply_regions(project: Project, files: Iterable[FileEdits], choices: Choices = NO_CHOICES) -> AppliedEdits:
    """Apply all edits of regions to the designs of a project.

    Args:
        project: The project, of which the generated texts of `files` were made.
        files: The edited files.
        choices: The sides that win conflicts; the others are left.
    """
    designs = {design.component: design for design in project.designs}
    changed: dict[str, Design] = {}
    applied: list[AppliedEdit] = []
    conflicts: list[tuple[FileEdits, RegionEdit, DesignPath]] = []
    settled: list[SettledConflict] = []
    for file in files:
        # A file that no design generates any more has no component.
        paths = list_regions(project, file.component, file.language) if file.component and file.regions else {}
        for region in file.regions:
            path = paths.get(region.target, ())
            choice = None
            if region.is_conflict or not path:
                choice = _settle(file, region, choices)
                if choice is None or (choice.side == "file" and not path):
                    conflicts.append((file, region, path))
                    continue
                settled.append(choice)
            text = _text_of(region, choice)
            if path and text != region.design_text:
                design = changed.get(file.component, designs[file.component])
                code = text.strip("\n") or _EMPTY[file.language]
                changed[file.component] = set_code(design, path, file.language, code)
                applied.append(AppliedEdit(file=file, region=region, path=path))
    return AppliedEdits(designs=changed, applied=tuple(applied), conflicts=tuple(conflicts), settled=tuple(settled))


def _settle(file: FileEdits, region: RegionEdit, choices: Choices) -> SettledConflict | None:
    names = (region.id, f"{file.path}:{region.line}")
    side = choices.find(names)
    if side is None:
        return None
    dropped = region.design_text if side == "file" else region.file_text
    return SettledConflict(path=file.path, names=names, side=side, dropped=dropped)


def _text_of(region: RegionEdit, choice: SettledConflict | None) -> str:
    if choice is not None:
        return region.file_text if choice.side == "file" else region.design_text
    return region.merged or ""


def set_code(design: Design, path: DesignPath, language: str, text: str) -> Design:
    """Replace the code at a path, as in `CodePlan`, in one language; a final line break stays."""

    def change(code: Code | None) -> Code:
        texts = dict(code.texts if code else ())
        texts[language] = text + "\n" * texts.get(language, "").endswith("\n")
        return Code(texts=tuple(texts.items()))

    match path:
        case ("module",):
            return replace(design, module=change(design.module))
        case ("members",):
            return replace(design, members=change(design.members))
        case (*phase, int(index), "code") if phase[-1] in ("enter", "actions", "leave"):
            return _set_action_code(design, tuple(phase), index, change)
        case _:
            return _set_guard_code(design, path[:-1], change)


def _set_action_code(design: Design, phase: DesignPath, index: int, change: Callable[[Code | None], Code]) -> Design:
    return update_actions(
        design,
        phase,
        lambda actions: tuple(
            replace(action, code=change(action.code)) if at == index and isinstance(action, RunCode) else action
            for at, action in enumerate(actions)
        ),
    )


def _set_guard_code(design: Design, path: DesignPath, change: Callable[[Code | None], Code]) -> Design:
    located = find_decision(design, path)
    if located is None:
        raise ValueError(f"no decision at {path}")
    guard = replace(located.decision.guard, code=change(located.decision.guard.code))
    return replace_decision(design, path, replace(located.decision, guard=guard))
