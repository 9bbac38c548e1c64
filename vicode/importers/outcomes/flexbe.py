"""Reads behaviors of FlexBE, which are Python, without running them."""

import ast
import re
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from vicode.importers.outcomes import OutcomeMachine, OutcomeState, OutcomeTransition
from vicode.importers.sources import SourceError, Sources
from vicode.model.design import Point

_MACHINE = "OperatableStateMachine"
_CONTAINERS = (_MACHINE, "PriorityContainer", "ConcurrencyContainer")
_POSITION = re.compile(r"x:(-?\d{1,6}) y:(-?\d{1,6})")
_MANUAL = re.compile(r"# \[(MANUAL_(?!IMPORT)\w+)\][^\n]*\n(.*?)# \[/\1\]", re.DOTALL)
_MAX_SHOWN = 60


def contains_behavior(text: str) -> bool:
    """Whether a Python file may declare a behavior."""
    return _MACHINE in text and re.search(r"^class \w+\(.*\bBehavior\)", text, re.MULTILINE) is not None


class FlexbeReader:
    """Collects the machines of files by key."""

    def __init__(self, sources: Sources) -> None:
        self.machines: dict[str, OutcomeMachine] = {}
        self.sources = sources

    def read(self, path: Path, data: bytes) -> None:
        """Read a file, and the behaviors that it uses.

        Raises:
            SourceError: It cannot be read.
        """
        self.machines |= _BehaviorReader(self, path, data.decode("utf-8", errors="replace")).read()


@dataclass(slots=True, kw_only=True)
class _Container:
    kind: str
    outcomes: tuple[str, ...]
    line: int
    states: list[OutcomeState] = field(default_factory=list)


