"""Another name for one thing, wherever a project says it; docs, remarks and texts in quotes keep theirs."""

from vicode.model.renaming.designs import map_code
from vicode.model.renaming.names import ReferenceKind, ReferenceRename, SymbolRef
from vicode.model.renaming.projects import is_declared, rename_alias, rename_symbol, sibling_names

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
