"""Reads behaviors of FlexBE, which are Python, without running them."""

import ast
import re
import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from vicode.findings import Finding
from vicode.importers.notes import ImportNote
from vicode.importers.outcomes import OutcomeMachine, OutcomeState, OutcomeTransition
from vicode.importers.xml_reader import SourceError
from vicode.model.design import Point

_MACHINES = ("OperatableStateMachine", "PriorityContainer")
_CONTAINERS = (*_MACHINES, "ConcurrencyContainer")
_POSITION = re.compile(r"x:(-?\d+) y:(-?\d+)")
_MANUAL = re.compile(r"# \[(MANUAL_(?!IMPORT)\w+)\][^\n]*\n(.*?)# \[/\1\]", re.DOTALL)
_MAX_SHOWN = 60


def contains_behavior(text: str) -> bool:
    """Whether a Python file may declare a behavior."""
    return "OperatableStateMachine" in text and re.search(r"^class \w+\(.*\bBehavior\)", text, re.MULTILINE) is not None


class FlexbeReader:
    """Collects the machines of files.

    Args:
        find: Returns a file that another file names, by its name and the file.
    """

    def __init__(self, find: Callable[[str, Path], Path | None]) -> None:
        self.machines: dict[str, OutcomeMachine | None] = {}
        self.notes: list[ImportNote] = []
        self.errors: list[Finding] = []
        self._find = find

    def read_file(self, path: Path) -> str:
        """Read a file, with the behaviors that it uses, and return the key of its machine.

        Raises:
            SourceError: It cannot be read.
            OSError: The same.
        """
        key = str(path)
        if key not in self.machines:
            self.machines[key] = None
            try:
                _BehaviorReader(self, path, path.read_bytes().decode("utf-8", errors="replace")).read(key)
            except (SourceError, OSError):
                del self.machines[key]
                raise
        return key

    def read_module(self, module: str, user: Path) -> str:
        """The key of the behavior in a module that a file uses, "" if it cannot be read."""
        found = self._find(f"{module.rpartition('.')[2]}.py", user)
        try:
            return self.read_file(found) if found else ""
        except SourceError as error:
            self.errors.append(error.finding(found or user))
            return ""


@dataclass(slots=True, kw_only=True)
class _Container:
    kind: str
    outcomes: tuple[str, ...]
    line: int
    states: list[OutcomeState] = field(default_factory=list)


