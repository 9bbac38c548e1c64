"""The tools that `vicode mcp` offers to agents: the commands of vicode on one folder."""

import difflib
import json
import os
import re
import secrets
import shutil
import subprocess
import sys
from collections import Counter, OrderedDict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from vicode.output import resolve_below, temporary_folder
from vicode.simulation.environment import fresh_environment
from vicode.store import looks_like_design, replace_text

_LIMIT_S = 120.0
_MAX_TEXT = 100_000
_MAX_PROPOSALS = 20
_SUFFIXES = (".yaml", ".yml")
_COPIED = (*_SUFFIXES, ".py")
_FORMATS = ("mermaid", "plantuml", "dot", "svg", "png")
_LINK = re.compile(r"!?\[([^\]\n]*)\]\([^()\s]*\)")
_ANCHOR = re.compile(r"<a id=\"[^\"]*\"></a>")


class AgentToolError(Exception):
    """A tool cannot do what it was asked for; the message says why and what to do."""


@dataclass(frozen=True, slots=True)
class _Proposal:
    path: str
    old: str | None
    new: str
    errors: int


@dataclass(slots=True)
class AgentTools:
    """What an agent may do with the designs in a folder.

    Each tool runs a command of vicode in a process of its own and returns what it prints.

    Attributes:
        folder: The folder; paths of tools are relative to it.
        may_edit: Whether designs and generated files may be written.
        may_run: Whether the code of the folder may be run, with all rights of the user.
    """

    folder: Path
    may_edit: bool = False
    may_run: bool = False
    _proposals: "OrderedDict[str, _Proposal]" = field(init=False, default_factory=OrderedDict)
    _outputs: frozenset[Path] | None = field(init=False, default=None)
    """Where generated files went before the first edit."""

    def list_designs(self) -> list[dict[str, Any]]:
        """List the designs: component, file, description, states, used components, and number of findings."""
        from vicode.services.project_loader import load_projects

        listed = []
        for loaded in load_projects([str(self.folder)], with_warnings=True):
            opened = loaded.open_project
            for design in opened.project.designs:
                file = opened.files[design.component].resolve()
                listed.append(
                    {
                        "component": design.component,
                        "path": file.relative_to(self.folder.resolve()).as_posix(),
                        "doc": design.doc,
                        "states": [state.name for state in design.states],
                        "uses": sorted({use.component for use in design.uses}),
                        "findings": sum(
                            each.location is not None and Path(each.location.file).resolve() == file
                            for each in loaded.findings
                        ),
                    }
                )
        return listed

    def read(self, path: str) -> str:
        """Read the YAML of a design or of a project.yaml."""
        text = self._read(self._design_file(path))
        if text is None:
            raise AgentToolError(f"there is no file {path}; list_designs lists the designs")
        return text

    def check(self, path: str = ".", deep: bool = False) -> list[dict[str, Any]]:
        """Check a design or a folder: findings with rule, message, file, line, column and fix.

        With `deep`, also search for states that alternate and prove the properties of the design, which takes longer.
        """
        return self._check(self.folder, self._inside(path), deep=deep)

    def explain(self, path: str, state: str = "") -> str:
        """Explain a component, or one of its states, as Markdown: what enters it, its transitions, uses and times."""
        self._design_file(path)
        with temporary_folder("explain") as out:
            self._vicode("docs", self._inside(path), "--format", "markdown", "--out", str(out), codes=(0, 1))
            pages = sorted(out.glob("component-*.md"))
            component = self._component(path)
            page = next((page for page in pages if page.stem == f"component-{component}"), None)
            if page is None:
                raise AgentToolError(f"{path} has errors; check lists them")
            text = _without_links(page.read_text(encoding="utf-8"))
        if not state:
            return text[:_MAX_TEXT]
        found = re.search(rf"^### {re.escape(state)}$.*?(?=^##|\Z)", text, re.MULTILINE | re.DOTALL)
        if found is None:
            raise AgentToolError(f"{component} has no state {state}; list_designs lists the states")
        return found.group()

    def render(self, path: str, format: str = "mermaid") -> bytes:  # noqa: A002 - the word of `vicode export`
        """Draw the diagram of a design: mermaid, plantuml, dot or svg as text, or png."""
        if format not in _FORMATS:
            raise AgentToolError(f"there is no format {format}; use one of {', '.join(_FORMATS)}")
        return self._vicode_bytes("export", self._inside(path), "--format", format, "-o", "-")

    def propose_edit(self, path: str, text: str) -> dict[str, Any]:
        """Check new text for a design without writing it: what changes, and the findings before and after.

        The result has an `id` for apply_edit.
        """
        file = self._design_file(path)
        if not looks_like_design(text.encode()):
            raise AgentToolError("the text is no design; it starts with 'vicode: 1' and has 'component' or 'project'")
        old = self._read(file)
        with temporary_folder("proposal") as place:
            copy = place / "project"
            self._copy(copy)
            before = self._check(copy, ".")
            new_file = resolve_below(copy, path)
            new_file.parent.mkdir(parents=True, exist_ok=True)
            new_file.write_bytes(text.encode())
            after = self._check(copy, ".")
            changes = self._words(place, old, text)
        new = list(_find_added(before, after))
        proposal = _Proposal(path, old, text, sum(each["severity"] == "error" for each in new))
        identifier = secrets.token_hex(4)
        self._proposals[identifier] = proposal
        while len(self._proposals) > _MAX_PROPOSALS:
            self._proposals.popitem(last=False)
        lines = ((old or "").splitlines(keepends=True), text.splitlines(keepends=True))
        return {
            "id": identifier,
            "diff": "".join(difflib.unified_diff(*lines, path if old is not None else os.devnull, path)),
            "changes": changes,
            "new_findings": new,
            "solved_findings": list(_find_added(after, before)),
        }

    def apply_edit(self, id: str) -> str:  # noqa: A002 - the key of `propose_edit`
        """Write a proposed edit, if it causes no new error and the file is still as it was."""
        self._require(self.may_edit, "--allow-edit")
        proposal = self._proposals.get(id)
        if proposal is None:
            raise AgentToolError(f"there is no proposal {id}; call propose_edit again")
        if proposal.errors:
            raise AgentToolError("the edit causes new errors; see new_findings of propose_edit")
        file = self._design_file(proposal.path)
        self._known_outputs()
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            replace_text(file, proposal.old, proposal.new)
        except OSError as error:
            raise AgentToolError(f"{proposal.path}: {error.strerror or error}; call propose_edit again") from error
        del self._proposals[id]
        return f"wrote {proposal.path}"

    def generate(self, path: str = ".") -> str:
        """Generate the code of a design or of all designs; edits of generated files are kept or reported."""
        self._require(self.may_edit, "--allow-edit")
        for out in self._output_folders() - self._known_outputs():
            if not out.is_relative_to(self.folder.resolve()):
                raise AgentToolError(
                    f"'generated' in project.yaml leads to {out}; only the user can choose this folder"
                )
        return self._vicode("gen", self._inside(path))

    def run(
        self, path: str, seconds: float = 10.0, inputs: Sequence[str] = (), seed: int = 0, profile: str = ""
    ) -> dict[str, Any]:
        """Run a design in simulated time: the state changes, and the last iterations of its trace with values.

        Without `inputs` it runs in the world of its project. Each of `inputs` is `NAME=VALUE`, or `TIME:NAME=VALUE` as
        in `2.5 s: Eyes.distance=0.4`; then hand-written components are replaced by these values.
        """
        self._require(self.may_run, "--allow-run")
        self._design_file(path)
        given = [part for each in inputs for part in ("--set", each)]
        with temporary_folder("trace") as place:
            trace = place / "trace.jsonl"
            options = ["--seconds", str(seconds), "--seed", str(seed), "--values", "--trace", str(trace), "--plain"]
            profiles = ["--profile", profile] if profile else []
            printed = self._vicode("run", self._inside(path), *options, *given, *profiles, codes=(0, 1))
            lines = trace.read_text(encoding="utf-8").splitlines() if trace.exists() else []
        # The first line describes the run, the last one sums it up.
        iterations = [record for record in map(json.loads, lines) if "tree" in record]
        kept, size = list[Any](), 0
        while iterations and (size := size + len(json.dumps(iterations[-1]))) < _MAX_TEXT:
            kept.insert(0, iterations.pop())
        return {"printed": printed, "left_out": len(iterations), "iterations": kept}

    def _check(self, folder: Path, path: str, *, deep: bool = False) -> list[dict[str, Any]]:
        options = ["--deep"] if deep else []
        printed = self._vicode_bytes("check", path, "--json", *options, codes=(0, 1), folder=folder)
        findings: list[dict[str, Any]] = json.loads(printed)
        return findings

    def _known_outputs(self) -> frozenset[Path]:
        if self._outputs is None:
            self._outputs = self._output_folders()
        return self._outputs

    def _output_folders(self) -> frozenset[Path]:
        """The folders of generated files of all projects."""
        from vicode.services.generation.project_output import output_folder
        from vicode.services.project_loader import load_projects

        try:
            loaded = load_projects([str(self.folder)])
        except OSError:
            # There is no design yet.
            return frozenset()
        return frozenset(output_folder(each).resolve() for each in loaded)

    def _words(self, place: Path, old: str | None, new: str) -> str:
        if old is None:
            return "a new file"
        for name, text in (("old.yaml", old), ("new.yaml", new)):
            (place / name).write_bytes(text.encode())
        printed = self._vicode("diff", "old.yaml", "new.yaml", codes=(0, 1, 2), folder=place)
        return printed.partition("\n")[2]

    def _copy(self, target: Path) -> None:
        """Copy what a check reads."""

        def ignored(folder: str, names: list[str]) -> list[str]:
            files = {name: Path(folder, name) for name in names}
            wanted = {name for name, file in files.items() if file.is_dir() or name.endswith(_COPIED)}
            return [name for name, file in files.items() if name not in wanted or name[0] == "." or file.is_symlink()]

        shutil.copytree(self.folder, target, ignore=ignored)

    def _component(self, path: str) -> str:
        """The component of a design."""
        return next((each["component"] for each in self.list_designs() if each["path"] == Path(path).as_posix()), "")

    def _design_file(self, path: str) -> Path:
        file = self.folder / self._inside(path)
        if file.suffix not in _SUFFIXES or any(part.startswith(".") for part in Path(path).parts):
            raise AgentToolError(f"{path} is no design; the name of a design ends with .yaml")
        return file

    def _read(self, file: Path) -> str | None:
        try:
            return file.read_bytes().decode("utf-8")
        except FileNotFoundError:
            return None
        except (OSError, UnicodeDecodeError) as error:
            raise AgentToolError(f"{file.name} cannot be read: {error}") from error

    def _inside(self, path: str) -> str:
        """A path relative to the folder; links that lead out of it are refused."""
        try:
            resolve_below(self.folder, path or ".")
        except OSError as error:
            raise AgentToolError(f"{path}: {error.strerror or error}") from error
        if path.startswith("-") or Path(path).is_absolute() or ".." in Path(path).parts:
            raise AgentToolError(f"{path} must be a path inside {self.folder.name}")
        return path

    def _require(self, is_allowed: bool, option: str) -> None:
        if not is_allowed:
            raise AgentToolError(f"not allowed; start the server with: vicode mcp {option}")

    def _vicode(self, *arguments: str, codes: Sequence[int] = (0,), folder: Path | None = None) -> str:
        return self._vicode_bytes(*arguments, codes=codes, folder=folder).decode(errors="replace")[:_MAX_TEXT]

    def _vicode_bytes(self, *arguments: str, codes: Sequence[int] = (0,), folder: Path | None = None) -> bytes:
        """Run a command and return its output.

        Raises:
            AgentToolError: It took too long, or its exit code is not one of `codes`.
        """
        command = [sys.executable, "-P", "-m", "vicode", *arguments]
        try:
            done = subprocess.run(
                command,
                cwd=folder or self.folder,
                stdin=subprocess.DEVNULL,
                capture_output=True,
                timeout=_LIMIT_S,
                check=False,
                env=fresh_environment(),
            )
        except subprocess.TimeoutExpired:
            raise AgentToolError(f"'vicode {arguments[0]}' took longer than {_LIMIT_S:g} s") from None
        if done.returncode not in codes:
            words = (done.stderr or done.stdout).decode(errors="replace").strip()
            raise AgentToolError(
                words[:_MAX_TEXT] or f"'vicode {arguments[0]}' failed with exit code {done.returncode}"
            )
        return done.stdout


def _without_links(page: str) -> str:
    """The text of a page of `vicode docs --format markdown`; a picture is a link in a link."""
    plain = _ANCHOR.sub("", _LINK.sub(r"\1", _LINK.sub(r"\1", page)))
    return re.sub(r"\n{3,}", "\n\n", re.sub(r"(?<!`)`( ?)`(?!`)", r"\1", plain)).strip() + "\n"


def _find_added(before: Sequence[dict[str, Any]], after: Sequence[dict[str, Any]]) -> Iterator[dict[str, Any]]:
    """The findings that are new, wherever they are; equal ones count."""
    known = Counter(map(_without_place, before))
    for each in after:
        known[_without_place(each)] -= 1
        if known[_without_place(each)] < 0:
            yield each


def _without_place(finding: dict[str, Any]) -> tuple[object, ...]:
    """What identifies a finding when lines before it change."""
    return tuple(finding.get(name) for name in ("code", "message", "file"))
