"""Selects the root component of a command that runs code, and checks that its code can be generated."""

import sys

from vicode.cli.console import print_findings
from vicode.findings import count_findings
from vicode.services.project_loader import LoadedProject, load_projects

_UNPROVIDED = ("P209", "P210")
"""Rules about components whose outputs nothing provides during the run."""


def select_root(
    path: str, profile: str, verb: str, language: str = "python", *, are_inputs_given: bool = False
) -> tuple[LoadedProject, str] | int:
    """The project and the root component of a path; the exit code, after the reason was printed, if there is none.

    Args:
        path: A design, or the folder of a project with one agent.
        profile: The profile, "" for none.
        verb: What the command does, such as "run".
        language: The language of the code.
        are_inputs_given: Whether components that have no implementation get their outputs in another way.

    Raises:
        OSError: The path cannot be read, or there is no such profile.
    """
    from vicode.services.root_component import find_root_component, find_unsynced_edits

    projects = load_projects([path], profile)
    if len(projects) > 1:
        print(f"vicode: {path} contains {len(projects)} projects; specify a design", file=sys.stderr)
        return 2
    opened = projects[0]
    errors = opened.errors_for(language)
    if language == "python":
        # Python would report a missing attribute or parameter only when a design uses it.
        errors += tuple(each for each in opened.findings if each.rule.code == "P212")
    if errors:
        print_findings(errors, to_stderr=True)
        print(f"vicode: cannot {verb} {path}: correct {count_findings(errors)} first", file=sys.stderr)
        return 1
    component = find_root_component(opened)
    if component is None:
        print(f"vicode: {path} has several components; specify the design to {verb}", file=sys.stderr)
        return 2
    if not are_inputs_given:
        print_findings((each for each in opened.findings if each.rule.code in _UNPROVIDED), to_stderr=True)
    edits = find_unsynced_edits(opened, component, language)
    if edits:
        print_findings(edits, to_stderr=True)
        return 1
    return opened, component
