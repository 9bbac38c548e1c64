"""Collapsible sections of a form, built when they are first opened; they stay open when the form is rebuilt."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.form import Form

# Scrolls the content of a section that is opened at the lower edge into view. Sections open without animation, so that
# buttons do not move while the user presses them.
_SCROLL_INTO_VIEW = """
  const section = getHtmlElement(%d), height = section?.offsetHeight;
  const watch = new ResizeObserver(() => {
    if (section.offsetHeight <= height) return;
    watch.disconnect();
    section.scrollIntoView({ block: "nearest" });
  });
  if (section) watch.observe(section);
  setTimeout(() => watch.disconnect(), 2000);
"""


def collapsible_section(
    form: Form,
    key: str,
    title: Callable[[], str],
    caption: Callable[[], str],
    build: Callable[[], object],
    *,
    is_shared: bool = False,
) -> ui.expansion:
    """Build a section.

    `caption` summarizes its content. `key` identifies it within the design; a shared section is open in all designs or
    in none.
    """
    context = form.context
    key = key if is_shared else f"{context.design.component}/{key}"
    built: list[bool] = []

    def fill() -> None:
        if not built:
            built.append(True)
            with section:
                build()

    def turn(*, is_open: bool) -> None:
        if is_open:
            context.open_sections.add(key)
            fill()
            ui.run_javascript(_SCROLL_INTO_VIEW % section.id)
        else:
            context.open_sections.discard(key)

    def show_caption(text: str) -> None:
        section.props["caption"] = text
        section.update()

    section = ui.expansion(value=key in context.open_sections, on_value_change=lambda event: turn(is_open=event.value))
    section.classes("section").props("dense duration=0")
    form.watch(title, section.set_text)
    form.watch(caption, show_caption)
    if key in context.open_sections:
        fill()
    return section
