"""Laws of sync: nothing that anyone wrote is lost, whatever the order of edits."""

import itertools
import re
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.generators.sound_designs import project_of, sound_designs
from vicode.check import check_project
from vicode.findings import DesignPath, Severity
from vicode.generators import generate, list_regions
from vicode.model.design import Code, Design, RunCode, State, Transition
from vicode.model.edits import rename_state
from vicode.model.project import Project
from vicode.model.traversal import iter_code
from vicode.regions import find_regions, wrap_region
from vicode.sync import (
    Choices,
    GeneratedHistory,
    GenerationInput,
    GenerationPlan,
    Side,
    plan_generation,
    write_generated,
)
from vicode.sync.apply_regions import set_code

_T = TypeVar("_T")
_HALF = 5
few_examples = settings(max_examples=max(20, settings.default.max_examples // 4))


class Workspace:
    """A project and its generated folder; `lines` are the lines that someone wrote and nobody removed."""

    def __init__(self, project: Project, folder: Path) -> None:
        self.project, self.folder = project, folder
        self.lines: set[str] = set()
        self._numbers = itertools.count()
        assert self.sync() == ()

    @property
    def design(self) -> Design:
        return self.project.designs[0]

    @design.setter
    def design(self, design: Design) -> None:
        self.project = replace(self.project, designs=(design,))

    @property
    def file(self) -> Path:
        return next(file for file in self.folder.glob("python/*/*.py") if "<vicode" in file.read_text("utf-8"))

    def plan(self, *, applies_edits: bool = True, take: Side | None = None) -> GenerationPlan:
        job = GenerationInput(
            project=self.project,
            folder=self.folder,
            generate=lambda project: generate(project, languages=["python"]),
            history=GeneratedHistory(folder=self.folder),
        )
        return plan_generation(job, applies_edits=applies_edits, choices=Choices(default=take))

    def sync(self, take: Side | None = None) -> tuple[str, ...]:
        """Apply edits and write; return the codes of the findings that prevent it."""
        plan = self.plan(take=take)
        if plan.findings:
            assert not plan.designs
            return tuple(finding.rule.code for finding in plan.findings)
        for design in plan.designs.values():
            self.design = design
        write_generated(plan)
        return ()

    def new_line(self) -> str:
        line = f"note_{next(self._numbers)} = 1"
        self.lines.add(line)
        return line

    def edit_file(self, which: int, at: int) -> None:
        text = self.file.read_text("utf-8")
        regions = find_regions(text).regions
        region = self._choose(regions, which, lambda region: len(region.body))
        lines = text.split("\n")
        body = _inserted(region.body, self.new_line(), at)
        new = wrap_region(region.id, body, indent=region.indent).split("\n")[1:-2]
        self.file.write_text("\n".join([*lines[: region.line], *new, *lines[region.end_line - 1 :]]), "utf-8")

    def edit_design(self, which: int, at: int) -> None:
        paths = list_regions(self.project, self.design.component, "python")
        texts = [(path, text) for path, text in iter_texts(self.design) if path in paths.values()]
        path, text = self._choose(texts, which, lambda item: len(item[1]))
        self.design = set_code(self.design, path, "python", _inserted(text, self.new_line(), at))

    @staticmethod
    def _choose(items: Sequence[_T], which: int, length: Callable[[_T], int]) -> _T:
        """The longest in half of the cases, so that both sides often edit the same one."""
        return max(items, key=length) if which < _HALF else items[which % len(items)]

    def format_file(self, how: int) -> None:
        changes: list[Callable[[str], str]] = [
            lambda text: text.replace("\n", "\r\n"),
            lambda text: re.sub(r"^( {4})+", lambda match: "\t" * (len(match[0]) // 4), text, flags=re.MULTILINE),
            lambda text: text.replace("\n\n\n", "\n\n"),
            lambda text: text + "\n\n",
        ]
        text = changes[how % len(changes)](self.file.read_bytes().decode())
        self.file.write_bytes(text.encode())

    def rename_state(self, which: int) -> None:
        state = self.design.states[which % len(self.design.states)].name
        self.design = rename_state(self.design, state, f"Renamed{next(self._numbers)}")

    def lost_lines(self) -> set[str]:
        written = self.file.read_text("utf-8") + "\n".join(text for _path, text in iter_texts(self.design))
        return {line for line in self.lines if line not in written}


def iter_texts(design: Design) -> Iterator[tuple[DesignPath, str]]:
    return ((located.path, located.code.in_language("python") or "") for located in iter_code(design))


def _inserted(body: str, line: str, at: int) -> str:
    """Insert a line before a line of the body that is not indented."""
    lines = body.split("\n")
    starts = [index for index, text in enumerate(lines) if text[:1].strip()] or [0]
    index = starts[at % len(starts)]
    return "\n".join([*lines[:index], line, *lines[index:]])


@contextmanager
def workspace(project: Project) -> Iterator[Workspace]:
    with tempfile.TemporaryDirectory() as name:
        yield Workspace(project, Path(name))


def code(text: str) -> Code:
    return Code(texts=(("python", text),))


SAMPLE = Design(
    component="Sample",
    initial="A",
    module=code("import math"),
    members=code("def helper(self):\n    return math.pi"),
    states=(
        State(
            name="A",
            enter=(RunCode(code=code("\n".join(f"self.a{number} = {number}" for number in range(9)))),),
            transitions=(Transition(to="B"),),
        ),
        State(name="B", actions=(RunCode(code=code("self.b += 1")), RunCode(code=code("self.b += 1")))),
    ),
)

numbers = st.integers(0, 9)
operations = st.lists(
    st.one_of(
        st.tuples(st.just("edit_file"), numbers, numbers),
        st.tuples(st.just("edit_design"), numbers, numbers),
        st.tuples(st.just("format_file"), numbers),
        st.tuples(st.just("rename_state"), numbers),
        st.tuples(st.just("sync")),
    ),
    max_size=12,
)


@few_examples
@given(operations, st.sampled_from(["file", "design"]))
def test_no_line_is_lost(steps: list[tuple[object, ...]], side: Side) -> None:
    with workspace(project_of(SAMPLE)) as work:
        for name, *arguments in steps:
            getattr(work, str(name))(*arguments)
            assert not work.lost_lines()
        has_conflicts = bool(work.sync())
        assert not work.lost_lines()
        if has_conflicts:
            assert work.sync(side) == ()
        assert work.plan().differences == ()
        kept = work.lines - work.lost_lines()
        in_design = "\n".join(text for _path, text in iter_texts(work.design))
        assert all(line in in_design for line in kept)


@few_examples
@given(sound_designs())
def test_sync_after_generation_changes_nothing(design: Design) -> None:
    project = _sound(design)
    with workspace(project) as work:
        plan = work.plan()
        assert (plan.designs, plan.differences, plan.findings) == ({}, (), ())


@few_examples
@given(sound_designs(), numbers, numbers)
def test_an_edit_of_any_region_is_generated_again(design: Design, which: int, at: int) -> None:
    project = _sound(design)
    assume(list_regions(project, design.component, "python"))
    with workspace(project) as work:
        work.edit_file(which, at)
        edited = {region.id: region.body for region in find_regions(work.file.read_text("utf-8")).regions}
        assume(not any(finding.rule.code == "D412" for finding in work.plan().findings))
        assert work.sync() == ()
        assert {region.id: region.body for region in find_regions(work.file.read_text("utf-8")).regions} == edited


def _sound(design: Design) -> Project:
    project = project_of(design)
    assume(not any(finding.severity is Severity.ERROR for finding in check_project(project)))
    return project
