"""Saves a design or a project into its old text: what did not change keeps every byte."""

import itertools
import sys

from vicode.model.design import Design
from vicode.model.project import Project
from vicode.store.documents import read_record
from vicode.store.encode import encode_design, encode_project
from vicode.store.format import DESIGN, PROJECT
from vicode.store.patcher import CannotPatchError, Patcher
from vicode.store.sanitize import sanitize_design
from vicode.store.schema_types import FormatValue, RecordSchema
from vicode.store.tree_diff import TargetBuilder
from vicode.store.typed_node import TypedNode
from vicode.store.yaml_writer import YamlStyle, detect_style, format_document

# Everything that differs is replaced by itself; if that fails, whole states and declarations, then whole sections.
_MAX_PATCH_DEPTHS = (sys.maxsize, 3, 2)


def save_design(design: Design, old_text: str = "") -> str:
    """The new text of a design file: the old one with what differs replaced; without an old one a fresh text.

    Where an expression is nothing but spaces none is written, as none could be read.

    Raises:
        ValueError: Two states, uses or declarations of the design have one name, which no mapping can hold; or a name
            is longer than YAML allows.
    """
    text = _save(DESIGN, encode_design(design), old_text)
    if text is None:
        text = _save(DESIGN, encode_design(sanitize_design(design)), old_text)
    return _require_text(text)


def save_project_file(project: Project, old_text: str = "") -> str:
    """The new text of a project.yaml, like `save_design`; the designs of the project are not part of it."""
    return _require_text(_save(PROJECT, encode_project(project), old_text))


def _require_text(text: str | None) -> str:
    if text is None:
        raise ValueError("something in it is more than YAML can hold, such as a name of a thousand letters")
    return text


def _save(shape: RecordSchema, data: FormatValue, old_text: str) -> str | None:
    """The text that says the data; None when no text does."""
    _report, old = read_record(old_text, "", shape)
    if old is None:
        return _format_new_text(shape, data, old_text)
    if old.value == data:
        return old_text
    is_windows = "\r\n" in old_text and old_text.count("\r\n") == old_text.count("\n")
    plain = old_text.replace("\r\n", "\n") if is_windows else old_text
    for deepest in _MAX_PATCH_DEPTHS:
        new = _patch_text(shape, data, plain, old if plain is old_text else None, deepest)
        for text in () if new is None else _ending_variants(new, is_ended=plain.endswith("\n")):
            saved = text.replace("\n", "\r\n") if is_windows else text
            if _reads_as(shape, saved, data):
                return saved
    return _format_new_text(shape, data, old_text)


def _ending_variants(new: str, *, is_ended: bool) -> tuple[str, ...]:
    """The text, first as the old one ended: without a line break a block of code at the end would lose its own."""
    return (new,) if is_ended else (new.removesuffix("\n"), new)


def _patch_text(shape: RecordSchema, data: FormatValue, text: str, old: TypedNode | None, deepest: int) -> str | None:
    """The new text, ending in a line break whether or not the old one did."""
    ended = text if text.endswith("\n") else text + "\n"
    if old is None or ended is not text:
        _report, old = read_record(ended, "", shape)
    if old is None:
        return None
    wish = TargetBuilder(ended, max_depth=deepest).build(shape, data, old)
    patcher = Patcher(text=ended, style=detect_style(old.node, ended))
    try:
        patcher.patch_document(old.node, wish)
        return patcher.patched_text()
    except CannotPatchError:
        return None


def _reads_as(shape: RecordSchema, text: str, data: FormatValue) -> bool:
    _report, read = read_record(text, "", shape)
    return read is not None and read.value == data


def _format_new_text(shape: RecordSchema, data: FormatValue, old_text: str) -> str | None:
    """A text without a model, None if it says something else; the comments that an old one began with are kept."""
    lines = itertools.takewhile(lambda line: line.startswith("#") or not line.strip(), old_text.splitlines())
    header = "".join(f"{line}\n" for line in lines if line.isprintable())
    new = header.lstrip("\n") + format_document(TargetBuilder("").build(shape, data), YamlStyle())
    return new if _reads_as(shape, new, data) else None
