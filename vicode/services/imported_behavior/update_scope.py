"""Decides which designs take part in an update: a design that cannot be written keeps its option as it was imported."""

from collections.abc import Collection, Iterable
from dataclasses import replace

from vicode.check import find_errors
from vicode.model.design import Design
from vicode.model.project import Project
from vicode.model.xabsl.names import component_name


class UpdateScope:
    """The project to write, without the edits of some designs.

    Args:
        imported: The project as it was imported.
        edited: The edited project.
        left_out: Components whose edits are not written.
    """

    def __init__(self, imported: Project, edited: Project, left_out: Collection[str]) -> None:
        self._imported = {component_name(design): design for design in imported.designs}
        self._edited = edited
        self.left_out = set(left_out)

    def leave_out(self, components: Iterable[str]) -> bool:
        """Leave out the edits of more designs; returns whether there were any."""
        added = set(components) - self.left_out
        self.left_out |= added
        return bool(added)

    def project(self) -> Project | None:
        """The project to write; None if what remains cannot be separated from the edits that are left out."""
        while True:
            project = self._without_edits()
            if project is None or not self.left_out:
                return project
            errors = find_errors(replace(project, languages=("xabsl",)))
            names = {finding.subject.component if finding.subject else "" for finding in errors}
            if not names:
                return project
            if "" in names or not self.leave_out(names | self._neighbors(project, names)):
                return None

    def _without_edits(self) -> Project | None:
        """The edited project with the imported versions of the designs that are left out; a new design is omitted."""
        kept = [design for design in self._edited.designs if design.component not in self.left_out]
        present = {component_name(design) for design in self._edited.designs}
        # An unreadable design is not in the project, and one with errors may be the renamed version of another.
        hidden = [name for name in self._imported if name not in present]
        replaced = [
            self._imported[component_name(design)]
            for design in self._edited.designs
            if design.component in self.left_out and component_name(design) in self._imported
        ]
        unread = [name for name, _file in self._edited.unreadable]
        restored = [self._imported[name] for name in hidden if self._imported[name].component in unread]
        has_new = any(self._is_new(design) and design.component in self.left_out for design in self._edited.designs)
        if has_new and len(hidden) > len(restored):
            return None
        return replace(self._edited, designs=(*kept, *replaced, *restored), unreadable=())

    def _is_new(self, design: Design) -> bool:
        return component_name(design) not in self._imported

    def _neighbors(self, project: Project, names: Collection[str]) -> set[str]:
        """The designs that use these ones or that these ones use."""
        found = set()
        for design in project.designs:
            used = {use.component for use in design.uses}
            found |= {design.component} if used & set(names) else set()
            found |= used if design.component in names else set()
        return found & {design.component for design in self._edited.designs}
