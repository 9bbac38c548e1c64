"""The inspector: a form for the selected item, or for the design if nothing is selected."""

from collections.abc import Callable
from functools import partial

from nicegui import ui

from vicode.editor.panels.form import Form, RemovedTexts, Rows
from vicode.editor.panels.interface_lists import commands_list, inputs_list
from vicode.editor.panels.item_forms import ItemForms
from vicode.editor.panels.multi_selection_panel import multi_selection_panel
from vicode.editor.panels.project.project_form import project_form
from vicode.editor.panels.use_panel import link_panel, use_panel
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session.forms.form_data import has_form
from vicode.editor.session.rebase import rebase_selection
from vicode.editor.view import ItemRef

# Escape returns the focus to the canvas, unless it closes an open list or completion.
_FOCUS_CANVAS = """(event) => {
  if (event.defaultPrevented || event.target.getAttribute("aria-expanded") === "true") return;
  document.querySelector(".canvas")?.shadowRoot?.querySelector(".stage")?.focus();
}"""


_SCROLL_TO_TOP = """
for (let each = getHtmlElement(%d); each && !each.matches(".side"); each = each.parentElement) each.scrollTop = 0;
"""


class Inspector:
    """Builds a form when another item is selected or its kind changes; else it refreshes the form."""

    def __init__(self, context: WindowContext) -> None:
        self.context = context
        self._last_seen = (context.selected, context.design)
        self._selection_number = 0
        """Changes if another item is selected, but not if the same item was renamed or moved."""
        self._form = Form(context, RemovedTexts())
        with ui.element("div").props("data-form") as self._host:
            self._item_forms = ItemForms(context)
            Rows(self._form, self._list_keys, self._build, "inspector")
        for name, build in (("interfaces", _interfaces), ("project", project_form)):
            with self._item_forms.view.add_slot(name):
                Rows(self._form, self._design_keys, partial(_build_part, build))
        self._host.on("keydown.escape", js_handler=_FOCUS_CANVAS)
        context.linter.changes.subscribe(lambda: None if self._host.is_deleted else self.refresh())

    def refresh(self) -> None:
        self._item_forms.refresh()
        self._form.refresh()

    def _list_keys(self) -> list[object]:
        context, before = self.context, self._last_seen
        self._last_seen = (context.selected, context.design)
        if tuple(rebase_selection(item, before[1], context.design) for item in before[0]) != context.selected:
            self._selection_number += 1
            if self._item_kind() is not None:
                context.client.run_javascript(_SCROLL_TO_TOP % self._host.id)
        return [(self._selection_number, self._item_kind())]

    def _design_keys(self) -> list[object]:
        """The parts of the design's form are built while it is shown."""
        return [] if self.context.selected else ["design"]

    def _item_kind(self) -> object:
        """What a form cannot follow in place; None if the item does not exist."""
        context = self.context
        if len(context.selected) == 1 and has_form(context.design, context.selected[0]):
            # Drawn by the browser.
            return None
        match context.single_selection:
            case ItemRef(kind="states" | "frames" | "notes"):
                return None
            case ItemRef(kind="components", id=alias):
                use, project = context.design.use(alias), context.workspace.project
                interface = project.interface(use.component) if use else None
                is_designed = use is not None and project.design(use.component) is not None
                return use and (use.component, interface if is_designed else interface is not None)
            case _:
                return context.selected or None

    def _build(self, form: Form, _key: object) -> None:
        context = self.context
        if len(context.selected) > 1:
            multi_selection_panel(context)
            return
        if self._item_kind() is None:
            return
        match context.single_selection:
            case ItemRef(kind="components", id=alias):
                use_panel(form, alias)
            case ItemRef(kind="links", id=key):
                link_panel(context, key)
            case _:
                pass


def _build_part(build: Callable[[Form], None], form: Form, _key: object) -> None:
    build(form)


def _interfaces(form: Form) -> None:
    inputs_list(form)
    commands_list(form)
