"""The files of an import, with what is left out and what cannot be read."""

import glob
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from vicode.findings import Finding, SourceLocation, get_rule
from vicode.importers.notes import ImportNote


class SourceError(Exception):
    """A file cannot be imported; `finding` says why and where."""

    def __init__(self, code: str, message: str, line: int, fix: str = "") -> None:
        super().__init__(message)
        self.code, self.message, self.line, self.fix = code, message, line, fix

    def finding(self, file: Path) -> Finding:
        location = SourceLocation(file=str(file), line=self.line, column=1)
        return Finding(rule=get_rule(self.code), message=self.message, fix=self.fix, location=location)


@dataclass(slots=True, kw_only=True)
class Sources:
    """Reads each file once; `folder` is where files are searched that others name."""

    folder: Path
    notes: list[ImportNote] = field(default_factory=list)
    errors: list[Finding] = field(default_factory=list)
    _read: dict[Path, bool] = field(default_factory=dict)

    def note(self, path: Path, line: int, text: str) -> None:
        self.notes.append(ImportNote(file=path, line=line, text=text))

    def contains(self, path: Path) -> bool:
        """Whether a file is in the folder, also by its real path."""
        return path.resolve().is_relative_to(self.folder.resolve())

    def find(self, named: str, user: Path, line: int) -> Path | None:
        """A file that another file names in a line: relative to that file, or anywhere in the folder.

        A file outside of the folder is an error, and not opened.
        """
        try:
            beside, last = user.parent / named, Path(named).name
            found = [beside, *sorted(self.folder.rglob(glob.escape(last)) if last else [])]
            inside = next((each for each in found if self.contains(each) and each.is_file()), None)
            outside = next((each for each in found if not self.contains(each)), None)
        except (OSError, ValueError):
            return None
        if inside is None and outside is not None and last not in ("", ".."):
            text = f"'{named}' is outside of the imported folder: it is not read"
            self.errors.append(SourceError("S805", text, line, "import a folder that contains it").finding(user))
        return inside

    def load(self, path: Path, read: Callable[[Path, bytes], None]) -> str:
        """Read a file; return its key, "" if it cannot be read, which becomes an error."""
        if path not in self._read:
            self._read[path] = True
            try:
                read(path, path.read_bytes())
            except (SourceError, RecursionError, MemoryError) as error:
                self._read[path] = False
                found = error if isinstance(error, SourceError) else SourceError("S805", "nested too deeply", 1)
                self.errors.append(found.finding(path))
        return str(path) if self._read[path] else ""
