"""Shows the files of a behavior in findings as paths from the working directory."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from vicode.findings import Finding


def with_display_paths(findings: Sequence[Finding], agents: Path) -> tuple[Finding, ...]:
    """Replace the paths in findings by paths relative to the working directory."""

    def shown(file: str) -> str:
        path = agents.parent / file
        if not path.is_absolute():
            return str(path)
        # Deferred: the store is slow to import.
        from vicode.store.projects import display_path

        return display_path(path)

    return tuple(
        replace(finding, location=replace(finding.location, file=shown(finding.location.file)))
        if finding.location
        else finding
        for finding in findings
    )
