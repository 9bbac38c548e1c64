"""The list of designs: every project of the folder with its components."""

from collections.abc import Callable

from nicegui import ui

from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.rows import icon_button, primary_button
from vicode.editor.session import Library, Workspace
from vicode.editor.view.address import design_address
from vicode.model.names import is_name

Say = Callable[[str, str], None]


def design_url(workspace: Workspace, component: str) -> str:
    """Where a design is edited."""
    return design_address(workspace.key, component)


class DesignsList:
    """The designs; built anew when files come or go, or a design becomes saved or unsaved."""

    def __init__(self, library: Library, here: tuple[str, str], say: Say) -> None:
        """Build it; `here` is the project's key and the component that is open."""
        self.library, self.here, self.say = library, here, say
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
            icon_button("add", f"New design in {workspace.project.name}", _creator(workspace, self.say))
        for design in sorted(workspace.project.designs, key=lambda each: each.component.casefold()):
            self._design(workspace, design.component)
        for file in workspace.broken:
            with ui.row().classes("design-link is-broken"):
                ui.icon("error")
                ui.label(file)
                ui.tooltip(f"{file} cannot be read: run 'vicode check' for the places and mends")

    def _design(self, workspace: Workspace, component: str) -> None:
        is_here = self.here == (workspace.key, component)
        link = ui.link(target=design_url(workspace, component))
        link.classes("design-link" + (" is-open" if is_here else ""))
        if is_here:
            link.props('aria-current="page"')
        with link:
            ui.label(component)
            if component in workspace.unsaved:
                ui.label("●").classes("unsaved-mark").props('aria-label="unsaved" role="img"')


def _creator(workspace: Workspace, say: Say) -> Callable[[], None]:
    def ask() -> None:
        with titled_dialog("New design") as dialog:
            name = ui.input("Component", placeholder="FollowBall").props("outlined dense stack-label autofocus")

            def create() -> None:
                wanted = name.value.strip()
                if not is_name(wanted):
                    say("A component is named in letters, digits and underscores, such as FollowBall", "warning")
                elif workspace.project.interface(wanted) is not None:
                    say(f"There is already a component {wanted}", "warning")
                else:
                    workspace.create(wanted)
                    ui.navigate.to(design_url(workspace, wanted))

            name.on("keydown.enter", create)
            with ui.row().classes("dialog-buttons"):
                ui.button("Cancel", on_click=dialog.close).props("flat no-caps")
                primary_button("Create", create)

    return ask
