"""Saves a design or project by patching its old text: unchanged parts keep each byte."""

import itertools
import sys
from collections import Counter

from vicode.model.design import Design
from vicode.model.lowering import describe_origin, find_lost_edit
from vicode.model.project import Project
from vicode.store.codec import encode_design, encode_project
from vicode.store.documents import read_record
from vicode.store.format import DESIGN
from vicode.store.kept_comments import keep_comments
from vicode.store.patcher import CannotPatchError, Patcher
from vicode.store.project_format import PROJECT
from vicode.store.sanitize import sanitize_design
from vicode.store.schema_types import FormatValue, RecordSchema
from vicode.store.tree_diff import TargetBuilder
from vicode.store.typed_node import TypedNode
from vicode.store.unread import UnreadContentError, find_unread, require_unread
from vicode.store.yaml_tree import find_undefined_aliases
from vicode.store.yaml_writer import YamlStyle, detect_style, format_document

# First, only the differing values are replaced; if that fails, whole states and declarations, then whole sections.
_MAX_PATCH_DEPTHS = (sys.maxsize, 3, 2)


def save_design(design: Design, old_text: str = "") -> str:
    """Return the new text of a design file: the patched old text, or a new text if there is none.

    Expressions that consist of spaces are dropped, as they cannot be read back.

    Raises:
        UnreadContentError: Content of the old text that was not understood would be lost.
        ValueError: An edit of something derived (`vicode.model.lowering`) would be lost; states, uses or declarations
            have duplicate names, or a name is longer than YAML allows.
    """
    origin = find_lost_edit(design)
    if origin:
        raise ValueError(f"the change is in a part that is derived from {describe_origin(origin)}; change that instead")
    text = _save(DESIGN, encode_design(design), old_text)
    if text is None:
        text = _save(DESIGN, encode_design(sanitize_design(design)), old_text)
    return _require_text(text)


def save_extracted(design: Design, whole_text: str) -> str:
    """The text of a new file for a part of a design, with the comments and the layout of this part of its text."""
    lines = itertools.dropwhile(lambda line: line.startswith("#"), whole_text.splitlines(keepends=True))
    try:
        return save_design(design, "".join(lines))
    except UnreadContentError:
        return save_design(design)


def save_project_file(project: Project, old_text: str = "") -> str:
    """Return the new text of a project.yaml, without the designs of the project; see `save_design`."""
    return _require_text(_save(PROJECT, encode_project(project), old_text))


def _require_text(text: str | None) -> str:
    if text is None:
        raise ValueError("a value cannot be written as YAML, such as a name of more than 1000 characters; shorten it")
    return text


def _save(schema: RecordSchema, data: FormatValue, old_text: str) -> str | None:
    """Return a text with this value; None if there is none.

    Raises:
        UnreadContentError: Each such text would lose content that was not understood.
    """
    _report, old = read_record(old_text, "", schema)
    if old is None:
        if any(line.strip() and not line.startswith("#") for line in old_text.splitlines()):
            raise UnreadContentError("the file is not readable; correct it first")
        return _format_new_text(schema, data, old_text)
    if old.value == data:
        return old_text
    unread = find_unread(old, old_text)
    is_windows = "\r\n" in old_text and old_text.count("\r\n") == old_text.count("\n")
    plain = old_text.replace("\r\n", "\n") if is_windows else old_text
    for deepest in _MAX_PATCH_DEPTHS:
        new = _patch_text(schema, data, plain, old if plain is old_text else None, deepest)
        for variant in () if new is None else _ending_variants(new, is_ended=plain.endswith("\n")):
            text = keep_comments(plain, variant, is_project_file=schema is PROJECT)
            saved = text.replace("\n", "\r\n") if is_windows else text
            if _reads_as(schema, saved, data, unread) and not _lost_anchors(plain, text):
                return saved
    require_unread(unread, old, old_text)
    formatted = _format_new_text(schema, data, old_text)
    return None if formatted is None else keep_comments(plain, formatted, is_project_file=schema is PROJECT)


def _lost_anchors(old: str, new: str) -> set[str | None]:
    """The anchors that a new text lacks: other programs cannot read a file with aliases of them."""
    return find_undefined_aliases(new) - find_undefined_aliases(old) if "*" in old and "&" in old else set()


def _ending_variants(new: str, *, is_ended: bool) -> tuple[str, ...]:
    """The text with and without final line break, as in the old text first; a final block scalar may need the other."""
    return (new,) if is_ended else (new.removesuffix("\n"), new)


def _patch_text(schema: RecordSchema, data: FormatValue, text: str, old: TypedNode | None, deepest: int) -> str | None:
    """Return the patched text with a final line break; None if it cannot be patched."""
    ended = text if text.endswith("\n") else text + "\n"
    if old is None or ended is not text:
        _report, old = read_record(ended, "", schema)
    if old is None:
        return None
    target = TargetBuilder(ended, max_depth=deepest).build(schema, data, old)
    patcher = Patcher(text=ended, style=detect_style(old.node, ended))
    try:
        patcher.patch_document(old.node, target)
        return patcher.patched_text()
    except CannotPatchError:
        return None


def _reads_as(schema: RecordSchema, text: str, data: FormatValue, unread: Counter[str] | None = None) -> bool:
    """Whether a text has this value and still contains what was not understood."""
    _report, read = read_record(text, "", schema)
    return read is not None and read.value == data and (not unread or not unread - find_unread(read, text))


def _format_new_text(schema: RecordSchema, data: FormatValue, old_text: str) -> str | None:
    """Return a new text after the head comment of the old one; None if the value cannot be written."""
    lines = itertools.takewhile(lambda line: line.startswith("#") or not line.strip(), old_text.splitlines())
    header = "".join(f"{line}\n" for line in lines if line.isprintable())
    new = header.lstrip("\n") + format_document(TargetBuilder("").build(schema, data), YamlStyle())
    return new if _reads_as(schema, new, data) else None
