"""Reads the files of two ancestors: XML of VICODE with its C++ files, and `.bica` files of rqt.

VICODE keeps code in marked regions of `X.cpp` and `X.h` beside `X.xml`. A guard that returns one expression becomes a
condition; other code stays C++ text of the design. A `.bica` file has no guards: each becomes an input.
"""

import ast
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from textwrap import dedent

from vicode.importers.cpp.conditions import ALIAS, CppConditions, to_guard
from vicode.importers.cpp.tree import CppError, CppTree, compact, read_source
from vicode.importers.design_names import DesignNames
from vicode.importers.sources import SourceError, Sources
from vicode.importers.xml_reader import Element, read_position, read_xml
from vicode.languages import LANGUAGES
from vicode.model.design import Call, Code, Design, Guard, RunCode, State, Transition, Use
from vicode.model.names import name_from_text, snake_case
from vicode.model.project import MISSING, Enumeration, Interface, Project

_MARK = re.compile(
    r"^[ \t]*//BUILDER COMMENT\. DO NOT REMOVE\. (?:(begin|end) (\w+)|(\w+) (begin|end))\s*$", re.MULTILINE
)
_RATE = re.compile(r"\bsetFreqTime\s*\(\s*(\w+)\s*\)")
_RATES_MS = {"SHORT_RATE": 50, "MEDIUM_RATE": 100, "LONG_RATE": 500}
_STOPWATCH = re.compile(r"\bgetStopWatch\s*\(\s*\)")
_INITIAL = "Initial"
# Names of regions of code, which follow from those of states, and positions of labels.
_KNOWN = ("code", "x", "y", "autorestart")
_KEYWORDS = LANGUAGES["cpp"].keywords


class BicaReader:
    """Collects the designs of files, each with its file."""

    def __init__(self, sources: Sources) -> None:
        self.sources = sources
        self.designs: list[tuple[Design, Path]] = []
        self.inputs: list[Interface] = []
        self._types: dict[str, tuple[str, list[str]]] = {}
        self._names = DesignNames(keywords=_KEYWORDS)
        self._components: dict[str, str] = {}

    def read(self, path: Path, data: bytes) -> None:
        """Read a file, and those beside it that are named after the components that it uses.

        Raises:
            SourceError: It cannot be read.
        """
        root = read_xml(data, ("component",))
        design = _MachineReader(self, path, root).read()
        if any(each.component == design.component for each, _path in self.designs):
            raise SourceError("S805", f"another file declares '{design.component}'", root.line)
        self.designs.append((design, path))
        for each in root.find("dependenceComponent", "component"):
            found = self.sources.find(f"{each.get('id')}{path.suffix}", path, each.line)
            if found is not None:
                self.sources.load(found, self.read)
        for line, text in root.unread(_KNOWN):
            self.sources.note(path, line, text)

    def project(self, name: str) -> Project:
        designs = {design.component: design for design, _path in self.designs}
        plain = (Interface(component=each) for each in self._components.values() if each not in designs)
        enumerations = (
            Enumeration(name=each, elements=tuple((element, "") for element in elements))
            for each, elements in self._types.values()
        )
        return Project(
            name=name,
            languages=("cpp",) if any(map(_has_code, designs.values())) else ("python", "cpp"),
            enumerations=tuple(enumerations),
            components=(*plain, *self.inputs),
            designs=tuple(designs.values()),
        )

    def component(self, text: str) -> str:
        if text not in self._components:
            self._components[text] = self._names.allocate(name_from_text(text) or text)
        return self._components[text]

    def conditions(self, machine: str) -> CppConditions:
        component = self._names.allocate(f"{machine}Inputs")
        return CppConditions(machine=machine, component=component, names=self._names, types=self._types)


