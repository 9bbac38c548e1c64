"""Library internals that vicode relies on: listed here with a reason, and present in the installed version."""

import ast
from pathlib import Path

import pytest
from nicegui import Client, props
from nicegui.element import Element

ROOT = Path(__file__).parents[2]

# (owner, name) -> reason. An upgrade of NiceGUI (see its upper bound in pyproject.toml) must keep or replace each.
INTERNALS: dict[tuple[type, str], str] = {
    (
        Element,
        "_props",
    ): "props that are large or change on each keystroke are set without building the element's text form",
    (Client, "_response_built"): "the scene is embedded into the page if the page has not been sent yet",
}


@pytest.mark.parametrize(("owner", "name"), INTERNALS, ids=lambda value: getattr(value, "__name__", value))
def test_the_internal_exists(owner: type, name: str) -> None:
    in_source = f"self.{name}" in Path(__import__(owner.__module__, fromlist=["_"]).__file__ or "").read_text()
    assert hasattr(owner, name) or in_source, f"NiceGUI no longer has {owner.__name__}.{name}: {INTERNALS[owner, name]}"


def test_nicegui_parses_props_with_the_module_that_the_editor_replaces() -> None:
    assert props.ast.literal_eval  # type: ignore[attr-defined]


def test_these_and_no_other_internals_of_nicegui_are_used() -> None:
    used = {
        name: path.relative_to(ROOT).as_posix()
        for path in sorted((ROOT / "vicode" / "editor").rglob("*.py"))
        for name in _foreign_private_names(ast.parse(path.read_text(encoding="utf-8")))
    }
    listed = {name for _owner, name in INTERNALS}
    assert used.keys() == listed, [f"{path}: {name}" for name, path in used.items() if name not in listed]


def _foreign_private_names(tree: ast.Module) -> set[str]:
    """Private attributes that are used in a module but not defined in it."""
    nodes = list(ast.walk(tree))
    attributes = [node for node in nodes if isinstance(node, ast.Attribute)]
    defined = {node.name for node in nodes if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)}
    defined |= {node.attr for node in attributes if isinstance(node.ctx, ast.Store)}
    defined |= {
        node.target.id for node in nodes if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name)
    }
    used = {node.attr for node in attributes if node.attr.startswith("_") and not node.attr.startswith("__")}
    return used - defined
