"""Finds the root component to run, and the edits of its generated code that a run would not contain."""

from dataclasses import replace

from vicode.findings import Finding
from vicode.generators import generate
from vicode.services.generation.project_output import output_folder
from vicode.services.project_loader import LoadedProject
from vicode.sync import GeneratedHistory, GenerationInput, describe_edits, plan_generation


def find_root_component(opened: LoadedProject) -> str | None:
    """The component to run: the requested one, else the root of the only agent, else the only design."""
    if opened.selected_components is not None:
        return next(iter(opened.requested), None)
    roots = [agent.root for agent in opened.open_project.project.agents] or list(opened.selected_designs)
    return roots[0] if len(roots) == 1 else None


def find_unsynced_edits(opened: LoadedProject, component: str, language: str = "python") -> tuple[Finding, ...]:
    """Edits of generated code that are missing from the designs: the run would not contain them."""
    folder = output_folder(opened)
    if not folder.is_dir():
        return ()
    job = GenerationInput(
        project=opened.open_project.project,
        folder=folder,
        generate=lambda project: generate(
            project, components=[component], languages=[language], sources=opened.open_project.design_paths
        ),
        may_delete=False,
        history=GeneratedHistory(folder=folder, project_folder=opened.open_project.folder),
    )
    edits = plan_generation(job).edits
    certain = (replace(file, is_edited_outside=file.is_edited_outside and file.is_origin_known) for file in edits)
    return tuple(describe_edits(certain, folder.as_posix()))
