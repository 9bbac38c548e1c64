"""Code pages: the source and the generated code of components, with links to their descriptions."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from vicode.docsite.build_cache import BuildCache, StoredForm, compute_digest
from vicode.docsite.languages import GenerationErrors, find_components_with_errors
from vicode.docsite.page_inputs import strip_to_interfaces
from vicode.docsite.site_input import SiteInput
from vicode.docsite.syntax_highlighting import code_row, highlight_lines
from vicode.docsite.urls import SiteUrls
from vicode.docsite.views import CodeView, TextSpan
from vicode.findings import DesignPath
from vicode.generators import GENERATORS, ComponentCode, Origin, component_generator
from vicode.languages import language_title
from vicode.model.design import Design

_LINKED_SECTIONS = ("states", "common", "parameters", "outputs", "variables")


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeFile:
    """Source or generated code of a component.

    `variant` is "source" or a language; `line_numbers` are the first lines of the nodes of the design.
    """

    component: str
    variant: str
    path: str
    text: str
    language: str
    line_numbers: Mapping[DesignPath, int]

    @property
    def title(self) -> str:
        """The text of links to this file."""
        return "Source" if self.variant == "source" else language_title(self.variant)


class CodeFiles:
    """The source and, where there are no errors, the generated code of each component.

    Code is generated on first access: this takes longer than the rest of a page.
    """

    def __init__(self, subject: SiteInput, generation_errors: GenerationErrors, memory: BuildCache) -> None:
        project = subject.project
        self._site_input, self._cache = subject, memory
        self._interfaces_digest = compute_digest(strip_to_interfaces(project))
        self._sources = {name: source.path for name, source in subject.sources.items() if name}
        self._components_with_errors = {
            language: find_components_with_errors(subject, language, generation_errors) for language in GENERATORS
        }
        self._generators = {language: component_generator(project, language, self._sources) for language in GENERATORS}
        self._loaded: dict[str, tuple[CodeFile, ...]] = {}
        self.component_names = tuple(
            dict.fromkeys([*subject.sources, *(design.component for design in project.designs)])
        )

    def files_of(self, name: str) -> tuple[CodeFile, ...]:
        """The files of a component, or of the project for ""."""
        if name not in self._loaded:
            self._loaded[name] = (*self._source(name), *self._generated(self._site_input.project.design(name)))
        return self._loaded[name]

    def _source(self, name: str) -> Iterator[CodeFile]:
        source = self._site_input.sources.get(name)
        if source:
            yield CodeFile(
                component=name,
                variant="source",
                path=source.path,
                text=source.text,
                language=source.language,
                line_numbers=source.line_numbers,
            )

    def _generated(self, design: Design | None) -> Iterator[CodeFile]:
        """The code in each language for which the design has no errors."""
        for language in GENERATORS:
            if design is None or design.component in self._components_with_errors[language]:
                continue
            used = tuple(self._site_input.project.interface(use.component) for use in design.uses)
            key = (language, design, used, self._sources.get(design.component, ""), self._interfaces_digest)
            make = partial(_generated_file, language, self._generators[language], design)
            written = self._cache.get_or_create("code", key, make, _STORED_CODE)
            if written is not None:
                yield written


def code_links_by_path(
    texts: tuple[CodeFile, ...], addresses: SiteUrls, link: Callable[[str, int], str]
) -> dict[DesignPath, tuple[TextSpan, ...]]:
    """Links into the files of a component, by the path of the node; `link` returns the address in the repository."""
    places: dict[DesignPath, tuple[TextSpan, ...]] = {}
    for text in texts:
        page = addresses.code(text.component, text.variant)
        is_linked = text.variant == "source" and link(text.path, 1) != ""
        for path, line in text.line_numbers.items():
            part = TextSpan(text=f"{text.title} {line}", href=f"{page}#L{line}")
            repository = (TextSpan(text="Repository", href=link(text.path, line)),) if is_linked else ()
            places[path] = (*places.get(path, ()), part, *repository)
    return places


def code_page_title(text: CodeFile, component: str) -> str:
    """The title of the page of a file; `component` is the shown name of its component."""
    return f"{component or 'Project'}: {text.title}"


def code_view(text: CodeFile, links: tuple[TextSpan, ...], addresses: SiteUrls, component: TextSpan) -> CodeView:
    """The page of a file; `links` lead to all files of its component."""
    begins: dict[int, DesignPath] = {}
    for path, line in text.line_numbers.items():
        begins.setdefault(line, path)
    lines_html = highlight_lines(text.text, text.language)
    rows = []
    for number, html in enumerate(lines_html, start=1):
        path = begins.get(number, ())
        href = addresses.design_path(text.component, path) if path and text.component else ""
        rows.append(code_row(number, html, href, _path_label(path)))
    return CodeView(
        title=code_page_title(text, component.text if text.component else ""),
        path=text.path,
        component=component,
        code_pages=links,
        lines_html=lines_html,
        rows_html="\n".join(rows),
    )


def code_page_links(texts: tuple[CodeFile, ...], addresses: SiteUrls) -> tuple[TextSpan, ...]:
    return tuple(
        TextSpan(text=each.title, href=addresses.code(each.component, each.variant), title=each.path) for each in texts
    )


def _generated_file(
    language: str, generate: Callable[[Design], ComponentCode | None], design: Design
) -> CodeFile | None:
    written = generate(design)
    if written is None:
        return None
    file, lines = written.file, _line_numbers(written.origins)
    return CodeFile(
        component=design.component,
        variant=language,
        path=file.path,
        text=file.text,
        language=language,
        line_numbers=lines,
    )


def _encode_code(file: CodeFile | None) -> list[Any] | None:
    if file is None:
        return None
    return [file.component, file.variant, file.path, file.text, [*file.line_numbers.items()]]


def _decode_code(value: Any) -> CodeFile | None:
    component, language, path, text = (str(each) for each in value[:4])
    lines = {tuple(place): int(line) for place, line in value[4]}
    return CodeFile(component=component, variant=language, path=path, text=text, language=language, line_numbers=lines)


_STORED_CODE = StoredForm(_encode_code, _decode_code)


def _line_numbers(origins: Iterable[Origin]) -> dict[DesignPath, int]:
    lines: dict[DesignPath, int] = {}
    for origin in origins:
        if origin.path and origin.path[0] in _LINKED_SECTIONS and origin.path[-1] != "code":
            lines.setdefault(origin.path, origin.first)
    return lines


def _path_label(path: DesignPath) -> str:
    match path:
        case ("states", str(name), "transitions", *_):
            return f"transition of {name}"
        case ("states", str(name), *_):
            return f"state {name}"
        case ("common", *_):
            return "common to all states"
        case (_section, str(name), *_):
            return name
        case _:
            return ""
