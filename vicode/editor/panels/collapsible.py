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

_ARROW = "M7.41 8.59 12 13.17l4.59-4.58L18 10l-6 6-6-6 1.41-1.41z"
"""A shape, as the letters of an icon font would belong to the visible name."""


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

    def show_texts(texts: tuple[str, str]) -> None:
        section.props["label"], section.props["caption"] = texts
        # Speech control uses what is visible; the role tells whether the section is open.
        section.props["toggle-aria-label"] = " ".join(texts).strip()
        section.update()

    section = ui.expansion(value=key in context.open_sections, on_value_change=lambda event: turn(is_open=event.value))
    section.classes("section").props("dense duration=0")
    section.props["expand-icon"] = _ARROW
    form.watch(lambda: (title(), caption()), show_texts)
    if key in context.open_sections:
        fill()
    return section