class _BehaviorReader:
    def __init__(self, reader: FlexbeReader, path: Path, text: str) -> None:
        self._reader, self._path, self._text = reader, path, text
        self._lines = text.splitlines()
        self._containers: dict[str, _Container] = {}
        self._modules: dict[str, str] = {}

    def _note(self, line: int, text: str) -> None:
        self._reader.notes.append(ImportNote(file=self._path, line=line, text=text))

    def read(self, key: str) -> None:
        tree = _parse(self._text)
        for node in tree.body:
            if isinstance(node, ast.ImportFrom):
                self._modules |= {each.asname or each.name: node.module or "" for each in node.names}
        for node in tree.body:
            create = next((each for each in ast.iter_child_nodes(node) if _is_create(each)), None)
            if isinstance(node, ast.ClassDef) and isinstance(create, ast.FunctionDef):
                break
        else:
            raise SourceError("S805", "no behavior of FlexBE: no class with a method 'create'", 1)
        self._note_left_out(node)
        for statement in create.body:
            self._statement(statement)
        result = next((each.value for each in create.body if isinstance(each, ast.Return)), None)
        root = self._containers.get(result.id) if isinstance(result, ast.Name) else None
        if root is None or not root.states:
            raise SourceError("S805", "no state machine that 'create' returns, or it has no states", create.lineno)
        doc = ast.get_docstring(node) or ""
        for name, each in self._containers.items():
            own = key if each is root else f"{key}:{name}"
            if each.kind in _MACHINES and each.states:
                title = (
                    node.name.removesuffix("SM") if each is root else name.removeprefix("_sm_").rstrip("_0123456789")
                )
                self._reader.machines[own] = self._machine(each, title, doc if each is root else "")

    def _machine(self, container: _Container, name: str, doc: str) -> OutcomeMachine:
        ends = dict(zip(container.outcomes, self._positions(container.line), strict=False))
        return OutcomeMachine(
            name=name,
            place=(self._path, container.line),
            outcomes=container.outcomes,
            start=container.states[0].name,
            states=tuple(container.states),
            doc=doc,
            ends=ends,
        )

    def _note_left_out(self, behavior: ast.ClassDef) -> None:
        for node in ast.walk(behavior):
            if (
                isinstance(node, ast.Call)
                and isinstance(node.func, ast.Attribute)
                and node.func.attr == "add_parameter"
            ):
                self._note(node.lineno, f"not in the design: {_shown(node)}")
        for found in _MANUAL.finditer(self._text):
            if found[2].strip():
                self._note(self._text.count("\n", 0, found.start()) + 1, f"not in the design: the code in [{found[1]}]")

    def _statement(self, node: ast.stmt) -> None:
        match node:
            case ast.Assign([ast.Name(name)], ast.Call(ast.Name(kind)) as call) if kind in _CONTAINERS:
                outcomes = _literal(_argument(call, 0, "outcomes"))
                if not isinstance(outcomes, list) or not all(isinstance(each, str) and each for each in outcomes):
                    raise SourceError("S805", f"the outcomes of '{name}' are no list of texts", node.lineno)
                container = _Container(kind=kind, outcomes=tuple(dict.fromkeys(outcomes)), line=node.lineno)
                self._containers[name] = container
                if kind == "PriorityContainer":
                    self._note(node.lineno, f"the priority of '{name}' is left out")
            case ast.With([ast.withitem(ast.Name(name))]) if name in self._containers:
                for each in node.body:
                    self._add(self._containers[name], each)
            case ast.Return() | ast.Expr(ast.Constant()) | ast.Pass():
                pass
            case _:
                self._note(node.lineno, f"not in the design: {_shown(node)}")

    def _add(self, container: _Container, node: ast.stmt) -> None:
        match node:
            case ast.Expr(ast.Call(ast.Attribute(ast.Name(kind), "add")) as call) if kind in _CONTAINERS:
                name, work = _literal(_argument(call, 0, "label")), _argument(call, 1, "state")
                if not isinstance(name, str) or not name or work is None:
                    raise SourceError("S805", "a state needs a text as its name, and what it runs", node.lineno)
                container.states.append(self._state(call, name, work))
            case ast.Pass():
                pass
            case _:
                self._note(node.lineno, f"not in the design: {_shown(node)}")

    def _state(self, call: ast.Call, name: str, work: ast.expr) -> OutcomeState:
        remapping = _argument(call, 4, "remapping")
        texts = [_shown(work, 1000)] if not isinstance(work, ast.Name) else []
        texts += [f"remapping: {_shown(remapping, 1000)}"] if remapping is not None else []
        position = self._positions(call.lineno)
        return OutcomeState(
            name=name,
            place=(self._path, call.lineno),
            transitions=tuple(self._transitions(call)),
            machine=self._machine_of(work, name),
            doc="\n".join(texts),
            at=position[0] if position else None,
        )

    def _machine_of(self, work: ast.expr, name: str) -> str:
        """The key of the machine that a state runs, "" for a component that is to be written."""
        match work:
            case ast.Name(variable) if variable in self._containers:
                if self._containers[variable].kind in _MACHINES:
                    return f"{self._path}:{variable}"
                text = f"what '{name}' runs in parallel is left out: it is one component to be written"
                self._note(self._containers[variable].line, text)
            case ast.Call(ast.Attribute(ast.Name("self"), "use_behavior"), [ast.Name(behavior), *_]):
                found = self._reader.read_module(self._modules.get(behavior, ""), self._path)
                if not found:
                    text = f"the file of {behavior} is not found: '{name}' is one component to be written"
                    self._note(work.lineno, text)
                return found
            case ast.Call():
                pass
            case _:
                self._note(work.lineno, f"what '{name}' runs is not understood: {_shown(work)}")
        return ""

    def _transitions(self, call: ast.Call) -> Iterator[OutcomeTransition]:
        levels = {outcome: ast.unparse(level) for outcome, level in self._items(_argument(call, 3, "autonomy"))}
        for outcome, target in self._items(_argument(call, 2, "transitions")):
            to = _literal(target)
            if not isinstance(to, str):
                self._note(target.lineno, f"the target of '{outcome}' is not understood: {_shown(target)}")
                continue
            level = levels.get(outcome, "").rpartition(".")[2]
            doc = "" if level in ("", "Off", "Inherit") else f"Autonomy level: {level}."
            yield OutcomeTransition(outcome=outcome, to=to, place=(self._path, target.lineno), doc=doc)

    def _items(self, node: ast.expr | None) -> Iterator[tuple[str, ast.expr]]:
        pairs: Mapping[str, ast.expr] = {}
        if isinstance(node, ast.Dict):
            keys = [_literal(key) for key in node.keys]
            pairs = {key: value for key, value in zip(keys, node.values, strict=True) if isinstance(key, str) and key}
        if node is not None and (not isinstance(node, ast.Dict) or len(pairs) < len(node.keys)):
            self._note(node.lineno, f"not understood: {_shown(node)}")
        yield from pairs.items()

    def _positions(self, line: int) -> list[Point]:
        """The positions in the comment above a line."""
        above = self._lines[line - 2].strip() if 2 <= line <= len(self._lines) + 1 else ""
        found = _POSITION.findall(above) if above.startswith("#") else ()
        return [(int(x), int(y)) for x, y in found if len(x) < 7 and len(y) < 7]


def _parse(text: str) -> ast.Module:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return ast.parse(text)
    except SyntaxError as error:
        raise SourceError("S805", f"no Python 3: {error.msg}", error.lineno or 1) from error
    except (ValueError, RecursionError, MemoryError) as error:
        raise SourceError("S805", f"no Python 3: {error}", 1) from error


def _is_create(node: ast.AST) -> bool:
    return isinstance(node, ast.FunctionDef) and node.name == "create"


def _argument(call: ast.Call, index: int, name: str) -> ast.expr | None:
    named = next((each.value for each in call.keywords if each.arg == name), None)
    return call.args[index] if index < len(call.args) else named


def _literal(node: ast.expr | None) -> object:
    """The value of a literal; None for other expressions."""
    try:
        return ast.literal_eval(node) if node is not None else None
    except (ValueError, TypeError, SyntaxError, RecursionError, MemoryError):
        return None


def _shown(node: ast.AST, length: int = _MAX_SHOWN) -> str:
    text = " ".join(ast.unparse(node).split())
    return text if len(text) <= length else f"{text[:length]} …"
