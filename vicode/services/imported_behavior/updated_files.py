"""The files of an update: the designs with their errors before it, and the XABSL files and the record after it."""

import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from vicode.check import find_errors
from vicode.findings import Finding
from vicode.output import resolve_below, write_atomically
from vicode.services.imported_behavior.import_record import RECORD_FILE, format_record
from vicode.store import OpenProject, locate_findings
from vicode.transactions import replace_files
from vicode.xabsl.patching.program_patch import FileTexts
from vicode.xabsl.source_loader import ProgramSource, load_source
from vicode.xabsl.source_text import ReadText, SourceEncodingError, decode_source, encode_source


def list_errors(opened: OpenProject) -> list[Finding]:
    """The errors of designs that prevent generating XABSL."""
    project = replace(opened.project, languages=("xabsl",))
    findings = [*opened.findings, *locate_findings(find_errors(project), opened)]
    return [each for each in findings if each.severity == "error"]


def find_faulty_designs(errors: Iterable[Finding], opened: OpenProject) -> set[str] | None:
    """The designs with errors; None if one does not belong to a single design."""
    unread = {file.name: name for name, file in _unreadable(opened)}
    found = set()
    for error in errors:
        component = error.subject.component if error.subject else ""
        if not component and error.location is not None:
            component = unread.get(Path(error.location.file).name, "")
        if not component:
            return None
        found.add(component)
    return found


def _unreadable(opened: OpenProject) -> Iterator[tuple[str, Path]]:
    """The unreadable design files whose names are unique, with the names of their components."""
    names = {file: name for name, file in opened.project.unreadable}
    for file in opened.broken_files:
        if file.name in names and sum(other.name == file.name for other in opened.broken_files) == 1:
            yield names[file.name], file


def write_update(
    texts: FileTexts,
    source: ProgramSource,
    folder: Path,
    designs: Mapping[str, str],
    read: ReadText,
    *,
    has_comments: bool,
) -> None:
    """Write all files or none, then the record of the import."""
    if texts:
        contents = _encoded(texts, source)
        root = behavior_folder(source)
        replace_files(root, {path.relative_to(root).as_posix(): content for path, content in contents.items()})
    record = folder / RECORD_FILE
    text = format_record(folder, load_source(source.main, read), designs, has_comments=has_comments)
    if not record.exists() or record.read_text("utf-8") != text:
        write_atomically(resolve_below(folder, RECORD_FILE), text)


def behavior_folder(source: ProgramSource) -> Path:
    """The folder that contains all files of a behavior."""
    return Path(os.path.commonpath([path.parent for path in source.files]))


def _encoded(texts: FileTexts, source: ProgramSource) -> Mapping[Path, bytes | None]:
    """Encode each text like its file, that of a moved file like the old one, a new one like the main file.

    Raises:
        OSError: A file changed since it was read, or its encoding does not have a character.
    """
    main_encoding = source.encodings[source.main]
    moved = {path.name: source.encodings[path] for path, text in texts.items() if text is None}
    encoded: dict[Path, bytes | None] = {}
    for path, text in texts.items():
        encoding = source.encodings.get(path) or moved.get(path.name) or main_encoding.removesuffix("-sig")
        old = path.read_bytes() if path in source.files else None
        if old is not None and decode_source(old, encoding).text != source.files[path].tokens.text:
            raise OSError(f"{path} was changed at the same time; run the command again")
        try:
            encoded[path] = None if text is None else encode_source(text, encoding, old)
        except SourceEncodingError as error:
            raise OSError(f"{path} {error}") from error
    return encoded
