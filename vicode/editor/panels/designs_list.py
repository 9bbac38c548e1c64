"""The list of designs: every project of the folder with its components."""

from nicegui import ui

from vicode.editor.panels.design_dialogs import DesignDialogs
from vicode.editor.panels.design_menu import add_design_menu
from vicode.editor.panels.rows import icon_button
from vicode.editor.session import Library, Workspace
from vicode.editor.view.address import broken_address, design_address


class DesignsList:
    """The designs; built anew when files come or go, or a design becomes saved or unsaved."""

    def __init__(self, library: Library, here: tuple[str, str], dialogs: DesignDialogs) -> None:
        """Build it; `here` is the project's key and the component that is open."""
        self.library, self.here, self.dialogs = library, here, dialogs
        self.shape: object = None
        self.body = ui.element("nav").classes("designs").props('aria-label="Designs"')
        self.refresh()

    def refresh(self) -> None:
        """Show what there is now."""
        shape = [
            (each.key, sorted(each.project.interfaces()), each.broken, each.unsaved) for each in self.library.workspaces
        ]
        if shape == self.shape:
            return
        self.shape = shape
        self.body.clear()
        with self.body:
            for workspace in self.library.workspaces:
                self._project(workspace)

    def _project(self, workspace: Workspace) -> None:
        with ui.row().classes("project-head"):
            ui.label(workspace.project.name).classes("project-name")
            icon_button("add", f"New design in {workspace.project.name}", lambda: self.dialogs.ask_new(workspace))
        with ui.element("div").props("role=list") as listed:
            listed.props["aria-label"] = workspace.project.name
            for design in sorted(workspace.project.designs, key=lambda each: each.component.casefold()):
                self._design(workspace, design.component)
            for file in workspace.broken:
                _broken(workspace, file)

    def _design(self, workspace: Workspace, component: str) -> None:
        is_here = self.here == (workspace.key, component)
        with ui.element("div").classes("design-row").props("role=listitem") as row:
            link = ui.link(target=design_address(workspace.key, component))
            link.classes("design-link" + (" is-open" if is_here else ""))
            if is_here:
                link.props('aria-current="page"')
            with link:
                ui.label(component)
                if component in workspace.unsaved:
                    ui.label("●").classes("unsaved-mark").props('aria-label="unsaved" role="img"')
            add_design_menu(workspace, component, self.dialogs, row)


def _broken(workspace: Workspace, file: str) -> None:
    address = broken_address(workspace.key, file)
    with ui.element("div").props("role=listitem"), ui.link(target=address).classes("design-link is-broken"):
        ui.icon("error").props('aria-hidden="true"')
        ui.label(file)
        ui.tooltip(f"{file} cannot be read: open its text to mend it")
