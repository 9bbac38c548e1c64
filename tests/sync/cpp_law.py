"""Runs the source that a person edited, and the one generated from the design that was read back, and compares."""

import random
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from tests.cpp_tools import unoptimized
from tests.sync.cpp_random_edits import edit_text
from tests.sync.patches import apply_patch
from vicode.conformance.cpp import CppProgram
from vicode.conformance.inputs import ConformanceRun
from vicode.conformance.random_inputs import random_run
from vicode.conformance.traces import first_difference
from vicode.generators import component_generator
from vicode.model.design import Code, Design, RunCode
from vicode.model.edits import update_state
from vicode.model.project import Project
from vicode.sync.interpret import Interpretation, interpret_cpp_edits

ITERATIONS = 60
_COMMENT = re.compile(r'"(?:[^"\\\n]|\\.)*"|//[^\n]*|/\*.*?\*/', re.DOTALL)
_MARK = re.compile(r"// </?vicode|/\*\w+=\*/")


@dataclass(frozen=True)
class Trial:
    """One edited file: the edits, the texts, and what was read."""

    name: str
    project: Project
    component: str
    edits: tuple[str, ...]
    generated: str
    edited: str
    read: Interpretation
    result: str

    @property
    def is_taken(self) -> bool:
        return bool(self.read.edits)

    @property
    def kind(self) -> str:
        if not self.is_taken:
            return "left" if self.read.leftover else "same"
        return "taken in part" if self.read.leftover else "taken"


def source_of(project: Project, component: str) -> str:
    design = project.design(component)
    assert design is not None
    code = component_generator(project, "cpp", {})(design)
    assert code is not None
    return code.file.text


def prepared(project: Project, component: str) -> Project:
    """The project in C++ only, with hand-written code in a state of its component."""
    design = project.design(component)
    assert design is not None
    if any(each.name == "n" for each in (*design.outputs, *design.variables)):
        code = RunCode(code=Code(texts=(("cpp", "// counts\nif (n < 100) {\n    n += 2;\n}\n"),)))
        name = design.states[-1].name if not design.states[-1].disabled else design.initial
        design = update_state(design, name, lambda state: replace(state, enter=(*state.enter, code)))
    designs = tuple(design if each.component == component else each for each in project.designs)
    return replace(project, languages=("cpp",), designs=designs)


def try_edit(name: str, project: Project, component: str, seed: int, folder: Path) -> Trial | None:
    """Edit the source of a component at random, and read it back; None if no edit was possible."""
    named = replace(prepared(project, component), name=name)
    design = named.design(component)
    assert design is not None
    text = source_of(named, component)
    edited, edits = edit_text(text, design, random.Random(seed))
    return None if edited == text else try_text(name, named, component, edits, edited, folder)


def try_text(name: str, project: Project, component: str, edits: tuple[str, ...], edited: str, folder: Path) -> Trial:
    text = source_of(project, component)
    read = interpret_cpp_edits(project, component, generated=text, edited=edited)
    result = source_of(with_design(project, read.design), component)
    if read.leftover:
        folder.mkdir(exist_ok=True)
        result = apply_patch(result, read.leftover, folder)
    return Trial(name, project, component, edits, text, edited, read, result)


def with_design(project: Project, design: Design) -> Project:
    return replace(
        project,
        designs=tuple(design if each.component == design.component else each for each in project.designs),
    )


def lost_text(trial: Trial) -> list[str]:
    """What the person wrote and neither the design nor the patch has: comments, strings, and lines of regions."""
    written, result = _plain(trial.edited), _plain(trial.result)
    missing = _texts(written) - _texts(result)
    added = _texts(result) - _texts(written)
    hand_written = [re.sub(r"\s", "", line) for line in _regions(trial.generated)]
    there, kept = _lines(written), _lines(result)
    return [
        *missing.elements(),
        *(f"invented: {each}" for each in added.elements()),
        *(line for line in hand_written if there[line] and not kept[line]),
    ]


def may_differ(trial: Trial) -> bool:
    """Whether the two versions differ in more than layout and the order of lines."""
    return _lines(_plain(trial.edited)) != _lines(_plain(trial.result))


def _lines(text: str) -> Counter[str]:
    return Counter(re.sub(r"\s", "", line) for line in text.split("\n"))


def _plain(text: str) -> str:
    return text.replace("\r\n", "\n")


def _texts(text: str) -> Counter[str]:
    """The words of comments, and strings."""
    found: Counter[str] = Counter()
    for each in _COMMENT.findall(text):
        if _MARK.match(each):
            continue
        found.update([each] if each.startswith('"') else each.strip("/* \n").split())
    return found


def _regions(text: str) -> list[str]:
    lines: list[str] = []
    is_inside = False
    for line in text.split("\n"):
        is_mark = line.strip().startswith(("// <vicode", "// </vicode"))
        is_inside = "// <vicode" in line if is_mark else is_inside
        if is_inside and not is_mark:
            lines.append(line)
    return lines


class EditedProgram(CppProgram):
    """Compiles runs in which the source of one component has another text."""

    def __init__(
        self, runs: Mapping[str, ConformanceRun], texts: Mapping[str, tuple[str, str]], folder: Path, compiler: str
    ) -> None:
        self._texts = texts
        super().__init__(runs, folder, unoptimized(compiler), programs=2)

    def _write(self, name: str, run: ConformanceRun) -> None:
        super()._write(name, run)
        component, text = self._texts[name]
        files = sorted((self._folder / "cpp" / name).glob("*.cpp"))
        (path,) = (each for each in files if f" {component}::" in each.read_text(encoding="utf-8"))
        path.write_text(text, encoding="utf-8")


def changed_behavior(trials: Iterable[Trial], folder: Path, compiler: str) -> dict[str, str]:
    """Run both versions of each trial on the same random inputs; returns the first differences by name."""
    runs: dict[str, ConformanceRun] = {}
    texts: dict[str, tuple[str, str]] = {}
    tried = [trial for trial in trials if may_differ(trial)]
    for number, trial in enumerate(tried):
        run = random_run(trial.project, trial.component, iterations=ITERATIONS, seed=number)
        after = with_design(trial.project, trial.read.design)
        for suffix, project, text in (("w", trial.project, trial.edited), ("r", after, trial.result)):
            name = trial.name + suffix
            runs[name] = replace(run, project=project)
            texts[name] = (trial.component, re.sub(rf"\b{trial.name}\b", name, text))
    if not runs:
        return {}
    traces = EditedProgram(runs, texts, folder, compiler).run()
    found = {}
    for trial in tried:
        difference = first_difference(traces[f"{trial.name}w"], traces[f"{trial.name}r"])
        if difference is not None:
            found[trial.name] = f"{trial.edits}: {difference}"
    return found


def count_kinds(trials: Sequence[Trial]) -> str:
    counts = Counter(trial.kind for trial in trials)
    return ", ".join(f"{kind} {counts[kind]}" for kind in ("taken", "taken in part", "left", "same"))
