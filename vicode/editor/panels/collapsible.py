"""Folds in a form: what few need, built when it is opened, and still open when the form is built anew."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.window_context import WindowContext

# What was opened at the lower edge is not looked for below it. Folds open at once, as what is in them comes a moment
# later anyway: what is about to be pressed would move away under the hand.
_BRING_UP = """
  const fold = getHtmlElement(%d), height = fold?.offsetHeight;
  const watch = new ResizeObserver(() => {
    if (fold.offsetHeight <= height) return;
    watch.disconnect();
    fold.scrollIntoView({ block: "nearest" });
  });
  if (fold) watch.observe(fold);
  setTimeout(() => watch.disconnect(), 2000);
"""


def collapsible_section(
    context: WindowContext, key: str, title: str, caption: str, build: Callable[[], None]
) -> ui.expansion:
    """A fold under a title; `caption` says what is in it, `key` tells it from the others of the design."""
    built: list[bool] = []

    def fill() -> None:
        if not built:
            built.append(True)
            with whole:
                build()

    def turn(*, is_open: bool) -> None:
        if is_open:
            context.open_sections.add(key)
            fill()
            ui.run_javascript(_BRING_UP % whole.id)
        else:
            context.open_sections.discard(key)

    whole = ui.expansion(
        title,
        caption=caption,
        value=key in context.open_sections,
        on_value_change=lambda event: turn(is_open=event.value),
    )
    whole.classes("section").props("dense duration=0")
    if key in context.open_sections:
        fill()
    return whole
