"""A cache of build results, keyed by their inputs, so that an edit rebuilds only what depends on it.

Results live as long as the process. Those that are slow to create and small, layouts and generated code, are also kept
in a file for the next process, under a digest of their inputs.
"""

import json
from collections.abc import Callable, Hashable
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any, Generic, TypeVar, cast

from vicode.output import write_atomically

CachedValue = TypeVar("CachedValue")


@dataclass(frozen=True, slots=True)
class StoredForm(Generic[CachedValue]):
    """How a result is written as JSON and read again; `encode` returns None for one that must not be kept."""

    encode: Callable[[CachedValue], Any]
    decode: Callable[[Any], CachedValue]


class StoredResults:
    """Results of earlier processes in a JSON file; those that this process did not use are dropped.

    A file that cannot be read, that another version wrote or that is ignored counts as empty. `tool` identifies the
    version.
    """

    def __init__(self, file: Path, tool: str, *, is_ignored: bool = False) -> None:
        self._file, self._tool = file, tool
        self._known = {} if is_ignored else _load_results(file, tool)
        self._used: dict[str, Any] = {}

    def find(self, digest: str, form: StoredForm[CachedValue]) -> CachedValue | None:
        """The kept result of a digest; None if there is none."""
        try:
            value = form.decode(self._known[digest])
        except (KeyError, ValueError, TypeError, AttributeError, IndexError):
            return None
        self._used[digest] = self._known[digest]
        return value

    def keep(self, digest: str, value: CachedValue, form: StoredForm[CachedValue]) -> None:
        encoded = form.encode(value)
        if encoded is not None:
            self._used[digest] = encoded

    def save(self) -> None:
        """Write the results; on failure, the next process creates them again."""
        if self._used.keys() == self._known.keys():
            return
        try:
            self._file.parent.mkdir(parents=True, exist_ok=True)
            text = json.dumps({"tool": self._tool, "results": self._used}, separators=(",", ":"))
            write_atomically(self._file, text + "\n", is_durable=False)
        except (OSError, ValueError):
            return
        self._known = dict(self._used)


def _load_results(file: Path, tool: str) -> dict[str, Any]:
    try:
        data = json.loads(file.read_bytes())
        return dict(data["results"]) if data["tool"] == tool else {}
    except (OSError, ValueError, TypeError, KeyError, RecursionError):
        return {}


class _HashedKey:
    """A value with a cached hash: hashing a design is slow."""

    __slots__ = ("_hash", "_value")

    def __init__(self, value: Hashable) -> None:
        self._value, self._hash = value, hash(value)

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _HashedKey) and self._hash == other._hash and self._value == other._value


class BuildCache:
    """Keeps the results used in the latest build, and in `stored` those with a stored form."""

    def __init__(self, stored: StoredResults | None = None) -> None:
        self._stored = stored
        self._previous: dict[_HashedKey, object] = {}
        self._current: dict[_HashedKey, object] = {}

    def get_or_create(
        self, kind: str, key: Hashable, make: Callable[[], CachedValue], form: StoredForm[CachedValue] | None = None
    ) -> CachedValue:
        """Return the cached value of a key, or create it. The key must contain all inputs of `make`."""
        whole = _HashedKey((kind, key))
        if whole not in self._current:
            is_known = whole in self._previous
            self._current[whole] = self._previous[whole] if is_known else self._find_or_make(kind, key, make, form)
        return cast("CachedValue", self._current[whole])

    def evict_unused(self) -> None:
        """Drop the values that the current build did not use. Call it after each build."""
        self._previous, self._current = self._current, {}

    def save(self) -> None:
        if self._stored is not None:
            self._stored.save()

    def _find_or_make(
        self, kind: str, key: Hashable, make: Callable[[], CachedValue], form: StoredForm[CachedValue] | None
    ) -> CachedValue:
        if self._stored is None or form is None:
            return make()
        digest = compute_digest(kind, key)
        found = self._stored.find(digest, form)
        if found is None:
            found = make()
            self._stored.keep(digest, found, form)
        return found


def compute_digest(*values: object) -> str:
    """Return a digest of frozen values that is the same in every process."""
    return sha256("\n".join(map(repr, values)).encode("utf-8", "surrogatepass")).hexdigest()[:32]
