"""From a design and its findings to the plain dicts that the canvas draws, and their difference."""

from vicode.editor.view.difference import difference
from vicode.editor.view.scene import scene_of, transition_key
from vicode.editor.view.selection import Selected, thing_of_path

__all__ = ["Selected", "difference", "scene_of", "thing_of_path", "transition_key"]
