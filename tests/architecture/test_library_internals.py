"""Library internals that vicode relies on: listed here with a reason, and present in the installed version."""

import ast
from pathlib import Path

import pytest
from nicegui import Client
from nicegui.element import Element
from nicegui.elements.mixins.value_element import ValueElement

ROOT = Path(__file__).parents[2]

# (owner, name) -> reason. An upgrade of NiceGUI (see its upper bound in pyproject.toml) must keep or replace each.
INTERNALS: dict[tuple[type, str], str] = {
    (
        Element,
        "_props",
    ): "props that are large or change on each keystroke are set without building the element's text form",
    (ValueElement, "_event_args_to_value"): "a text field decodes its own message, which contains sequence numbers",
    (ValueElement, "_handle_value_change"): "a text field sends its value with a sequence number instead of as a prop",
    (Client, "_response_built"): "the scene is embedded into the page if the page has not been sent yet",
}
INSTANCE_INTERNALS = {"_send_update_on_value_change": "see `_handle_value_change`; set per instance"}


@pytest.mark.parametrize(("owner", "name"), INTERNALS, ids=lambda value: getattr(value, "__name__", value))
def test_the_internal_exists(owner: type, name: str) -> None:
    in_source = f"self.{name}" in Path(__import__(owner.__module__, fromlist=["_"]).__file__ or "").read_text()
    assert hasattr(owner, name) or in_source, f"NiceGUI no longer has {owner.__name__}.{name}: {INTERNALS[owner, name]}"


def test_no_other_internal_of_nicegui_is_used() -> None:
    allowed = {name for _owner, name in INTERNALS} | set(INSTANCE_INTERNALS)
    offenders = [
        f"{path.relative_to(ROOT)}: {name}"
        for path in sorted((ROOT / "vicode" / "editor").rglob("*.py"))
        for name in _foreign_private_names(ast.parse(path.read_text(encoding="utf-8")))
        if name not in allowed
    ]
    assert not offenders, "list it in this test with a reason, or avoid it:\n  " + "\n  ".join(offenders)


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
