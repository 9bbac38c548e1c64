"""Conventions that linters do not check. Each failure lists all offenders and how to fix them."""

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

VAGUE_NAMES = {"base", "common", "core", "helper", "helpers", "manager", "misc", "util", "utils"}
MODULE_LINES = 400
FUNCTION_LINES = 50
NESTING = 4
POSITIONAL_PARAMETERS = 5
LARGEST_TEXT_BYTES = 2_000_000

# library -> the only package that may import it
PACKAGE_OF_LIBRARY = {
    "fastapi": "editor",
    "graphviz": "diagram",
    "jinja2": "templating",
    "nicegui": "editor",
    "lsprotocol": "xabsl",
    "markdown_it": "docsite",
    "pygls": "xabsl",
    "pygments": "docsite",
    "pygraphviz": "diagram",
    "pymunk": "simulated_robot",
    "regex": "model/text_search",
    "reportlab": "diagram",
    "resvg_py": "diagram",
    "send2trash": "editor",
    "ruff": "services/lint",
    "starlette": "editor",
    "watchfiles": "services/file_changes",
    "rosbags": "bica/ros_messages",
    "cyclonedds": "bica/ros_session",
    "yaml": "store",
    "zenoh": "bica/net_session",
}

# (pattern, fix, files to search); the brackets keep a pattern from matching itself.
FORBIDDEN_TEXT = (
    (r"\b(TO[D]O|FIX[M]E|XX[X])\b", "do it now, or write an issue", "code"),
    (r"\bNotImplemented[E]rror\b", "leave out what does not exist yet", "code"),
    (r"\bpytest\.(mark\.)?(xfail|importorski[p])\b", "run or delete the test", "code"),
    # A test may need a program of the system, and says how to install it.
    (
        r"\bpytest\.(mark\.)?(skip|skipi[f])\b(?!\($|.* is missing: )",
        "run or delete the test, or say which program is missing",
        "code",
    ),
    # What users may type instead of a key is quoted, or a misspelled line of a design.
    (
        r"(?i)(?<![\"\w])\w*(colou[r]|neighbou[r]|behaviou[r]|centr[e]\b|centr[e]d)(?!\"|: red)",
        "spell it the American way",
        "code",
    ),
    (r"\bnew Functio[n]\(", "pass data instead of code", "code"),
    (r"(?<![\w.])/(wor[k]|hom[e]|roo[t]|User[s])/", "use a relative path", "text"),
    (r"\b(pypi\.or[g]|pythonhosted\.or[g]|registry\.npmjs\.or[g]|jfrog\.i[o])", "do not name registry hosts", "text"),
)

# Calls that run text as code, and modules that need them.
RUNNING_CALLS = {"eval", "exec"}
RUNNING_ALLOWED = frozenset(
    {
        # The engine compiles behaviors to Python that it generates itself, with its own names.
        "vicode/xabsl/engine/engine.py",
    }
)

# Public class names that several modules define, and why.
REPEATED_CLASS_NAMES = {
    "Command": "an entry of the editor's command palette, and the declaration of a robot's command in vicode.bridge",
    "State": "the value in vicode.model, and the public runtime type of vicode.bica",
}

