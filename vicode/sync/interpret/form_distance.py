"""The distance of two modules: the number of items to delete and insert.

It is a metric. A module lies between two others if its distances to them add up to their distance.
"""

from collections.abc import Mapping, Sequence
from itertools import groupby

from vicode.sync.code_items import CODE, CodeItem
from vicode.sync.interpret.normal_form import NormalForm


def form_distance(a: NormalForm, b: NormalForm, *, with_enclosing: bool = False) -> int:
    """Return the distance of two normal forms.

    Items are compared within a definition, which is fast, and the definitions by their order.

    Args:
        a: One form.
        b: The other.
        with_enclosing: Items are equal only if the tests that they depend on are equal, too.
    """
    sections, others = _sections(a, with_enclosing), _sections(b, with_enclosing)
    scopes = sections.keys() | others.keys()
    return _order_distance(a, b) + sum(distance(sections.get(each, ()), others.get(each, ())) for each in scopes)


def _order_distance(a: NormalForm, b: NormalForm) -> int:
    orders = [[scope for scope, _items in groupby(form.items, key=lambda item: item.scope)] for form in (a, b)]
    return distance(*orders)


def _sections(form: NormalForm, with_enclosing: bool) -> Mapping[str, Sequence[object]]:
    sections: dict[str, list[object]] = {}
    enclosing: list[CodeItem] = []
    for item in form.items:
        while enclosing and (enclosing[-1].scope != item.scope or enclosing[-1].depth > item.depth):
            enclosing.pop()
        # An `else` depends on the tests before it.
        if enclosing and enclosing[-1].depth == item.depth and not item.code.startswith(("else:", "elif ")):
            while enclosing and enclosing[-1].depth == item.depth:
                enclosing.pop()
        tests = tuple(each.code for each in enclosing) if with_enclosing else ()
        sections.setdefault(item.scope, []).append((item.key, tests))
        if item.kind == CODE and item.code.endswith(":"):
            enclosing.append(item)
    return sections


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
