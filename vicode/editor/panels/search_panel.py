"""Search and replace in all texts of the open design; every replacing is one edit."""

from collections.abc import Callable
from functools import partial

from nicegui import run, ui

from vicode.editor.panels.widgets import icon_button
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.text_search import TextMatch, TextQuery, TextSearchResult, find_text, replace_matches
from vicode.editor.view import item_at_path, item_label, part_label
from vicode.model.texts import TextKind

_MAX_SHOWN = 100
_KINDS = {TextKind.CODE: "Code", TextKind.EXPRESSION: "Guards and values", TextKind.DOC: "Docs"}
_OPTIONS = (("match_case", "Aa", "Match case"), ("whole_word", "ab|", "Whole words"), ("is_pattern", ".*", "Pattern"))


class SearchPanel:
    """What is searched for above, the hits below; they follow the design."""

    def __init__(self, context: WindowContext) -> None:
        """Build it; `refresh` fills it."""
        self.context = context
        self.result, self.query = TextSearchResult(), TextQuery(text="")
        self.last_search: object = None
        self.is_busy = False
        self.options = dict.fromkeys((name for name, _sign, _words in _OPTIONS), False)
        self.kinds = set(TextKind)
        with ui.element("div").classes("search"):
            with ui.row().classes("search-head"):
                self.text = self._box("Search for", "search-text")
                for name, sign, words in _OPTIONS:
                    self._toggle(sign, words, partial(self._toggle_option, name), is_on=False)
                ui.element("div").classes("search-gap")
                for kind, words in _KINDS.items():
                    self._toggle(words, f"Search in {words.lower()}", partial(self._toggle_kind, kind), is_on=True)
            with ui.row().classes("search-head"):
                self.replacement = self._box("Replace with", "search-replacement")
                self.replace_all_button = ui.button("Replace all", on_click=self._replace_all, color=None)
                self.replace_all_button.props("flat dense no-caps").classes("search-all")
                self.summary = ui.label().classes("findings-summary").props('role="status"')
            self.list = ui.column().classes("findings-list").props('role="list" aria-label="Hits"')
        self.text.on_value_change(self.refresh)
        self.text.on("keydown.enter", self._open_first)

    def refresh(self) -> None:
        """Search anew if the design or what is searched for has changed."""
        self.query = TextQuery(text=self.text.value or "", kinds=frozenset(self.kinds), **self.options)
        if not self.is_busy and self.last_search != (self.query, self.context.document.rev):
            self.is_busy = True
            self.context.run_in_background(self._search(), "search")

    async def _search(self) -> None:
        """Search beside the event loop, until the newest question is answered."""
        try:
            while self.last_search != (now := (self.query, self.context.document.rev)):
                self.last_search = now
                found = await run.io_bound(find_text, self.context.design, self.query)
                # Nothing comes back while the server is shutting down.
                if found is None or self.list.is_deleted:
                    return
                self.result = found
                self._show()
        finally:
            self.is_busy = False

    def _show(self) -> None:
        hits, mistake = self.result.matches, self.result.error
        count = f"{len(hits)} hit{'s' * (len(hits) != 1)}" if self.query.text else "Type what to search for"
        self.summary.set_text(f"{count}: {mistake}" if mistake else count)
        self.replace_all_button.set_enabled(bool(hits))
        self.list.clear()
        with self.list:
            for hit in hits[:_MAX_SHOWN]:
                self._row(hit)
            if len(hits) > _MAX_SHOWN:
                ui.label(f"and {len(hits) - _MAX_SHOWN} more").classes("empty findings-more")

    def _row(self, hit: TextMatch) -> None:
        part, thing = part_label(hit.path), item_label(self.context.design, hit.path)
        with ui.element("div").classes("finding-row").props('role="listitem"'):
            with ui.element("button").classes("search-hit").props('type="button"') as row:
                ui.label(thing).classes("finding-thing")
                ui.label(f"{part}, line {hit.line}" if hit.line > 1 else part).classes("small")
                _line(hit)
            row.on("click", lambda: self._open(hit))
            icon_button("find_replace", f"Replace in {thing}", lambda: self._replace(hit))

    def _open(self, hit: TextMatch) -> None:
        thing = item_at_path(hit.path)
        self.context.select(*(() if thing.kind == "design" else (thing,)))
        self.context.reveal(thing)

    def _open_first(self) -> None:
        if self.result.matches:
            self._open(self.result.matches[0])

    def _replace(self, hit: TextMatch) -> None:
        self._edit([(hit.path, hit.start)], hit.matched)

    def _replace_all(self) -> None:
        self._edit(None, self.query.text)

    def _edit(self, only: list[tuple[tuple[str | int, ...], int]] | None, what: str) -> None:
        replacement = self.replacement.value or ""
        tried = replace_matches(self.context.design, self.query, replacement, only)
        if tried.error or not tried.count:
            self.context.show_toast(tried.error or "There is nothing to replace any more", "warning")
            return
        # The query is asked again of the design as it is when the edit is made.
        label = f"replace {what[:20]} by {replacement[:20]}"
        self.context.edit(label, lambda design: replace_matches(design, self.query, replacement, only).design)
        self.context.show_toast(f"Replaced {tried.count}: Ctrl+Z takes it back", "positive")

    def _box(self, label: str, style: str) -> ui.input:
        box = ui.input(placeholder=label).props("dense borderless clearable debounce=150 spellcheck=false")
        box.props["aria-label"] = label
        return box.classes(f"search-box mono {style}")

    def _toggle(self, sign: str, words: str, act: Callable[[], bool], *, is_on: bool) -> None:
        button = ui.button(sign, color=None).props("flat dense no-caps size=sm").classes("search-toggle")
        button.props["aria-label"], button.props["aria-pressed"] = words, str(is_on).lower()

        def flip() -> None:
            button.props(f'aria-pressed="{str(act()).lower()}"')
            self.refresh()

        button.on("click", flip)
        with button:
            ui.tooltip(words)

    def _toggle_option(self, name: str) -> bool:
        self.options[name] = not self.options[name]
        return self.options[name]

    def _toggle_kind(self, kind: TextKind) -> bool:
        self.kinds ^= {kind}
        return kind in self.kinds


def _line(hit: TextMatch) -> None:
    """The line of a hit with what was found in it marked."""
    with ui.element("span").classes("search-hit-line mono"):
        for text, tag in ((hit.before, "span"), (hit.matched, "mark"), (hit.after, "span")):
            with ui.element(tag):
                ui.label(text)
