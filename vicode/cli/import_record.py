"""Keeps the files of an imported behavior with its designs, as the base of later updates and merges."""

import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from vicode.xabsl.source_loader import ProgramSource, load_source

RECORD_FILE = "imported-behavior.json"
"""The name of the record in the folder of a project."""

_VERSION = 1


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportRecord:
    """The file with the agents, and the texts of all files by path relative to its folder."""

    agents: Path
    texts: dict[str, str]

    def source(self) -> ProgramSource:
        """The behavior as it was imported."""
        return load_source(self.agents, self._read)

    def is_current(self, source: ProgramSource) -> bool:
        """Whether a behavior has the same files."""
        return self.texts == source_texts(source)

    def _read(self, path: Path) -> str:
        text = self.texts.get(_relative(path, self.agents.resolve().parent))
        if text is None:
            raise FileNotFoundError(2, "No such file or directory")
        return text


def read_record(folder: Path) -> ImportRecord | None:
    """Read the record of a project, None if it has none.

    Raises:
        OSError: The record cannot be read.
    """
    path = folder / RECORD_FILE
    try:
        content: Any = json.loads(path.read_text("utf-8"))
        agents, texts = content["agents"], content["files"]
        is_sound = content["vicode"] == _VERSION and all(isinstance(text, str) for text in texts.values())
    except FileNotFoundError:
        return None
    except (ValueError, KeyError, TypeError, AttributeError):
        is_sound = False
    if not is_sound:
        raise OSError(f"{path} is damaged; restore it, or import again with --force")
    return ImportRecord(agents=folder / agents, texts=texts)


def format_record(folder: Path, source: ProgramSource) -> str:
    """The text of the record of a behavior whose designs are in a folder."""
    content = {
        "vicode": _VERSION,
        "agents": _relative(source.main, folder.resolve()),
        "files": source_texts(source),
    }
    return json.dumps(content, ensure_ascii=False, indent=1) + "\n"


def source_texts(source: ProgramSource) -> dict[str, str]:
    """The texts of the files by path relative to the folder of the main file."""
    return {_relative(path, source.main.parent): parsed.tokens.text for path, parsed in source.files.items()}


def _relative(path: Path, folder: Path) -> str:
    return Path(os.path.relpath(path, folder)).as_posix()
