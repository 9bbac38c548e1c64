"""The panel on the right: a form for what is selected, the design itself if nothing is."""

from collections import deque

from nicegui import ui

from vicode.editor.panels.decision_panel import decision_panel
from vicode.editor.panels.design_panel import common_panel, design_panel
from vicode.editor.panels.desk import Desk
from vicode.editor.panels.fields import Field
from vicode.editor.panels.several_panel import several_panel
from vicode.editor.panels.state_panel import state_panel
from vicode.editor.panels.use_panel import link_panel, use_panel
from vicode.editor.session import outline
from vicode.editor.session.following import follow
from vicode.editor.session.project_spots import outline_of_project
from vicode.editor.view import Selected

# Who went into a field by keys gets back by one. A list that is open, or a completion, takes Escape for itself.
_BACK_TO_CANVAS = """(event) => {
  if (event.defaultPrevented || event.target.getAttribute("aria-expanded") === "true") return;
  document.querySelector(".canvas")?.shadowRoot?.querySelector(".stage")?.focus();
}"""
_LATER_S = 0.4
_FORMS_KEPT = 4
_LONGEST = 200_000


class Inspector:
    """Builds a form when another thing is selected or its outline changed, else only refreshes the fields."""

    def __init__(self, desk: Desk) -> None:
        """Build the empty panel; `refresh` fills it."""
        self.desk = desk
        self.shape: object = None
        self.fields: list[Field] = []
        self.selected: tuple[Selected, ...] | None = None
        self.seen = (desk.selected, desk.design)
        self.number = 0
        """Of the thing that is shown: a browser keeps the focus in a form as long as it stays the same."""
        self.shown_number = 0
        self.body = ui.column().classes("inspector")
        self.body.on("keydown.escape", js_handler=_BACK_TO_CANVAS)
        self.later = ui.timer(_LATER_S, self.refresh, active=False)
        self.before: deque[tuple[int, list[Field]]] = deque(maxlen=_FORMS_KEPT)
        """The forms before this one, with their numbers: a browser may still show one of them."""
        ui.on("typed-and-left", lambda event: self.hear_late(event.args))
        ui.on("carried-on", lambda event: self.carry_on(event.args))

    def refresh(self) -> None:
        """Show the selected thing as it is now."""
        self._count_things()
        project = outline_of_project(self.desk.workspace.project)
        shape = (self.desk.selected, outline.outline_of(self.desk.design, self.desk.only), project)
        if shape == self.shape:
            self._refresh_fields()
        elif self._is_typed_in():
            # Somebody else changed the form: who types here goes on, and gets the new one afterwards.
            self._refresh_fields()
            self.later.activate()
        else:
            self.shape, self.selected = shape, self.desk.selected
            self.later.deactivate()
            self.body.clear()
            self.before.append((self.shown_number, self.fields))
            self.shown_number = self.number
            self.body.props(f"data-form={self.number}")
            with self.body:
                self.fields = self._build()

    def hear_late(self, payload: object) -> None:
        """Bring what was typed into a field of a form before, and left before the browser knew, where it belongs.

        Fields that are shown tell what is typed by themselves. The payload comes from a browser.
        """
        if not isinstance(payload, dict):
            return
        number, text = payload.get("number"), payload.get("text")
        if not isinstance(number, int) or not isinstance(text, str) or len(text) > _LONGEST:
            return
        for form, fields in self.before:
            old = _with_number(number, fields)
            if old is not None and (old.element.is_deleted or old not in self.fields):
                new = _counterpart(old, fields, self.fields) if form == self.shown_number else None
                if new is None:
                    old.write_late(text)
                else:
                    new.go_on_from(old, text)
                    new.hear_late(text)

    def carry_on(self, payload: object) -> None:
        """Note that what is typed into a field goes on from what stood in one of a form before.

        The payload comes from a browser.
        """
        if not isinstance(payload, dict):
            return
        before = [field for _form, fields in self.before for field in fields]
        old, new = _with_number(payload.get("from"), before), _with_number(payload.get("to"), self.fields)
        if old is not None and new is not None and type(old) is type(new):
            new.go_on_from(old)

    def _count_things(self) -> None:
        """Tell another thing that is selected from the same one under another name or number."""
        before, now = self.seen, (self.desk.selected, self.desk.design)
        self.seen = now
        if tuple(follow(thing, before[1], now[1]) for thing in before[0]) != now[0]:
            self.number += 1

    def _refresh_fields(self) -> None:
        for field in self.fields:
            field.refresh()

    def _is_typed_in(self) -> bool:
        """Whether a field has the focus that still leads where it did."""
        is_same = self.selected == self.desk.selected
        return is_same and any(field.has_focus and field.leads_there() for field in self.fields)

    def _build(self) -> list[Field]:
        desk = self.desk
        if len(desk.selected) > 1:
            several_panel(desk)
            return []
        match desk.only:
            case Selected(of="states", id=name):
                return state_panel(desk, name)
            case Selected(of="transitions", id=key):
                return decision_panel(desk, key)
            case Selected(of="components", id=alias):
                return use_panel(desk, alias)
            case Selected(of="links", id=key):
                return link_panel(desk, key)
            case Selected(of="common"):
                return common_panel(desk)
            case _:
                return design_panel(desk)


def _with_number(number: object, fields: list[Field]) -> Field | None:
    return next((field for field in fields if field.element.id == number), None)


def _counterpart(old: Field, before: list[Field], now: list[Field]) -> Field | None:
    """The field of the form as it is now that took the place of one: of the same kind and label, and as many before."""

    def alike(fields: list[Field]) -> list[Field]:
        return [each for each in fields if type(each) is type(old) and each.bound.label == old.bound.label]

    place, there = alike(before).index(old), alike(now)
    return there[place] if place < len(there) else None
