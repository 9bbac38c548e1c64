"""Renaming of symbols in a project. Docs, comments and string literals are not changed."""

from vicode.model.rename.designs import map_code
from vicode.model.rename.projects import is_declared, rename_alias, rename_symbol, sibling_names
from vicode.model.rename.references import ReferenceKind, ReferenceRename, SymbolRef

__all__ = [
    "ReferenceKind",
    "ReferenceRename",
    "SymbolRef",
    "is_declared",
    "map_code",
    "rename_alias",
    "rename_symbol",
    "sibling_names",
]
