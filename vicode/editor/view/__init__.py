"""From a design and its findings to the plain dicts that the canvas draws, and their difference."""

from vicode.diagram.labels import guard_label, label_of
from vicode.editor.view.difference import difference
from vicode.editor.view.peek import peek_of
from vicode.editor.view.scene import Scene, scene_of
from vicode.editor.view.selection import Selected, path_of_key, thing_of_path, transition_key
from vicode.editor.view.table import Table, row_of, table_difference, table_of, thing_of_row
from vicode.editor.view.wording import words_of_part, words_of_path

__all__ = [
    "Scene",
    "Selected",
    "Table",
    "difference",
    "guard_label",
    "label_of",
    "path_of_key",
    "peek_of",
    "row_of",
    "scene_of",
    "table_difference",
    "table_of",
    "thing_of_path",
    "thing_of_row",
    "transition_key",
    "words_of_part",
    "words_of_path",
]
