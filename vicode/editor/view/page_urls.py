"""Where a design is edited, with the thing that is selected there and the way one came."""

from collections.abc import Collection, Iterable, Sequence
from urllib.parse import quote, urlencode

from vicode.editor.view.selection import ItemRef

# Names cannot hold these signs, so that nobody's state can be taken for something else.
_BETWEEN, _NEXT = ":", ","
_KINDS = ("components", "links")
_MAX_TRAIL = 6


def design_url(key: str, component: str, selected: ItemRef | None = None, trail: Sequence[str] = ()) -> str:
    """The address of a design: project by its key, component by its name, `trail` the components one came through."""
    query = {}
    if selected is not None and selected.kind != "design":
        query["select"] = format_selection(selected)
    if trail:
        query["from"] = _NEXT.join(trail)
    path = f"/design/{quote(key, safe='')}/{quote(component, safe='')}"
    return f"{path}?{urlencode(query, safe=_SAFE)}" if query else path


_SAFE = "/:,@"


def broken_file_url(key: str, file: str) -> str:
    """Where the text of a file that cannot be read is mended."""
    return f"/broken/{quote(key, safe='')}/{quote(file)}"


def docs_url(key: str, file: str, anchor: str = "") -> str:
    """Where a page of a project's documentation is shown, as it would be now."""
    return f"/docs/{quote(key, safe='')}/{quote(file)}" + (f"#{quote(anchor)}" if anchor else "")


def format_selection(selected: ItemRef) -> str:
    """A thing as addresses say it: "Kick", "Kick/0", "@common/1", "components:head"."""
    if selected.kind in ("states", "transitions", "common"):
        return selected.id
    return f"{selected.kind}{_BETWEEN}{selected.id}"


def parse_selection(text: str) -> ItemRef | None:
    """The thing an address names; None for what is none. Whether it is there is for others to see."""
    kind, between, rest = text.partition(_BETWEEN)
    if between:
        return ItemRef(kind=kind, id=rest) if kind in _KINDS else None
    if not text:
        return None
    if text == "@common":
        return ItemRef(kind="common", id=text)
    return ItemRef(kind="transitions" if "/" in text else "states", id=text)


def parse_trail(text: str, known: Collection[str], here: str) -> tuple[str, ...]:
    """The components one came through, as far as they exist; one that was here before starts anew from there."""
    names = [name for name in text.split(_NEXT) if name in known]
    if here in names:
        names = names[: names.index(here)]
    return tuple(dict.fromkeys(names))[-_MAX_TRAIL:]


def extend_trail(trail: Iterable[str], here: str) -> tuple[str, ...]:
    """The trail of the component that is opened from here."""
    return (*(name for name in trail if name != here), here)[-_MAX_TRAIL:]
