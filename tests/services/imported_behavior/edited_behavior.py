"""An imported behavior whose designs are edited at random: the text of the files, with their comments."""

import random
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from tests.importers.differential_harness import EngineRun, GeneratedPythonRun, import_checked, random_input_rows
from tests.strategies.project_edits import Edited, random_edit
from tests.xabsl.xabsl_cases import load_texts
from vicode.check import check_project
from vicode.findings import Severity
from vicode.importers import ImportResult
from vicode.model.project import Project
from vicode.services.imported_behavior.behavior_update import EditedProject, UpdateProblem, update_behavior
from vicode.store import add_comments, read_design, read_project_file, save_design, save_project_file

ROOT = Path("/behavior")
PROJECT = ""
_COMMENT_LINE = re.compile(r"\s*#")
_REMARKS = ("note {}", "the {} of: all", "goto {};", "a */ b {}", "-- {} --", "Grüße {}", "see {{{}}}", "# {}")
Texts = Mapping[str, str]


@dataclass
class EditedBehavior:
    """The files of a behavior, and those of its designs by component, with `PROJECT` for project.yaml."""

    texts: Texts
    project: Project
    files: dict[str, str]
    paths: dict[str, str]
    known_paths: dict[str, str]
    numbers: Iterator[int] = field(default_factory=lambda: iter(range(10**6)))
    last: Edited | None = None

    def update(self) -> tuple[dict[str, str], tuple[UpdateProblem, ...]]:
        """Write the edits; returns the files of the new behavior, and what is not written."""

        def read(path: Path) -> str:
            return self.texts[path.relative_to(ROOT).as_posix()]

        edited = EditedProject(project=self.project, files=self.files, paths=self.paths, known_paths=self.known_paths)
        changed, problems = update_behavior(load_texts(dict(self.texts)), edited, read)
        new = {path.relative_to(ROOT).as_posix(): text for path, text in changed.items()}
        return {name: text for name, text in {**self.texts, **new}.items() if text is not None}, problems

    # Edits

    def edit(self, chance: random.Random) -> str:
        """Make one edit; returns its kind, "" for none."""
        kinds = (self.add_comment, self.change_comment, self.delete_comment, self.move_design, self.edit_content)
        kind = chance.choices(kinds, (3, 2, 2, 1, 5))[0]
        return kind(chance)

    def edit_content(self, chance: random.Random) -> str:
        edited = random_edit(chance, self.project)
        if edited is None:
            return ""
        findings = check_project(replace(edited.project, languages=("xabsl",)))
        if any(finding.severity is Severity.ERROR for finding in findings):
            return ""
        self._save(edited.project)
        self.last = edited
        return edited.kind

    def _save(self, project: Project) -> None:
        before = {design.component for design in self.project.designs}
        for design in project.designs:
            self.files[design.component] = save_design(design, self.files.get(design.component, ""))
            if design.component not in before:
                self.paths[design.component] = f"Options/{design.component}.yaml"
        self.files[PROJECT] = save_project_file(project, self.files[PROJECT])
        self.project = project

    def add_comment(self, chance: random.Random) -> str:
        name, lines = self._draw_file(chance)
        content = [index for index, line in enumerate(lines) if line.strip() and not _COMMENT_LINE.match(line)]
        elements = [index for index in content if re.match(r"  \w+:|\s+- |vicode|component", lines[index])]
        index = chance.choice(elements if chance.random() < 0.8 else content)
        indent = " " * (len(lines[index]) - len(lines[index].lstrip()))
        remark = chance.choice(_REMARKS).format(next(self.numbers))
        return self._replace(name, [*lines[:index], f"{indent}# {remark}", *lines[index:]], "added comment")

    def change_comment(self, chance: random.Random) -> str:
        name, lines = self._draw_file(chance)
        comments = [index for index, line in enumerate(lines) if _COMMENT_LINE.match(line)]
        if not comments:
            return ""
        index = chance.choice(comments)
        lines[index] = f"{lines[index]} changed {next(self.numbers)}"
        return self._replace(name, lines, "changed comment")

    def delete_comment(self, chance: random.Random) -> str:
        name, lines = self._draw_file(chance)
        comments = [index for index, line in enumerate(lines) if _COMMENT_LINE.match(line)]
        if not comments:
            return ""
        index = chance.choice(comments)
        return self._replace(name, [*lines[:index], *lines[index + 1 :]], "deleted comment")

    def move_design(self, chance: random.Random) -> str:
        name = chance.choice(sorted(self.paths))
        folder = chance.choice(("Options/Moved", "Elsewhere"))
        self.paths[name] = f"{folder}/{Path(self.paths[name]).name}"
        return "moved design"

    def _draw_file(self, chance: random.Random) -> tuple[str, list[str]]:
        name = chance.choice(sorted(self.files))
        return name, self.files[name].split("\n")

    def _replace(self, name: str, lines: list[str], kind: str) -> str:
        """Take new lines if they have the same value: a line may be inside a text."""
        text = "\n".join(lines)
        if name == PROJECT:
            is_same = read_project_file(text).project == read_project_file(self.files[name]).project
        else:
            is_same = read_design(text).design == read_design(self.files[name]).design
        if not is_same:
            return ""
        self.files[name] = text
        return kind


