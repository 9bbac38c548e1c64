"""Edits that must not be taken without others: code that uses a name which stays in the patch, and the reverse.

Units are explained one by one, so a method may be understood whose helper, attribute or import is not. Taken alone, it
would move into the design and fail there as soon as somebody generates without the patch. The search refuses such units
and starts again without them, until nothing depends on what is left. Names are compared as words, which errs to
refusing.
"""

import ast
import re
from collections.abc import Collection, Iterable

from vicode.sync.interpret.unit_comparison import UnitComparison
from vicode.sync.interpret.units import Imports, Items, Units


def find_dependent(
    before: UnitComparison, after: UnitComparison, taken: Collection[str], missing_imports: Imports
) -> frozenset[str]:
    """Return the units that were taken although they belong to units that were not.

    Args:
        before: The text generated before the edits, and the edited file.
        after: The text generated with the edits that were understood.
        taken: The units that these edits changed.
        missing_imports: Imports that the person added and that stay in the patch.
    """
    left = after.different()
    names = {alias or name or module.partition(".")[0] for module, name, alias in missing_imports}
    names |= {_short(name) for name in left if name not in before.own.items}
    names |= _attributes(after.target, left) - _attributes(after.own, left)
    using = {name for name in taken if names & _words(after.target.items.get(name, ()))}
    return frozenset(using) | _unused_definitions(before, after, taken, left)


def _unused_definitions(
    before: UnitComparison, after: UnitComparison, taken: Iterable[str], left: Collection[str]
) -> frozenset[str]:
    """Return the methods that were added and that only code uses which was not taken."""
    added = {name for name in taken if name not in before.own.items and name in after.target.items}
    if not added or not left:
        return frozenset()
    by_left = {word for name in left for word in _words(after.target.items.get(name, ()))}
    suspects = {name for name in added if _short(name) in by_left}
    kept = [name for name in after.target.items if name not in left and name not in suspects]
    used = {word for name in kept for word in _words(after.target.items[name])} if suspects else set()
    return frozenset(name for name in suspects if _short(name) not in used)


def _short(unit: str) -> str:
    return re.split(r"[.:]", unit)[-1].strip("'")


def _attributes(units: Units, names: Iterable[str]) -> set[str]:
    """Return the attributes that `__init__` sets, if it is one of the units."""
    nodes = (item.node for name in names if name.endswith(".__init__") for item in units.items.get(name, ()))
    targets = (node.targets[0] for node in nodes if isinstance(node, ast.Assign))
    return {target.attr for target in targets if isinstance(target, ast.Attribute)}


def _words(items: Items) -> set[str]:
    return {word for item in items for word in re.findall(r"\w+", item.code)}
