"""The inspector: a form for the selected item, or for the design if nothing is selected."""

from collections import deque

from nicegui import ui

from vicode.editor.panels.decision_panel import decision_panel
from vicode.editor.panels.design_panel import common_panel, design_panel
from vicode.editor.panels.fields import Field
from vicode.editor.panels.multi_selection_panel import multi_selection_panel
from vicode.editor.panels.state_panel import state_panel
from vicode.editor.panels.use_panel import link_panel, use_panel
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import form_key
from vicode.editor.session.project_paths import project_structure_key
from vicode.editor.session.rebase import rebase_selection
from vicode.editor.view import ItemRef

# Escape returns the focus to the canvas, unless it closes an open list or completion.
_FOCUS_CANVAS = """(event) => {
  if (event.defaultPrevented || event.target.getAttribute("aria-expanded") === "true") return;
  document.querySelector(".canvas")?.shadowRoot?.querySelector(".stage")?.focus();
}"""
_REBUILD_DELAY_S = 0.4
_MAX_PREVIOUS_FORMS = 4
_MAX_TEXT_LENGTH = 200_000


class Inspector:
    """Builds a form when the selection or the structure of the item changes; else it refreshes the fields."""

    def __init__(self, context: WindowContext) -> None:
        self.context = context
        self.form_key: object = None
        self.fields: list[Field] = []
        self.form_selection: tuple[ItemRef, ...] | None = None
        self.last_seen = (context.selected, context.design)
        self.form_id = 0
        """Identifies the shown item: the browser keeps the focus in a rebuilt form with the same id."""
        self.shown_form_id = 0
        self.body = ui.column().classes("inspector")
        self.body.on("keydown.escape", js_handler=_FOCUS_CANVAS)
        self.rebuild_timer = ui.timer(_REBUILD_DELAY_S, self.refresh, active=False)
        self.previous_forms: deque[tuple[int, list[Field]]] = deque(maxlen=_MAX_PREVIOUS_FORMS)
        """The previous forms with their ids: the browser may still show one of them."""
        context.linter.changes.subscribe(lambda: None if self.body.is_deleted else self.refresh())
        ui.on("delayed-input", lambda event: self.apply_delayed_input(event.args))
        ui.on("input-transferred", lambda event: self.transfer_input(event.args))

    def refresh(self) -> None:
        self._update_form_id()
        project = project_structure_key(self.context.workspace.project)
        key = (
            self.context.selected,
            form_key.form_structure_key(self.context.design, self.context.single_selection),
            project,
        )
        if key == self.form_key:
            self._refresh_fields()
        elif self._is_being_edited():
            # Another user changed the structure: rebuild the form after the user has stopped typing.
            self._refresh_fields()
            self.rebuild_timer.activate()
        else:
            self.form_key, self.form_selection = key, self.context.selected
            self.rebuild_timer.deactivate()
            self.body.clear()
            self.previous_forms.append((self.shown_form_id, self.fields))
            self.shown_form_id = self.form_id
            self.body.props(f"data-form={self.form_id}")
            with self.body:
                self.fields = self._build()

    def apply_delayed_input(self, payload: object) -> None:
        """Apply text from a field of a previous form that the user left before the browser got the new form.

        Fields of the current form send their input themselves. The payload comes from the browser and is untrusted.
        """
        if not isinstance(payload, dict):
            return
        number, text = payload.get("number"), payload.get("text")
        if not isinstance(number, int) or not isinstance(text, str) or len(text) > _MAX_TEXT_LENGTH:
            return
        for form, fields in self.previous_forms:
            old = _find_field(number, fields)
            if old is not None and (old.element.is_deleted or old not in self.fields):
                new = _find_counterpart(old, fields, self.fields) if form == self.shown_form_id else None
                if new is None:
                    old.commit_delayed_input(text)
                else:
                    new.transfer_input_from(old, text)
                    new.apply_delayed_input(text)

    def transfer_input(self, payload: object) -> None:
        """Record that a field continues the input of a field of a previous form.

        The payload comes from the browser and is untrusted.
        """
        if not isinstance(payload, dict):
            return
        before = [field for _form, fields in self.previous_forms for field in fields]
        old, new = _find_field(payload.get("from"), before), _find_field(payload.get("to"), self.fields)
        if old is not None and new is not None and type(old) is type(new):
            new.transfer_input_from(old)

    def _update_form_id(self) -> None:
        """Change the form id if another item is selected, but not if the same item was renamed or moved."""
        before, now = self.last_seen, (self.context.selected, self.context.design)
        self.last_seen = now
        if tuple(rebase_selection(item, before[1], now[1]) for item in before[0]) != now[0]:
            self.form_id += 1

    def _refresh_fields(self) -> None:
        for field in self.fields:
            field.refresh()

    def _is_being_edited(self) -> bool:
        """Whether the focused field still belongs to the same value."""
        is_same = self.form_selection == self.context.selected
        return is_same and any(field.has_focus and field.is_path_valid() for field in self.fields)

    def _build(self) -> list[Field]:
        context = self.context
        if len(context.selected) > 1:
            multi_selection_panel(context)
            return []
        match context.single_selection:
            case ItemRef(kind="states", id=name):
                return state_panel(context, name)
            case ItemRef(kind="transitions", id=key):
                return decision_panel(context, key)
            case ItemRef(kind="components", id=alias):
                return use_panel(context, alias)
            case ItemRef(kind="links", id=key):
                return link_panel(context, key)
            case ItemRef(kind="common"):
                return common_panel(context)
            case _:
                return design_panel(context)


def _find_field(number: object, fields: list[Field]) -> Field | None:
    return next((field for field in fields if field.element.id == number), None)


def _find_counterpart(old: Field, before: list[Field], now: list[Field]) -> Field | None:
    """Find the field of the new form that corresponds to an old one: same type, label and position among these."""

    def alike(fields: list[Field]) -> list[Field]:
        return [each for each in fields if type(each) is type(old) and each.binding.label == old.binding.label]

    index, candidates = alike(before).index(old), alike(now)
    return candidates[index] if index < len(candidates) else None
