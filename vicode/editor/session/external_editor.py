"""Opens code of a design in the user's own editor, at its line in the generated file."""

import contextlib
import os
import shlex
import subprocess
import threading
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path, PurePath
from urllib.parse import quote

from vicode.editor.session.document import DocumentSession
from vicode.editor.session.workspace import Workspace
from vicode.findings import DesignPath
from vicode.generators import UnsoundDesignError, list_regions
from vicode.platform import session_options
from vicode.regions import find_regions, get_comment_prefix

_VSCODE = ("-g", "{file}:{line}")
_PLUS = ("+{line}", "{file}")
_GRAPHICAL = {
    **dict.fromkeys(("code", "code-insiders", "codium", "vscodium", "cursor"), _VSCODE),
    **dict.fromkeys(("subl", "sublime_text", "zed"), ("{file}:{line}",)),
    **dict.fromkeys(("gedit", "gvim", "geany", "xed", "pluma", "mousepad"), _PLUS),
    **dict.fromkeys(("pycharm", "idea"), ("--line", "{line}", "{file}")),
    "kate": ("--line", "{line}", "{file}"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class CodePlace:
    """A line of a file."""

    file: Path
    line: int

    @property
    def text(self) -> str:
        return f"{self.file}:{self.line}"

    @property
    def vscode_url(self) -> str:
        return f"vscode://file{quote(self.file.as_posix())}:{self.line}"


@dataclass(frozen=True, slots=True, kw_only=True)
class ExternalEditor:
    """How code is opened: with a command, if there is one, or by a link; only on the machine of the server.

    The arguments contain "{file}" and "{line}".
    """

    arguments: tuple[str, ...] = ()
    is_local: bool = False

    @property
    def name(self) -> str:
        """The name of the command, empty if there is none."""
        return PurePath(self.arguments[0]).name if self.arguments else ""

    def open(self, place: CodePlace) -> None:
        """Start the command, and do not wait for it.

        Raises:
            OSError: It cannot be started.
        """
        values = {"{file}": str(place.file), "{line}": str(place.line)}
        command = [_filled(part, values) for part in self.arguments]
        null = subprocess.DEVNULL
        process = subprocess.Popen(command, stdin=null, stdout=null, stderr=null, **session_options())
        # An ended process that no one waits for stays in the process table.
        threading.Thread(target=process.wait, daemon=True).start()


def _filled(part: str, values: Mapping[str, str]) -> str:
    for name, value in values.items():
        part = part.replace(name, value)
    return part


def parse_command(text: str) -> tuple[str, ...]:
    """The arguments of a command such as "code -g {file}:{line}"; without "{file}", the file is appended.

    Raises:
        ValueError: It is empty, or a quote is not closed.
    """
    arguments = tuple(shlex.split(text))
    if not arguments:
        raise ValueError(text)
    return arguments if any("{file}" in part for part in arguments[1:]) else (*arguments, "{file}")


def find_command(environment: Mapping[str, str] = os.environ) -> tuple[str, ...]:
    """The arguments for the editor in $VISUAL or $EDITOR, empty if it needs a terminal or is unknown."""
    for name in ("VISUAL", "EDITOR"):
        with contextlib.suppress(ValueError, IndexError):
            program = shlex.split(environment.get(name, ""))[0]
            if PurePath(program).name in _GRAPHICAL:
                return (program, *_GRAPHICAL[PurePath(program).name])
    return ()


def find_place(
    workspace: Workspace, document: DocumentSession, path: DesignPath, language: str = "python"
) -> CodePlace | None:
    """The line of code of a design in its generated files of one language; None if there are none."""
    component = document.design.component
    paths = [each for each in workspace.generated_paths.find(workspace, component) if each.startswith(f"{language}/")]
    files = [workspace.output_folder / each for each in paths if (workspace.output_folder / each).is_file()]
    ids: set[str] = set()
    with contextlib.suppress(UnsoundDesignError):
        regions = list_regions(workspace.project, component, language)
        ids = {id_ for id_, at in regions.items() if at == path or (len(at) > 1 and at[:-1] == path[:-1])}
    for file in files:
        text = file.read_text("utf-8", errors="replace")
        for region in find_regions(text, get_comment_prefix(file.name)).regions:
            if region.id in ids:
                return CodePlace(file=file, line=region.line + 1)
    return CodePlace(file=files[0], line=1) if files else None
