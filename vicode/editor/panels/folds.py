"""Folds in a form: what few need, built when it is opened, and still open when the form is built anew."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.desk import Desk

# Once it has unfolded: what was opened at the lower edge is not looked for below it.
_BRING_UP = """setTimeout(() => getHtmlElement(%d)?.scrollIntoView({
  block: "nearest", behavior: matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth",
}), 350)"""


def fold(desk: Desk, key: str, title: str, caption: str, build: Callable[[], None]) -> ui.expansion:
    """A fold under a title; `caption` says what is in it, `key` tells it from the others of the design."""
    built: list[bool] = []

    def fill() -> None:
        if not built:
            built.append(True)
            with whole:
                build()

    def turn(*, is_open: bool) -> None:
        if is_open:
            desk.open_folds.add(key)
            fill()
            ui.run_javascript(_BRING_UP % whole.id)
        else:
            desk.open_folds.discard(key)

    whole = ui.expansion(
        title, caption=caption, value=key in desk.open_folds, on_value_change=lambda event: turn(is_open=event.value)
    )
    whole.classes("section").props("dense")
    if key in desk.open_folds:
        fill()
    return whole
