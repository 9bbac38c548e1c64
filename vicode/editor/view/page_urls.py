"""The URLs of the editor's pages, with the selection and the navigation trail."""

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from typing import cast
from urllib.parse import parse_qsl, quote, unquote, urlencode, urlsplit

from vicode.editor.view.selection import ItemKind, ItemRef

# Names cannot contain these characters; a title of a frame comes last.
_KIND_SEPARATOR, _TRAIL_SEPARATOR = ":", ","
_KINDS = ("components", "links", "frames", "notes")
_MAX_TRAIL = 6
_SAFE = "/:,@"


def design_url(key: str, component: str, selected: ItemRef | None = None, trail: Sequence[str] = ()) -> str:
    """The URL of a design; `key` is that of the project, `trail` the components visited before."""
    query = {}
    if selected is not None and selected.kind != "design":
        query["select"] = format_selection(selected)
    if trail:
        query["from"] = _TRAIL_SEPARATOR.join(trail)
    path = f"/design/{quote(key, safe='')}/{quote(component, safe='')}"
    return f"{path}?{urlencode(query, safe=_SAFE)}" if query else path


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignAddress:
    """What the URL of a design says; `trail` is its text, and neither design nor selected item need exist."""

    key: str
    component: str
    selected: ItemRef | None = None
    trail: str = ""


def parse_design_url(url: str) -> DesignAddress | None:
    """The parts of the URL of a design, None if it is another URL."""
    parts = urlsplit(url)
    match parts.path.split("/"):
        case ["", "design", key, component]:
            query = dict(parse_qsl(parts.query))
            return DesignAddress(
                key=unquote(key),
                component=unquote(component),
                selected=parse_selection(query.get("select", "")),
                trail=query.get("from", ""),
            )
        case _:
            return None


def broken_file_url(key: str, file: str) -> str:
    """The URL of the page that edits the text of an unreadable design file."""
    return f"/broken/{quote(key, safe='')}/{quote(file)}"


def docs_url(key: str, file: str, anchor: str = "") -> str:
    return f"/docs/{quote(key, safe='')}/{quote(file)}" + (f"#{quote(anchor)}" if anchor else "")


def format_selection(selected: ItemRef) -> str:
    """An item as it appears in URLs, such as "Kick", "Kick/0", "@common/1" or "components:head"."""
    if selected.kind in ("states", "transitions", "common"):
        return selected.id
    return f"{selected.kind}{_KIND_SEPARATOR}{selected.id}"


def parse_selection(text: str) -> ItemRef | None:
    """The item in a URL, None if the text is invalid; the item need not exist."""
    kind, separator, rest = text.partition(_KIND_SEPARATOR)
    if separator:
        return ItemRef(kind=cast("ItemKind", kind), id=rest) if kind in _KINDS else None
    if not text:
        return None
    if text == "@common":
        return ItemRef(kind="common", id=text)
    return ItemRef(kind="transitions" if "/" in text else "states", id=text)


def parse_trail(text: str, known: Collection[str], here: str) -> tuple[str, ...]:
    """The existing components of a trail; it ends before `here` if it contains that."""
    names = [name for name in text.split(_TRAIL_SEPARATOR) if name in known]
    if here in names:
        names = names[: names.index(here)]
    return tuple(dict.fromkeys(names))[-_MAX_TRAIL:]


def extend_trail(trail: Iterable[str], here: str) -> tuple[str, ...]:
    """The trail of a component opened from `here`."""
    return (*(name for name in trail if name != here), here)[-_MAX_TRAIL:]
