"""Edits of the imports of a module: the generator adds what the code needs, so that only the names count."""

import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass

from vicode.model.project import Project
from vicode.sync.interpret.leftover import import_statement
from vicode.sync.interpret.unit_comparison import UnitComparison
from vicode.sync.interpret.units import Imports


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportEdits:
    """Imports that a person added or removed and that the generated text does not have.

    Attributes:
        added: Those that the person added.
        removed: Those that the person removed.
        kept: Those that the design no longer needs, but a unit that stays in the patch.
        shown: Those that the generated text has.
    """

    added: Imports
    removed: Imports
    kept: Imports
    shown: Imports

    @classmethod
    def of(cls, project: Project, before: UnitComparison, now: UnitComparison) -> "ImportEdits":
        """Compare the edited file with the text generated before and now."""
        missing = now.target.imports - before.own.imports - now.own.imports
        declared = {item.name for item in project.constants} | {item.name for item in project.enumerations}
        rest = [item.code for name in now.different() for item in now.target.items.get(name, ())]
        rest += [now.target.bodies[code] for code in rest if code in now.target.bodies]
        words = {word for code in rest for word in re.findall(r"\w+", code)}
        added = frozenset(
            (module, name, alias)
            for module, name, alias in missing
            # The generator adds these where they are needed.
            if name.rstrip("_") not in (*declared, "arithmetic")
            or not module.startswith((".", "vicode"))
            or (alias or name) in words
        )
        removed = (before.own.imports - now.target.imports) & now.own.imports
        lost = (before.own.imports & now.target.imports) - now.own.imports
        kept = frozenset(each for each in lost if (each[2] or each[1] or each[0].partition(".")[0]) in words)
        return cls(added=added, removed=removed, kept=kept, shown=now.own.imports)

    @property
    def wanted(self) -> Imports:
        """What the edited file imports, and the generated text for the edits that were understood."""
        return (self.shown - self.removed) | self.added | self.kept

    def movable(self, edited: str, left: Collection[str]) -> Iterator[tuple[tuple[str, str, str], str, int]]:
        """Yield the added imports that may stand in the code of the module, with their statements and lines.

        Args:
            edited: The edited file.
            left: The words of the units that stay in the patch, and with them the imports that these need.
        """
        bound = {alias or name or module.partition(".")[0] for module, name, alias in self.shown}
        for module, name, alias in sorted(self.added):
            # An import in place of a generated one has another meaning.
            own = alias or name or module.partition(".")[0]
            if module == "__future__" or own in bound or own in left:
                continue
            statement = import_statement(module, name, alias)
            word = re.compile(rf"^\s*(import|from)\b.*\b{re.escape(name or module)}\b")
            lines = (number for number, line in enumerate(edited.split("\n"), start=1) if word.match(line))
            yield (module, name, alias), statement, next(lines, 1)
