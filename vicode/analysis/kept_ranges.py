"""Which declared ranges of variables and outputs a design keeps itself.

Nothing limits what a design sets. A range is kept if the initial value and all values that are assigned lie in it, as
long as the other kept ranges are; what is not kept is found by dropping ranges until nothing changes any more.
"""

import re
from collections.abc import Iterator

from vicode.analysis.bounds import find_bounds
from vicode.analysis.quantities import QuantityTable, initial_value
from vicode.model.design import Assign, Declaration, Design
from vicode.model.expressions import parse_expression
from vicode.model.traversal import iter_actions, iter_code


def find_kept_ranges(design: Design, table: QuantityTable) -> frozenset[str]:
    """The names of the variables and outputs whose declared range the design keeps.

    Args:
        design: The design.
        table: Its quantities.
    """
    declared = {each.name: each for each in (*design.variables, *design.outputs) if each.range is not None}
    kept = {name for name, each in declared.items() if not _may_be_set_by_code(design, name)}
    while True:
        trusting = table.trusting(frozenset(kept))
        left = {name for name in kept if not _is_kept(declared[name], design, trusting)}
        if not left:
            return frozenset(kept)
        kept -= left


def _is_kept(declared: Declaration, design: Design, table: QuantityTable) -> bool:
    assert declared.range is not None
    least, greatest = declared.range
    start = initial_value(declared, table.scope, table.constants)
    if not isinstance(start, int | float) or not least <= start <= greatest:
        return False
    type_ = table.scope.type_of(declared)
    for text in _assigned_texts(design, declared.name):
        parsed = parse_expression(text, table.scope, type_)
        if parsed.tree is None or parsed.diagnostics:
            return False
        (low, high), may_be_nan = find_bounds(parsed.tree, {}, table)
        if may_be_nan or low < (least, 0) or high > (greatest, 1):
            return False
    return True


def _assigned_texts(design: Design, name: str) -> Iterator[str]:
    for placed in iter_actions(design):
        if isinstance(placed.action, Assign):
            yield from (text for target, text in placed.action.values if target == name)


def _may_be_set_by_code(design: Design, name: str) -> bool:
    word = re.compile(rf"\b{re.escape(name)}\b")
    return any(word.search(text) for located in iter_code(design) for _language, text in located.code.texts)
