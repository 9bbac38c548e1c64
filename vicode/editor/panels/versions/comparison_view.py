"""The result of a comparison: what each language did, and the first differences with both traces side by side."""

from collections.abc import Callable
from dataclasses import dataclass

from nicegui import ui

from vicode.conformance.result import (
    LANGUAGE_TITLES,
    AbsentLanguage,
    CoverageCount,
    InputCoverage,
    LanguageComparison,
    LanguageDifference,
    NeverSeen,
    TraceCell,
    as_design_path,
    verdict,
)
from vicode.editor.panels import texts
from vicode.editor.panels.designs.open_design import open_design
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.view import ItemRef, item_at_path
from vicode.editor.view.page_urls import design_url

# A browser shows a longer table slowly; the sandbox could send any text.
_MAX_ROWS, _MAX_INPUTS, _MAX_TEXT = 200, 60, 400


@dataclass(frozen=True, eq=False)
class ComparisonView:
    """Builds the result; a click on a state closes the dialog and selects it."""

    context: WindowContext
    result: LanguageComparison
    seed: int
    close: Callable[[], None]

    def build(self) -> None:
        result = self.result
        is_good = not result.differences and not result.failed and len(result.languages) > 1
        with ui.element("div").classes("comparison-verdict" + (" is-good" if is_good else "")).props('role="status"'):
            ui.icon("check_circle" if is_good else "error").props('aria-hidden="true"')
            ui.label(texts.sentence(verdict(result)))
        ui.label(texts.comparison_inputs(self.seed)).classes("small")
        different = {difference.languages[1] for difference in result.differences}
        with ui.element("div").classes("comparison-languages").props('role="list"'):
            first = LANGUAGE_TITLES.get(result.baseline, "")
            for language in result.languages if different else ():
                if language != result.baseline:
                    words = "differs from" if language in different else "agrees with"
                    ui.label(f"{_title(language)} {words} {first}").props('role="listitem"')
            for absent in result.failed:
                self._add_absent(absent, "fails: ", "is-failed")
            for absent in result.absent:
                self._add_absent(absent, "is not compared: ", "")
            for limited in result.limited:
                self._add_absent(limited, "is not compared ", "")
            for partial in result.partial:
                ui.label(f"{_title(partial.language)} is compared in {partial.reason}").props('role="listitem"')
        for difference in result.differences:
            self._add_difference(difference)
        if result.coverage is not None:
            self._add_coverage(result.coverage)

    def _add_absent(self, absent: AbsentLanguage, words: str, css_class: str) -> None:
        title = _title(absent.language)
        with ui.element("div").classes(f"comparison-language {css_class}").props('role="listitem"'):
            ui.label(f"{title} {words}{absent.reason}")
            item = item_at_path(as_design_path(absent.path))
            if self._exists(absent.component, item):
                name = item.id or absent.component
                self._link("Show", f"Show {name}, for which {title} {words.rstrip(': ')}", absent.component, item)

    def _add_coverage(self, coverage: InputCoverage) -> None:
        with ui.element("section").classes("comparison-coverage").props('aria-label="Coverage of the inputs"'):
            with ui.element("table"), ui.element("tbody"):
                for count in coverage.counts:
                    _add_count(count)
            if coverage.never:
                self._add_never(coverage.never)

    def _add_never(self, never: tuple[NeverSeen, ...]) -> None:
        with ui.element("div").classes("comparison-never").props('role="list" aria-label="Never"'):
            for each in never[:_MAX_INPUTS]:
                with ui.element("div").classes("comparison-language").props('role="listitem"'):
                    ui.label(f"Never {each.outcome}: {each.text}"[:_MAX_TEXT])
                    item = item_at_path(as_design_path(each.path))
                    if each.path and self._exists(each.component, item):
                        self._link("Show", f"Show {each.text}", each.component, item)
            if len(never) > _MAX_INPUTS:
                ui.label(texts.more(len(never) - _MAX_INPUTS, "goals"))

    def _add_difference(self, difference: LanguageDifference) -> None:
        titles = tuple(LANGUAGE_TITLES.get(each, each) for each in difference.languages)
        heading = texts.traces_differ(titles, difference.run, difference.iteration, difference.time_ns)
        with ui.element("section").classes("comparison-difference") as section:
            section.props["aria-label"] = heading
            ui.label(heading).props("role=heading aria-level=3").classes("comparison-heading")
            subject = f"{difference.component}: " if difference.component else ""
            values = zip(titles, difference.values, strict=True)
            ui.label(
                subject + difference.field + ": " + ", ".join(f"{title} {value or '–'}" for title, value in values)
            )
            self._add_inputs(difference)
            self._add_traces(difference, titles)

    def _add_inputs(self, difference: LanguageDifference) -> None:
        if not difference.inputs:
            return
        with ui.element("div").classes("comparison-inputs mono"):
            ui.label("Inputs").classes("small")
            for each in difference.inputs[:_MAX_INPUTS]:
                label = ui.label(f"{each.name} = {each.value}"[:_MAX_TEXT])
                if each.is_changed:
                    label.classes("is-changed")
            if len(difference.inputs) > _MAX_INPUTS:
                ui.label(texts.more(len(difference.inputs) - _MAX_INPUTS, "inputs"))

    def _add_traces(self, difference: LanguageDifference, titles: tuple[str, ...]) -> None:
        box = ui.element("div").classes("comparison-traces").props('tabindex="0" role="region" aria-label="Traces"')
        with box, ui.element("table").classes("mono"):
            with ui.element("thead"), ui.element("tr"):
                for title in (titles[0], "", *titles[1:]):
                    with ui.element("th" if title else "td").props('scope="col"' if title else ""):
                        ui.label(title)
            with ui.element("tbody"):
                # The difference is at the end.
                for row in difference.rows[-_MAX_ROWS:]:
                    self._add_row(*row)

    def _add_row(self, left: TraceCell, right: TraceCell) -> None:
        differs = left.text != right.text
        with ui.element("tr").classes("differs" if differs else ""):
            with ui.element("td"):
                self._add_cell(left)
            with ui.element("td").classes("sign"):
                ui.label("≠" if differs else "")
            with ui.element("td"):
                self._add_cell(right)

    def _add_cell(self, cell: TraceCell) -> None:
        text, item = cell.text[:_MAX_TEXT], ItemRef(kind="states", id=cell.state)
        indent = len(text) - len(text.lstrip())
        with ui.element("div").style(f"padding-left: {indent}ch"):
            if cell.state and self._exists(cell.component, item):
                self._link(text.strip(), f"{cell.component}: show state {cell.state}", cell.component, item)
            else:
                ui.label(text.strip())

    def _link(self, text: str, accessible_name: str, component: str, item: ItemRef) -> None:
        button = ui.element("button").classes("comparison-link").props('type="button"')
        button.props["title"] = accessible_name
        with button:
            ui.label(text)
        button.on("click", lambda: self._reveal(component, item))

    def _exists(self, component: str, item: ItemRef) -> bool:
        design = self.context.workspace.project.design(component)
        return design is not None and (item.kind != "states" or any(each.name == item.id for each in design.states))

    def _reveal(self, component: str, item: ItemRef) -> None:
        self.close()
        with self.context.client:
            if component != self.context.design.component:
                open_design(design_url(self.context.workspace.key, component, item))
                return
            self.context.show(item)


def _add_count(count: CoverageCount) -> None:
    with ui.element("tr").classes("" if count.seen < count.total else "is-complete"):
        with ui.element("th").props('scope="row"'):
            ui.label(texts.sentence(count.kind))
        with ui.element("td"):
            ui.label(f"{count.seen} of {count.total}")


def _title(language: str) -> str:
    """The title at the beginning of a sentence."""
    return texts.sentence(LANGUAGE_TITLES.get(language, language))
