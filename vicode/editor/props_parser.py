"""Keeps NiceGUI from parsing props in one thread while another parses Python; see `vicode.model.python_parser`."""

import ast
from types import SimpleNamespace

from nicegui import props

from vicode.model.python_parser import serialize_calls


def serialize_props_parser() -> None:
    """Exchange the module that NiceGUI 3.18 parses props with; all other code keeps `ast` as it is."""
    vars(props)["ast"] = SimpleNamespace(literal_eval=serialize_calls(ast.literal_eval))
