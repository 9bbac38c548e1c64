"""Modules hold no state, and classes inherit only where one of ours is made for it; each exception says why."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

STATE = {
    "vicode/bica/live.py: _servers": "roots of one process with the same address share a server",
    "vicode/bica/net_session.py: _sessions": "roots of one process share a connection",
    "vicode/bica/recorder.py: _active_runs": "two records of one process get different names",
    "vicode/store/projects.py: _read_cache": "the last files that were read, by content",
}

# Bases of the product that others inherit from.
BASES = {
    "BaseRoot": "Root adds what is imported on demand",
    "Branch": "a branch of generated XABSL belongs to a transition",
    "Component": "components of the runtime",
    "CoopState": "the kinds of cooperative states of XABSL",
    "Observer": "the live view measures steps in addition",
    "Recording": "a recorded trace is a recording",
    "RobotModel": "a robot with declared sensors is a robot",
    "SynchronizedState": "strictly synchronized states are synchronized states",
    "SyntaxNode": "nodes of a syntax tree",
    "TableWorld": "a world of tables whose inputs are set",
    "_InputRow": "an input with arguments is an input",
}

_MUTABLE_CALLS = {"dict", "list", "set", "deque", "Counter", "OrderedDict", "defaultdict", "bytearray"}


@pytest.fixture(scope="module")
def trees() -> dict[str, ast.Module]:
    """The syntax tree of each module of the product, freed after the tests of this file."""
    paths = sorted((ROOT / "vicode").rglob("*.py"))
    return {path.relative_to(ROOT).as_posix(): ast.parse(path.read_text(encoding="utf-8")) for path in paths}


def test_modules_hold_no_state(trees: dict[str, ast.Module]) -> None:
    found = {f"{path}: {name}" for path, tree in trees.items() for name in _find_state(tree)}
    assert found == STATE.keys()


def test_no_function_rebinds_a_global(trees: dict[str, ast.Module]) -> None:
    assert not [path for path, tree in trees.items() if any(isinstance(node, ast.Global) for node in ast.walk(tree))]


def test_classes_inherit_only_from_classes_made_for_it(trees: dict[str, ast.Module]) -> None:
    classes = {
        node.name: {ast.unparse(base).split("[")[0].rsplit(".")[-1] for base in node.bases}
        for tree in trees.values()
        for node in ast.walk(tree)
        if isinstance(node, ast.ClassDef)
    }
    exempt = {
        name
        for name in classes
        if _leads_to(name, classes, {"Protocol", "Exception", "TypedDict", "ValueError", "OSError", "StrEnum"})
    }
    used = {base for bases in classes.values() for base in bases & classes.keys()}
    assert used - exempt == BASES.keys()


def _find_state(tree: ast.Module) -> Iterator[str]:
    """Lower-case variables of a module with a mutable value."""
    for node in tree.body:
        target, value = None, None
        if isinstance(node, ast.Assign):
            target, value = node.targets[0], node.value
        elif isinstance(node, ast.AnnAssign):
            target, value = node.target, node.value
        is_mutable = isinstance(value, ast.List | ast.Dict | ast.Set) or (
            isinstance(value, ast.Call) and ast.unparse(value.func).rsplit(".")[-1] in _MUTABLE_CALLS
        )
        if isinstance(target, ast.Name) and is_mutable and not target.id.isupper() and target.id != "__all__":
            yield target.id


def _leads_to(name: str, classes: dict[str, set[str]], roots: set[str]) -> bool:
    bases = classes.get(name, set())
    return bool(bases & roots) or any(_leads_to(base, classes, roots) for base in bases if base != name)
