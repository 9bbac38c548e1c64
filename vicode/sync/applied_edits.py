"""Remembers which edits of regions a design contains while the file with the edit has not been generated again.

Without it, the mark of such a region still names the text from before the edit: a later change of the same lines in the
design would look like a conflict. The same holds for a file that was generated again, and then saved by a text editor
that had read it before.
"""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

from vicode.regions import find_regions, get_comment_prefix
from vicode.transactions import STATE_FOLDER, replace_files

APPLIED_FILE = f"{STATE_FOLDER}/applied.json"
"""The file with the records, relative to the folder of generated files."""

RegionKey = tuple[str, str]
"""The path of a generated file and the id of a region in it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordedEdit:
    """An edit of a region that the design contains, or that a user decided against.

    Attributes:
        checksum: The checksum in the mark of the region.
        file_text: The text of the region in the file.
        design_text: The text of the design before, None if the user decided against the edit.
    """

    checksum: str
    file_text: str
    design_text: str | None


def read_applied(folder: Path) -> dict[RegionKey, RecordedEdit]:
    """Read the records of a folder of generated files; empty if there are none or they cannot be read."""
    try:
        rows = json.loads((folder / APPLIED_FILE).read_text("utf-8"))
        return {(str(path), str(region)): _read_edit(**record) for path, region, record in rows}
    except (OSError, ValueError, TypeError):
        return {}


def _read_edit(*, checksum: object, file_text: object, design_text: object) -> RecordedEdit:
    before = None if design_text is None else str(design_text)
    return RecordedEdit(checksum=str(checksum), file_text=str(file_text), design_text=before)


def format_applied(applied: Mapping[RegionKey, RecordedEdit]) -> str:
    return json.dumps([[*key, asdict(edit)] for key, edit in sorted(applied.items())], indent=1) + "\n"


def still_applied(
    recorded: Mapping[RegionKey, RecordedEdit], new: Mapping[RegionKey, RecordedEdit], texts: Mapping[str, str]
) -> dict[RegionKey, RecordedEdit]:
    """The records after files were generated.

    A record ends when its region is generated with the same text again, since the same edit is a new one then. So does
    the record that a user decided against an edit.

    Args:
        recorded: The records before.
        new: The edits that the designs contain since.
        texts: The generated texts, by path.
    """
    records = {**recorded, **new}
    checksums = {
        (path, region.id): region.checksum
        for path, text in texts.items()
        if any(path == key[0] for key in records)
        for region in find_regions(text, get_comment_prefix(path)).regions
    }
    return {
        key: edit
        for key, edit in records.items()
        if key[0] not in texts
        or (edit.design_text is not None and key in checksums and checksums[key] != edit.checksum)
    }


def record_applied(folder: Path, changes: Mapping[RegionKey, RecordedEdit | None]) -> None:
    """Change the records of a folder of generated files; None removes a record.

    Raises:
        OSError: The records cannot be written.
    """
    before = read_applied(folder)
    changed = {**before, **changes}
    now = {key: edit for key, edit in changed.items() if edit is not None}
    if now != before:
        replace_files(folder, {APPLIED_FILE: format_applied(now)})
