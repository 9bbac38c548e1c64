"""Writes the edits of imported designs back to the XABSL files of the behavior."""

from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path, PurePosixPath

from vicode.generators import generate
from vicode.importers import ImportResult, import_behavior
from vicode.model.project import Project
from vicode.model.xabsl.names import component_name, unqualified_name
from vicode.services.imported_behavior.comment_places import CommentPlace, DesignComments, PlaceKey
from vicode.services.imported_behavior.comment_update import comments_by_lines, write_comments
from vicode.services.imported_behavior.description_update import find_unwritten_descriptions
from vicode.services.imported_behavior.update_scope import UpdateScope
from vicode.xabsl.compiler import compile_source
from vicode.xabsl.patching.differences import find_differences
from vicode.xabsl.patching.program_items import iter_items
from vicode.xabsl.patching.program_patch import FileTexts, ProgramVersion, patch_program
from vicode.xabsl.patching.source_edits import PatchError
from vicode.xabsl.source_loader import ProgramSource, load_source
from vicode.xabsl.source_text import EncodedText, ReadText
from vicode.xabsl.tree import OptionNode

_FOLDER = Path("/generated")
_ATTEMPTS = 3
_MAX_SHOWN = 60


@dataclass(frozen=True, slots=True, kw_only=True)
class UpdateProblem:
    """An edit that is not written back.

    Attributes:
        component: The design, "" for project.yaml or if none is concerned.
        state: The state in the design, "" if none is concerned.
        line: The line in the file of the design, 0 if unknown.
    """

    message: str
    component: str = ""
    state: str = ""
    line: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class EditedProject:
    """A project to write back.

    Attributes:
        project: The project with its edits.
        files: The texts of the designs, and of project.yaml as "", if their comments are compared.
        paths: The path of each design, relative to the project.
        known_paths: The same at the last import or update.
        left_out: Components with errors: their options stay as they are.
    """

    project: Project
    files: Mapping[str, str] = field(default_factory=dict)
    paths: Mapping[str, str] = field(default_factory=dict)
    known_paths: Mapping[str, str] = field(default_factory=dict)
    left_out: Collection[str] = ()


@dataclass(frozen=True, slots=True)
class _Behavior:
    """XABSL files with their import."""

    version: ProgramVersion
    imported: ImportResult


def update_behavior(
    source: ProgramSource, edited: EditedProject, read: ReadText
) -> tuple[FileTexts, tuple[UpdateProblem, ...]]:
    """Write the edits of a project to the files of the behavior that it was imported from.

    An option that cannot be written keeps its files, and so do comments without a place in XABSL.

    Args:
        source: The files of the behavior; they compile.
        edited: The project.
        read: Reads other files of the behavior.

    Returns:
        The changed, added and removed files (None), and what is not written.
    """
    return _Update(source, edited, read).run()


def generated_version(project: Project, paths: Mapping[str, str], moves: Mapping[str, str] = {}) -> ProgramVersion:
    """Generate the XABSL program of a project."""
    files = generate(replace(project, languages=("xabsl",)))
    root = next(PurePosixPath(file.path).parent for file in files if file.path.endswith("/agents.xabsl"))
    texts = {_FOLDER / PurePosixPath(file.path).relative_to(root): file.text for file in files}
    source = load_source(_FOLDER / "agents.xabsl", texts.__getitem__)
    folders = {name: PurePosixPath(path).parent.as_posix() for name, path in paths.items()}
    return ProgramVersion(
        source,
        compile_source(source),
        {component_name(design): [unqualified_name(state) for state in design.states] for design in project.designs},
        {component_name(design): folders.get(design.component, ".").removeprefix(".") for design in project.designs},
        moves,
    )


