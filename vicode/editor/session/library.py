"""All projects below the folder that the editor was opened on."""

from dataclasses import dataclass, field
from pathlib import Path

from vicode.editor.session.overview import ProjectOverview
from vicode.editor.session.presence import UserDirectory
from vicode.editor.session.workspace import Workspace
from vicode.store import find_projects


@dataclass(eq=False)
class Library:
    """The projects of a folder, or the one project of a design file; `initial_design` is what to open first."""

    path: Path
    users: UserDirectory = field(init=False, default_factory=UserDirectory)
    workspaces: list[Workspace] = field(init=False)
    _overviews: dict[str, ProjectOverview] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        """Read them all."""
        found = find_projects(self.path)
        self.workspaces = [Workspace(each, _key(each, self.folder), self.users) for each in found]

    def workspace(self, key: str) -> Workspace | None:
        """The project of a key."""
        return next((each for each in self.workspaces if each.key == key), None)

    def overview(self, workspace: Workspace) -> ProjectOverview:
        """What the home page shows of a project, shared by all windows."""
        return self._overviews.setdefault(workspace.key, ProjectOverview(workspace))

    def ensure_project(self) -> Workspace:
        """The project of a folder that holds none yet."""
        if not self.workspaces:
            self.workspaces.append(Workspace(self.folder, _key(self.folder, self.folder), self.users))
        return self.workspaces[0]

    @property
    def folder(self) -> Path:
        """The folder that was opened, or that holds the file that was."""
        return self.path if self.path.is_dir() else self.path.parent

    @property
    def initial_design(self) -> tuple[Workspace, str] | None:
        """The design to open first: the file given, else the first agent's root, else any design."""
        for workspace in self.workspaces:
            component = workspace.component_in_file(self.path) if self.path.is_file() else None
            if component:
                return workspace, component
        for workspace in self.workspaces:
            for agent in workspace.project.agents:
                if workspace.project.design(agent.root) is not None:
                    return workspace, agent.root
        for workspace in self.workspaces:
            for design in workspace.project.designs:
                return workspace, design.component
        return None


def _key(project: Path, folder: Path) -> str:
    """A short name of a project in addresses."""
    inside = project if project.is_dir() else project.parent
    try:
        parts = inside.resolve().relative_to(folder.resolve()).parts
    except ValueError:
        parts = (inside.name,)
    return "~".join(parts) or folder.resolve().name
