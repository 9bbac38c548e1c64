"""Finds renamed items between two versions of a program, and renames them with all their uses.

No version says that an item was renamed: there are a name that is gone and a name that is new. They are a rename if
their content is equal, or similar for options and states; of several candidates, the one behind the same preceding item
is taken. Read as a removal and an addition, a rename would lose the comments and the layout of the item.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from vicode.xabsl import tree
from vicode.xabsl.compiler import CompileResult
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.patching.list_edits import text_similarity
from vicode.xabsl.patching.source_edits import SourceEdits
from vicode.xabsl.printer import print_node
from vicode.xabsl.source_loader import ProgramSource
from vicode.xabsl.symbol_table import Definition, SymbolTable

Key = tuple[str, ...]
"""Identifies a definition: its kind, its owner and its name."""

Renames = Mapping[Key, str]
_ROLES = ("input", "output", "internal", "const")
_MIN_SIMILARITY = 0.6


def iter_definitions(table: SymbolTable) -> Iterator[tuple[Key, Definition]]:
    """Yield all definitions with their keys."""
    groups = (table.enums, table.options, table.behaviors, table.agents)
    declared = [*(definition for group in groups for definition in group.values()), *table.symbols(*_ROLES)]
    for definition in declared:
        is_symbol = definition.role in _ROLES
        key = ("symbol", definition.kind, definition.name) if is_symbol else (definition.role, definition.name)
        yield key, definition
        for inner in (definition.parameters, definition.elements, definition.states):
            for name, item in inner.items():
                yield (item.role, *key, name), item


def find_renames(before: CompileResult, after: CompileResult) -> dict[Key, str]:
    """Find items of `before` that have another name in `after`."""
    renames: dict[Key, str] = {}
    options = _rename_pairs(before.table.options, after.table.options, _is_same_option)
    for old, new in options.items():
        renames["option", old] = new
    for name, option in before.table.options.items():
        other = after.table.options.get(options.get(name, name))
        if other is not None:
            renames |= _inner_renames(("option", name), option, other)
    for kind, group, others in (
        ("behavior", before.table.behaviors, after.table.behaviors),
        ("enum", before.table.enums, after.table.enums),
        ("agent", before.table.agents, after.table.agents),
    ):
        pairs = _rename_pairs(group, others, _is_same_declaration)
        renames |= {(kind, old): new for old, new in pairs.items()}
        for name, item in group.items():
            other = others.get(pairs.get(name, name))
            if other is not None and kind != "agent":
                renames |= _inner_renames((kind, name), item, other)
    return renames | _symbol_renames(before.table, after.table)


def _inner_renames(key: Key, before: Definition, after: Definition) -> dict[Key, str]:
    groups = (
        ("parameter", before.parameters, after.parameters, _is_same_declaration),
        ("state", before.states, after.states, _is_same_state),
        ("element", before.elements, after.elements, lambda _old, _new: True),
    )
    return {
        (role, *key, old): new
        for role, group, others, is_same in groups
        for old, new in _rename_pairs(group, others, is_same).items()
    }


def _symbol_renames(before: SymbolTable, after: SymbolTable) -> dict[Key, str]:
    renames: dict[Key, str] = {}
    for kind in ("d", "b", "e"):
        for role in _ROLES:
            olds = {item.name: item for item in before.symbols(role) if item.kind == kind}
            news = {item.name: item for item in after.symbols(role) if item.kind == kind}
            pairs = _rename_pairs(olds, news, _is_same_declaration)
            renames |= {("symbol", kind, old): new for old, new in pairs.items()}
            for name, item in olds.items():
                other = news.get(pairs.get(name, name))
                if other is not None:
                    renames |= _inner_renames(("symbol", kind, name), item, other)
    return renames


def _rename_pairs(
    before: Mapping[str, Definition],
    after: Mapping[str, Definition],
    is_same: Callable[[Definition, Definition], bool],
) -> dict[str, str]:
    """Pair removed names with added ones that stand in the same place, or else have the same content."""
    removed = [name for name in before if name not in after]
    added = [name for name in after if name not in before]
    places = _places(list(before), after), _places(list(after), before)
    pairs: dict[str, str] = {}
    for old in removed:
        candidates = [new for new in added if new not in pairs.values() and is_same(before[old], after[new])]
        best = [new for new in candidates if places[0][old] == places[1][new]]
        if best or candidates:
            pairs[old] = (best or candidates)[0]
    return pairs


def _places(names: Sequence[str], others: Mapping[str, Definition]) -> dict[str, str]:
    """The preceding name that both versions have, for each name."""
    places, last = {}, ""
    for name in names:
        places[name] = last
        last = name if name in others else last
    return places


def _is_same_option(before: Definition, after: Definition) -> bool:
    assert isinstance(before.node, tree.OptionNode)
    assert isinstance(after.node, tree.OptionNode)
    common = before.states.keys() & after.states.keys()
    if len(common) * 2 < max(len(before.states), len(after.states)):
        return False
    old, new = (print_node(replace(node, name=tree.NameNode("x"), doc="")) for node in (before.node, after.node))
    return text_similarity(old, new) >= _MIN_SIMILARITY


def _is_same_declaration(before: Definition, after: Definition) -> bool:
    name = tree.NameNode("x")
    old, new = (replace(item.node, name=name) for item in (before, after))  # type: ignore[call-arg]
    return bool(old == new)


def _is_same_state(before: Definition, after: Definition) -> bool:
    assert isinstance(before.node, tree.StateNode)
    assert isinstance(after.node, tree.StateNode)
    name = tree.NameNode("x")
    old, new = (print_node(replace(node, name=name)) for node in (before.node, after.node))
    return text_similarity(old, new) >= _MIN_SIMILARITY


def rename(source: ProgramSource, compiled: CompileResult, renames: Renames) -> dict[Path, str]:
    """Rename items with all their uses; returns the texts of the changed files."""
    new_names = {id(item): renames[key] for key, item in iter_definitions(compiled.table) if key in renames}
    enums = {key[1]: name for key, name in renames.items() if key[0] == "enum"}
    uses: dict[int, list[tuple[int, Definition]]] = {}
    for tokens, token, definition in _occurrences(compiled):
        uses.setdefault(id(tokens), []).append((token, definition))
    texts = {}
    for path, parsed in source.files.items():
        file = SourceEdits(parsed)
        for token, definition in dict.fromkeys(uses.get(id(parsed.tokens), ())):
            word = parsed.tokens.texts[token]
            qualifier = definition.enum if definition.role == "element" and word != definition.name else ""
            name = new_names.get(id(definition), definition.name)
            new = f"{enums.get(qualifier, qualifier)}.{name}" if qualifier else name
            if id(definition) in new_names or qualifier in enums:
                file.replace(file.start(token), file.end(token), "@" * word.startswith("@") + new)
        if file.edits:
            texts[path] = file.result()
    return texts


def _occurrences(compiled: CompileResult) -> Iterable[tuple[Tokens, int, Definition]]:
    yield from compiled.references
    for _key, definition in iter_definitions(compiled.table):
        yield definition.tokens, definition.name_node.first_token, definition