class _Update:
    def __init__(self, source: ProgramSource, edited: EditedProject, read: ReadText) -> None:
        self.source, self.edited, self.read = source, edited, read
        self.old = self._import(source)
        self.before = generated_version(self.old.imported.project, {})
        self.scope = UpdateScope(self.old.imported.project, edited.project, edited.left_out)
        self.problems: list[UpdateProblem] = []

    def run(self) -> tuple[FileTexts, tuple[UpdateProblem, ...]]:
        while True:
            project = self.scope.project()
            if project is None:
                message = "nothing is written, because other edits depend on what cannot be written"
                return {}, (*self.problems, UpdateProblem(message=message))
            texts, new, found = self._write_structure(project)
            if not found:
                break
            self.problems += found
            if not self.scope.leave_out(each.component for each in found if each.component):
                return {}, tuple(self.problems)
        if new is None:
            return {}, tuple(self.problems)
        comment_texts = self._write_comments(project, new)
        for path, text in comment_texts.items():
            texts[path] = text
        return texts, tuple(self.problems)

    def _import(self, source: ProgramSource) -> _Behavior:
        compiled = compile_source(source)
        name = self.edited.project.name
        return _Behavior(ProgramVersion(source, compiled), import_behavior(source, compiled, name))

    # Structure

    def _write_structure(self, project: Project) -> tuple[FileTexts, _Behavior | None, list[UpdateProblem]]:
        after = generated_version(project, self.edited.paths, self._moves(project))
        before = self.before
        is_same = before.state_orders == after.state_orders and not after.moves
        if is_same and not any(find_differences(before.source, after.source)):
            return {}, self.old, []
        try:
            texts = patch_program(self.old.version, before, after)
        except PatchError as error:
            components = {component_name(each): each.component for each in project.designs}
            return {}, None, [UpdateProblem(message=str(error), component=components.get(error.option, ""))]
        new = self._load(self.source.main, texts)
        problems = list(_compile_problems(new, project))
        if problems:
            return {}, None, problems
        behavior = _Behavior(new, import_behavior(new.source, new.compiled, project.name))
        return texts, behavior, list(_compare(after, behavior, project))

    def _moves(self, project: Project) -> dict[str, str]:
        """The new paths of the files of options whose designs moved."""
        moves = {}
        for design in project.designs:
            old, new = (paths.get(design.component) for paths in (self.edited.known_paths, self.edited.paths))
            if old and new and old != new and design.component not in self.scope.left_out:
                moves[component_name(design)] = PurePosixPath(new).with_suffix("").as_posix()
        return moves

    def _load(self, main: Path, texts: Mapping[Path, str | None]) -> ProgramVersion:
        def read_new(path: Path) -> str | EncodedText:
            text = texts[path] if path in texts else self.read(path)
            if text is None:
                raise FileNotFoundError(2, "removed", str(path))
            return text

        source = load_source(main, read_new)
        return ProgramVersion(source, compile_source(source))

    # Comments

    def _write_comments(self, project: Project, new: _Behavior) -> dict[Path, str]:
        files = {name: file for name, file in self.edited.files.items() if name not in self.scope.left_out}
        comments = DesignComments(project, files)
        old = [comment for place in comments.compare(self.old.imported) for comment in place.comments]
        originals = comments_by_lines(old, self.source)
        skipped: set[PlaceKey] = set()
        texts: dict[Path, str] = {}
        places = comments.compare(new.imported)
        for _attempt in range(_ATTEMPTS):
            texts = write_comments(new.version.source, [each for each in places if each.key not in skipped], originals)
            written, failed = self._check_comments(project, new, texts)
            found = comments.compare(written.imported)
            wrong = {each.key for each in found if not each.is_equal or each.key[0] in failed} - skipped
            if not texts or not wrong:
                break
            skipped |= wrong
        else:
            texts, found = {}, places
        self.problems += [problem for place in found for problem in _unwritten_comments(place)]
        self.problems += [
            UpdateProblem(message=each.message, component=each.component, line=each.line)
            for each in find_unwritten_descriptions(new.imported.project, project, files)
        ]
        return texts

    def _check_comments(
        self, project: Project, new: _Behavior, texts: Mapping[Path, str]
    ) -> tuple[_Behavior, set[str]]:
        """Import the files with the new comments; returns them with the designs that these comments changed."""
        if not texts:
            return new, set()
        files = {**{path: parsed.tokens.text for path, parsed in new.version.source.files.items()}, **texts}
        version = self._load(new.version.source.main, files)
        if version.compiled.program is None:
            return new, {"", *(design.component for design in project.designs)}
        written = _Behavior(version, import_behavior(version.source, version.compiled, project.name))
        before = generated_version(new.imported.project, {})
        return written, {problem.component for problem in _compare(before, written, project)}


def _compare(after: ProgramVersion, written: _Behavior, project: Project) -> Iterator[UpdateProblem]:
    """Compare the import of the new files with the designs."""
    again = generated_version(written.imported.project, {})
    components = {component_name(design): design for design in project.designs}
    for option, state in find_differences(after.source, again.source):
        design = components.get(option)
        states = {unqualified_name(each): each.name for each in design.states} if design else {}
        where = f"state {state} of option {option}" if state else option or "the agents"
        yield UpdateProblem(
            message=f"{where} cannot be written so that an import gives the same design",
            component=design.component if design else "",
            state=states.get(state, ""),
        )


def _compile_problems(new: ProgramVersion, project: Project) -> Iterator[UpdateProblem]:
    components = {component_name(design): design.component for design in project.designs}
    options = {
        parsed.tokens.file: components.get(item.name.text, "")
        for _path, parsed, item in iter_items(new.source)
        if isinstance(item, OptionNode)
    }
    for finding in new.compiled.findings:
        if finding.severity == "error":
            file = finding.location.file if finding.location else ""
            where = f"{file}:{finding.location.line}: " if finding.location else ""
            message = f"the new files would not compile: {where}{finding.message}"
            yield UpdateProblem(message=message, component=options.get(file, ""))


def _unwritten_comments(place: CommentPlace) -> Iterator[UpdateProblem]:
    """Report the comments of a place that are missing from XABSL, or cannot be changed there."""
    component, _line = place.key
    missing = place.missing()
    for text, line in missing:
        if not place.is_exact:
            reason = "XABSL has another form of these transitions or actions"
        elif place.start is None and not place.is_header:
            reason = "XABSL has no place for it; move it above a state, a transition, an action or a declaration"
        else:
            reason = "an import would place it elsewhere; change its text or write it above another element"
        message = f"the comment '{_short(text)}' is not written to XABSL: {reason}"
        yield UpdateProblem(message=message, component=component, line=line)
    if missing or place.is_equal:
        return
    extra = Counter(place.present_lines) - Counter(place.wanted_lines)
    shown = [
        comment for comment in place.comments if comment.comment.span is not None and extra & Counter(comment.lines)
    ]
    for comment in shown:
        message = f"the comment '{_short(comment.lines[0])}' of {comment.file.name} cannot be changed in XABSL"
        yield UpdateProblem(message=message, component=component, line=place.key[1])
    if not extra:
        message = "the order of these comments cannot be changed in XABSL; restore it"
        yield UpdateProblem(message=message, component=component, line=place.key[1])


def _short(text: str) -> str:
    return text if len(text) <= _MAX_SHOWN else f"{text[:_MAX_SHOWN]}…"
