"""View models: the scene of the canvas, the table, tooltips and labels, independent of NiceGUI."""

from vicode.diagram.transition_labels import guard_label, transition_label
from vicode.editor.view.item_labels import item_label, part_label
from vicode.editor.view.scene import make_scene
from vicode.editor.view.scene_diff import diff_scenes
from vicode.editor.view.scene_types import SCENE_LISTS, Scene, SceneChanges, SceneItem, SceneList
from vicode.editor.view.selection import ItemKind, ItemRef, item_at_path
from vicode.editor.view.table import TableData, diff_tables, item_row_id, make_table, parse_row_id
from vicode.editor.view.tooltip import tooltip_sections

__all__ = [
    "SCENE_LISTS",
    "ItemKind",
    "ItemRef",
    "Scene",
    "SceneChanges",
    "SceneItem",
    "SceneList",
    "TableData",
    "diff_scenes",
    "diff_tables",
    "guard_label",
    "item_at_path",
    "item_label",
    "item_row_id",
    "make_scene",
    "make_table",
    "parse_row_id",
    "part_label",
    "tooltip_sections",
    "transition_label",
]
