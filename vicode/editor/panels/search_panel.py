"""Search and replace in all texts of the open design; every replacing is one edit."""

from collections.abc import Callable
from functools import partial

from nicegui import run, ui

from vicode.editor.panels.desk import Desk
from vicode.editor.panels.rows import icon_button
from vicode.editor.session.searching import Found, Hit, Query, find, replace_hits
from vicode.editor.view import thing_of_path, words_of_part, words_of_path
from vicode.model.texts import TextKind

_SHOWN_AT_MOST = 100
_KINDS = {TextKind.CODE: "Code", TextKind.EXPRESSION: "Guards and values", TextKind.DOC: "Docs"}
_WAYS = (("match_case", "Aa", "Match case"), ("whole_word", "ab|", "Whole words"), ("is_pattern", ".*", "Pattern"))


class SearchPanel:
    """What is searched for above, the hits below; they follow the design."""

    def __init__(self, desk: Desk) -> None:
        """Build it; `refresh` fills it."""
        self.desk = desk
        self.found, self.query = Found(), Query(text="")
        self.searched: object = None
        self.is_busy = False
        self.ways = dict.fromkeys((name for name, _sign, _words in _WAYS), False)
        self.kinds = set(TextKind)
        with ui.element("div").classes("search"):
            with ui.row().classes("search-head"):
                self.text = self._box("Search for", "search-text")
                for name, sign, words in _WAYS:
                    self._toggle(sign, words, partial(self._flip_way, name), is_on=False)
                ui.element("div").classes("search-gap")
                for kind, words in _KINDS.items():
                    self._toggle(words, f"Search in {words.lower()}", partial(self._flip_kind, kind), is_on=True)
            with ui.row().classes("search-head"):
                self.replacement = self._box("Replace with", "search-replacement")
                self.all = ui.button("Replace all", on_click=self._replace_all, color=None)
                self.all.props("flat dense no-caps").classes("search-all")
                self.summary = ui.label().classes("findings-summary").props('role="status"')
            self.list = ui.column().classes("findings-list").props('role="list" aria-label="Hits"')
        self.text.on_value_change(self.refresh)
        self.text.on("keydown.enter", self._open_first)

    def refresh(self) -> None:
        """Search anew if the design or what is searched for has changed."""
        self.query = Query(text=self.text.value or "", kinds=frozenset(self.kinds), **self.ways)
        if not self.is_busy and self.searched != (self.query, self.desk.document.rev):
            self.is_busy = True
            self.desk.begin(self._search(), "search")

    async def _search(self) -> None:
        """Search beside the event loop, until the newest question is answered."""
        try:
            while self.searched != (now := (self.query, self.desk.document.rev)):
                self.searched = now
                found = await run.io_bound(find, self.desk.design, self.query)
                # Nothing comes back while the server is shutting down.
                if found is None or self.list.is_deleted:
                    return
                self.found = found
                self._show()
        finally:
            self.is_busy = False

    def _show(self) -> None:
        hits, mistake = self.found.hits, self.found.mistake
        count = f"{len(hits)} hit{'s' * (len(hits) != 1)}" if self.query.text else "Type what to search for"
        self.summary.set_text(f"{count}: {mistake}" if mistake else count)
        self.all.set_enabled(bool(hits))
        self.list.clear()
        with self.list:
            for hit in hits[:_SHOWN_AT_MOST]:
                self._row(hit)
            if len(hits) > _SHOWN_AT_MOST:
                ui.label(f"and {len(hits) - _SHOWN_AT_MOST} more").classes("empty findings-more")

    def _row(self, hit: Hit) -> None:
        part, thing = words_of_part(hit.path), words_of_path(self.desk.design, hit.path)
        with ui.element("div").classes("finding-row").props('role="listitem"'):
            with ui.element("button").classes("search-hit").props('type="button"') as row:
                ui.label(thing).classes("finding-thing")
                ui.label(f"{part}, line {hit.line}" if hit.line > 1 else part).classes("small")
                _line(hit)
            row.on("click", lambda: self._open(hit))
            icon_button("find_replace", f"Replace in {thing}", lambda: self._replace(hit))

    def _open(self, hit: Hit) -> None:
        thing = thing_of_path(hit.path)
        self.desk.select(*(() if thing.of == "design" else (thing,)))
        self.desk.reveal(thing)

    def _open_first(self) -> None:
        if self.found.hits:
            self._open(self.found.hits[0])

    def _replace(self, hit: Hit) -> None:
        self._edit([(hit.path, hit.start)], hit.found)

    def _replace_all(self) -> None:
        self._edit(None, self.query.text)

    def _edit(self, only: list[tuple[tuple[str | int, ...], int]] | None, what: str) -> None:
        replacement = self.replacement.value or ""
        tried = replace_hits(self.desk.design, self.query, replacement, only)
        if tried.mistake or not tried.count:
            self.desk.say(tried.mistake or "There is nothing to replace any more", "warning")
            return
        # The query is asked again of the design as it is when the edit is made.
        label = f"replace {what[:20]} by {replacement[:20]}"
        self.desk.edit(label, lambda design: replace_hits(design, self.query, replacement, only).design)
        self.desk.say(f"Replaced {tried.count}: Ctrl+Z takes it back", "positive")

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

    def _flip_way(self, name: str) -> bool:
        self.ways[name] = not self.ways[name]
        return self.ways[name]

    def _flip_kind(self, kind: TextKind) -> bool:
        self.kinds ^= {kind}
        return kind in self.kinds


def _line(hit: Hit) -> None:
    """The line of a hit with what was found in it marked."""
    with ui.element("span").classes("search-hit-line mono"):
        for text, tag in ((hit.before, "span"), (hit.found, "mark"), (hit.after, "span")):
            with ui.element(tag):
                ui.label(text)
