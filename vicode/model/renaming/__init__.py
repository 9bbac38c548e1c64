"""Another name for one thing, wherever a project says it; docs, remarks and texts in quotes keep theirs."""

from vicode.model.renaming.designs import map_code
from vicode.model.renaming.names import Declared, Said, Way
from vicode.model.renaming.projects import has_declared, names_beside, rename_alias, rename_declared

__all__ = ["Declared", "Said", "Way", "has_declared", "map_code", "names_beside", "rename_alias", "rename_declared"]
