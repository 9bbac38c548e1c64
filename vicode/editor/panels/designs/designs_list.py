"""The list of the designs of all projects of the folder."""

from typing import Any

from nicegui import ui
from nicegui.events import GenericEventArguments

from vicode.editor.panels.designs.design_dialogs import DesignDialogs
from vicode.editor.panels.designs.folders import MANY_DESIGNS, group_by_folder
from vicode.editor.panels.texts import pluralize
from vicode.editor.session import Library, Workspace
from vicode.editor.view.page_urls import broken_file_url, design_url

_FILTER_THRESHOLD = 25
"""The filter is shown for more designs than this."""


class DesignsList(ui.element, component="designs_list.js"):
    """The list; `refresh` follows the files and what is unsaved.

    Args:
        library: the projects.
        dialogs: the dialogs of the menu.
    """

    def __init__(self, library: Library, dialogs: DesignDialogs) -> None:
        super().__init__()
        self._library = library
        self._menu = dialogs.menu_entries()
        self._ask_new = dialogs.ask_new
        self._rendered_key: object = None
        self.props["menu"] = list(self._menu)
        self.props["noMatches"] = "No designs match the filter."
        self.props["current"] = ""
        # NiceGUI remounts an element when handlers are added after its first rendering.
        self.on("new-design", self._on_new)
        self.on("menu", self._on_menu)
        self.refresh()

    def show_current(self, url: str) -> None:
        """Mark the design with this URL as the one that is open."""
        self.props["current"] = url

    def refresh(self) -> None:
        key = [
            (each.key, sorted(each.project.interfaces()), each.broken_file_names, dict(each.files))
            for each in self._library.workspaces
        ]
        if key != self._rendered_key:
            self._rendered_key = key
            projects = [_project(workspace) for workspace in self._library.workspaces]
            count = sum(len(folder["rows"]) for project in projects for folder in project["folders"])
            self.props["projects"], self.props["hasFilter"] = projects, count > _FILTER_THRESHOLD
        unsaved = [
            design_url(workspace.key, component)
            for workspace in self._library.workspaces
            for component in workspace.unsaved_components
        ]
        if unsaved != self.props.get("unsaved"):
            self.props["unsaved"] = unsaved

    def _on_new(self, event: GenericEventArguments) -> None:
        match event.args:
            case {"key": str() as key} if (workspace := self._library.workspace(key)) is not None:
                self._ask_new(workspace)

    def _on_menu(self, event: GenericEventArguments) -> None:
        match event.args:
            case {"entry": str() as entry, "key": str() as key, "component": str() as component}:
                workspace = self._library.workspace(key)
                if entry in self._menu and workspace is not None and workspace.project.design(component) is not None:
                    self._menu[entry](workspace, component)


def _project(workspace: Workspace) -> dict[str, Any]:
    """The designs and unreadable files of a project, by folder."""
    sources = workspace.source_paths
    names = sorted((design.component for design in workspace.project.designs), key=str.casefold)
    files = [*((name, sources.get(name, "")) for name in names), *(("", file) for file in workspace.broken_file_names)]
    folders = group_by_folder(files, lambda entry: entry[1])
    return {
        "key": workspace.key,
        "name": workspace.project.name,
        "isSmall": len(files) <= MANY_DESIGNS,
        "folders": [
            {
                "name": name,
                "count": pluralize(len(entries), "design"),
                "rows": [_row(workspace, component, file) for component, file in entries],
            }
            for name, entries in folders.items()
        ],
    }


def _row(workspace: Workspace, component: str, file: str) -> dict[str, str]:
    if component:
        return {"component": component, "url": design_url(workspace.key, component)}
    return {
        "file": file,
        "url": broken_file_url(workspace.key, file),
        "hint": f"{file} cannot be read. Open it to fix the errors.",
    }