FunctionNode = ast.FunctionDef | ast.AsyncFunctionDef
NESTING_STATEMENTS = (
    ast.If,
    ast.For,
    ast.AsyncFor,
    ast.While,
    ast.With,
    ast.AsyncWith,
    ast.Try,
    ast.TryStar,
    ast.Match,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class FunctionDescription:
    """What the tests ask about a function."""

    place: str
    lines: int
    nesting: int
    positional: int


@dataclass(frozen=True, slots=True, kw_only=True)
class ModuleDescription:
    """What the tests ask about a module."""

    docstring: str
    functions: tuple[FunctionDescription, ...]
    public_classes: tuple[str, ...]
    libraries: frozenset[str]
    running_calls: tuple[str, ...]


def _list_files() -> tuple[str, ...]:
    """Return all tracked and untracked files that are not ignored, as POSIX paths relative to the root."""
    command = ["git", "-c", "safe.directory=*", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    listed = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    return tuple(sorted(path for path in set(listed.split("\0")) if path and (ROOT / path).is_file()))


FILES = _list_files()
PYTHON = tuple(path for path in FILES if path.endswith(".py") and path.startswith(("vicode/", "tests/", "benchmarks/")))
# Cases contain generated code for unusual designs.
PYTHON = tuple(path for path in PYTHON if "/cases/" not in path)
JAVASCRIPT = tuple(
    path for path in FILES if path.endswith((".js", ".mjs")) and path.startswith(("vicode/", "templates/", "tests/"))
)
PACKAGE = tuple(path for path in PYTHON if path.startswith("vicode/"))


def test_files_are_listed() -> None:
    assert "vicode/__init__.py" in PACKAGE
    assert "tests/architecture/test_code_rules.py" in PYTHON


def test_modules_are_short() -> None:
    sizes = {path: _read(path).count("\n") for path in (*PYTHON, *JAVASCRIPT)}
    offenders = [f"{path}: {size} lines" for path, size in sizes.items() if size > MODULE_LINES]
    _assert_none(offenders, f"split by purpose (at most {MODULE_LINES} lines)")


def test_module_names_are_specific() -> None:
    parts = {path: {part.lower() for part in Path(path).with_suffix("").parts} for path in (*PYTHON, *JAVASCRIPT)}
    offenders = [path for path, names in parts.items() if names & VAGUE_NAMES]
    _assert_none(offenders, "name the module after its content")


def test_modules_have_docstrings() -> None:
    offenders = [path for path in PYTHON if not 1 <= _first_paragraph_lines(path) <= 3]
    offenders += [path for path in JAVASCRIPT if not _read(path).lstrip().startswith(("//", "/*"))]
    _assert_none(
        offenders, "start with a docstring (JavaScript: a comment) whose first paragraph has one to three lines"
    )


def test_functions_are_short() -> None:
    offenders = [
        f"{each.place}: {each.lines} lines"
        for path in PYTHON
        for each in _describe_module(path).functions
        if each.lines > FUNCTION_LINES
    ]
    _assert_none(offenders, f"extract functions (at most {FUNCTION_LINES} lines)")


def test_functions_are_flat() -> None:
    offenders = [
        f"{each.place}: {each.nesting} levels"
        for path in PYTHON
        for each in _describe_module(path).functions
        if each.nesting > NESTING
    ]
    _assert_none(offenders, f"return early, or extract a function (at most {NESTING} levels)")


def test_functions_take_few_positional_parameters() -> None:
    offenders = [
        f"{each.place}: {each.positional} parameters"
        for path in PACKAGE
        for each in _describe_module(path).functions
        if each.positional > POSITIONAL_PARAMETERS
    ]
    _assert_none(offenders, f"make the others keyword-only (at most {POSITIONAL_PARAMETERS} positional)")


def test_public_class_names_are_unique() -> None:
    modules: dict[str, list[str]] = {}
    for path in PACKAGE:
        for name in _describe_module(path).public_classes:
            modules.setdefault(name, []).append(path)
    repeated = {name: paths for name, paths in modules.items() if len(paths) > 1}
    offenders = [f"{name}: {', '.join(paths)}" for name, paths in repeated.items() if name not in REPEATED_CLASS_NAMES]
    _assert_none(offenders, "rename all but one, for example with the subject as a prefix")
    _assert_none(sorted(REPEATED_CLASS_NAMES.keys() - repeated.keys()), "remove the exception: the name is unique")


@pytest.mark.parametrize(("pattern", "fix", "kind"), FORBIDDEN_TEXT, ids=[row[1] for row in FORBIDDEN_TEXT])
def test_no_forbidden_text(pattern: str, fix: str, kind: str) -> None:
    paths = (*PYTHON, *JAVASCRIPT) if kind == "code" else _text_files()
    expression = re.compile(pattern)
    offenders = [
        f"{path}:{number}: {line.strip()[:100]}"
        for path in paths
        for number, line in enumerate(_read(path).splitlines(), start=1)
        if expression.search(line)
    ]
    _assert_none(offenders, fix)


def test_no_text_is_run_as_code() -> None:
    offenders = [
        call for path in PACKAGE if path not in RUNNING_ALLOWED for call in _describe_module(path).running_calls
    ]
    offenders += [f"{path}: eval()" for path in JAVASCRIPT if re.search(r"(?<![\w.])eva[l]\(", _read(path))]
    _assert_none(offenders, "the editor never runs text from users")


def test_yaml_is_never_loaded_with_tags() -> None:
    unsafe = re.compile(r"yaml\.(unsafe_|full_)?loa[d](_all)?\(")
    _assert_none(
        [path for path in PYTHON if unsafe.search(_read(path))], "process events or nodes, or use yaml.safe_load"
    )


@pytest.mark.parametrize("library", sorted(PACKAGE_OF_LIBRARY))
def test_only_one_package_imports_a_library(library: str) -> None:
    package = PACKAGE_OF_LIBRARY[library]
    offenders = [
        f"{path} imports {library}"
        for path in PACKAGE
        if library in _describe_module(path).libraries
        and not path.startswith((f"vicode/{package}/", f"vicode/{package}.py"))
    ]
    _assert_none(offenders, f"only vicode/{package} may import {library}")


def test_the_runtime_has_no_dependencies() -> None:
    runtime = [path for path in PACKAGE if path.startswith("vicode/bica/")]
    foreign = {path: _describe_module(path).libraries - set(sys.stdlib_module_names) for path in runtime}
    # They are optional, and imported when a robot connects.
    foreign["vicode/bica/net_session.py"] -= {"zenoh"}
    foreign["vicode/bica/ros_messages.py"] -= {"rosbags"}
    foreign["vicode/bica/ros_session.py"] -= {"cyclonedds"}
    offenders = [f"{path} imports {', '.join(sorted(names))}" for path, names in foreign.items() if names]
    _assert_none(offenders, "vicode/bica is deployed alone: use only the standard library and relative imports")


def test_generators_do_not_import_each_other() -> None:
    offenders = []
    for path in PACKAGE:
        match = re.match(r"vicode/generators/(\w+)/", path)
        others = _generator_packages() - {match.group(1)} if match else set()
        offenders += [f"{path} imports {name}" for name in _imported_generators(path) & others]
    _assert_none(offenders, "move shared code into the plan")


def _assert_none(offenders: list[str], fix: str) -> None:
    assert not offenders, f"{fix}:\n  " + "\n  ".join(offenders)


def _read(path: str) -> str:
    return (ROOT / path).read_text(encoding="utf-8")


@cache
def _describe_module(path: str) -> ModuleDescription:
    """Parse a module once for all tests. Its tree is not kept: the trees of all modules take 100 MB."""
    module = ast.parse(_read(path), filename=path)
    nodes = list(ast.walk(module))
    imported = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    imported |= {node.module or "" for node in nodes if isinstance(node, ast.ImportFrom) and node.level == 0}
    classes = (node.name for node in module.body if isinstance(node, ast.ClassDef))
    calls = (node.func for node in nodes if isinstance(node, ast.Call) and isinstance(node.func, ast.Name))
    return ModuleDescription(
        docstring=ast.get_docstring(module) or "",
        functions=tuple(_describe_function(path, node) for node in nodes if isinstance(node, FunctionNode)),
        public_classes=tuple(name for name in classes if not name.startswith("_")),
        libraries=frozenset(name.split(".")[0] for name in imported),
        running_calls=tuple(f"{path}:{call.lineno}: {call.id}()" for call in calls if call.id in RUNNING_CALLS),
    )


def _text_files() -> tuple[str, ...]:
    return tuple(path for path in FILES if _is_text(ROOT / path))


def _is_text(path: Path) -> bool:
    return path.stat().st_size < LARGEST_TEXT_BYTES and _is_utf8(path.read_bytes())


def _is_utf8(content: bytes) -> bool:
    try:
        content.decode("utf-8")
    except UnicodeDecodeError:
        return False
    return b"\0" not in content


def _first_paragraph_lines(path: str) -> int:
    return len(_describe_module(path).docstring.split("\n\n")[0].splitlines())


def _describe_function(path: str, node: FunctionNode) -> FunctionDescription:
    return FunctionDescription(
        place=f"{path}:{node.lineno}: {node.name}",
        lines=(node.end_lineno or node.lineno) - node.lineno + 1,
        nesting=_measure_nesting(node.body),
        positional=_count_positional(node),
    )


def _count_positional(node: FunctionNode) -> int:
    names = [argument.arg for argument in (*node.args.posonlyargs, *node.args.args)]
    return len([name for name in names if name not in {"self", "cls"}])


def _measure_nesting(body: list[ast.stmt]) -> int:
    """Return the nesting depth of compound statements; `elif` adds no level."""
    return max((_measure_statement(statement) for statement in body), default=0)


def _measure_statement(statement: ast.stmt) -> int:
    if not isinstance(statement, NESTING_STATEMENTS):
        return 0
    depths = [1 + _measure_nesting(block) for block in _blocks(statement)]
    if isinstance(statement, ast.If):
        is_elif = len(statement.orelse) == 1 and isinstance(statement.orelse[0], ast.If)
        depths.append(_measure_nesting(statement.orelse) + (0 if is_elif else 1))
    return max(depths)


def _blocks(statement: ast.stmt) -> Iterator[list[ast.stmt]]:
    yield getattr(statement, "body", [])
    if not isinstance(statement, ast.If):
        yield getattr(statement, "orelse", [])
    yield getattr(statement, "finalbody", [])
    for part in (*getattr(statement, "handlers", []), *getattr(statement, "cases", [])):
        yield part.body


def _generator_packages() -> set[str]:
    folders = {match.group(1) for path in PACKAGE if (match := re.match(r"vicode/generators/(\w+)/", path))}
    return folders - {"plan"}


def _imported_generators(path: str) -> set[str]:
    found = re.findall(r"vicode\.generators(?:\.| import )(\w+)", _read(path))
    return set(found) | set(re.findall(r"from \.\.(\w+)", _read(path)))
