"""The texts of a component, as pages of code whose lines and things link each other."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial

from vicode.docsite.addresses import Addresses
from vicode.docsite.languages import Unsaid, faulty_in
from vicode.docsite.listings import TITLES, code_row, lines_of
from vicode.docsite.memory import Memory, digest_of
from vicode.docsite.parts import outside_of
from vicode.docsite.subject import Subject
from vicode.docsite.views import CodeView, Part
from vicode.findings import Path
from vicode.generators import GENERATORS, ComponentText, Origin, component_texts
from vicode.model.design import Design

_LINKED = ("states", "common", "parameters", "outputs", "variables")


@dataclass(frozen=True, slots=True, kw_only=True)
class Text:
    """A text of a component: `form` is "source" or a language; `lines` are where the things in it begin."""

    component: str
    form: str
    path: str
    text: str
    language: str
    lines: Mapping[Path, int]

    @property
    def title(self) -> str:
        """What links call it."""
        return "Source" if self.form == "source" else TITLES.get(self.form, self.form)


class Texts:
    """All texts by component: what somebody wrote, and what is generated where nothing stands in the way.

    Those of a component are made when they are asked for, which takes longer than all the rest of its page.
    """

    def __init__(self, subject: Subject, unsaid: Unsaid, memory: Memory) -> None:
        project = subject.project
        self._subject, self._memory = subject, memory
        self._outside = digest_of(outside_of(project))
        self._sources = {name: source.path for name, source in subject.sources.items() if name}
        self._faulty = {language: faulty_in(subject, language, unsaid) for language in GENERATORS}
        self._write = {language: component_texts(project, language, self._sources) for language in GENERATORS}
        self._made: dict[str, tuple[Text, ...]] = {}
        self.names = tuple(dict.fromkeys([*subject.sources, *(design.component for design in project.designs)]))

    def of(self, name: str) -> tuple[Text, ...]:
        """The texts of a component, "" for those of the project."""
        if name not in self._made:
            self._made[name] = (*self._source(name), *self._generated(self._subject.project.design(name)))
        return self._made[name]

    def _source(self, name: str) -> Iterator[Text]:
        source = self._subject.sources.get(name)
        if source:
            yield Text(
                component=name,
                form="source",
                path=source.path,
                text=source.text,
                language=source.language,
                lines=source.lines,
            )

    def _generated(self, design: Design | None) -> Iterator[Text]:
        """The text in each language in which nothing is wrong with it."""
        for language in GENERATORS:
            if design is None or design.component in self._faulty[language]:
                continue
            used = tuple(self._subject.project.interface(use.component) for use in design.uses)
            key = (language, design, used, self._sources.get(design.component, ""), self._outside)
            written = self._memory.recall("text", key, partial(self._write[language], design))
            if written is not None:
                yield _text_of(design.component, language, written)


def places_in(texts: tuple[Text, ...], addresses: Addresses) -> dict[Path, tuple[Part, ...]]:
    """Where each thing of a component stands in its texts."""
    places: dict[Path, tuple[Part, ...]] = {}
    for text in texts:
        page = addresses.code(text.component, text.form)
        for path, line in text.lines.items():
            part = Part(text=f"{text.title} {line}", href=f"{page}#L{line}", title=f"{text.path}, line {line}")
            places[path] = (*places.get(path, ()), part)
    return places


def title_of(text: Text) -> str:
    """What the page of a text is called."""
    return f"{text.component or 'Project'}: {text.title}"


def code_view(text: Text, links: tuple[Part, ...], addresses: Addresses, component: Part) -> CodeView:
    """The page of a text; `links` lead to all texts of its component."""
    begins: dict[int, Path] = {}
    for path, line in text.lines.items():
        begins.setdefault(line, path)
    lines_html = lines_of(text.text, text.language)
    rows = []
    for number, html in enumerate(lines_html, start=1):
        path = begins.get(number, ())
        href = addresses.thing(text.component, path) if path and text.component else ""
        rows.append(code_row(number, html, href, _name_of(path)))
    return CodeView(
        title=title_of(text),
        path=text.path,
        component=component,
        texts=links,
        lines_html=lines_html,
        rows_html="\n".join(rows),
    )


def text_links(texts: tuple[Text, ...], addresses: Addresses) -> tuple[Part, ...]:
    """The pages of a component's texts."""
    return tuple(
        Part(text=each.title, href=addresses.code(each.component, each.form), title=each.path) for each in texts
    )


def _text_of(component: str, language: str, written: ComponentText) -> Text:
    file, lines = written.file, _lines_of(written.origins)
    return Text(component=component, form=language, path=file.path, text=file.text, language=language, lines=lines)


def _lines_of(origins: Iterable[Origin]) -> dict[Path, int]:
    lines: dict[Path, int] = {}
    for origin in origins:
        if origin.path and origin.path[0] in _LINKED and origin.path[-1] != "code":
            lines.setdefault(origin.path, origin.first)
    return lines


def _name_of(path: Path) -> str:
    match path:
        case ("states", str(name), "transitions", *_):
            return f"a decision of {name}"
        case ("states", str(name), *_):
            return f"state {name}"
        case ("common", *_):
            return "common to every state"
        case (_section, str(name), *_):
            return name
        case _:
            return ""
