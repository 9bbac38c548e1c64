"""Reads the files of two ancestors: XML of VICODE with its C++ files, and `.bica` files of rqt.

VICODE keeps code in marked regions of `X.cpp` and `X.h` beside `X.xml`. A guard that returns one expression becomes a
condition; other code stays C++ text of the design. A `.bica` file has no guards: each becomes an input.
"""

import ast
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from textwrap import dedent

from vicode.findings import Finding
from vicode.importers import ImportNote
from vicode.importers.cpp.conditions import ALIAS, CppConditions, to_guard
from vicode.importers.cpp.tree import CppError, CppTree, compact, read_source
from vicode.importers.design_names import DesignNames
from vicode.importers.xml_reader import Element, SourceError, read_position, read_xml
from vicode.model.design import Call, Code, Design, Guard, RunCode, State, Transition, Use
from vicode.model.names import name_from_text, snake_case
from vicode.model.project import MISSING, Enumeration, Interface, Project

_MARK = re.compile(
    r"^[ \t]*//BUILDER COMMENT\. DO NOT REMOVE\. (?:(begin|end) (\w+)|(\w+) (begin|end))[ \t]*\r?$", re.MULTILINE
)
_RATE = re.compile(r"\bsetFreqTime\s*\(\s*(\w+)\s*\)")
_RATES_MS = {"SHORT_RATE": 50, "MEDIUM_RATE": 100, "LONG_RATE": 500}
_STOPWATCH = re.compile(r"\bgetStopWatch\s*\(\s*\)")
_INITIAL = "Initial"


@dataclass(slots=True, kw_only=True)
class BicaReader:
    """Collects the designs of files, with those of the components that they use.

    Attributes:
        files: The file of each design.
    """

    designs: list[Design] = field(default_factory=list)
    files: list[Path] = field(default_factory=list)
    notes: list[ImportNote] = field(default_factory=list)
    errors: list[Finding] = field(default_factory=list)
    _inputs: list[Interface] = field(default_factory=list)
    _types: dict[str, tuple[str, list[str]]] = field(default_factory=dict)
    _names: DesignNames = field(default_factory=DesignNames)
    _components: dict[str, str] = field(default_factory=dict)

    def read_file(self, path: Path) -> None:
        """Read a file, and those beside it that are named after the components that it uses.

        Raises:
            SourceError: It cannot be read.
            OSError: The same.
        """
        waiting = [path]
        while waiting:
            file = waiting.pop(0)
            if file in self.files:
                continue
            try:
                root = read_xml(file.read_bytes(), ("component",))
                design = _MachineReader(self, file, root).read()
            except SourceError as error:
                if file == path:
                    raise
                self.errors.append(error.finding(file))
                continue
            self.files.append(file)
            self.designs.append(design)
            names = [each.attributes.get("id", "") for each in root.find("dependenceComponent", "component")]
            waiting += (
                each for name in names if name and (each := file.parent / f"{Path(name).name}{file.suffix}").is_file()
            )

    def project(self, name: str) -> Project:
        designed = {each.component for each in self.designs}
        plain = (Interface(component=each) for each in self._components.values() if each not in designed)
        return Project(
            name=name,
            languages=("cpp",) if any(map(_has_code, self.designs)) else ("python", "cpp"),
            enumerations=tuple(
                Enumeration(name=each, elements=tuple((element, "") for element in elements))
                for each, elements in self._types.values()
            ),
            components=(*plain, *self._inputs),
            designs=tuple(self.designs),
        )

    def component(self, text: str) -> str:
        if text not in self._components:
            self._components[text] = self._names.allocate(name_from_text(text) or text)
        return self._components[text]

    def conditions(self, machine: str) -> CppConditions:
        component = self._names.allocate(f"{machine}Inputs")
        return CppConditions(machine=machine, component=component, names=self._names, types=self._types)

    def add_inputs(self, interface: Interface) -> None:
        self._inputs.append(interface)