def import_behavior_texts(texts: Texts) -> EditedBehavior:
    imported, _compiled = import_checked(load_texts(dict(texts)))
    paths = {about.component: about.path for about in imported.designs}
    return EditedBehavior(texts, imported.project, design_texts(imported), paths, dict(paths))


def design_texts(imported: ImportResult) -> dict[str, str]:
    comments = [(each.path, each.text) for each in imported.comments]
    files = {PROJECT: add_comments(save_project_file(imported.project), comments, is_project_file=True)}
    for design, about in zip(imported.project.designs, imported.designs, strict=True):
        comments = [(each.path, each.text) for each in about.comments]
        files[design.component] = add_comments(save_design(design), comments)
    return files


# Laws


@dataclass(frozen=True)
class Shown:
    """A line of a comment: the keys of the element below it, by indentation, and its text."""

    keys: tuple[str, ...]
    text: str
    line: int


def shown_comments(text: str) -> list[Shown]:
    """The comments of a design file with the state and section that they stand in."""
    lines = text.split("\n")
    found = []
    for index, line in enumerate(lines):
        # The title of a namespace without symbols is shown as a comment.
        if _COMMENT_LINE.match(line) and line.strip(" #") and not line.startswith("  # namespace "):
            below = next((n for n in range(index, len(lines)) if _is_content(lines[n])), len(lines) - 1)
            found.append(Shown(_keys(lines, below), line.strip().removeprefix("#").strip(), index + 1))
    return found


def _is_content(line: str) -> bool:
    return bool(line.strip()) and not _COMMENT_LINE.match(line)


def _keys(lines: list[str], index: int) -> tuple[str, ...]:
    """The keys of up to three levels around a line: section, state, and section of the state."""
    keys: list[str] = []
    indent = len(lines[index]) - len(lines[index].lstrip()) + 1
    for line in reversed(lines[: index + 1]):
        depth = len(line) - len(line.lstrip())
        if _is_content(line) and depth < indent:
            indent = depth
            keys.append(line.strip().removeprefix("- ").partition(":")[0])
    return tuple(reversed(keys))[:3]


def places(shown: list[Shown]) -> Counter[tuple[tuple[str, ...], str]]:
    return Counter((_place(each.keys), each.text) for each in shown)


def _place(keys: tuple[str, ...]) -> tuple[str, ...]:
    """The element without what depends on the layout: which key of a state or item is the first."""
    if keys[:1] == ("states",):
        return keys if keys[2:] in (("actions",), ("transitions",)) else keys[:2]
    return keys[:2]


def assert_written_or_reported(edited: EditedBehavior, new: Texts, problems: tuple[UpdateProblem, ...]) -> None:
    """Assert that an import of the written files shows the comments and paths of the designs, except reported ones."""
    imported, _compiled = import_checked(load_texts(dict(new)))
    again, left = design_texts(imported), {problem.component for problem in problems if not problem.line}
    reported = Counter((problem.component, problem.line) for problem in problems)
    for name in edited.files.keys() - left:
        shown = shown_comments(edited.files[name])
        missing = places(shown) - places(shown_comments(again[name]))
        for each in shown:
            key = (_place(each.keys), each.text)
            if missing[key]:
                missing[key] -= 1
                assert reported[name, each.line], (name, each)
        extra = places(shown_comments(again[name])) - places(shown)
        assert not extra or any(problem.component == name for problem in problems), (name, extra)
    written = {about.component: about.path for about in imported.designs}
    assert all(written[name] == path for name, path in edited.paths.items() if name not in left)


def assert_only_comments_changed(old: Texts, new: Texts) -> None:
    """Assert that all lines are the same without their comments, except lines without anything else."""
    assert old.keys() == new.keys()
    for name, text in new.items():
        assert _without_comments(old[name]) == _without_comments(text)


def _without_comments(text: str) -> list[str]:
    """The lines of a file without comments."""
    plain = re.sub(r"//[^\n]*|/\*(?!\*[^/*])(?s:.*?)\*/|\A/\*\*\*(?s:.*?)\*/", "", text)
    return ["".join(line.split()) for line in plain.splitlines() if line.strip()]


def assert_runs_agree(texts: Texts, project: Project, folder: Path, *, count: int, seed: int) -> None:
    """Assert that the XABSL files and the Python generated from the designs do the same in every cycle."""
    _imported, compiled = import_checked(load_texts(dict(texts)))
    agent = next(iter(compiled.table.agents))
    first, second = EngineRun(compiled, agent), GeneratedPythonRun(project, compiled, agent, folder)
    for number, (ms, inputs) in enumerate(random_input_rows(first.symbols, seed, count)):
        for name, value in inputs.items():
            first.recording.world.set_input(name, value)
            second.recording.world.set_input(name, value)
        wanted, got = first.cycle(ms), second.cycle(ms)
        for key in ("options", "set", "told"):
            assert got[key] == wanted[key], (agent, number, ms, key)
