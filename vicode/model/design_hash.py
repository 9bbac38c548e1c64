"""A hash that identifies the content of a design with all it uses, whatever its file looks like."""

import hashlib
import json
from dataclasses import MISSING, Field, fields, is_dataclass
from functools import lru_cache
from typing import Any

from vicode.model.design import Design
from vicode.model.project import Project

HASH_LENGTH = 12
# What only diagrams show, and what is only proved or monitored.
_WITHOUT_EFFECT = frozenset({"at", "label_at", "color", "frames", "notes", "properties", "assume"})
_DECLARED = ("world", "enumerations", "constants", "components")


def hash_design(project: Project, component: str) -> str:
    """The first digits of the SHA-256 of a design, the designs it uses, and the declarations of the project.

    Comments, layout, positions, properties and assumptions do not count. Fields with their default do not either, so
    that the hash stays the same when the format gets a new key.
    """
    designs = [_canonical_text(design) for design in _used_designs(project, component)]
    declared = [_canonical(getattr(project, section)) for section in _DECLARED]
    text = json.dumps([designs, declared], ensure_ascii=True, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:HASH_LENGTH]


def _used_designs(project: Project, component: str) -> list[Design]:
    """The design of a component and those it uses, directly or not, by name."""
    by_name = {design.component: design for design in project.designs}
    found: set[str] = set()
    waiting = [component]
    while waiting:
        name = waiting.pop()
        if name in by_name and name not in found:
            found.add(name)
            waiting += [use.component for use in by_name[name].uses]
    return [by_name[name] for name in sorted(found)]


@lru_cache(maxsize=4096)
def _canonical_text(design: Design) -> str:
    return json.dumps(_canonical(design), ensure_ascii=True, sort_keys=True)


def _canonical(value: Any) -> Any:
    """A value as JSON data: records with their type, without defaults and layout."""
    if isinstance(value, tuple):
        return [_canonical(item) for item in value]
    if not is_dataclass(value):
        return value
    given = {
        each.name: _canonical(getattr(value, each.name))
        for each in fields(value)
        if each.init and each.name not in _WITHOUT_EFFECT and getattr(value, each.name) != _default(each)
    }
    return [type(value).__name__, given]


def _default(field: "Field[Any]") -> object:
    if field.default_factory is not MISSING:
        return field.default_factory()
    return field.default
