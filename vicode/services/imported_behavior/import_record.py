"""Keeps the files of an imported behavior with its designs, as the base of later updates and merges."""

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from vicode.xabsl.source_loader import ProgramSource, load_source

RECORD_FILE = "imported-behavior.json"
"""The name of the record in the folder of a project."""

_VERSION = 1


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportRecord:
    """What was imported.

    Attributes:
        agents: The file with the agents.
        texts: The texts of all files by path relative to its folder.
        designs: The path of each design, relative to the project, when it last agreed with the behavior.
        has_comments: Whether the designs show each comment at its place, so that an update can write them.
    """

    agents: Path
    texts: dict[str, str]
    designs: Mapping[str, str] = field(default_factory=dict)
    has_comments: bool = True

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
        # Records of earlier versions have no designs, and other places of comments.
        designs, has_comments = content.get("designs", {}), content.get("comments", False) is True
        strings = [*texts.values(), *designs.values()]
        is_sound = content["vicode"] == _VERSION and all(isinstance(text, str) for text in strings)
    except FileNotFoundError:
        return None
    except (ValueError, KeyError, TypeError, AttributeError):
        is_sound = False
    if not is_sound:
        raise OSError(f"{path} is damaged; restore it, or import again with --force")
    return ImportRecord(agents=folder / agents, texts=texts, designs=designs, has_comments=has_comments)


def format_record(folder: Path, source: ProgramSource, designs: Mapping[str, str], *, has_comments: bool = True) -> str:
    """The text of the record of a behavior whose designs, by path relative to it, are in a folder."""
    content = {
        "vicode": _VERSION,
        "agents": _relative(source.main, folder.resolve()),
        "comments": has_comments,
        "designs": dict(sorted(designs.items())),
        "files": source_texts(source),
    }
    return json.dumps(content, ensure_ascii=False, indent=1) + "\n"


def source_texts(source: ProgramSource) -> dict[str, str]:
    """The texts of the files by path relative to the folder of the main file."""
    return {_relative(path, source.main.parent): parsed.tokens.text for path, parsed in source.files.items()}


def _relative(path: Path, folder: Path) -> str:
    return Path(os.path.relpath(path, folder)).as_posix()
