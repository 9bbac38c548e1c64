"""Which modules import or run code of users: each is listed with its reason, and the editor reaches none of them."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]

LOADERS = {"exec", "eval", "__import__", "import_module", "load_attribute", "load_component", "make_world"}
"""Calls that import a module by a computed name, or run a text as code."""
LOADER_MODULES = {"pkgutil", "runpy"}

# module -> reason
RUNS_USER_CODE = {
    "vicode/bica/loader.py": "the runtime: loads classes by their path",
    "vicode/bica/match.py": "the runtime: the process of a match, with two versions of a design",
    "vicode/bica/reload.py": "the runtime: exchanges modules during a run",
    "vicode/bica/run.py": "the runtime: the process that `vicode run` starts",
    "vicode/bridge/behaviors.py": "`vicode bridge` runs behaviors in its own process",
    "vicode/bridge/robot.py": "`vicode bridge` makes a world for each robot",
    "vicode/cli/bridge_behaviors.py": "`vicode bridge` loads the class of its world",
    "vicode/cli/sim.py": "`vicode sim` loads the model of the robot",
    "vicode/conformance/worker.py": "the process of the Python adapters",
    "vicode/simulation/host.py": "the process of a simulation",
    "vicode/simulation/scripted_run.py": "the world of a run with given inputs",
}
IMPORTS_VICODE = {
    "vicode/cli/entry_point.py": "imports the module of a command",
    "vicode/store/__init__.py": "imports its modules when they are used",
    "vicode/xabsl/engine/__init__.py": "imports its modules when they are used",
}
COMPILES = {"vicode/xabsl/engine/engine.py": "compiles behaviors to Python that it generates itself"}

# Modules that only the process that they are part of imports: module -> who does.
ENTERED_BY = {
    "vicode.conformance.worker": set[str](),
    "vicode.simulation.worker": {"vicode/simulation/__main__.py"},
    "vicode.simulation.host": {"vicode/simulation/worker.py", "vicode/conformance/worker.py"},
}


def test_only_listed_modules_load_code_by_a_computed_name() -> None:
    allowed = {*RUNS_USER_CODE, *IMPORTS_VICODE, *COMPILES}
    found = {
        path.relative_to(ROOT).as_posix(): list(_loading_calls(path)) for path in _modules(*LOADERS, *LOADER_MODULES)
    }
    loading = {path: calls for path, calls in found.items() if calls}
    assert not loading.keys() - allowed, f"run user code in a process, or list the module with its reason: {loading}"
    assert not allowed - loading.keys(), "remove these modules from the list: they load nothing"


def test_modules_of_other_processes_are_not_imported() -> None:
    for module, expected in ENTERED_BY.items():
        name = module.rpartition(".")[2]
        users = {path.relative_to(ROOT).as_posix() for path in _modules(name) if module in _imports(path)}
        assert users == expected, f"{module} runs user code: start its process instead"


def _modules(*words: str) -> Iterator[Path]:
    """The modules that contain one of some words; to parse the others, too, takes long."""
    word = re.compile(rf"\b(?:{'|'.join(words)})\b")
    return (path for path in sorted((ROOT / "vicode").rglob("*.py")) if word.search(path.read_text(encoding="utf-8")))


def _tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def _loading_calls(path: Path) -> Iterator[str]:
    for node in ast.walk(_tree(path)):
        if isinstance(node, ast.Import | ast.ImportFrom):
            names = {alias.name for alias in node.names} if isinstance(node, ast.Import) else {node.module}
            yield from (f"import {name}" for name in names & LOADER_MODULES)
        if isinstance(node, ast.Call):
            called = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            is_fixed = bool(node.args) and isinstance(node.args[0], ast.Constant) and called == "import_module"
            if called in LOADERS and not is_fixed:
                yield f"{node.lineno}: {called}()"


def _imports(path: Path) -> set[str]:
    nodes = list(ast.walk(_tree(path)))
    names = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    for node in nodes:
        if isinstance(node, ast.ImportFrom) and node.module:
            names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return names
