"""Runs designs in JavaScript: generated modules with a driver, in Node.js."""

import json
import math
import shutil
import subprocess
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from vicode.conformance.cpp import ProgramError, format_inputs
from vicode.conformance.inputs import ConformanceRun, OutputArgument, RunInput, used_interfaces
from vicode.conformance.traces import TraceDifference, TraceIteration, TraceNormalizer
from vicode.generators import collect_components, generate
from vicode.generators.javascript import RESERVED_MODULES, escape
from vicode.generators.plan import INTERFACES_MODULE, plan_package
from vicode.model.expressions import FunctionCall, build_scope, parse_expression, walk
from vicode.model.project import INTERNAL
from vicode.model.traversal import iter_expressions
from vicode.output import apply_diffs, compare_files
from vicode.templating import read_asset

NODE_MISSING = "there is no node (Debian: sudo apt install nodejs)"
_MAX_NS = 2**53
_LIBM = frozenset({"exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "atan2"})


def find_node() -> str | None:
    """Return the path of Node.js."""
    return shutil.which("node") or shutil.which("nodejs")


def find_unfit_javascript(run: ConformanceRun) -> str:
    """Why JavaScript cannot run these inputs; "" if it can."""
    if run.robots > 1:
        return "JavaScript runs one robot"
    if any(step.time_ns > _MAX_NS for step in run.steps):
        return "times of JavaScript are at most 2^53 ns"
    return ""


def is_last_bit(run: ConformanceRun, found: TraceDifference) -> bool:
    """Whether a difference is one of rounding, in a design that calls functions of libm."""
    try:
        one, other = map(float, found.values)
    except ValueError:
        return False
    return math.isclose(one, other, rel_tol=1e-13) and bool(_list_functions(run) & _LIBM)


def _list_functions(run: ConformanceRun) -> set[str]:
    project, found = run.project, set[str]()
    kept = collect_components(project, (run.root,))
    for design in (each for each in project.designs if each.component in kept):
        scope = build_scope(project, design)
        texts = (each.text for each in iter_expressions(design))
        trees = [parse_expression(text, scope, None).tree for text in texts]
        found |= {node.function for tree in trees if tree for node in walk(tree) if isinstance(node, FunctionCall)}
    return found


def run_javascript(runs: Mapping[str, ConformanceRun], folder: Path) -> dict[str, list[TraceIteration]]:
    """Run designs in one process.

    Raises:
        ProgramError: The program crashed, or there is no Node.js.
        UnsoundDesignError: A design cannot be generated.
    """
    node = find_node()
    if node is None:
        raise ProgramError(NODE_MISSING)
    base = folder / "javascript_runs"
    manifest = [_prepare(run, base / name) for name, run in runs.items()]
    base.mkdir(exist_ok=True)
    (base / "driver.mjs").write_text(read_asset("conformance/driver.mjs"), encoding="utf-8")
    (base / "runs.json").write_text(json.dumps(manifest), encoding="utf-8")
    command = [node, str(base / "driver.mjs"), str(base / "runs.json")]
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
    if done.returncode:
        raise ProgramError(f"node ended with exit code {done.returncode}\n{done.stderr.strip()[-2000:]}")
    return {name: _read(run, base / name / "trace") for name, run in runs.items()}


def _prepare(run: ConformanceRun, folder: Path) -> dict[str, Any]:
    """Write the code and the inputs of a run; return what the driver needs to know."""
    files = generate(run.project, languages=("javascript",), components=(run.root,))
    folder.mkdir(parents=True)
    apply_diffs(compare_files(files, folder), folder)
    (folder / "inputs").write_text(format_inputs(run), encoding="ascii")
    package = plan_package(run.project, RESERVED_MODULES)
    interfaces = [each.component for each in used_interfaces(run.project, run.root)]
    modules = dict.fromkeys(interfaces, INTERFACES_MODULE) | {run.root: package.modules[run.root]}
    return {
        "folder": str(folder / "javascript"),
        "root": run.root,
        "classes": {
            component: (f"{package.name}/{module}.mjs", escape(component)) for component, module in modules.items()
        },
        "shared": [
            each.component for each in used_interfaces(run.project, run.root) if each.implementation == INTERNAL
        ],
        "inputs": [_input(each) for each in run.inputs],
        "steps": str(folder / "inputs"),
        "trace": str(folder / "trace"),
    }


def _input(each: RunInput) -> dict[str, Any]:
    arguments = None if each.arguments is None else [_argument(argument) for argument in each.arguments]
    return {
        "component": each.component,
        "property": escape(each.name),
        "type": each.type,
        "elements": [f"{each.type}.{name}" for name in each.elements],
        "arguments": arguments,
    }


def _argument(argument: OutputArgument) -> dict[str, Any]:
    elements = [f"{argument.type}.{name}" for name in argument.elements]
    return {"name": escape(argument.name), "type": argument.type, "elements": elements}


def _read(run: ConformanceRun, file: Path) -> list[TraceIteration]:
    normalizer = TraceNormalizer(run.project)
    return [normalizer.iteration(json.loads(line)) for line in file.read_text(encoding="utf-8").splitlines()]