class _BehaviorReader:
    def __init__(self, reader: FlexbeReader, path: Path, text: str) -> None:
        self._reader, self._path, self._text, self._lines = reader, path, text, text.split("\n")
        self._containers: dict[str, _Container] = {}
        self._modules: dict[str, str] = {}

    def _note(self, node: ast.AST, text: str = "") -> None:
        line = getattr(node, "lineno", 1)
        self._reader.sources.note(self._path, line, text or f"not in the design: {_shown(node, _MAX_SHOWN)}")

    def read(self) -> Iterator[tuple[str, OutcomeMachine]]:
        tree = _parse(self._text)
        imports = [node for node in tree.body if isinstance(node, ast.ImportFrom)]
        self._modules = {each.asname or each.name: node.module or "" for node in imports for each in node.names}
        classes = [node for node in tree.body if isinstance(node, ast.ClassDef)]
        found = [(node, each) for node in classes for each in node.body if isinstance(each, ast.FunctionDef)]
        behavior, create = next((pair for pair in found if pair[1].name == "create"), (None, None))
        if behavior is None or create is None:
            raise SourceError("S805", "no behavior of FlexBE: no class with a method 'create'", 1)
        self._note_left_out(behavior)
        root = ""
        for statement in create.body:
            root = self._statement(statement) or root
        if root not in self._containers or not self._containers[root].states:
            raise SourceError("S805", "'create' returns no state machine with states", create.lineno)
        yield str(self._path), self._machine(root, behavior.name.removesuffix("SM"), ast.get_docstring(behavior) or "")
        for name, each in self._containers.items():
            if each.kind == _MACHINE and each.states and name != root:
                yield f"{self._path}:{name}", self._machine(name, name.removeprefix("_sm_").rstrip("_0123456789"), "")

    def _note_left_out(self, behavior: ast.ClassDef) -> None:
        for node in ast.walk(behavior):
            if isinstance(node, ast.Call) and getattr(node.func, "attr", "") == "add_parameter":
                self._note(node)
        for manual in _MANUAL.finditer(self._text):
            if manual[2].strip():
                line = self._text.count("\n", 0, manual.start()) + 1
                self._reader.sources.note(self._path, line, f"not in the design: the code in [{manual[1]}]")

    def _machine(self, variable: str, name: str, doc: str) -> OutcomeMachine:
        container = self._containers[variable]
        return OutcomeMachine(
            name=name,
            place=(self._path, container.line),
            outcomes=container.outcomes,
            start=container.states[0].name,
            states=tuple(container.states),
            doc=doc,
            ends=dict(zip(container.outcomes, self._positions(container.line), strict=False)),
        )

    def _statement(self, node: ast.stmt) -> str:
        """Read a statement of 'create'; return the name of the variable that it returns."""
        match node:
            case ast.Assign([ast.Name(name)], ast.Call(ast.Name(kind)) as call) if kind in _CONTAINERS:
                outcomes = _literal(_argument(call, 0, "outcomes"))
                if not isinstance(outcomes, list) or not all(isinstance(each, str) and each for each in outcomes):
                    raise SourceError("S805", f"the outcomes of '{name}' are no list of texts", node.lineno)
                outcomes = tuple(dict.fromkeys(outcomes))
                self._containers[name] = _Container(kind=kind, outcomes=outcomes, line=node.lineno)
            case ast.With([ast.withitem(ast.Name(name))]) if name in self._containers:
                self._containers[name].states += (state for each in node.body for state in self._add(each))
            case ast.Return(ast.Name(name)):
                return name
            case _:
                self._note(node)
        return ""

    def _add(self, node: ast.stmt) -> Iterator[OutcomeState]:
        match node:
            case ast.Expr(ast.Call(ast.Attribute(ast.Name(kind), "add")) as call) if kind in _CONTAINERS:
                name, work = _literal(_argument(call, 0, "label")), _argument(call, 1, "state")
                if not isinstance(name, str) or not name or work is None:
                    raise SourceError("S805", "a state needs a text as its name, and what it runs", node.lineno)
                remapping = _argument(call, 4, "remapping")
                yield OutcomeState(
                    name=name,
                    place=(self._path, call.lineno),
                    transitions=tuple(self._transitions(call)),
                    machine=self._machine_of(work, name),
                    doc=_shown(work) + (f"\nremapping: {_shown(remapping)}" if remapping else ""),
                    at=next(iter(self._positions(call.lineno)), None),
                )
            case _:
                self._note(node)

    def _machine_of(self, work: ast.expr, name: str) -> str:
        """The key of the machine that a state runs, "" for a component that is to be written."""
        match work:
            case ast.Name(variable) if variable in self._containers:
                if self._containers[variable].kind == _MACHINE:
                    return f"{self._path}:{variable}"
                self._note(work, f"what '{name}' runs in parallel is left out: it is one component to be written")
            case ast.Call(ast.Attribute(ast.Name("self"), "use_behavior"), [ast.Name(behavior), *_]):
                module = self._modules.get(behavior, "").rpartition(".")[2]
                found = self._reader.sources.find(f"{module}.py", self._path, work.lineno)
                if found:
                    return self._reader.sources.load(found, self._reader.read)
                self._note(work, f"the file of {behavior} is not found: '{name}' is one component to be written")
            case ast.Call():
                pass
            case _:
                self._note(work)
        return ""

    def _transitions(self, call: ast.Call) -> Iterator[OutcomeTransition]:
        levels = {outcome: _shown(level).rpartition(".")[2] for outcome, level in self._items(call, 3, "autonomy")}
        for outcome, target in self._items(call, 2, "transitions"):
            to, level = _literal(target), levels.get(outcome, "Off")
            if isinstance(to, str):
                doc = "" if level in ("Off", "Inherit") else f"Autonomy level: {level}."
                yield OutcomeTransition(outcome=outcome, to=to, place=(self._path, target.lineno), doc=doc)
            else:
                self._note(target)

    def _items(self, call: ast.Call, index: int, name: str) -> Iterator[tuple[str, ast.expr]]:
        node, items = _argument(call, index, name), dict[str, ast.expr]()
        for key, value in zip(node.keys, node.values, strict=True) if isinstance(node, ast.Dict) else ():
            outcome = _literal(key)
            if not isinstance(outcome, str) or not outcome:
                self._note(value)
                continue
            if outcome in items:
                # Python keeps the last one.
                text = f"'{outcome}' follows again in '{name}': {_shown(items[outcome])} is left out"
                self._note(items[outcome], text)
            items[outcome] = value
        yield from items.items()
        if node is not None and not isinstance(node, ast.Dict):
            self._note(node)

    def _positions(self, line: int) -> list[Point]:
        """The positions in the comment above a line."""
        above = self._lines[line - 2].strip() if line > 1 else ""
        return [(int(x), int(y)) for x, y in _POSITION.findall(above)] if above.startswith("#") else []


def _parse(text: str) -> ast.Module:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return ast.parse(text)
    except (SyntaxError, ValueError) as error:
        line = error.lineno if isinstance(error, SyntaxError) and error.lineno else 1
        raise SourceError("S805", f"no Python 3: {getattr(error, 'msg', error)}", line) from error


def _argument(call: ast.Call, index: int, name: str) -> ast.expr | None:
    named = next((each.value for each in call.keywords if each.arg == name), None)
    return call.args[index] if index < len(call.args) else named


def _literal(node: ast.expr | None) -> object:
    """The value of a literal; None for other expressions."""
    try:
        return ast.literal_eval(node) if node is not None else None
    except (ValueError, TypeError, SyntaxError, RecursionError, MemoryError):
        return None


def _shown(node: ast.AST, length: int = 1000) -> str:
    text = " ".join(ast.unparse(node).split())
    return text if len(text) <= length else f"{text[:length]} …"
