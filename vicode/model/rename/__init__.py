"""Renaming of symbols in a project. Docs, comments and string literals are not changed."""

from vicode.model.rename.designs import map_code, rename_in_design
from vicode.model.rename.projects import is_declared, rename_alias, rename_symbol, sibling_names
from vicode.model.rename.references import ReferenceKind, ReferenceRename, SymbolRef
from vicode.model.rename.search import find_symbols, list_names

__all__ = [
    "ReferenceKind",
    "ReferenceRename",
    "SymbolRef",
    "find_symbols",
    "is_declared",
    "list_names",
    "map_code",
    "rename_alias",
    "rename_in_design",
    "rename_symbol",
    "sibling_names",
]
