"""Prints the findings of XABSL behaviors, for several commands."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from vicode.cli.console import print_findings
from vicode.services.display_paths import with_display_paths

if TYPE_CHECKING:
    from vicode.findings import Finding
    from vicode.xabsl.source_loader import ProgramSource


def print_behavior_findings(
    findings: "Sequence[Finding]", agents: Path, encoding: str = "", *, to_stderr: bool = True
) -> None:
    print_findings(with_display_paths(findings, agents), to_stderr=to_stderr, encoding=encoding)


def print_encoding_doubts(source: "ProgramSource", agents: Path) -> None:
    """Warn of files that do not look like the encoding in which they were read."""
    from vicode.xabsl.behavior_loader import DOUBTFUL_ENCODING

    print_behavior_findings([each for each in source.findings if each.rule.code == DOUBTFUL_ENCODING], agents)
