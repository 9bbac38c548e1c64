"""What the commands about XABSL share: compiling a behavior, and showing what is wrong with it."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.printing import print_findings

if TYPE_CHECKING:
    from vicode.findings import Finding
    from vicode.xabsl.compiler import Compiled


def compiled_behavior(agents: Path) -> "Compiled":
    """Compile the behavior whose agents are in this file."""
    from vicode.xabsl.compiler import compile_source
    from vicode.xabsl.sources import load

    return compile_source(load(agents))


def shown(findings: "Sequence[Finding]", agents: Path) -> "tuple[Finding, ...]":
    """Findings with the paths of files as they are seen from here."""
    folder = agents.parent
    return tuple(
        replace(each, place=replace(each.place, file=str(folder / each.place.file)) if each.place else None)
        for each in findings
    )


def tell(findings: "Sequence[Finding]", agents: Path, *, to_stderr: bool = True) -> None:
    """Print findings."""
    print_findings(shown(findings, agents), to_stderr=to_stderr)