class _MachineReader:
    def __init__(self, reader: BicaReader, file: Path, root: Element) -> None:
        self._reader, self._file, self._root = reader, file, root
        self._is_rqt = file.suffix == ".bica"
        self._regions: dict[str, tuple[Path, int, str]] = {}
        self._name = root.attributes.get("id") or file.stem
        self._component = reader.component(self._name)
        self._conditions = reader.conditions(self._component)
        names, aliases = DesignNames(), DesignNames(frozenset({ALIAS}))
        self._elements = {self._id(each, "state"): each for each in reversed([*root.find("state")])}
        self._elements = dict(reversed(self._elements.items()))
        self._states = {each: names.allocate(each) for each in self._elements}
        tag = "component" if self._is_rqt else "dependenceComponent"
        self._uses: dict[str, Use] = {}
        for each in root.find(tag):
            name = self._id(each, tag)
            use = Use(
                alias=aliases.allocate(snake_case(name)), component=reader.component(name), at=read_position(each)
            )
            self._uses.setdefault(name, use)

    def _note(self, line: int, text: str, file: Path | None = None) -> None:
        self._reader.notes.append(ImportNote(file=file or self._file, line=line, text=text))

    def _id(self, element: Element, what: str) -> str:
        name = element.attributes.get("id", "")
        if not name:
            raise SourceError("S805", f"a {what} has no id", element.line)
        return _INITIAL if name == "initial" and what == "state" and not self._is_rqt else name

    def read(self) -> Design:
        if not self._states:
            raise SourceError("S805", f"'{self._name}' has no states", self._root.line)
        for suffix in () if self._is_rqt else (".h", ".cpp"):
            self._read_regions(self._file.with_suffix(suffix))
        transitions = self._transitions()
        states = tuple(self._state(name, each, transitions.get(name, [])) for name, each in self._elements.items())
        initial = next((name for name, each in self._elements.items() if each.attributes.get("initial") == "true"), "")
        initial = initial or (_INITIAL if _INITIAL in self._states else next(iter(self._states)))
        interface = self._conditions.interface()
        uses = tuple(self._uses.values())
        if interface:
            uses = (Use(alias=ALIAS, component=interface.component), *uses)
            self._reader.add_inputs(replace(interface, implementation=MISSING))
        design = Design(component=self._component, uses=uses, initial=self._states[initial], states=states)
        return design if self._is_rqt else self._with_code(design)

    def _with_code(self, design: Design) -> Design:
        conf = next(self._root.find("conf"), None)
        is_restarting = conf is not None and conf.attributes.get("autorestart") == "1"
        if conf is not None and is_restarting:
            self._note(
                conf.line,
                "auto-restart: the design restarts after one iteration without a step, VICODE after ten periods",
            )
        texts = {name: self._code(name) for name in ("auxinclude.h", "auxinclude.cpp", "auxcode.h")}
        module = "\n".join(filter(None, (texts["auxinclude.h"], texts["auxinclude.cpp"])))
        for name in ("auxclass.h", "auxcode.cpp"):
            if self._code(name):
                file, line, _text = self._regions[name]
                self._note(line, f"not in the design: the region {name.partition('.')[0]}", file)
        rate = _RATE.search("".join(text for _file, _line, text in self._regions.values()))
        period = (
            _RATES_MS.get(rate[1]) or (int(rate[1]) if rate[1].isdecimal() and len(rate[1]) < 7 else 0) if rate else 0
        )
        return replace(
            design,
            frequency_hz=1000 / period if period else None,
            resume=not is_restarting,
            time_unit="ms",
            module=_cpp(module),
            members=_cpp(texts["auxcode.h"]),
        )

    def _read_regions(self, path: Path) -> None:
        """Read the marked regions of a file by name; those with the same name in both files get its suffix."""
        if not path.is_file():
            self._note(1, f"{path.name} is not found: its code is left out")
            return
        text = path.read_bytes().decode("utf-8", errors="replace")
        opened: dict[str, int] = {}
        for found in _MARK.finditer(text):
            name = found[2] or f"{found[3]}{path.suffix}"
            line = text.count("\n", 0, found.start()) + 1
            if (found[1] or found[4]) == "begin":
                opened[name] = found.end()
            elif name in opened:
                line = text.count("\n", 0, opened[name]) + 1
                code = text[opened.pop(name) : found.start()].replace("\r", "").strip("\n")
                self._regions[name] = (path, line, code.expandtabs(4) if code.strip() else "")
            else:
                self._note(line, f"the region '{name}' has no begin: its code is left out", path)
        for name, start in opened.items():
            self._note(text.count("\n", 0, start) + 1, f"the region '{name}' has no end: its code is left out", path)

    def _code(self, name: str) -> str:
        return dedent(self._regions[name][2]).strip() if name in self._regions else ""

    def _state(self, name: str, element: Element, transitions: Sequence[Transition]) -> State:
        code = self._code(f"{name}_state_code")
        return State(
            name=self._states[name],
            at=read_position(element),
            requires=tuple(self._used(element, "requirement", "activation")),
            modulates=tuple(Call(alias=each) for each in self._used(element, "modulation")),
            actions=(RunCode(code=_cpp(code)),) if code else (),
            transitions=tuple(transitions),
        )

    def _used(self, element: Element, *tags: str) -> Iterator[str]:
        names = dict.fromkeys((each.attributes.get("id", ""), each.line) for each in element.find(*tags))
        for name, line in names:
            if name in self._uses:
                yield self._uses[name].alias
            else:
                self._note(line, f"'{name}' is no component of '{self._name}': it is left out")

    def _transitions(self) -> dict[str, list[Transition]]:
        """The transitions by source, in the order of their priorities."""
        ends = ("src", "dst") if self._is_rqt else ("source", "target")
        found = dict[str, list[Element]]()
        for each in self._root.find("transition"):
            source, target = (each.attributes.get(end, "") for end in ends)
            if source in self._states and target in self._states:
                found.setdefault(source, []).append(each)
            else:
                unknown = source if source not in self._states else target
                self._note(each.line, f"a transition has no state '{unknown}': it is left out")
        result = dict[str, list[Transition]]()
        for source, elements in found.items():
            is_timed = any(each.attributes.get("timer") == "true" for each in elements)
            ordered = sorted(elements, key=_priority)
            result[source] = [
                Transition(to=self._states[each.attributes[ends[1]]], guard=self._guard(each, source, is_timed))
                for each in ordered
            ]
        return result

    def _guard(self, element: Element, source: str, is_timed: bool) -> Guard:
        name = element.attributes.get("id", "") or f"{source}_2_{element.attributes.get('dst', '')}"
        code = self._code(f"{name}_transition_code")
        if not code:
            if not self._is_rqt:
                self._note(element.line, f"the guard of '{name}' has no code: it is an input")
            return to_guard(self._conditions.flag(name))
        tested = _STOPWATCH.sub("state_time", code) if is_timed else code
        condition = self._condition(tested)
        if condition is not None:
            return Guard() if ast.unparse(condition) == "True" else to_guard(condition)
        file, line, _text = self._regions[f"{name}_transition_code"]
        self._note(line, f"the guard of '{name}' stays C++ code", file)
        return Guard(code=_cpp(_STOPWATCH.sub("state_time()", code) if is_timed else code))

    def _condition(self, code: str) -> ast.expr | None:
        """The condition of a guard that is `return X;` or `if(X) return true; return false;`, None for others."""
        try:
            nodes = read_source(self._file, code).nodes
            test = _tested(nodes)
            return self._conditions.read(test) if test else None
        except (CppError, RecursionError):
            return None


def _tested(nodes: Sequence[CppTree]) -> Sequence[CppTree]:
    """The expression that a function returns, empty if there is more in it."""
    texts = [each.text for each in nodes]
    if len(nodes) > 2 and texts[0] == "return" and ";" in texts and texts.index(";") == len(nodes) - 1:
        return nodes[1:-1]
    if len(nodes) > 2 and texts[:2] == ["if", "("]:
        rest = re.sub(r"[{}\s]|else", "", compact(nodes[2:]))
        return nodes[1].children if rest == "returntrue;returnfalse;" else ()
    return ()


def _priority(element: Element) -> int:
    text = element.attributes.get("priority", "")
    return int(text) if text.isdecimal() and len(text) < 10 else 0


def _has_code(design: Design) -> bool:
    guards = (each.guard for state in design.states for each in state.transitions if isinstance(each, Transition))
    texts = (design.module.texts, design.members.texts, *(state.actions for state in design.states))
    return any(texts) or any(guard.code for guard in guards)


def _cpp(text: str) -> Code:
    return Code(texts=(("cpp", text),)) if text else Code()
