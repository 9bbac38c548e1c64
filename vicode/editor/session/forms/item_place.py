"""Places of items in lists: in a form by ids, in the design or project by indices."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeVar

from vicode.editor.session.forms.list_ids import ListIds, noun_of
from vicode.findings import DesignPath

T = TypeVar("T")


@dataclass(frozen=True, slots=True, kw_only=True)
class ItemPlace:
    """The place of an item, or of the design or project itself; a new item has no paths yet.

    `path` is its path in the form, `at` that in the design or project, `section` the list that contains it.
    """

    path: DesignPath = ()
    at: DesignPath = ()
    section: str = ""
    ids: ListIds = field(default_factory=ListIds)

    @property
    def id(self) -> str:
        return str(self.path[-1]) if self.path else ""

    @property
    def is_first(self) -> bool:
        return not self.at or self.at[-1] == 0

    @property
    def key(self) -> str:
        """Identifies the item in its form."""
        return "/".join(map(str, self.path))

    @property
    def noun(self) -> str:
        return noun_of(self.section)

    def within(self, *steps: str) -> DesignPath:
        """The path of a part of the item in the form."""
        return (*self.path, *steps)

    def items(self, section: str, items: Sequence[T]) -> Iterator[tuple["ItemPlace", T]]:
        """The items of a list of this item, with their places."""
        known = self.ids.ids((*self.at, section), tuple(items))
        for index, (id_, each) in enumerate(zip(known, items, strict=True)):
            path, at = (*self.path, section, id_), (*self.at, section, index)
            yield replace(self, path=path, at=at, section=section), each
