"""Plans renames of states, components and declarations in all files of a project."""
