"""Cases of tests/conformance: a design, its inputs and the expected trace, in one file each.

The first YAML document of a file is the case; the others are design files, and project.yaml if the case needs one:

    feature    what the case shows
    not_in     languages that cannot run it, with the reason
    inputs     one entry per iteration: `ms` since the last one, changed inputs; those of a team in the list `robots`
    trace      the expected trace in short form; `pytest --accept` writes it

Short form: `time | Component:State@ms since entry <state before (parameters) values`, nested steps after `|`; `-` marks
required components, `>` called ones, `~` a component whose period has not elapsed, `*` a final state.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import yaml

from vicode.check import check_project
from vicode.conformance.inputs import ConformanceRun, RunStep
from vicode.conformance.traces import TraceIteration, TraceStep
from vicode.findings import Severity, render_text
from vicode.model.project import Project
from vicode.store import open_project

CASES = Path(__file__).parent / "cases"
LANGUAGES = ("python", "cpp", "xabsl", "javascript", "simulator")


@dataclass(frozen=True)
class Case:
    """A case; `folder` is an empty folder for its design files."""

    file: Path
    folder: Path

    @cached_property
    def documents(self) -> list[str]:
        return re.split(r"^---\n", self.file.read_text(encoding="utf-8"), flags=re.MULTILINE)

    @cached_property
    def header(self) -> dict[str, Any]:
        return dict(yaml.safe_load(self.documents[0]))

    @property
    def name(self) -> str:
        return self.file.stem

    @property
    def not_in(self) -> Mapping[str, str]:
        return dict(self.header.get("not_in", {}))

    @cached_property
    def project(self) -> Project:
        (self.folder / "project.yaml").write_text(f"vicode: 1\nproject: {self.name}\n", encoding="utf-8")
        for number, text in enumerate(self.documents[1:]):
            is_project = re.search(r"^component:", text, re.MULTILINE) is None
            name = "project.yaml" if is_project else f"design{number}.yaml"
            head = f"vicode: 1\n{f'project: {self.name}' if is_project else ''}\n"
            (self.folder / name).write_text(head + text, encoding="utf-8")
        opened = open_project(self.folder)
        errors = [each for each in opened.findings if each.severity is Severity.ERROR]
        errors += [each for each in check_project(opened.project) if each.severity is Severity.ERROR]
        assert not errors, f"{self.name}: {render_text(errors)}"
        return opened.project

    @property
    def root(self) -> str:
        found = re.search(r"^component: *(\w+)", "".join(self.documents[1:]), re.MULTILINE)
        assert found is not None
        return found[1]

    @property
    def run(self) -> ConformanceRun:
        steps, now_ns = [], 0
        robots = int(self.header.get("robots", 1))
        for index, plain in enumerate(self.header["inputs"]):
            entry = dict(plain or {})
            now_ns += round(float(entry.pop("ms", 100 if index else 0)) * 1e6)
            each = entry.pop("robots", [entry] * robots)
            for repeated in range(int(entry.pop("times", 1))):
                now_ns += 100_000_000 if repeated else 0
                steps.append(RunStep(time_ns=now_ns, inputs=tuple(_keys(values) for values in each)))
        return ConformanceRun(
            project=self.project,
            root=self.root,
            steps=tuple(steps),
            robots=robots,
            team_ticks=int(self.header.get("team_ticks", 0)),
        )

    @property
    def expected(self) -> str:
        return str(self.header.get("trace", ""))

    def accept(self, text: str) -> None:
        """Write the expected trace."""
        kept = re.sub(r"^trace: \|\n(?:  .*\n|\n)*", "", self.documents[0], flags=re.MULTILINE)
        block = "".join(f"  {line}\n" for line in text.splitlines())
        self.file.write_text("---\n".join([f"{kept}trace: |\n{block}", *self.documents[1:]]), encoding="utf-8")


def _keys(values: Mapping[str, Any] | None) -> dict[tuple[str, str], Any]:
    """Inputs by component and name; those of the root component have no component."""
    pairs = ((name.rpartition("."), value) for name, value in (values or {}).items())
    return {(key[0], key[2]): float(value) if value in ("nan", "inf", "-inf") else value for key, value in pairs}


def short_form(iterations: list[TraceIteration], robots: int = 1) -> str:
    """A trace as text, one line per iteration."""
    lines = []
    for iteration in iterations:
        robot = f"robot {iteration.robot} " if robots > 1 else ""
        shared = "".join(f" {name}={value}" for name, value in sorted(iteration.shared.items()))
        steps = " | ".join(_short_step(step) for step in iteration.steps)
        lines.append(f"{robot}{iteration.time_ns / 1e6:g}{shared} | {steps}".rstrip())
    return "".join(f"{line}\n" for line in lines)


def _short_step(step: TraceStep) -> str:
    fields = step.fields
    mark = {"requires": "-", "modulates": ">"}.get(fields["link"], "")
    text = f"{mark}{step.component}"
    if fields.get("state"):
        text += f":{fields['state']}{'*' if fields['done'] == 'true' else ''}@{fields['state_time']}"
    text += "~" if fields["worked"] == "false" else ""
    if fields.get("changed_from"):
        text += f" <{fields['changed_from']}" + (f" {fields['transition']}" if fields["transition"] else "")
    parameters = [f"{name[11:]}={value}" for name, value in sorted(fields.items()) if name.startswith("parameters.")]
    text += f"({', '.join(parameters)})" if parameters else ""
    return text + "".join(
        f" {name[7:]}={value}" for name, value in sorted(fields.items()) if name.startswith("values.")
    )
