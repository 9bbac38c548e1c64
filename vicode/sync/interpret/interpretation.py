"""Explains a changed file by edits of its design: proposes edits, generates, and keeps those that give the change.

Each unit of the module (a method, an entry of the list of states, an attribute) is taken whole: the proposals for it
are kept only if every unit that they change is then what the person wrote, or as it was. `verification`, which knows
nothing of proposals, checks the result.
"""

import ast
import re
from dataclasses import dataclass

from vicode.findings import DesignPath
from vicode.model.design import Design
from vicode.model.diff import Change, ChangeKind, describe_change, diff_designs
from vicode.model.project import Project
from vicode.sync.interpret.leftover import make_patch, with_bodies, write_leftover
from vicode.sync.interpret.leftover_reasons import describe_unit
from vicode.sync.interpret.parameter_defaults import align_defaults
from vicode.sync.interpret.search import EditSearch, Snapshot
from vicode.sync.interpret.verification import is_same_program

_OTHER_PROGRAM = "the edits that were read do not give the program that was written, so all of it stays in the patch"
_OTHER_DESIGN = "the design produces other code than the file that was edited; generate it again"
_SOURCE = re.compile(r"^    design_file = (.*)$", re.MULTILINE)


@dataclass(frozen=True, slots=True, kw_only=True)
class InterpretedEdit:
    """An edit of the design: the path of the element, the edit in words, and its line in the edited file."""

    path: DesignPath
    words: str
    line: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Interpretation:
    """The design with the edits that were understood, and the rest as a patch of the text generated from it.

    `reasons` say why functions and other units stay in the patch.
    """

    design: Design
    edits: tuple[InterpretedEdit, ...] = ()
    leftover: str = ""
    reasons: tuple[str, ...] = ()


def interpret_edits(project: Project, component: str, *, generated: str, edited: str, file: str = "") -> Interpretation:
    """Explain the edits of a generated Python file; bodies of regions are ignored.

    Args:
        project: The project with the design of the component.
        component: The component.
        generated: The text generated from the design.
        edited: The file as it was found.
        file: The path in the patch; the component if empty.
    """
    design = project.design(component)
    if design is None:
        raise ValueError(f"the component '{component}' has no design")
    edited = edited.replace("\r\n", "\n").replace("\r", "\n")
    generated = generated.replace("\r\n", "\n")
    try:
        aligned = align_defaults(generated, edited)
        result = _interpret(project, design, generated=generated, edited=aligned, file=file or component)
        if aligned == edited or not result.leftover:
            return result
        # A default that was not understood is not changed where the person did not change it.
        exact = _interpret(project, design, generated=generated, edited=edited, file=file or component)
        return result if len(result.edits) > len(exact.edits) else exact
    except SyntaxError as error:
        reason = f"line {error.lineno or 1} is not Python: {error.msg}"
        leftover = make_patch(generated, edited, file or component)
        return Interpretation(design=design, leftover=leftover, reasons=(reason,))


def _interpret(project: Project, design: Design, *, generated: str, edited: str, file: str) -> Interpretation:
    source = _SOURCE.search(generated)
    search = EditSearch(project, design, generated, edited, ast.literal_eval(source[1]) if source else "")
    leftover = make_patch(generated, edited, file)
    if missing := search.missing_classes():
        reasons = tuple(f"{describe_unit(name)} is missing" for name in missing)
        return Interpretation(design=design, leftover=leftover, reasons=reasons)
    found = search.run()
    if found.steps and not search.is_of_design():
        return Interpretation(design=design, leftover=leftover, reasons=(_OTHER_DESIGN,))
    imports = search.imports_of(found)
    if not found.units.different() and imports.wanted == imports.shown:
        result = found.text
    else:
        different = found.units.different_text()
        result = write_leftover(found.text, found.edited, different=different, imports=imports.wanted)
    if not is_same_program(result, with_bodies(found.edited, search.start.text)):
        return Interpretation(design=design, leftover=leftover, reasons=(_OTHER_PROGRAM,))
    leftover = make_patch(found.text, result, file)
    reasons = search.reasons_of(found) if leftover else ()
    return Interpretation(design=found.design, edits=_list_edits(found), leftover=leftover, reasons=reasons)


def _list_edits(found: Snapshot) -> tuple[InterpretedEdit, ...]:
    return tuple(
        InterpretedEdit(path=change.path, words=describe_edit(change), line=step.line)
        for step in found.steps
        for change in diff_designs(step.before, step.after)
    )


def describe_edit(change: Change) -> str:
    """Describe a change by the new value in full, or the lines that are new: the reader knows what was written."""
    if change.kind != ChangeKind.CHANGED:
        verb = f"{change.kind} " if change.kind in (ChangeKind.ADDED, ChangeKind.REMOVED) else ""
        return f"{verb}{describe_change(change)[2:]}"
    is_transition = change.subject.startswith("transition ")
    subject = change.subject.removeprefix("transition ") if is_transition else change.subject
    attribute = " of ".join(part for part in (change.attribute, subject) if part)
    old = change.old.split("\n") if "\n" in change.new else []
    lines = [line.strip() for line in change.new.split("\n") if line.strip() and line not in old]
    new = f"{lines[0]} …" if len(lines) > 1 else "".join(lines)
    return f"{attribute}: {new or '(none)'}"