class _MachineReader:
    def __init__(self, reader: BicaReader, file: Path, root: Element) -> None:
        self._reader, self._file, self._root = reader, file, root
        self._is_rqt = file.suffix == ".bica"
        # By name: the file, the line and the text.
        self._regions: dict[str, tuple[Path, int, str]] = {}
        self._component = reader.component(root.get("id") or file.stem)
        self._conditions = reader.conditions(self._component)
        names, aliases = DesignNames(keywords=_KEYWORDS), DesignNames(frozenset({ALIAS}), _KEYWORDS)
        self._elements: dict[str, Element] = {}
        for each in root.find("state"):
            name = _INITIAL if _id(each) == "initial" and not self._is_rqt else _id(each)
            if self._elements.setdefault(name, each) is not each:
                self._note(each.line, f"another state has the id '{name}': it is left out")
        if not self._elements:
            raise SourceError("S805", f"'{self._component}' has no states", root.line)
        self._states = {each: names.allocate(each) for each in self._elements}
        self._uses: dict[str, Use] = {}
        for each in root.find("component" if self._is_rqt else "dependenceComponent"):
            use = Use(alias=aliases.allocate(snake_case(_id(each))), component=reader.component(_id(each)))
            self._uses.setdefault(_id(each), replace(use, at=read_position(each)))

    def _note(self, line: int, text: str, file: Path | None = None) -> None:
        self._reader.sources.note(file or self._file, line, text)

    def read(self) -> Design:
        for suffix in () if self._is_rqt else (".h", ".cpp"):
            self._read_regions(self._file.with_suffix(suffix))
        transitions = self._transitions()
        states = tuple(self._state(name, each, transitions.get(name, ())) for name, each in self._elements.items())
        marked = [name for name, each in self._elements.items() if each.get("initial") == "true"]
        for each in marked[1:]:
            self._note(self._elements[each].line, f"'{each}' is another initial state: '{marked[0]}' is the first one")
        initial = next((each for each in (*marked, _INITIAL) if each in self._states), next(iter(self._states)))
        uses, interface = tuple(self._uses.values()), self._conditions.interface()
        if interface:
            uses = (Use(alias=ALIAS, component=interface.component), *uses)
            self._reader.inputs.append(replace(interface, implementation=MISSING))
        design = Design(component=self._component, uses=uses, initial=self._states[initial], states=states)
        return design if self._is_rqt else self._with_code(design)

    def _with_code(self, design: Design) -> Design:
        conf = next((each for each in self._root.find("conf") if each.get("autorestart") == "1"), None)
        if conf is not None:
            self._note(
                conf.line,
                "auto-restart: the design restarts after an iteration without a step, VICODE after ten periods",
            )
        for name in ("auxclass.h", "auxcode.cpp"):
            if self._code(name):
                file, line, _text = self._regions[name]
                self._note(line, f"not in the design: the region {name.partition('.')[0]}", file)
        rate = _RATE.search("".join(text for _file, _line, text in self._regions.values()))
        word = rate[1] if rate else ""
        period = _RATES_MS.get(word) or (int(word) if word.isdecimal() and len(word) < 7 else 0)
        return replace(
            design,
            frequency_hz=1000 / period if period else None,
            resume=conf is None,
            time_unit="ms",
            module=_cpp("\n".join(filter(None, map(self._code, ("auxinclude.h", "auxinclude.cpp"))))),
            members=_cpp(self._code("auxcode.h")),
        )

    def _read_regions(self, path: Path) -> None:
        """Read the marked regions of a file by name; those that both files have get its suffix."""
        if not path.is_file() or not self._reader.sources.contains(path):
            self._note(1, f"{path.name} is not found: its code is left out")
            return
        text = path.read_bytes().decode("utf-8", errors="replace").replace("\r\n", "\n")
        opened: dict[str, int] = {}
        for found in _MARK.finditer(text):
            name = found[2] or f"{found[3]}{path.suffix}"
            if (found[1] or found[4]) == "begin":
                opened[name] = found.end()
            elif name in opened:
                start = opened.pop(name)
                code = dedent(text[start : found.start()].expandtabs(4)).strip()
                self._regions[name] = (path, text.count("\n", 0, start) + 1, code)
            else:
                line = text.count("\n", 0, found.start()) + 1
                self._note(line, f"the region '{name}' has no begin: its code is left out", path)
        for name, start in opened.items():
            self._note(text.count("\n", 0, start) + 1, f"the region '{name}' has no end: its code is left out", path)

    def _code(self, name: str) -> str:
        return self._regions[name][2] if name in self._regions else ""

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
        for name, line in {_id(each): each.line for each in element.find(*tags)}.items():
            if name in self._uses:
                yield self._uses[name].alias
            else:
                self._note(line, f"'{name}' is no component of '{self._component}': it is left out")

    def _transitions(self) -> dict[str, list[Transition]]:
        """The transitions by source, in the order of their priorities."""
        ends = ("src", "dst") if self._is_rqt else ("source", "target")
        result, timed = dict[str, list[Transition]](), set[str]()
        elements = sorted(self._root.find("transition"), key=_priority)
        for each in elements:
            timed |= {each.get(ends[0], "")} if each.get("timer") == "true" else set()
        for each in elements:
            source, target = (each.get(end, "") for end in ends)
            name = f"{source}_2_{target}" if self._is_rqt else each.get("id", "")
            for unknown in {source, target} - self._states.keys():
                self._note(each.line, f"'{unknown}' is no state: the transition '{name}' is left out")
            if {source, target} <= self._states.keys():
                guard = self._guard(each, name, source in timed)
                result.setdefault(source, []).append(Transition(to=self._states[target], guard=guard))
        return result

    def _guard(self, element: Element, name: str, is_timed: bool) -> Guard:
        region = f"{name}_transition_code"
        code = self._code(region)
        if not code:
            if not self._is_rqt:
                self._note(element.line, f"the guard of '{name}' has no code: it is an input")
            return to_guard(self._conditions.flag(name))
        # Only a transition with a timer resets the stopwatch when its state is entered.
        condition = self._condition(_STOPWATCH.sub("state_time", code) if is_timed else code)
        if condition is not None:
            return Guard() if ast.unparse(condition) == "True" else to_guard(condition)
        self._note(self._regions[region][1], f"the guard of '{name}' stays C++ code", self._regions[region][0])
        return Guard(code=_cpp(_STOPWATCH.sub("state_time()", code) if is_timed else code))

    def _condition(self, code: str) -> ast.expr | None:
        """The condition of a guard that is `return X;` or `if(X) return true; return false;`, None for others."""
        try:
            test = _tested(read_source(self._file, code).nodes)
            return self._conditions.read(test) if test else None
        except (CppError, RecursionError):
            return None


def _tested(nodes: Sequence[CppTree]) -> Sequence[CppTree]:
    """The expression that a function returns, empty if there is more in it."""
    texts = [each.text for each in nodes]
    if texts[:1] == ["return"] and ";" in texts and texts.index(";") == len(nodes) - 1:
        return nodes[1:-1]
    rest = re.sub(r"[{}\s]|else", "", compact(nodes[2:]))
    is_test = texts[:2] == ["if", "("] and rest == "returntrue;returnfalse;"
    return nodes[1].children if is_test else ()


def _id(element: Element) -> str:
    name = element.get("id", "")
    if not name:
        raise SourceError("S805", f"<{element.tag}> has no id", element.line)
    return name


def _priority(element: Element) -> int:
    text = element.get("priority", "")
    return int(text) if text.isdecimal() and len(text) < 10 else 0


def _has_code(design: Design) -> bool:
    guards = (each.guard for state in design.states for each in state.transitions if isinstance(each, Transition))
    texts = (design.module.texts, design.members.texts, *(state.actions for state in design.states))
    return any(texts) or any(guard.code for guard in guards)


def _cpp(text: str) -> Code:
    return Code(texts=(("cpp", text),)) if text else Code()
