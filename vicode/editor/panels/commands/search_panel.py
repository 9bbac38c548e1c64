"""Search and replace in all texts of the open design. Each replacement is one edit."""

from collections.abc import Callable
from functools import partial

from nicegui import run, ui

from vicode.editor.panels import texts
from vicode.editor.panels.widgets import icon_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.view import item_at_path, item_label, part_label
from vicode.model.text_search import TextMatch, TextQuery, TextSearchResult, find_text, replace_matches
from vicode.model.texts import TextKind

_MAX_SHOWN = 100
_KINDS = {TextKind.CODE: "Code", TextKind.EXPRESSION: "Guards and values", TextKind.DOC: "Descriptions"}
_OPTIONS = (
    ("match_case", "Aa", "Match case"),
    ("whole_word", "ab|", "Match whole word"),
    ("is_pattern", ".*", "Use regular expression"),
)


class SearchPanel:
    """The search form and its results, which follow the design."""

    def __init__(self, context: WindowContext) -> None:
        self.context = context
        self.result, self.query = TextSearchResult(), TextQuery(text="")
        self.last_search: object = None
        self.is_busy = False
        self.options = dict.fromkeys((name for name, _sign, _words in _OPTIONS), False)
        self.kinds = set(TextKind)
        with ui.element("div").classes("search"):
            with ui.row().classes("search-head"):
                self.text = self._box("Search for", "search-text")
                for name, symbol, label in _OPTIONS:
                    self._toggle(symbol, label, partial(self._toggle_option, name), is_on=False)
                ui.element("div").classes("search-gap")
                for kind, label in _KINDS.items():
                    self._toggle(label, f"Search in {label.lower()}", partial(self._toggle_kind, kind), is_on=True)
            with ui.row().classes("search-head"):
                self.replacement = self._box("Replace with", "search-replacement")
                self.replace_all_button = ui.button("Replace all", on_click=self._replace_all, color=None)
                self.replace_all_button.props("flat dense no-caps").classes("search-all")
                self.summary = ui.label().classes("findings-summary").props('role="status"')
            self.list = ui.column().classes("findings-list").props('role="list" aria-label="Results"')
        self.text.on_value_change(self.refresh)
        self.text.on("keydown.enter", self._open_first)

    def refresh(self) -> None:
        """Search if the design or the query has changed."""
        self.query = TextQuery(text=self.text.value or "", kinds=frozenset(self.kinds), **self.options)
        if not self.is_busy and self.last_search != (self.query, self.context.document.rev):
            self.is_busy = True
            self.context.run_in_background(self._search(), "search")

    async def _search(self) -> None:
        """Search in a thread, until the results match the newest query."""
        try:
            while self.last_search != (now := (self.query, self.context.document.rev)):
                self.last_search = now
                result = await run.io_bound(find_text, self.context.design, self.query)
                # The result is None while the server shuts down.
                if result is None or self.list.is_deleted:
                    return
                self.result = result
                self._show()
        finally:
            self.is_busy = False

    def _show(self) -> None:
        matches, error = self.result.matches, self.result.error
        count = texts.pluralize(len(matches), "result") if self.query.text else "Enter a search term"
        self.summary.set_text(f"{count}: {error}" if error else count)
        self.replace_all_button.set_enabled(bool(matches))
        self.list.clear()
        with self.list:
            for match in matches[:_MAX_SHOWN]:
                self._row(match)
            if len(matches) > _MAX_SHOWN:
                ui.label(texts.more(len(matches) - _MAX_SHOWN)).classes("empty findings-more")

    def _row(self, match: TextMatch) -> None:
        part, item = part_label(match.path), item_label(self.context.design, match.path)
        with ui.element("div").classes("finding-row").props('role="listitem"'):
            with ui.element("button").classes("search-hit").props('type="button"') as row:
                ui.label(item).classes("finding-thing")
                ui.label(f"{part}, line {match.line}" if match.line > 1 else part).classes("small")
                _line(match)
            row.on("click", lambda: self._open(match))
            icon_button("find_replace", f"Replace in {item}", lambda: self._replace(match))

    def _open(self, match: TextMatch) -> None:
        self.context.show(item_at_path(match.path))

    def _open_first(self) -> None:
        if self.result.matches:
            self._open(self.result.matches[0])

    def _replace(self, match: TextMatch) -> None:
        self._edit([(match.path, match.start)], match.matched)

    def _replace_all(self) -> None:
        self._edit(None, self.query.text)

    def _edit(self, only: list[tuple[tuple[str | int, ...], int]] | None, what: str) -> None:
        replacement = self.replacement.value or ""
        result = replace_matches(self.context.design, self.query, replacement, only)
        if result.error or not result.count:
            self.context.show_toast(result.error or "No matches to replace", "warning")
            return
        # Repeat the query: the design may change before the edit is applied.
        label = f"replace {what[:20]} with {replacement[:20]}"
        self.context.edit(label, lambda design: replace_matches(design, self.query, replacement, only).design)
        self.context.show_toast(texts.replaced(result.count), "positive")

    def _box(self, label: str, style: str) -> ui.input:
        box = ui.input(placeholder=label).props("dense borderless clearable debounce=150 spellcheck=false")
        box.props["aria-label"] = label
        return box.classes(f"search-box mono {style}")

    def _toggle(self, symbol: str, label: str, toggle: Callable[[], bool], *, is_on: bool) -> None:
        button = ui.button(symbol, color=None).props("flat dense no-caps size=sm").classes("search-toggle")
        # Speech control uses what is visible.
        button.props["aria-label"], button.props["aria-pressed"] = f"{label} ({symbol})", str(is_on).lower()

        def flip() -> None:
            button.props(f'aria-pressed="{str(toggle()).lower()}"')
            self.refresh()

        button.on("click", flip)
        with button:
            ui.tooltip(label)

    def _toggle_option(self, name: str) -> bool:
        self.options[name] = not self.options[name]
        return self.options[name]

    def _toggle_kind(self, kind: TextKind) -> bool:
        self.kinds ^= {kind}
        return kind in self.kinds


def _line(match: TextMatch) -> None:
    with ui.element("span").classes("search-hit-line mono"):
        for text, tag in ((match.before, "span"), (match.matched, "mark"), (match.after, "span")):
            with ui.element(tag):
                ui.label(text)
