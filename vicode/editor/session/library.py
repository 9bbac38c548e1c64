"""All projects in the folder that the editor was opened on."""

import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from vicode.editor.session.external_editor import ExternalEditor
from vicode.editor.session.presence import UserDirectory
from vicode.editor.session.project.overview import ProjectOverview
from vicode.editor.session.trust import trust_folder
from vicode.editor.session.workspace import Workspace
from vicode.output import remove_leftovers
from vicode.platform import state_folder
from vicode.samples import DEFAULT_SAMPLE, copy_sample
from vicode.services.running_robots.robot_link import RobotLink
from vicode.store import find_projects, folder_times

_SEARCH_INTERVAL_S = 2.0


@dataclass(eq=False)
class Library:
    """The projects in a folder, or the one project of a design file."""

    path: Path
    users: UserDirectory = field(init=False, default_factory=UserDirectory)
    robots: RobotLink = field(init=False, default_factory=RobotLink)
    workspaces: list[Workspace] = field(init=False)
    clock: Callable[[], float] = time.monotonic
    external_editor: ExternalEditor = field(default_factory=ExternalEditor)
    _next_search_s: float = field(init=False, default=0.0)
    _folder_times: frozenset[tuple[str, int]] = field(init=False, default=frozenset())
    _earlier_folder_times: frozenset[tuple[str, int]] = field(init=False, default=frozenset())
    _overviews: dict[str, ProjectOverview] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        self.workspaces = [self._open(folder) for folder in find_projects(self.path)]

    def find_new_projects(self) -> None:
        """Add the projects of folders that appeared, at most once per interval.

        Raises:
            OSError: The folder no longer exists.
        """
        if not self.path.is_dir() or self.clock() < self._next_search_s:
            return
        self._next_search_s = self.clock() + _SEARCH_INTERVAL_S
        times = folder_times(self.path)
        # Once more after each change: a file that appears may get its content later.
        if times == self._folder_times == self._earlier_folder_times:
            return
        self._earlier_folder_times, self._folder_times = self._folder_times, times
        known = {workspace.folder.resolve() for workspace in self.workspaces}
        self.workspaces += [self._open(folder) for folder in find_projects(self.path) if folder.resolve() not in known]

    def workspace(self, key: str) -> Workspace | None:
        return next((workspace for workspace in self.workspaces if workspace.key == key), None)

    def overview(self, workspace: Workspace) -> ProjectOverview:
        """The overview of a project, shared by all windows."""
        return self._overviews.setdefault(workspace.key, ProjectOverview(workspace))

    def ensure_project(self) -> Workspace:
        """The first project, created if the folder contains none."""
        if not self.workspaces:
            is_empty = not any(path for path in self.folder.iterdir() if not path.name.startswith("."))
            self.workspaces.append(self._open(self.folder))
            # All code of this folder will be written here; after a restart, nobody knows.
            self.workspaces[0].is_trusted = is_empty
        return self.workspaces[0]

    def remove_leftovers(self) -> None:
        """Remove the temporary files that a killed editor left beside designs and generated files."""
        for workspace in self.workspaces:
            generated = (workspace.output_folder, *workspace.output_folder.rglob("*/"))
            for folder in {workspace.folder, *(file.parent for file in workspace.files.values()), *generated}:
                remove_leftovers(folder)

    def add_sample(self) -> Workspace:
        """Copy the default sample into the opened folder and return its project.

        Raises:
            OSError: The folder cannot be written, or already contains another folder with the name of the sample.
        """
        target = self.folder / DEFAULT_SAMPLE
        copy_sample(DEFAULT_SAMPLE, target)
        added = self._open(target)
        added.is_trusted = True
        with suppress(OSError):
            trust_folder(state_folder(), target)
        self.workspaces.append(added)
        return added

    def _open(self, folder: Path) -> Workspace:
        return Workspace(folder, _key(folder, self.folder), self.users, self.robots)

    @property
    def folder(self) -> Path:
        """The opened folder, or the folder of the opened file."""
        return self.path if self.path.is_dir() else self.path.parent

    def find_initial_design(self, preferred: str = "") -> tuple[Workspace, str] | None:
        """The design to open first: the given file, else `preferred`, else the root of the first agent, else any."""
        for workspace in self.workspaces:
            component = workspace.component_in_file(self.path) if self.path.is_file() else None
            if component:
                return workspace, component
        for workspace in self.workspaces:
            if workspace.project.design(preferred) is not None:
                return workspace, preferred
        for workspace in self.workspaces:
            for agent in workspace.project.agents:
                if workspace.project.design(agent.root) is not None:
                    return workspace, agent.root
        for workspace in self.workspaces:
            for design in workspace.project.designs:
                return workspace, design.component
        return None


def _key(project: Path, folder: Path) -> str:
    """The name of a project in URLs."""
    root = project if project.is_dir() else project.parent
    try:
        parts = root.resolve().relative_to(folder.resolve()).parts
    except ValueError:
        parts = (root.name,)
    return "~".join(parts) or folder.resolve().name
