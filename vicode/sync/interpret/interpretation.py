"""Explains a changed file by edits of its design: proposes edits, generates, and keeps those that give the change.

The distance of modules counts the statements to delete and insert. An edit is understood if the code generated with it
lies between the code generated without it and the edited file; it contains nothing that the person did not write.
"""

import ast
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from vicode.check import check_design
from vicode.findings import DesignPath, Severity
from vicode.generators import component_generator
from vicode.model.design import Design
from vicode.model.diff import Change, ChangeKind, describe_change, diff_designs
from vicode.model.project import Project
from vicode.model.traversal import iter_decisions
from vicode.sync.interpret.action_proposals import propose_action_code, propose_actions
from vicode.sync.interpret.class_proposals import propose_class_code, propose_class_edits, with_imports
from vicode.sync.interpret.code_changes import find_changes
from vicode.sync.interpret.decision_proposals import propose_decisions
from vicode.sync.interpret.edit_context import CodeChange, EditContext
from vicode.sync.interpret.form_distance import form_distance
from vicode.sync.interpret.leftover import LeftoverWriter, import_statement, make_patch
from vicode.sync.interpret.normal_form import NormalForm, build_normal_form, collect_parts
from vicode.sync.interpret.parameter_defaults import align_defaults
from vicode.sync.interpret.renames import find_word_mapping, list_states, map_parts, map_words, propose_renames

_SOURCE = re.compile(r"^    design_file = (.*)$", re.MULTILINE)
_MAX_PROPOSALS = 3000
"""Limits the time for a file that has little in common with the generated one."""
_Imports = frozenset[tuple[str, str, str]]


@dataclass(frozen=True, slots=True, kw_only=True)
class InterpretedEdit:
    """An edit of the design: the path of the element, the edit in words, and its line in the edited file."""

    path: DesignPath
    words: str
    line: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Interpretation:
    """The design with the edits that were understood, and the rest as a patch of the text generated from it."""

    design: Design
    edits: tuple[InterpretedEdit, ...] = ()
    leftover: str = ""


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
    except SyntaxError:
        return Interpretation(design=design, leftover=make_patch(generated, edited, file or component))


def _interpret(project: Project, design: Design, *, generated: str, edited: str, file: str) -> Interpretation:
    search = _Search(project, design, generated, edited)
    if not search.is_possible(generated):
        return Interpretation(design=design, leftover=make_patch(generated, edited, file))
    search.run()
    return Interpretation(design=search.design, edits=tuple(search.edits), leftover=search.write_leftover(file))


