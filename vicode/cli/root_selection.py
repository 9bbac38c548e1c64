"""Selects the root component of a command that runs code, and checks that its code can be generated."""

import sys
from dataclasses import replace

from vicode.cli.console import print_findings
from vicode.findings import Finding
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


def find_root_component(opened: LoadedProject) -> str | None:
    """The component to run: the requested one, else the root of the only agent, else the only design."""
    if opened.selected_components is not None:
        return next(iter(opened.requested), None)
    roots = [agent.root for agent in opened.open_project.project.agents] or list(opened.selected_designs)
    return roots[0] if len(roots) == 1 else None


def find_unsynced_edits(opened: LoadedProject, component: str, language: str = "python") -> tuple[Finding, ...]:
    """Edits of generated code that are missing from the designs: the run would not contain them."""
    from vicode.cli.gen import output_folder
    from vicode.generators import generate
    from vicode.sync import GeneratedHistory, GenerationInput, describe_edits, plan_generation

    folder = output_folder(opened)
    if not folder.is_dir():
        return ()
    job = GenerationInput(
        project=opened.open_project.project,
        folder=folder,
        generate=lambda project: generate(
            project, components=[component], languages=[language], sources=opened.design_paths
        ),
        may_delete=False,
        history=GeneratedHistory(folder=folder, project_folder=opened.open_project.folder),
    )
    edits = plan_generation(job).edits
    certain = (replace(file, is_edited_outside=file.is_edited_outside and file.is_origin_known) for file in edits)
    return tuple(describe_edits(certain, folder.as_posix()))
