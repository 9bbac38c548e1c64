"""Searches for edits of one design that give the units of an edited file.

The generator cannot be inverted, but it can be tried: proposals are designs, the code of each is generated, and it is
kept if it lies between the code so far and the edited file: for every unit that it changes, the distances add up. So a
step never adds or removes a statement that the person did not, steps need not be undone, and a greedy search is enough.
The steps for one unit are kept only if the unit, and every other one that they changed, is what the person wrote.
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from vicode.check import find_design_errors
from vicode.generators import component_generator
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.model.traversal import iter_decisions
from vicode.sync.interpret.action_proposals import propose_action_code, propose_actions, propose_region_code
from vicode.sync.interpret.class_proposals import (
    propose_class_code,
    propose_class_edits,
    propose_states,
    with_imports,
)
from vicode.sync.interpret.code_changes import find_changes
from vicode.sync.interpret.decision_proposals import propose_decisions
from vicode.sync.interpret.dependencies import find_dependent
from vicode.sync.interpret.edit_context import CodeChange, EditContext
from vicode.sync.interpret.import_edits import ImportEdits
from vicode.sync.interpret.leftover_reasons import (
    DEPENDENT,
    describe_difference,
    describe_imports,
    describe_unit,
)
from vicode.sync.interpret.normal_form import collect_parts
from vicode.sync.interpret.renames import find_word_mapping, list_states, map_parts, map_words, propose_renames
from vicode.sync.interpret.unit_comparison import NormalForms, UnitComparison, unit_distance
from vicode.sync.interpret.units import UnitReader, list_bodies

_MAX_LINES, _MIN_TRIES = 150_000, 100
"""Limit the lines that are generated for a file that has little in common with the generated one: some seconds."""
_MAX_STEPS = 60
"""Limits the edits that explain one unit."""
_Errors = frozenset[tuple[str, str, str]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """An edit that was understood, and its line in the edited file."""

    before: Design
    after: Design
    line: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Snapshot:
    """A design with the edits understood so far.

    Attributes:
        design: The design.
        text: The text generated from it.
        edited: The edited file, in which the names of renamed states are the new ones everywhere.
        units: The units of the two texts.
        steps: The edits.
        taken: The units that changed with the edits.
    """

    design: Design
    text: str
    edited: str
    units: UnitComparison
    steps: tuple[Step, ...] = ()
    taken: frozenset[str] = frozenset()


class EditSearch:
    """Searches for edits; remembers what was generated and compared."""

    def __init__(self, project: Project, design: Design, generated: str, edited: str, source: str) -> None:
        self._project, self._generated = project, generated
        self._write = component_generator(project, "python", {design.component: source} if source else {})
        self._reader = UnitReader(list_bodies(generated))
        units = self._reader.split_generated(generated)
        compared = UnitComparison.of(units, self._reader.split_edited(edited), NormalForms(collect_parts(units)))
        self.start = Snapshot(design=design, text=generated, edited=edited, units=compared)
        # Differs from any interface, so that the errors of all users are known.
        self._interface: object = None
        self._errors = self._find_errors(design)
        self._interface = (design.parameters, design.outputs)
        self._texts: dict[Design, str | None] = {}
        self._max_tries = max(_MIN_TRIES, _MAX_LINES // (generated.count("\n") + 1))
        self._refused: frozenset[str] = frozenset()
        self._stuck: dict[str, str] = {}

    def is_of_design(self) -> bool:
        """Whether the text is generated from the design."""
        code = self._write(self.start.design)
        return code is not None and code.file.text == self._generated

    def missing_classes(self) -> tuple[str, ...]:
        """Return the classes that the edited file no longer has."""
        units = self.start.units
        return tuple(name for name in units.own.items if name.endswith(":") and name not in units.target.items)

    def run(self) -> Snapshot:
        """Apply every edit that is understood."""
        while True:
            found = self._with_imports(self._search())
            missing = self.imports_of(found).added
            more = find_dependent(self.start.units, found.units, found.taken, missing) - self._refused
            if not more:
                return found
            self._refused |= more

    def reasons_of(self, found: Snapshot) -> tuple[str, ...]:
        """Say of each unit that differs, and of each import, why it stays in the patch."""
        units = (f"{describe_unit(name)}: {self._reason_of(name)}" for name in found.units.different())
        return (*units, *describe_imports(self.imports_of(found)))

    def _reason_of(self, name: str) -> str:
        if name in self._refused:
            return DEPENDENT
        if self._is_exhausted():
            return f"the search ended after {self._max_tries} proposals; make fewer edits at once"
        return self._stuck.get(name, DEPENDENT)

    def imports_of(self, found: Snapshot) -> ImportEdits:
        """Return the edits of imports that the generated text does not have."""
        return ImportEdits.of(self._project, self.start.units, found.units)

    def _search(self) -> Snapshot:
        found, has_progress = self.start, True
        while has_progress and not self._is_exhausted():
            has_progress = False
            while (renamed := self._rename(found)) is not None:
                found, has_progress = renamed, True
            for name in found.units.different():
                if name in self._refused or found.units.is_equal(name):
                    continue
                explained = self._explain(found, name)
                if explained is not None and self._refused.isdisjoint(explained.taken):
                    found, has_progress = explained, True
        return found

    def _explain(self, start: Snapshot, name: str) -> Snapshot | None:
        """Return the snapshot in which a unit, and every other one that changed with it, is what the person wrote."""
        current = start
        failed: set[object] = set()
        for _step in range(_MAX_STEPS):
            changed = current.units.changed_since(start.units)
            missing = [each for each in dict.fromkeys((name, *changed)) if not current.units.is_equal(each)]
            if not missing:
                return replace(current, taken=start.taken | {name, *changed})
            following = next((found for each in missing if (found := self._step(current, each, failed))), None)
            if following is None:
                self._stuck[name] = describe_difference(
                    *(of(missing[0]) for of in (current.units.own_items, current.units.target_items))
                )
                return None
            current = following
        return None

    def _step(self, current: Snapshot, name: str, failed: set[object]) -> Snapshot | None:
        """Return the snapshot after one edit that brings a unit nearer to the edited file."""
        context = self._context(current)
        changes = list(find_changes(current.units.own_items(name), current.units.target_items(name)))
        seen = {current.design}
        for proposers in _PROPOSERS:
            for change in changes:
                key = (proposers, change.key)
                if key in failed or self._is_exhausted():
                    continue
                for design in (each for propose in proposers for each in propose(context, change)):
                    if design in seen:
                        continue
                    seen.add(design)
                    found = self._try(current, design, change.item.first if change.added else change.line)
                    if found is not None:
                        return found
                failed.add(key)
        return None

    def _try(self, current: Snapshot, design: Design, line: int) -> Snapshot | None:
        """Return the snapshot of a proposal whose code contains nothing but what the person wrote."""
        found = self._generate(current, design, line)
        if found is None or not _is_between(current, found) or self._has_new_errors(design):
            return None
        return found

    def _generate(self, current: Snapshot, design: Design, line: int) -> Snapshot | None:
        text = self._write_text(design)
        if text is None:
            return None
        try:
            units = UnitComparison.of(self._reader.split_generated(text), current.units.target, current.units.forms)
        except SyntaxError:
            return None
        step = Step(before=current.design, after=design, line=line)
        return replace(current, design=design, text=text, units=units, steps=(*current.steps, step))

    def _rename(self, current: Snapshot) -> Snapshot | None:
        """Return the snapshot after a state was renamed."""
        own, target = current.units.own.states(), current.units.target.states()
        for design in propose_renames(current.design, own, target) if own != target else ():
            text = self._write_text(design)
            mapping = find_word_mapping(current.text, text) if text else None
            if text is None or mapping is None or self._has_new_errors(design):
                continue
            found = self._with_names(current, design, text, mapping)
            if found is not None and _total(found) < _total(current) and _has_kept_method(current, found):
                return found
        return None

    def _with_names(self, current: Snapshot, design: Design, text: str, mapping: dict[str, str]) -> Snapshot | None:
        renamed = self._reader.split_generated(map_words(current.text, mapping))
        own = self._reader.split_generated(text)
        forms = NormalForms(map_parts(current.units.forms.parts, mapping))
        if UnitComparison.of(own, renamed, forms).different():
            return None
        # Where a new name is also an old one, as after a swap, the person must have changed every use.
        is_ambiguous = not mapping.keys().isdisjoint(mapping.values())
        edited = current.edited if is_ambiguous else map_words(current.edited, mapping)
        units = UnitComparison.of(own, self._reader.split_edited(edited), forms)
        line = next((item.first for item in current.units.target.states()), 1)
        step = Step(before=current.design, after=design, line=line)
        return replace(current, design=design, text=text, edited=edited, units=units, steps=(*current.steps, step))

    def _with_imports(self, found: Snapshot) -> Snapshot:
        """Move imports that were added to the code of the module."""
        left = (item.code for name in found.units.different() for item in found.units.target_items(name))
        words = {word for code in left for word in re.findall(r"\w+", code)}
        for name, statement, line in self.imports_of(found).movable(found.edited, words):
            changed = self._generate(found, with_imports(found.design, [statement]), line)
            if changed is None or self._has_new_errors(changed.design):
                continue
            is_same = changed.units.different() == found.units.different()
            if is_same and name not in self.imports_of(changed).added:
                found = changed
        return found

    def _context(self, found: Snapshot) -> EditContext:
        return EditContext(
            project=self._project,
            design=found.design,
            stems={stem: name for name, stem in list_states(found.units.own.states())},
            edited=found.units.target,
            lines=tuple(found.edited.split("\n")),
            bodies=found.units.own.bodies,
        )

    def _write_text(self, design: Design) -> str | None:
        if design not in self._texts and not self._is_exhausted():
            code = self._write(design)
            self._texts[design] = None if code is None else code.file.text
        return self._texts.get(design)

    def _is_exhausted(self) -> bool:
        return len(self._texts) >= self._max_tries

    def _find_errors(self, design: Design) -> _Errors:
        """Return the errors of the design, and of those that use it if its interface changed."""
        others = [each for each in self._project.designs if each.component != design.component]
        project = replace(self._project, designs=(*others, design))
        is_same = (design.parameters, design.outputs) == self._interface
        users = [each for each in others if any(use.component == design.component for use in each.uses)]
        return frozenset(
            (each.component, finding.rule.code, finding.message)
            for each in (design, *(() if is_same else users))
            for finding in find_design_errors(project, each)
        )

    def _has_new_errors(self, design: Design) -> bool:
        return not self._find_errors(design) <= self._errors


def _is_between(before: Snapshot, after: Snapshot) -> bool:
    """Whether a snapshot is a part of the way from another one to the edited file.

    If a guard was added or removed, items are compared with the tests that they depend on: no part of a decision is
    read as another one.
    """
    names = after.units.changed_since(before.units)
    has_other_guards = _are_unguarded(before.design) != _are_unguarded(after.design)
    return bool(names) and all(
        _is_nearer(before.units, after.units, name, with_enclosing=with_enclosing)
        for with_enclosing in ((False, True) if has_other_guards else (False,))
        for name in names
    )


def _is_nearer(before: UnitComparison, after: UnitComparison, name: str, *, with_enclosing: bool) -> bool:
    old, new, target = before.own_items(name), after.own_items(name), after.target_items(name)
    step, rest, total = (
        unit_distance(a, b, with_enclosing=with_enclosing)
        for a, b in ((old, new), (new, target), (old, before.target_items(name)))
    )
    return step + rest == total


def _are_unguarded(design: Design) -> list[bool]:
    """Return for each decision whether it has no guard; the lists of two designs differ if guards come or go."""
    return [located.decision.guard.is_empty for located in iter_decisions(design)]


def _has_kept_method(before: Snapshot, after: Snapshot) -> bool:
    """Whether most of a method of a renamed state is as before; otherwise one state was deleted and another added."""
    units = after.units
    new = (name for name in units.own.items if "._" in name and name not in before.units.own.items)
    # The method of an action that only one module has stands where it is called.
    methods = [name for name in new if units.own_items(name)]
    return not methods or any(
        2 * unit_distance(units.own_items(name), units.target_items(name)) <= len(units.own_items(name))
        for name in methods
    )


def _total(found: Snapshot) -> int:
    units = found.units
    return sum(unit_distance(units.own_items(name), units.target_items(name)) for name in units.different())


_Proposer = Callable[[EditContext, CodeChange], Iterator[Design]]
_PROPOSERS: tuple[tuple[_Proposer, ...], ...] = (
    (propose_decisions, propose_actions, propose_class_edits, propose_states),
    (propose_action_code, propose_region_code, propose_class_code),
)
"""Hand-written code is the last way to explain a statement."""
