"""The list of the designs of all projects of the folder."""

import contextlib
import re
from dataclasses import dataclass, field
from html import escape

from nicegui import ui

from vicode.editor.panels.design_dialogs import DesignDialogs
from vicode.editor.panels.design_menu import add_design_menu
from vicode.editor.panels.folders import MANY_DESIGNS, Folder, group_by_folder
from vicode.editor.panels.texts import NO_MATCHING_DESIGNS, unreadable_file
from vicode.editor.panels.widgets import icon_button
from vicode.editor.session import Library, Workspace
from vicode.editor.view.page_urls import broken_file_url, design_url

_MAX_SOLID_NAME = 18
_FILTER_THRESHOLD = 25
"""The filter is shown for more designs than this."""


@dataclass(frozen=True, slots=True)
class _Row:
    """A row of the list: the name to filter by, the URL and the element."""

    name: str
    address: str
    element: ui.element


@dataclass(frozen=True, slots=True)
class _OpenedFolder:
    """A folder, whether it is open without a filter, and its rows."""

    folder: Folder
    is_open: bool
    rows: list[_Row] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class _UnsavedMark:
    workspace: Workspace
    component: str
    link: ui.link
    dot: ui.label

    def refresh(self) -> None:
        is_unsaved = self.component in self.workspace.unsaved_components
        if is_unsaved == self.dot.visible:
            return
        self.dot.set_visibility(is_unsaved)
        self.update_label()

    def update_label(self) -> None:
        """Set the accessible name, as the label of a long name is split into parts."""
        if len(self.component) > _MAX_SOLID_NAME:
            self.link.props["aria-label"] = self.component + (", unsaved" if self.dot.visible else "")


class DesignsList:
    """The list, rebuilt when files are added or removed."""

    def __init__(self, library: Library, current: tuple[str, str], dialogs: DesignDialogs) -> None:
        """Build it; `current` is the project's key and the component that is open."""
        self.library, self.current, self.dialogs = library, current, dialogs
        self.rendered_key: object = None
        self._rows: list[_Row] = []
        self._marks: list[_UnsavedMark] = []
        self._folders: list[_OpenedFolder] = []
        with ui.element("nav").classes("designs").props('aria-label="Designs"'):
            self._filter = ui.input(placeholder="Filter", on_change=self._apply_filter).classes("designs-filter")
            self._filter.props('dense borderless clearable debounce=150 aria-label="Filter designs"')
            # Sends the current text: the value of the field is updated with a delay.
            emit_text = "(event) => emit(event.target.value)"
            self._filter.on("keydown.enter", lambda event: self._open_first(str(event.args)), js_handler=emit_text)
            self.body = ui.element("div")
            self._no_matches = ui.label(NO_MATCHING_DESIGNS).classes("empty")
        self.refresh()

    def refresh(self) -> None:
        key = [
            (each.key, sorted(each.project.interfaces()), each.broken_file_names, dict(each.files))
            for each in self.library.workspaces
        ]
        if key == self.rendered_key:
            for mark in self._marks:
                mark.refresh()
            return
        self.rendered_key = key
        self._rows, self._marks, self._folders = [], [], []
        self.body.clear()
        with self.body:
            for workspace in self.library.workspaces:
                self._project(workspace)
        self._filter.set_visibility(len(self._rows) > _FILTER_THRESHOLD)
        self._apply_filter()

    def _apply_filter(self) -> None:
        """Show the designs whose names contain all words of the filter."""
        matching_rows = self._matching_rows(str(self._filter.value or ""))
        for row in self._rows:
            row.element.set_visibility(row in matching_rows)
        for opened in self._folders:
            shown = [row for row in opened.rows if row in matching_rows]
            opened.folder.element.set_visibility(bool(shown))
            opened.folder.set_open(is_open=opened.is_open or len(matching_rows) < len(self._rows))
        self._no_matches.set_visibility(bool(self._rows) and not matching_rows)

    def _matching_rows(self, text: str) -> list[_Row]:
        parts = text.casefold().split() if self._filter.visible else []
        return [row for row in self._rows if all(part in row.name.casefold() for part in parts)]

    def _open_first(self, text: str) -> None:
        matching_rows = self._matching_rows(text)
        if matching_rows:
            ui.navigate.to(matching_rows[0].address)

    def _project(self, workspace: Workspace) -> None:
        with ui.row().classes("project-head"):
            ui.label(workspace.project.name).classes("project-name")
            icon_button("add", f"New design in {workspace.project.name}", lambda: self.dialogs.ask_new(workspace))
        sources, broken = workspace.source_paths, workspace.broken_file_names
        names = sorted((design.component for design in workspace.project.designs), key=str.casefold)
        files = [*((name, sources.get(name, "")) for name in names), *(("", file) for file in broken)]
        for name, entries in group_by_folder(files, lambda entry: entry[1]).items():
            place: contextlib.AbstractContextManager[object] = contextlib.nullcontext()
            folder = None
            if name:
                is_here = self.current in ((workspace.key, component) for component, _file in entries)
                is_open = is_here or len(files) <= MANY_DESIGNS
                folder = _OpenedFolder(Folder(name, len(entries), is_open=is_open), is_open)
                place = folder.folder.element
                self._folders.append(folder)
            with place, ui.element("div").props("role=list") as design_list:
                design_list.props["aria-label"] = f"{workspace.project.name} {name}".strip()
                for component, file in entries:
                    row = self._design(workspace, component) if component else _broken(workspace, file)
                    self._rows.append(row)
                    if folder:
                        folder.rows.append(row)

    def _design(self, workspace: Workspace, component: str) -> _Row:
        address = design_url(workspace.key, component)
        is_here = self.current == (workspace.key, component)
        with ui.element("div").classes("design-row").props("role=listitem") as row:
            link = ui.link(target=address)
            link.classes("design-link" + (" is-open" if is_here else ""))
            if is_here:
                link.props('aria-current="page"')
            with link:
                _name(component)
                dot = ui.label("●").classes("unsaved-mark").props('aria-label="unsaved" role="img"')
            mark = _UnsavedMark(workspace, component, link, dot)
            mark.update_label()
            mark.refresh()
            self._marks.append(mark)
            add_design_menu(workspace, component, self.dialogs, row)
        return _Row(component, address, row)


def _name(component: str) -> None:
    """Build a label; a long name may break between its words."""
    if len(component) <= _MAX_SOLID_NAME:
        ui.label(component).classes("design-name")
    else:
        parts = re.split(r"(?<=_)(?=[^_])|(?<=[a-z0-9])(?=[A-Z])", component)
        ui.html("<wbr>".join(escape(part) for part in parts), sanitize=False).classes("design-name")


def _broken(workspace: Workspace, file: str) -> _Row:
    address = broken_file_url(workspace.key, file)
    with ui.element("div").props("role=listitem") as row, ui.link(target=address).classes("design-link is-broken"):
        ui.icon("error").props('aria-hidden="true"')
        ui.label(file).classes("design-name")
        ui.tooltip(unreadable_file(file))
    return _Row(file, address, row)
