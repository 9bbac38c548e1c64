"""Compares the units of generated code with those of the edited file.

The distance of two versions of a unit is a metric: a version lies between two others if its distances to them add up to
their distance.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from vicode.sync.code_items import CODE, REGION, CodeItem
from vicode.sync.interpret.normal_form import GeneratedParts, called_actions, find_inlined, normalize
from vicode.sync.interpret.units import Items, Units

_Key = tuple[object, ...]


@dataclass(frozen=True, slots=True)
class NormalForms:
    """Remembers normal forms: most units of two generated texts are identical."""

    parts: GeneratedParts
    _known: dict[_Key, tuple[Items, Items]] = field(default_factory=dict)

    def normalize(self, units: Units, name: str, inlined: Mapping[str, CodeItem], *, is_generated: bool) -> Items:
        """Return a unit in the normal form; empty if there is no such unit."""
        items = units.items.get(name, ())
        if not items or name in inlined:
            return ()
        by_method = {unit.rpartition(".")[2]: region for unit, region in inlined.items()}
        called = {method: by_method[method] for method in called_actions(items) if method in by_method}
        regions = [item.code for item in (*items, *called.values()) if item.kind == REGION]
        key = (is_generated, id(items), *called, *(units.bodies.get(region) for region in regions))
        if key not in self._known:
            normal = normalize(items, called, units.bodies, self.parts, is_generated=is_generated)
            # The items are kept, so that no other ones get their identity.
            self._known[key] = (normal, items)
        return self._known[key][0]


@dataclass(frozen=True, slots=True)
class UnitComparison:
    """The units of a generated text (`own`) and of the edited file (`target`)."""

    own: Units
    target: Units
    forms: NormalForms
    _inlined: tuple[Mapping[str, CodeItem], Mapping[str, CodeItem]]

    @classmethod
    def of(cls, own: Units, target: Units, forms: NormalForms) -> "UnitComparison":
        return cls(own, target, forms, (find_inlined(own, target), find_inlined(target, own)))

    def own_items(self, name: str) -> Items:
        return self.forms.normalize(self.own, name, self._inlined[0], is_generated=True)

    def target_items(self, name: str) -> Items:
        return self.forms.normalize(self.target, name, self._inlined[1], is_generated=False)

    def is_equal(self, name: str) -> bool:
        own, target = self.own_items(name), self.target_items(name)
        return own is target or [item.key for item in own] == [item.key for item in target]

    def different(self) -> tuple[str, ...]:
        """Return the units that differ, in the order of the edited file."""
        return tuple(name for name in self._names() if not self.is_equal(name))

    def different_text(self) -> frozenset[str]:
        """Return the units whose text differs: also the methods `_do_…` that a unit that differs calls."""
        different = self.different()
        called = {
            f"{name.partition('.')[0]}.{method}"
            for name in different
            for units in (self.own, self.target)
            for method in called_actions(units.items.get(name, ()))
        }
        inlined = self._inlined[0].keys() | self._inlined[1].keys()
        return frozenset(different) | (called & inlined)

    def changed_since(self, before: "UnitComparison") -> tuple[str, ...]:
        """Return the units whose generated code is another one than in a comparison before."""
        names = dict.fromkeys((*self.own.items, *before.own.items))
        return tuple(
            name
            for name in names
            if self.own.items.get(name) is not before.own.items.get(name) or self._is_inlined(name, before)
            if [item.key for item in self.own_items(name)] != [item.key for item in before.own_items(name)]
        )

    def _is_inlined(self, name: str, other: "UnitComparison") -> bool:
        return any(called_actions(each.own.items.get(name, ())) for each in (self, other))

    def _names(self) -> Iterator[str]:
        yield from self.target.items
        yield from (name for name in self.own.items if name not in self.target.items)


def unit_distance(a: Items, b: Items, *, with_enclosing: bool = False) -> int:
    """Return the distance of two versions in the normal form.

    Args:
        a: One version.
        b: The other.
        with_enclosing: Items are equal only if the tests that they depend on are equal, too.
    """
    return distance(_keys(a, with_enclosing), _keys(b, with_enclosing))


def _keys(items: Items, with_enclosing: bool) -> Sequence[object]:
    if not with_enclosing:
        return [item.key for item in items]
    keys: list[object] = []
    enclosing: list[CodeItem] = []
    for item in items:
        while enclosing and enclosing[-1].depth > item.depth:
            enclosing.pop()
        # An `else` depends on the tests before it.
        if enclosing and enclosing[-1].depth == item.depth and not item.code.startswith(("else:", "elif ")):
            while enclosing and enclosing[-1].depth == item.depth:
                enclosing.pop()
        keys.append((item.key, tuple(each.code for each in enclosing)))
        if item.kind == CODE and item.code.endswith(":"):
            enclosing.append(item)
    return keys


def distance(a: Sequence[object], b: Sequence[object]) -> int:
    """Return the number of deletions and insertions that turn `a` into `b`.

    The algorithm is that of Myers, An O(ND) Difference Algorithm and Its Variations, 1986.
    """
    start = 0
    while start < min(len(a), len(b)) and a[start] == b[start]:
        start += 1
    end = 0
    while end < min(len(a), len(b)) - start and a[-1 - end] == b[-1 - end]:
        end += 1
    return _distance(a[start : len(a) - end], b[start : len(b) - end])


def _distance(a: Sequence[object], b: Sequence[object]) -> int:
    furthest = {1: 0}
    for edits in range(len(a) + len(b) + 1):
        for diagonal in range(-edits, edits + 1, 2):
            is_insertion = diagonal == -edits or (diagonal != edits and furthest[diagonal - 1] < furthest[diagonal + 1])
            x = furthest[diagonal + 1] if is_insertion else furthest[diagonal - 1] + 1
            while x < len(a) and x - diagonal < len(b) and a[x] == b[x - diagonal]:
                x += 1
            furthest[diagonal] = x
            if x >= len(a) and x - diagonal >= len(b):
                return edits
    return len(a) + len(b)
