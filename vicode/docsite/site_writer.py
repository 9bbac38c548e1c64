"""Writes a site into a folder: renders and writes only outdated files."""

import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache, lru_cache
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import vicode
from vicode.output import cache_path, remove_leftovers, resolve_below, write_atomically
from vicode.templating import template_files

GENERATED_HEADERS = (
    b'<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<meta name="generator" content="vicode docs">',
    b"<!-- vicode docs -->",
    b"/* vicode docs: ",
    b"# vicode docs: the order of the pages;",
    b".. vicode docs\n",
)
"""The first bytes of generated files. Changing one makes existing sites unrecognizable."""

_PAGES = (".css", ".html", ".js", ".md", ".rst", ".svg", ".yml")
_HEADER_BYTES = 200
# Libraries that affect the pages.
_LIBRARIES = ("jinja2", "markdown-it-py", "markupsafe", "pygments", "pygraphviz")


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannedFile:
    """A file to write; `key` is a digest of its inputs, so an unchanged file is not rendered."""

    path: str
    key: str
    render: Callable[[], str]


@dataclass(frozen=True, slots=True, kw_only=True)
class Manifest:
    """The state of a written folder: key and content digest of each file; `tool` is the version that wrote them."""

    tool: str = ""
    files: Mapping[str, tuple[str, str]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class SiteWriteResult:
    """The result of writing a site; `changed` are the files that were written or deleted.

    `foreign` are existing files that vicode did not write; if there are any, nothing is written.
    """

    manifest: Manifest
    changed: tuple[str, ...] = ()
    foreign: tuple[str, ...] = ()


def write_site(
    planned: Iterable[PlannedFile], out: Path, manifest: Manifest, on_progress: Callable[[int, int], None]
) -> SiteWriteResult:
    """Write outdated files and delete stale pages; `on_progress` receives the numbers of finished and all files."""
    wanted = {each.path: each for each in planned}
    there = {path: _find_existing(out / path) for path in wanted}
    stale = {path: _find_existing(out / path) for path in _pages_in(out) if path not in wanted}
    foreign = tuple(path for path, old in there.items() if old is not None and not old.is_generated)
    if foreign:
        return SiteWriteResult(manifest=manifest, foreign=foreign)
    known = manifest.files if manifest.tool == tool_digest() else {}
    files, touched = dict[str, tuple[str, str]](), []
    out.mkdir(parents=True, exist_ok=True)
    remove_leftovers(out)
    for path, each in wanted.items():
        old = there[path]
        digest = old.digest if old else ""
        if known.get(path) != (each.key, digest):
            text = each.render()
            made = _digest(text.encode())
            if digest != made:
                write_atomically(resolve_below(out, path), text, is_durable=False)
                touched.append(path)
            digest = made
        files[path] = (each.key, digest)
        on_progress(len(files), len(wanted))
    for path, old in stale.items():
        if old is not None and old.is_generated:
            (out / path).unlink()
            touched.append(path)
    return SiteWriteResult(manifest=Manifest(tool=tool_digest(), files=files), changed=tuple(touched))


def manifest_path(out: Path) -> Path:
    """The path of the manifest of a folder."""
    return cache_path(out, "docs")


def results_path(out: Path) -> Path:
    """The path of the kept results of a folder."""
    return cache_path(out, "docs-results")


def load_manifest(file: Path) -> Manifest:
    """Load a manifest; return an empty one if it cannot be read."""
    try:
        data = json.loads(file.read_bytes())
        files = {str(path): (str(key), str(digest)) for path, (key, digest) in data["files"].items()}
        return Manifest(tool=str(data["tool"]), files=files)
    except (OSError, ValueError, TypeError, KeyError, AttributeError):
        return Manifest()


def save_manifest(manifest: Manifest, file: Path) -> None:
    """Save a manifest; on failure, the next build is not incremental."""
    data = {"tool": manifest.tool, "files": manifest.files}
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(file, json.dumps(data, indent=0, sort_keys=True) + "\n")
    except OSError:
        return


def is_generated(file: Path) -> bool:
    """Whether vicode wrote a file, by its first bytes."""
    with file.open("rb") as stream:
        return _has_header(stream.read(_HEADER_BYTES))


@cache
def tool_digest() -> str:
    """A digest of the code, templates and library versions that determine the pages."""
    package = Path(vicode.__file__).parent
    sources = sorted(path for path in package.rglob("*.py") if path.relative_to(package).parts[0] != "editor")
    digest = sha256()
    for path in (*sources, *template_files("docsite")):
        digest.update(f"{path.parent.name}/{path.name}\n".encode())
        digest.update(path.read_bytes())
    digest.update("\n".join(f"{name} {_version_of(name)}" for name in _LIBRARIES).encode())
    return digest.hexdigest()[:32]


def _version_of(library: str) -> str:
    try:
        return version(library)
    except PackageNotFoundError:
        return ""


def _pages_in(out: Path) -> list[str]:
    return sorted(each.name for each in out.glob("*.*") if each.suffix in _PAGES)


@dataclass(frozen=True, slots=True, kw_only=True)
class _ExistingFile:
    digest: str
    is_generated: bool


def _find_existing(path: Path) -> _ExistingFile | None:
    try:
        status = path.stat()
        return _read_existing(path, status.st_mtime_ns, status.st_size, status.st_ino)
    except (FileNotFoundError, NotADirectoryError):
        return None


@lru_cache(maxsize=1 << 14)
def _read_existing(path: Path, _changed_ns: int, _size: int, _number: int) -> _ExistingFile:
    content = path.read_bytes()
    return _ExistingFile(digest=_digest(content), is_generated=_has_header(content[:_HEADER_BYTES]))


def _has_header(content: bytes) -> bool:
    return content.replace(b"\r\n", b"\n").startswith(GENERATED_HEADERS)


def _digest(content: bytes) -> str:
    return sha256(content).hexdigest()[:32]