class _Search:
    """Searches for edits of one design; `design` and `form` change with each edit that is understood."""

    def __init__(self, project: Project, design: Design, generated: str, edited: str) -> None:
        source = _SOURCE.search(generated)
        self._project = project
        self._write = component_generator(
            project,
            "python",
            {design.component: ast.literal_eval(source[1])} if source else {},
        )
        self.design, self._text, self._edited = design, generated, edited
        self._parts = collect_parts(generated)
        self._form = build_normal_form(generated, self._parts, is_generated=True)
        self._target = build_normal_form(edited, self._parts, is_generated=False)
        self._old_imports = self._form.imports
        # Differs from any interface, so that the errors of all users are known.
        self._interface: object = None
        self._errors = self._find_errors(design)
        self._interface = (design.parameters, design.outputs)
        self._failed: set[object] = set()
        self._proposal_count = 0
        self.edits: list[InterpretedEdit] = []

    def is_possible(self, generated: str) -> bool:
        """Whether the text is generated from the design, and the edited file still has its class."""
        classes = {item.scope for item in self._form.raw if isinstance(item.node, ast.ClassDef)}
        scopes = {item.scope for item in self._target.raw}
        return self._write_text(self.design) == generated and classes <= scopes

    def run(self) -> None:
        """Apply every edit that is understood."""
        has_progress = False
        while self._form.keys != self._target.keys and self._proposal_count < _MAX_PROPOSALS:
            if self._apply_rename() or self._apply_edit():
                has_progress = True
            elif has_progress:
                # What was not understood at first may depend on an edit that was understood since, as on a declaration.
                self._failed.clear()
                has_progress = False
            else:
                break
        self._apply_imports()

    def write_leftover(self, file: str) -> str:
        return LeftoverWriter(
            generated=self._text,
            generated_form=self._form,
            edited=self._edited,
            edited_form=self._target,
            parts=self._parts,
            imports=self._wanted_imports(),
        ).write(file)

    def _apply_rename(self) -> bool:
        for design in propose_renames(self.design, self._form, self._target):
            text = self._write_text(design)
            mapping = find_word_mapping(self._text, text) if text else None
            if text is None or mapping is None or self._has_new_errors(design):
                continue
            parts = map_parts(self._parts, mapping)
            form = build_normal_form(text, parts, is_generated=True)
            # Where a new name is also an old one, as after a swap, the person must have changed every use.
            is_ambiguous = not mapping.keys().isdisjoint(mapping.values())
            edited = self._edited if is_ambiguous else map_words(self._edited, mapping)
            target = build_normal_form(edited, parts, is_generated=False)
            if build_normal_form(map_words(self._text, mapping), parts, is_generated=True).keys != form.keys:
                continue
            if form_distance(form, target) >= form_distance(self._form, self._target):
                continue
            self._accept(design, self._first_difference())
            self._text, self._form, self._parts = text, form, parts
            self._edited, self._target = edited, target
            return True
        return False

    def _apply_edit(self) -> bool:
        total = form_distance(self._form, self._target)
        context = self._context()
        seen = {self.design}
        changes = [change for change in find_changes(self._form, self._target) if context.is_kept(change)]
        for proposers in _PROPOSERS:
            for change in changes:
                key = (proposers, change.key)
                proposals = (
                    () if key in self._failed else (each for propose in proposers for each in propose(context, change))
                )
                for design in proposals:
                    if design not in seen and self._try(design, change, total):
                        return True
                    seen.add(design)
                self._failed.add(key)
        return False

    def _try(self, design: Design, change: CodeChange, total: int) -> bool:
        """Accept a proposal if its code contains nothing but what the person wrote."""
        self._proposal_count += 1
        result = self._generate(design) if self._proposal_count < _MAX_PROPOSALS else None
        if result is None or not self._is_between(result[1], total) or self._has_new_errors(design):
            return False
        if _guarded(design) != _guarded(self.design) and not self._is_between_with_tests(result[1]):
            return False
        self._accept(design, change.item.first if change.added else change.line)
        self._text, self._form = result
        return True

    def _is_between(self, form: NormalForm, total: int) -> bool:
        """Whether a form is a part of the way from the generated text to the edited one."""
        step = form_distance(self._form, form)
        return 0 < step <= total and step + form_distance(form, self._target) == total

    def _is_between_with_tests(self, form: NormalForm) -> bool:
        """The same for items with the tests that they depend on: no part of a decision is read as another one."""
        total = form_distance(self._form, self._target, with_enclosing=True)
        step = form_distance(self._form, form, with_enclosing=True)
        return step + form_distance(form, self._target, with_enclosing=True) == total

    def _apply_imports(self) -> None:
        """Move imports that were added to the code of the module."""
        bound = {alias or name or module for module, name, alias in self._form.imports}
        for name in sorted(self._added_imports()):
            # An import in place of a generated one has another meaning.
            if name[0] == "__future__" or (name[2] or name[1] or name[0]) in bound:
                continue
            design = with_imports(self.design, [import_statement(*name)])
            result = self._generate(design)
            if result is None or result[1].keys != self._form.keys or self._has_new_errors(design):
                continue
            if result[1].imports - self._form.imports == {name}:
                lines = [item.first for item in self._target.raw if import_statement(*name).split()[1] in item.code]
                self._accept(design, lines[0] if lines else 1)
                self._text, self._form = result

    def _added_imports(self) -> _Imports:
        """Return the imports that the person added, without those that the generator adds where they are needed."""
        added = self._target.imports - self._old_imports - self._form.imports
        declared = {item.name for item in self._project.constants} | {"arithmetic"}
        declared |= {item.name for item in self._project.enumerations}
        words = self._words_of_rest()
        return frozenset(
            (module, name, alias)
            for module, name, alias in added
            if name.rstrip("_") not in declared or not module or (alias or name) in words
        )

    def _words_of_rest(self) -> set[str]:
        own = set(self._form.keys)
        rest = (item.code for item in self._target.items if item.key not in own)
        return {word for code in rest for word in re.findall(r"\w+", code)}

    def _wanted_imports(self) -> _Imports:
        """Return the imports of the generated text with the changes of the person that were not understood."""
        removed = self._old_imports - self._target.imports
        return (self._form.imports - removed) | self._added_imports()

    def _context(self) -> EditContext:
        return EditContext(
            project=self._project,
            design=self.design,
            stems={stem: name for name, stem in list_states(self._form.items)},
            edited=self._target.raw,
            lines=tuple(self._edited.split("\n")),
        )

    def _generate(self, design: Design) -> tuple[str, NormalForm] | None:
        text = self._write_text(design)
        try:
            return None if text is None else (text, build_normal_form(text, self._parts, is_generated=True))
        except SyntaxError:
            return None

    def _write_text(self, design: Design) -> str | None:
        code = self._write(design)
        return None if code is None else code.file.text

    def _find_errors(self, design: Design) -> frozenset[tuple[str, str, str]]:
        """Return the errors of the design, and of those that use it if its interface changed."""
        others = [each for each in self._project.designs if each.component != design.component]
        project = replace(self._project, designs=(*others, design))
        is_same = (design.parameters, design.outputs) == self._interface
        users = [each for each in others if any(use.component == design.component for use in each.uses)]
        return frozenset(
            (each.component, finding.rule.code, finding.message)
            for each in (design, *(() if is_same else users))
            for finding in check_design(project, each)
            if finding.severity is Severity.ERROR
        )

    def _has_new_errors(self, design: Design) -> bool:
        return not self._find_errors(design) <= self._errors

    def _accept(self, design: Design, line: int) -> None:
        for change in diff_designs(self.design, design):
            self.edits.append(InterpretedEdit(path=change.path, words=describe_edit(change), line=line))
        self.design = design

    def _first_difference(self) -> int:
        """Return the first line of the edited file that differs from the generated text."""
        for own, other in zip(self._form.items, self._target.items, strict=False):
            if own.key != other.key:
                return other.first
        return self._target.items[-1].last if self._target.items else 1


def _guarded(design: Design) -> list[bool]:
    """Whether the decisions have a guard; differs if a decision or its guard was added or removed."""
    return [located.decision.guard.is_empty for located in iter_decisions(design)]


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


_Proposer = Callable[[EditContext, CodeChange], Iterator[Design]]
_PROPOSERS: tuple[tuple[_Proposer, ...], ...] = (
    (propose_decisions, propose_actions, propose_class_edits),
    (propose_action_code, propose_class_code),
)
"""Hand-written code is the last way to explain a statement."""
