"""Names of events: the descriptors of a document, and the inputs that stand for them (SCXML 3.12.1)."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from vicode.importers.design_names import DesignNames
from vicode.languages import LANGUAGES
from vicode.model.design import Declaration

KEYWORDS = LANGUAGES["cpp"].keywords
"""Keywords of C++, in which imported designs are generated, too."""
ANY = "*"
DONE = "done.state."
_OTHER = "other"


def plain(descriptor: str) -> str:
    """A descriptor without the ending that says that it is one: `a.*` and `a.` match what `a` matches."""
    return descriptor.removesuffix(".*").removesuffix(".")


def matches(descriptor: str, event: str) -> bool:
    """Whether a descriptor matches an event: token by token, so that `foo` matches `foo.bar` but not `foobar`."""
    prefix = plain(descriptor)
    return prefix in (ANY, event) or event.startswith(f"{prefix}.")


@dataclass(frozen=True, slots=True)
class EventInputs:
    """The inputs by descriptor. An event is the input of the longest descriptor that matches it."""

    names: Mapping[str, str]

    @classmethod
    def of_descriptors(cls, descriptors: Iterable[str], taken: frozenset[str]) -> "EventInputs":
        """Name the inputs; `taken` are names that the component of the events uses itself."""
        allocator, names = DesignNames(taken, KEYWORDS), dict[str, str]()
        for descriptor in map(plain, descriptors):
            if descriptor not in names:
                names[descriptor] = allocator.allocate(_OTHER if descriptor == ANY else descriptor)
        return cls(names)

    def matched_by(self, descriptor: str) -> Iterator[str]:
        """The inputs of all events that a descriptor matches."""
        return (name for known, name in self.names.items() if matches(descriptor, known))

    def of_event(self, event: str) -> str | None:
        """The input of an event; None if no descriptor matches it."""
        found = [known for known in self.names if matches(known, event)]
        return self.names[max(found, key=lambda known: (known != ANY, len(known)))] if found else None

    def declarations(self) -> tuple[Declaration, ...]:
        return tuple(
            Declaration(name=name, type="bool", doc=self._describe(known)) for known, name in self.names.items()
        )

    def _describe(self, descriptor: str) -> str:
        if descriptor == ANY:
            return "An event that no other output stands for."
        return f"The event {descriptor}, or one that begins with it and a dot and has no output of its own."
